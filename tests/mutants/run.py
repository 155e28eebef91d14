#!/usr/bin/env python3
"""Tries the mutants of the list: each is a small fault put into a copy of the tree, built, and a named test must fail.

Usage: tests/mutants/run.py [--jobs N] [NAME...]      (from the top of the tree, after `make programs`)
The copies lie under build/mutants, one per job, with the objects of the build, so that only what a mutant changes is
compiled again. A mutant whose test passes has survived: the exit status is then 1.
"""

import argparse
import glob
import os
import queue
import shutil
import subprocess
import sys
import threading

COPIED = ["Makefile", "src", "kernels", "tests", ".ci", "scenes"]
STRESS = ["--scale", "0.002", "--seed", "1"]
TIMEOUT_S = 300


def read_list(path):
    """[(name, file, test, before, after)]"""
    mutants, lines = [], [line.rstrip("\n") for line in open(path, encoding="utf-8")]
    lines = [line for line in lines if line and not line.startswith("#")]
    for head, before, after in zip(lines[0::3], lines[1::3], lines[2::3]):
        assert before.startswith("- ") and after.startswith("+ "), f"not a mutant: {head}"
        mutants.append((*head.split(), before[2:], after[2:]))
    return mutants


def copy_tree(folder):
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    for name in COPIED:
        subprocess.run(["cp", "-a", name, folder], check=True)
    os.makedirs(f"{folder}/build")
    for name in ["src", "tests", "unity", "kernel_sources.c", "kernel_sources.o", "rectray-parts.a", "stress",
                 "rectray", "shims",
                 ".libraries-found"]:
        if os.path.exists(f"build/{name}"):
            subprocess.run(["cp", "-a", f"build/{name}", f"{folder}/build"], check=True)


def program_of(test):
    """What is built for the test, and the command that runs it."""
    if test.startswith("stress:"):
        return "build/stress", ["build/stress", "--test", test[len("stress:"):], *STRESS]
    suite, _, part = test.partition(":")
    if suite.endswith("_test"):
        return "build/rectray", [sys.executable, f"tests/{suite}.py", part]
    return f"build/tests/{test}", [f"build/tests/{test}"]


def try_mutant(folder, mutant):
    """(killed, what happened)"""
    _, file, test, before, after = mutant
    path = f"{folder}/{file}"
    original = open(path, encoding="utf-8").read()
    if original.count(before) != 1:
        return False, f"the list is out of date: {original.count(before)} times in {file}"
    times = os.stat(path)
    try:
        with open(path, "w", encoding="utf-8") as out:
            out.write(original.replace(before, after))
        program, command = program_of(test)
        build = subprocess.run(["make", "-s", program, "WERROR="], cwd=folder, capture_output=True, text=True,
                               check=False)
        if build.returncode != 0:
            return False, "does not build: " + (build.stderr.strip().splitlines() or ["?"])[0]
        environment = dict(os.environ, RECTRAY_KERNELS=os.path.abspath(f"{folder}/kernels"))
        try:
            run = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True,
                                 timeout=TIMEOUT_S, check=False)
        except subprocess.TimeoutExpired:
            return True, "timed out"
        if run.returncode == 3 and test.startswith("stress:"):
            return False, "the test could not run: " + (run.stderr.strip().splitlines() or ["?"])[-1]
        return run.returncode != 0, ""
    finally:
        with open(path, "w", encoding="utf-8") as out:
            out.write(original)
        os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))
        undo(folder, file)


def undo(folder, file):
    """The mutant's objects must not stay: what depends on the file is taken from the build again."""
    names = ["rectray-parts.a", "stress", "rectray"]
    if file.startswith("kernels/"):
        names += ["kernel_sources.c", "kernel_sources.o"]
    if file.endswith(".c"):
        names.append(f"{file[:-2]}.o")
    if file.endswith(".h"):
        names += [os.path.relpath(path, "build") for path in glob.glob("build/src/**/*.o", recursive=True)]
    for name in names:
        subprocess.run(["cp", "-a", f"build/{name}", f"{folder}/build/{name}"], check=True)
    shutil.rmtree(f"{folder}/build/tests", ignore_errors=True)
    subprocess.run(["cp", "-a", "build/tests", f"{folder}/build/tests"], check=True)


def work(number, waiting, results):
    folder = f"build/mutants/{number}"
    copy_tree(folder)
    while True:
        try:
            mutant = waiting.get_nowait()
        except queue.Empty:
            return
        killed, why = try_mutant(folder, mutant)
        results.append((mutant, killed, why))
        verdict = "killed  " if killed else "SURVIVED"
        print(f"  {verdict} {mutant[0]:34} {mutant[1]:30} {mutant[2]:22} {why}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--jobs", type=int, default=min(2, os.cpu_count() or 1))
    parser.add_argument("names", nargs="*", help="mutants to try; all if none is named")
    arguments = parser.parse_args()
    mutants = read_list("tests/mutants/list")
    chosen = [m for m in mutants if not arguments.names or m[0] in arguments.names]
    if not chosen:
        sys.exit("mutants: no mutant of that name")
    waiting, results = queue.Queue(), []
    for mutant in chosen:
        waiting.put(mutant)
    threads = [threading.Thread(target=work, args=(i, waiting, results))
               for i in range(min(arguments.jobs, len(chosen)))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    survivors = [mutant[0] for mutant, killed, _ in results if not killed]
    print(f"{len(results) - len(survivors)} killed, {len(survivors)} survived")
    for name in survivors:
        print(f"  {name}")
    sys.exit(1 if survivors or len(results) < len(chosen) else 0)


if __name__ == "__main__":
    main()
