"""The compilers of GPUs that .ci/gpu_tools fetches: what each makes of a program, kernel by kernel. To add one: a
function like `nvidia`, and its line in `available`."""
import collections
import os
import re
import shutil
import subprocess

FOLDER = os.path.abspath("build/gpu")
DEBIAN = os.path.join(FOLDER, "debian/usr")

# A number is None where the compiler does not tell it.
Row = collections.namedtuple("Row", "program kernel registers private spills instructions doubles")

# A program's text: the options that it is built with, the file that holds it, the kernels that it is built for.
Source = collections.namedtuple("Source", "options file kernels")


def run(words, **options):
    return subprocess.run(words, capture_output=True, text=True, check=False, **options)


def skip(reason):
    print(f"skipped: {reason}")


def own_kernels(text):
    """The kernels of the file that a program is named after, without those of the files that it includes. Lines
    `#line N "FILE"` tell which file is which."""
    parts = re.split(r'^#line \d+ "([^"]*)"\n', text, flags=re.M)[1:]
    own = "".join(body for name, body in zip(parts[::2], parts[1::2]) if name == parts[0])
    pattern = re.compile(r"^kernel\b[^;{]*?\bvoid\s+(\w+)\(", re.M)
    return pattern.findall(own) or pattern.findall(text)


def read_source(name):
    with open(name, encoding="utf-8") as file:
        options, text = file.readline()[2:].split(), file.read()
    return Source(options, name, own_kernels(text))


def clang():
    """Debian's clang that libclc was made for."""
    return shutil.which("clang-15") or shutil.which("clang")


def compile_for(target, processor, library, source, out):
    command = [clang(), "-x", "cl", "-cl-std=CL1.2", "-w", "-O3", "-target", target, *processor, "-Xclang",
               "-finclude-default-header", "-Xclang", "-mlink-builtin-bitcode", "-Xclang",
               os.path.join(DEBIAN, "lib/clc", library), *source.options, "-S", source.file, "-o", out]
    done = run(command)
    if done.returncode:
        skip(f"{target}: {done.stderr.strip().splitlines()[0]}")
    return done.returncode == 0


# --- NVIDIA: sm_86, consumer GPUs of 2020 ---

def nvidia_code(sass):
    """Each kernel's instructions."""
    found, name = {}, None
    for line in sass.splitlines():
        begun = re.match(r"\.text\.(\w+):", line)
        name = begun[1] if begun else name
        instruction = re.match(r"\s+/\*[0-9a-f]+\*/\s+(?:@!?U?P\w+\s+)?([A-Z0-9_.]+)", line)
        if name and instruction:
            found.setdefault(name, []).append(instruction[1])
    return found


def nvidia(program, source, folder):
    ptx, cubin = os.path.join(folder, "a.ptx"), os.path.join(folder, "a.cubin")
    if not compile_for("nvptx64-nvidia-nvcl", ["-march=sm_86", "-Xclang", "-target-feature", "-Xclang", "+ptx72"],
                       "nvptx64--nvidiacl.bc", source, ptx):
        return
    # rectray asks NVIDIA's platform for so few registers, in all programs of the kernel for GPUs.
    limit = ["-maxrregcount", "128"] if program.startswith("gpu") else []
    done = run([os.path.join(FOLDER, "nvidia/ptxas"), "-v", "-arch=sm_86", *limit, ptx, "-o", cubin])
    if done.returncode:
        skip(f"ptxas: {done.stderr.strip().splitlines()[0]}")
        return
    code = nvidia_code(run([os.path.join(FOLDER, "nvidia/nvdisasm"), "-c", cubin]).stdout)
    for kernel, text in re.findall(r"Compiling entry function '(\w+)'(.*?)(?=Compiling entry|\Z)", done.stderr, re.S):
        frame = r"(\d+) bytes stack frame, (\d+) bytes spill stores, (\d+) bytes"
        stack, stores, loads = (int(number) for number in re.search(frame, text).groups())
        registers = int(re.search(r"Used (\d+) registers", text)[1])
        instructions = code.get(kernel, [])
        doubles = sum(1 for name in instructions if re.match(r"D[A-Z]+|F2F\.F(64\.F32|32\.F64)|[FI]2[FI]\.F64", name))
        yield Row(program, kernel, registers, stack, stores + loads, len(instructions), doubles)


# --- AMD: gfx1030, consumer GPUs of 2020 ---

def amd_code(text):
    """The instructions of each function, and the functions that it calls."""
    found = {}
    for name, body in re.findall(r"^(\w+):[^\n]*; @\1\n(.*?)^\.Lfunc_end", text, re.M | re.S):
        instructions = re.findall(r"^\t([vsdfgb][a-z]*_\w+)", body, re.M)
        found[name] = instructions, set(re.findall(r"(\w+)@rel32@lo", body))
    return found


def amd_reached(code, kernel):
    """The instructions of a kernel and of all functions that it calls, each function once."""
    waiting, seen = [kernel], set()
    while waiting:
        name = waiting.pop()
        if name in code and name not in seen:
            seen.add(name)
            waiting += code[name][1]
    return [instruction for name in seen for instruction in code[name][0]]


def amd(program, source, folder):
    assembly = os.path.join(folder, "a.s")
    if not compile_for("amdgcn-amd-amdhsa", ["-mcpu=gfx1030", "-nogpulib"], "amdgcn--amdhsa.bc", source, assembly):
        return
    with open(assembly, encoding="utf-8") as file:
        text = file.read()
    code = amd_code(text)
    for block in re.split(r"\n  - \.args:", text)[1:]:
        value = dict(re.findall(r"\.(\w+): +(\S+)", block))
        instructions = amd_reached(code, value["name"])
        doubles = sum("f64" in name for name in instructions)
        yield Row(program, value["name"], int(value["vgpr_count"]), int(value["private_segment_fixed_size"]),
                  int(value["vgpr_spill_count"]), len(instructions), doubles)


# --- Intel: skl, whose GPUs know double ---

def intel(program, source, folder):
    libraries = os.path.join(DEBIAN, "lib/x86_64-linux-gnu")
    environment = dict(os.environ, LD_LIBRARY_PATH=f"{libraries}:{libraries}/intel-opencl")
    done = run([os.path.join(DEBIAN, "bin/ocloc"), "compile", "-file", source.file, "-device", "skl", "-out_dir",
                folder, "-output", "intel", "-options", " ".join(["-cl-std=CL1.2", *source.options])], env=environment)
    text = done.stdout + done.stderr
    if done.returncode:
        skip(f"ocloc: {text.strip().splitlines()[-1]}")
        return
    for kernel in source.kernels:
        spilled = re.search(rf"kernel {kernel}\s.*?spilled around (\d+)", text)
        yield Row(program, kernel, None, None, int(spilled[1]) if spilled else 0, None, None)


def available():
    """The compilers that are here: each one's name, what its table is called, and what makes its rows."""
    libclc = os.path.exists(os.path.join(DEBIAN, "lib/clc/nvptx64--nvidiacl.bc"))
    if not clang() or not libclc:
        skip("NVIDIA and AMD: clang or libclc is not there")
    elif not os.path.exists(os.path.join(FOLDER, "nvidia/ptxas")):
        skip("NVIDIA: ptxas is not there")
    else:
        yield "sm_86", "NVIDIA sm_86: spills in bytes", nvidia
    if clang() and libclc:
        yield "gfx1030", "AMD gfx1030: registers are VGPRs, spills too", amd
    if os.path.exists(os.path.join(DEBIAN, "bin/ocloc")):
        yield "skl", "Intel skl: spills only are told", intel
    else:
        skip("Intel: ocloc is not there")
