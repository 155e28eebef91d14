"""What a machine with a GPU can say of the kernel for GPUs, in at most 8 minutes: `rectray devices --check`, the suites
that render, a short stress suite, and a ladder of scenes on the GPU, on the processor and by the reference. Nothing is
fetched. Each step has a budget, and what is missing or did not fit is told. Whatever happens, the results are written:
OUT.json and OUT.md, build/gpu-check by default.
Usage: check.py [--pose SHIM] [--seconds N] [--out OUT] RECTRAY
    --pose      OpenCL's first device poses as a GPU, to try this script without one
    --seconds   how long it may take"""
import argparse
import glob
import json
import os
import signal
import subprocess
import sys
import tempfile
import time

import bandwidth

SECONDS, RESERVE = 8 * 60, 2  # RESERVE: to write the results
MOST = {"list": 20, "check": 120, "bandwidth": 20, "suite": 75, "scene": 15, "picture": 30}  # seconds for a step
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
    def __init__(self, options):
        self.rectray, self.shim = os.path.abspath(options.rectray), options.pose and os.path.abspath(options.pose)
        self.seconds, self.begun = options.seconds, time.monotonic()
        self.out = options.out or os.path.join(os.path.dirname(self.rectray), "gpu-check")
        self.found = {"posed": bool(self.shim), "check": None, "bandwidth": None, "missing": [], "ladder": [],
                      "suites": {}}

    def left(self):
        return self.seconds - RESERVE - (time.monotonic() - self.begun)

    def miss(self, what):
        print(f"missing: {what}", flush=True)
        self.found["missing"].append(what)

    def run(self, name, words, most, **environment):
        """The finished command; None where it took too long or time is up. name: what is told then."""
        allowed = min(most, self.left())
        if allowed <= 0:
            self.miss(f"{name}: the {self.seconds:g} seconds are over")
            return None
        try:
            return subprocess.run(words, capture_output=True, text=True, timeout=allowed, check=False,
                                  env=dict(os.environ, **environment))
        except subprocess.TimeoutExpired:
            self.miss(f"{name}: not done after {allowed:.0f} s")
        except OSError as error:
            self.miss(f"{name}: {error.strerror}")
        return None

    def report(self, name, words, most, **environment):
        """What the command tells as JSON; None where it tells nothing."""
        done = self.run(name, words, most, **environment)
        if done is None:
            return None
        try:
            return json.loads(done.stdout)
        except ValueError:
            why = (done.stderr.strip() or "it tells nothing").splitlines()[-1]
            self.miss(f"{name}: status {done.returncode}, {why}")
            return None

    # --- Devices ---

    def listed(self, **environment):
        report = self.report("the list of devices", [self.rectray, "devices", "--json"], MOST["list"], **environment)
        return report["devices"] if report else []

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
        words = [self.rectray, "devices", "--check", "0", "--json"]
        self.found["check"] = self.report("devices --check", words, MOST["check"], **gpu)
        if self.found["check"]:
            print(f"devices --check: {self.found['check']['verdict']}", flush=True)

    def measure_bandwidth(self, gpu):
        """In a process of its own: a loader reads its environment once."""
        done = self.run("the peak bandwidth", [sys.executable, bandwidth.__file__], MOST["bandwidth"], **gpu)
        if done and done.returncode == 0:
            self.found["bandwidth"] = float(done.stdout)
        elif done:
            self.miss("the peak bandwidth, which decides nothing else")

    # --- Suites ---

    def suite(self, name, words, gpu):
        done = self.run(f"suite {name}", words, MOST["suite"], **gpu)
        passed = None if done is None else done.returncode == 0
        self.found["suites"][name] = {"passed": passed, "end": "" if done is None else done.stdout[-300:]}
        print(f"{name}: {'not done' if passed is None else 'passed' if passed else 'FAILED'}", flush=True)

    def suites(self, gpu):
        for name in ("gpu", "backends"):
            program = os.path.join(os.path.dirname(self.rectray), "tests", f"test_{name}")
            if os.path.exists(program):
                self.suite(name, [program], gpu)
            else:
                self.miss(f"the suite {name}, which was not built: Unity, or a compiler for it, is not there")
        stress = os.path.join(os.path.dirname(self.rectray), "stress")
        if os.path.exists(stress):
            self.suite("stress", [stress, "--seed", "1", "--scale", "0.02"], gpu)
        else:
            self.miss("the stress suite, which was not built: it needs GMP (libgmp-dev)")

    # --- The ladder ---

    def measure(self, name, words, environment, repeats):
        """The report of the quickest picture, of as many as fit into the budget."""
        best, begun = None, time.monotonic()
        for _ in range(repeats):
            report = self.report(name, [self.rectray, "render", *words, "-q", "--stats=json", "--sampling",
                                        "uniform:1", "-o", self.picture], MOST["picture"], **environment)
            if report is None:
                break
            if best is None or report["phases_ms"]["trace"] < best["phases_ms"]["trace"]:
                best = report
            if time.monotonic() - begun > MOST["scene"]:
                break
        return best

    def row(self, name, who, words, environment):
        size, repeats = (SMALL, 1) if who == "reference" else (SIZE, REPEATS)
        report = self.measure(f"{name}, {who}", [*words, "--size", size], environment, repeats)
        peak = self.found["bandwidth"]
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
        for name, made in LADDER.items():
            scene = made[0]
            if len(made) > 1:
                scene = os.path.join(folder, f"{made[0]}.json")
                self.run(f"{name}, the scene", [self.rectray, "generate", made[0], "--size", made[1], "-o", scene],
                         MOST["scene"])
            self.row(name, "GPU", [scene, "--accel", "bvh"], gpu)
            if cpu is not None:
                self.row(name, "processor", [scene], cpu)
            self.row(name, "reference", [scene, "--backend", "reference"], {})

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
        self.found["seconds"] = round(time.monotonic() - self.begun)
        with open(self.out + ".json", "w", encoding="utf-8") as file:
            json.dump(self.found, file, indent=1)
        with open(self.out + ".md", "w", encoding="utf-8") as file:
            file.write(self.markdown())
        print(f"\n{self.markdown()}\nThe results are {self.out}.json and {self.out}.md ({self.found['seconds']} s)")

    def steps(self):
        gpu, cpu = self.find_gpu()
        if gpu is None:
            self.miss("a GPU: OpenCL lists none. `rectray devices` shows what there is")
            return
        os.environ["RECTRAY_CACHE_DIR"] = os.path.join(os.path.dirname(self.rectray), "gpu-check-cache")
        self.check_device(gpu)
        self.suites(gpu)
        self.measure_bandwidth(gpu)
        with tempfile.TemporaryDirectory() as folder:
            self.ladder(gpu, cpu, folder)

    def all(self):
        try:
            self.steps()
        finally:
            self.write()
        right = self.found["check"] and self.found["check"]["wrong"] == 0
        return 0 if right and all(suite["passed"] is not False for suite in self.found["suites"].values()) else 1


def stop(number, _):
    sys.exit(128 + number)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("rectray")
    parser.add_argument("--pose")
    parser.add_argument("--seconds", type=float, default=SECONDS)
    parser.add_argument("--out")
    signal.signal(signal.SIGTERM, stop)
    sys.exit(Check(parser.parse_args()).all())


if __name__ == "__main__":
    main()
