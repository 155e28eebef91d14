"""What a machine with a GPU can say of the kernel for GPUs, in at most 8 minutes: `rectray devices --check`, the suites
that render, a short stress suite, and a ladder of scenes on the GPU, on the processor and by the reference. Nothing is
fetched; what is missing is told. Results: build/gpu-check.json and build/gpu-check.md.
Usage: check.py RECTRAY [SHIM]    SHIM: OpenCL's first device poses as a GPU, to try this script without one"""
import glob
import json
import os
import subprocess
import sys
import tempfile
import time

import bandwidth

SECONDS = 8 * 60
LADDER = {
    "original": ["scenes/original.json"],
    "cornell": ["scenes/cornell.json"],
    "gallery": ["scenes/gallery.json"],
    "menger-3": ["menger", "3"],
    "city of 10 k": ["city", "1667"],
}
SIZE, SMALL = "1920x1080", "480x270"
REPEATS = 5

# What a search reads: a node's boxes and children, a face.
NODE_BYTES, NODE_BOXES, FACE_BYTES, PIXEL_BYTES = 112, 4, 64, 3


class Check:
    def __init__(self, rectray, shim):
        self.rectray, self.shim = rectray, shim
        self.begun = time.monotonic()
        self.found = {"missing": [], "ladder": [], "suites": {}}

    def left(self):
        return SECONDS - (time.monotonic() - self.begun)

    def miss(self, what):
        print(f"missing: {what}", flush=True)
        self.found["missing"].append(what)

    def run(self, words, most, **environment):
        """The finished command; None where it took too long or time is up."""
        allowed = min(most, self.left() - 5)
        if allowed <= 0:
            self.miss(f"{' '.join(words[:4])}: the {SECONDS // 60} minutes are over")
            return None
        try:
            return subprocess.run(words, capture_output=True, text=True, timeout=allowed, check=False,
                                  env=dict(os.environ, **environment))
        except subprocess.TimeoutExpired:
            self.miss(f"{' '.join(words[:4])}: not done after {allowed:.0f} s")
            return None

    # --- Devices ---

    def listed(self, **environment):
        done = self.run([self.rectray, "devices", "--json"], 60, **environment)
        return json.loads(done.stdout)["devices"] if done and done.returncode == 0 else []

    def find_gpu(self):
        """The environment in which a GPU is device 0, and in which PoCL is; None: there is none."""
        if self.shim:
            return {"LD_PRELOAD": self.shim, "SHIM_GPU": "1"}, {}
        gpu = cpu = None
        for vendor in sorted(glob.glob("/etc/OpenCL/vendors/*.icd")):
            for device in self.listed(OCL_ICD_VENDORS=vendor)[:1]:
                if device["type"] == "GPU":
                    gpu = gpu or {"OCL_ICD_VENDORS": vendor}
                elif device["type"] == "CPU":
                    cpu = cpu or {"OCL_ICD_VENDORS": vendor}
        return gpu, cpu

    def check_device(self, gpu):
        done = self.run([self.rectray, "devices", "--check", "0", "--json"], 150, **gpu)
        self.found["check"] = json.loads(done.stdout) if done and done.stdout else None
        if self.found["check"]:
            print(f"devices --check: {self.found['check']['verdict']}", flush=True)

    def measure_bandwidth(self, gpu):
        """In a process of its own: a loader reads its environment once."""
        done = self.run([sys.executable, bandwidth.__file__], 30, **gpu)
        if done and done.returncode == 0:
            self.found["bandwidth"] = float(done.stdout)
        else:
            self.miss("the peak bandwidth, which decides nothing else")

    # --- Suites ---

    def suite(self, name, words, most, gpu):
        done = self.run(words, most, **gpu)
        passed = None if done is None else done.returncode == 0
        self.found["suites"][name] = {"passed": passed, "end": "" if done is None else done.stdout[-300:]}
        print(f"{name}: {'not done' if passed is None else 'passed' if passed else 'FAILED'}", flush=True)

    def suites(self, gpu):
        for name in ("gpu", "backends"):
            program = os.path.join(os.path.dirname(self.rectray), "tests", f"test_{name}")
            if os.path.exists(program):
                self.suite(name, [program], 120, gpu)
            else:
                self.miss(f"the suite {name}, which was not built: Unity, or a compiler for it, is not there")
        stress = os.path.join(os.path.dirname(self.rectray), "stress")
        if os.path.exists(stress):
            self.suite("stress", [stress, "--seed", "1", "--scale", "0.02"], 90, gpu)
        else:
            self.miss("the stress suite, which was not built: it needs GMP (libgmp-dev)")

    # --- The ladder ---

    def measure(self, scene, size, words, environment, repeats):
        """The report of the quickest picture."""
        best = None
        for _ in range(repeats):
            done = self.run([self.rectray, "render", scene, "-q", "--stats=json", "--size", size, "--sampling",
                             "uniform:1", *words, "-o", self.picture], 60, **environment)
            if done is None or done.returncode:
                return best
            report = json.loads(done.stdout)
            if best is None or report["phases_ms"]["trace"] < best["phases_ms"]["trace"]:
                best = report
        return best

    def row(self, name, who, size, report, peak):
        if report is None:
            return
        ms, columns, rows = report["phases_ms"]["trace"], *(int(number) for number in size.split("x"))
        rays = sum(report["rays"].values())
        read = (report["tests"]["box"] / NODE_BOXES * NODE_BYTES + report["tests"]["face"] * FACE_BYTES +
                columns * rows * PIXEL_BYTES)
        row = {"scene": name, "by": who, "size": size, "kernel": report.get("kernel", "-"), "ms": ms, "rays": rays,
               "rays_per_second": rays / ms * 1000 if ms else None, "exact_pixels": report.get("exact_pixels")}
        if peak and ms and who == "GPU":
            row["share_of_bandwidth"] = read / ms * 1000 / peak
        self.found["ladder"].append(row)
        print(f"{name}, {who}: {ms:.2f} ms", flush=True)

    def ladder(self, gpu, cpu, folder):
        self.picture = os.path.join(folder, "a.png")
        peak = self.found["bandwidth"]
        for name, made in LADDER.items():
            scene = made[0]
            if len(made) > 1:
                scene = os.path.join(folder, f"{made[0]}.json")
                self.run([self.rectray, "generate", made[0], "--size", made[1], "-o", scene], 60)
            self.row(name, "GPU", SIZE, self.measure(scene, SIZE, ["--accel", "bvh"], gpu, REPEATS), peak)
            if cpu is not None:
                self.row(name, "processor", SIZE, self.measure(scene, SIZE, [], cpu, REPEATS), peak)
            self.row(name, "reference", SMALL, self.measure(scene, SMALL, ["--backend", "reference"], {}, 1), peak)

    # --- All of it ---

    def markdown(self):
        check = self.found["check"]
        device = check["device"]["name"] if check else "no device"
        posed = ", which only poses as a GPU" if self.shim else ""
        lines = [f"`make gpu-check` on {device}{posed}:", "",
                 "| scene | by | size | ms | million rays/s | share of peak bandwidth | pixels done exactly |",
                 "| --- | --- | --- | --- | --- | --- | --- |"]
        for row in self.found["ladder"]:
            rate, share = row["rays_per_second"], row.get("share_of_bandwidth")
            exact = row["exact_pixels"]
            lines.append(f"| {row['scene']} | {row['by']} | {row['size']} | {row['ms']:.2f} | "
                         f"{rate / 1e6 if rate else 0:.1f} | {f'{share:.0%}' if share else '-'} | "
                         f"{'-' if exact is None else exact} |")
        lines += ["", "devices --check: " + (check["verdict"] if check else "not done")]
        lines += [f"suite {name}: " + {None: "not done", True: "passed", False: "FAILED"}[suite["passed"]]
                  for name, suite in self.found["suites"].items()]
        lines += [f"missing: {what}" for what in self.found["missing"]]
        return "\n".join(lines) + "\n"

    def write(self):
        base = os.path.join(os.path.dirname(self.rectray), "gpu-check")
        self.found["seconds"] = round(time.monotonic() - self.begun)
        with open(base + ".json", "w", encoding="utf-8") as file:
            json.dump(self.found, file, indent=1)
        with open(base + ".md", "w", encoding="utf-8") as file:
            file.write(self.markdown())
        print(f"\n{self.markdown()}\nThe results are {base}.json and {base}.md ({self.found['seconds']} s)")

    def all(self):
        gpu, cpu = self.find_gpu()
        self.found.update(check=None, bandwidth=None, posed=bool(self.shim))
        if gpu is None:
            self.miss("a GPU: OpenCL lists none. `rectray devices` shows what there is")
            self.write()
            return 1
        os.environ["RECTRAY_CACHE_DIR"] = os.path.join(os.path.dirname(self.rectray), "gpu-check-cache")
        self.check_device(gpu)
        self.measure_bandwidth(gpu)
        with tempfile.TemporaryDirectory() as folder:
            self.ladder(gpu, cpu, folder)
        self.suites(gpu)
        self.write()
        right = self.found["check"] and self.found["check"]["wrong"] == 0
        failed = any(suite["passed"] is False for suite in self.found["suites"].values())
        return 0 if right and not failed else 1


if __name__ == "__main__":
    sys.exit(Check(os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]) if len(sys.argv) > 2 else None).all())
