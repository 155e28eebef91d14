"""What the compilers of GPUs make of the kernels: registers, private memory, spills, arithmetic in double. No GPU is
needed. The texts are those that rectray gives to OpenCL, which tests/shims/opencl_device.c writes down; the compilers
are those of .ci/gpu_tools. Executed instructions are counted by valgrind in what PoCL compiles with one lane.
Usage: report.py RECTRAY SHIM [--counts]"""
import collections
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile

FOLDER = os.path.abspath("build/gpu")
DEBIAN = os.path.join(FOLDER, "debian/usr")
SCENE = "scenes/cornell.json"
UNIFORM = ["--sampling", "uniform:1"]
ONE_LANE = ["--lanes", "1", "--kernel", "packet"]

# The programs that a GPU would be given, and what makes rectray build them.
PROGRAMS = {
    "packet, 1 lane": ONE_LANE + UNIFORM,
    "packet, 1 lane, adaptive": ONE_LANE + ["--sampling", "adaptive:4"],
    "plain": ["--kernel", "plain"] + UNIFORM,
    "gpu": ["--kernel", "gpu"] + UNIFORM,
}

Row = collections.namedtuple("Row", "program kernel registers private spills instructions doubles")


def run(words, **options):
    return subprocess.run(words, capture_output=True, text=True, **options)


def skip(reason):
    print(f"skipped: {reason}")


def sources(rectray, shim, words, folder):
    """The programs that rectray builds for these words: (options, file)."""
    environment = dict(os.environ, LD_PRELOAD=shim, SHIM_SOURCES=folder, RECTRAY_CACHE_DIR="")
    done = run([rectray, "render", SCENE, "-q", "--accel", "bvh", "--size", "8x8", *words, "-o",
                os.path.join(folder, "a.png")], env=environment)
    if done.returncode:
        skip(f"render {' '.join(words)}: {done.stderr.strip()}")
    for name in sorted(glob.glob(os.path.join(folder, "*.cl"))):
        with open(name, encoding="utf-8") as file:
            yield file.readline()[2:].split(), name


def clang():
    """Debian's clang that libclc was made for."""
    return shutil.which("clang-15") or shutil.which("clang")


def compile_for(target, processor, library, words, source, out):
    command = [clang(), "-x", "cl", "-cl-std=CL1.2", "-w", "-O3", "-target", target, *processor, "-Xclang",
               "-finclude-default-header", "-Xclang", "-mlink-builtin-bitcode", "-Xclang",
               os.path.join(DEBIAN, "lib/clc", library), *words, "-S", source, "-o", out]
    done = run(command)
    if done.returncode:
        skip(f"{target}: {done.stderr.strip().splitlines()[0]}")
    return done.returncode == 0


# --- NVIDIA: sm_86, consumer GPUs of 2020 ---

def code_of(sass):
    """Each kernel's instructions."""
    found, name = {}, None
    for line in sass.splitlines():
        begun = re.match(r"\.text\.(\w+):", line)
        name = begun[1] if begun else name
        instruction = re.match(r"\s+/\*[0-9a-f]+\*/\s+(?:@!?U?P\w+\s+)?([A-Z0-9_.]+)", line)
        if name and instruction:
            found.setdefault(name, []).append(instruction[1])
    return found


def nvidia(program, words, source, folder):
    ptx, cubin = os.path.join(folder, "a.ptx"), os.path.join(folder, "a.cubin")
    if not compile_for("nvptx64-nvidia-nvcl", ["-march=sm_86", "-Xclang", "-target-feature", "-Xclang", "+ptx72"],
                       "nvptx64--nvidiacl.bc", words, source, ptx):
        return
    with open(source, encoding="utf-8") as file:
        is_gpu = '"gpu.cl"' in file.read(1000)  # rectray asks NVIDIA's platform for so few registers
    limit = ["-maxrregcount", "128"] if is_gpu else []
    done = run([os.path.join(FOLDER, "nvidia/ptxas"), "-v", "-arch=sm_86", *limit, ptx, "-o", cubin])
    if done.returncode:
        skip(f"ptxas: {done.stderr.strip().splitlines()[0]}")
        return
    code = code_of(run([os.path.join(FOLDER, "nvidia/nvdisasm"), "-c", cubin]).stdout)
    for kernel, text in re.findall(r"Compiling entry function '(\w+)'(.*?)(?=Compiling entry|\Z)", done.stderr, re.S):
        frame = r"(\d+) bytes stack frame, (\d+) bytes spill stores, (\d+) bytes"
        stack, stores, loads = re.search(frame, text).groups()
        registers = re.search(r"Used (\d+) registers", text)[1]
        instructions = code.get(kernel, [])
        doubles = sum(1 for name in instructions if re.match(r"D[A-Z]+|F2F\.F(64\.F32|32\.F64)|[FI]2[FI]\.F64", name))
        yield Row(program, kernel, registers, stack, int(stores) + int(loads), len(instructions), doubles)


# --- AMD: gfx1030, consumer GPUs of 2020 ---

def amd(program, words, source, folder):
    assembly = os.path.join(folder, "a.s")
    processor = ["-mcpu=gfx1030", "-nogpulib"]
    if not compile_for("amdgcn-amd-amdhsa", processor, "amdgcn--amdhsa.bc", words, source, assembly):
        return
    with open(assembly, encoding="utf-8") as file:
        text = file.read()
    for block in re.split(r"\n  - \.args:", text)[1:]:
        value = dict(re.findall(r"\.(\w+): +(\S+)", block))
        kernel = value["name"]
        instructions = re.findall(r"^\t([vsdfgb][a-z]*_\w+)", text, re.M)  # with all functions that it calls
        doubles = sum("f64" in name for name in instructions)
        yield Row(program, kernel, value["vgpr_count"], value["private_segment_fixed_size"],
                  int(value["vgpr_spill_count"]), len(instructions), doubles)


# --- Intel: skl, whose GPUs know double ---

def intel(program, words, source, folder):
    libraries = os.path.join(DEBIAN, "lib/x86_64-linux-gnu")
    environment = dict(os.environ, LD_LIBRARY_PATH=f"{libraries}:{libraries}/intel-opencl")
    done = run([os.path.join(DEBIAN, "bin/ocloc"), "compile", "-file", source, "-device", "skl", "-out_dir", folder,
                "-output", "intel", "-options", " ".join(["-cl-std=CL1.2", *words])], env=environment)
    text = done.stdout + done.stderr
    if done.returncode:
        skip(f"ocloc: {text.strip().splitlines()[-1]}")
        return
    with open(source, encoding="utf-8") as file:
        kernels = re.findall(r"^kernel[^(]*?(\w+)\(", file.read(), re.M)
    for kernel in kernels:
        spilled = re.search(rf"{kernel}\W.*?spilled around (\d+)", text)
        yield Row(program, kernel, "-", "-", spilled[1] if spilled else 0, "-", "-")


def table(title, rows):
    print(f"\n### {title}\n")
    print("| program | kernel | registers | private bytes | spills | instructions | of them in double |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for row in rows:
        print("| " + " | ".join(str(value) for value in row) + " |")


def available():
    """The compilers that are here: how a table is called, and what makes its rows."""
    libclc = os.path.exists(os.path.join(DEBIAN, "lib/clc/nvptx64--nvidiacl.bc"))
    if not clang() or not libclc:
        skip("NVIDIA and AMD: clang or libclc is not there")
    elif not os.path.exists(os.path.join(FOLDER, "nvidia/ptxas")):
        skip("NVIDIA: ptxas is not there")
    else:
        yield "NVIDIA sm_86: spills in bytes", nvidia
    if clang() and libclc:
        yield "AMD gfx1030: registers are VGPRs, spills too", amd
    if os.path.exists(os.path.join(DEBIAN, "bin/ocloc")):
        yield "Intel skl: spills only are told", intel
    else:
        skip("Intel: ocloc is not there")


# --- Executed instructions ---

COUNTED = {
    "original": ["scenes/original.json"],
    "gallery": ["scenes/gallery.json"],
    "city of 10 k": ["city", "1667"],
    "menger-3": ["menger", "3"],
}


def executed(rectray, scene, words, size, folder):
    """Instructions of the kernels' own code, in what PoCL compiled: those of its shared objects."""
    out = os.path.join(folder, "callgrind.out")
    environment = dict(os.environ, POCL_MAX_PTHREAD_COUNT="1", RECTRAY_CACHE_DIR=os.path.join(FOLDER, "cache"))
    render = [rectray, "render", scene, "-q", "--accel", "bvh", "--size", size, "--threads", "1", *words, "-o",
              os.path.join(folder, "a.png")]
    run(["valgrind", "--tool=none", *render], env=environment)  # compiles the kernel, in less time, and keeps it
    done = run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", "--compress-strings=no",
                "--compress-pos=no", *render], env=environment)
    if done.returncode:
        skip(f"valgrind: {done.stderr.strip().splitlines()[-1]}")
        return None
    total, inside = 0, False
    with open(out, encoding="utf-8", errors="replace") as file:
        calls = False
        for line in file:
            if line.startswith("ob="):
                inside = "_workgroup" in line or "/tempfile" in line or "pocl" in line and "libpocl" not in line
            elif line.startswith("calls="):
                calls = True
            elif calls:
                calls = False
            elif inside and line[:1].isdigit() or inside and line[:1] in "+-*":
                total += int(line.split()[1])
    return total


def make_scene(rectray, words, folder):
    if len(words) == 1:
        return words[0]
    path = os.path.join(folder, f"{words[0]}.json")
    run([rectray, "generate", words[0], "--size", words[1], "-o", path])
    return path


def counts(rectray, folder, sizes=((96, 54), (192, 108))):
    print("\n### Instructions per pixel, counted by valgrind in what PoCL compiles\n")
    print("| scene | " + " | ".join(PROGRAMS) + " |\n" + "| --- " * (1 + len(PROGRAMS)) + "|")
    for name, made in COUNTED.items():
        scene = make_scene(rectray, made, folder)
        cells = []
        for words in PROGRAMS.values():
            small, large = (executed(rectray, scene, words, f"{c}x{r}", folder) for c, r in sizes)
            pixels = sizes[1][0] * sizes[1][1] - sizes[0][0] * sizes[0][1]
            cells.append(str(round((large - small) / pixels)) if small and large else "-")
        print(f"| {name} | " + " | ".join(cells) + " |", flush=True)


def main():
    rectray, shim = (os.path.abspath(word) for word in sys.argv[1:3])
    compilers = list(available())
    rows = {title: [] for title, _ in compilers}
    for program, words in PROGRAMS.items():
        with tempfile.TemporaryDirectory() as folder:
            for options, source in list(sources(rectray, shim, words, folder)):
                for title, compiler in compilers:
                    rows[title] += list(compiler(program, options, source, folder))
    for title, found in rows.items():
        table(title, found)
    if "--counts" in sys.argv:
        if shutil.which("valgrind"):
            with tempfile.TemporaryDirectory() as folder:
                counts(rectray, folder)
        else:
            skip("instructions per pixel: valgrind is not there")


if __name__ == "__main__":
    main()
