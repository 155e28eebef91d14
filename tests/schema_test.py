#!/usr/bin/env python3
"""docs/scene.schema.json and `rectray check` agree: over all good scenes, and over all bad ones whose fault a schema
can express. Every bad scene's error is the one that tests/scenes/bad/expected.tsv gives.

Run from the top folder: python3 tests/schema_test.py. Needs Debian's python3-jsonschema."""
import glob
import json
import subprocess
import sys

import jsonschema

from support.program import PROGRAM

BAD = "tests/scenes/bad/"
failed = set()


def expect(condition, scene, message):
    if not condition:
        failed.add(scene)
        print(f"{scene}: {message}\n  reproduce: {PROGRAM} check {scene}")


def check(scene):
    run = subprocess.run([PROGRAM, "check", scene], capture_output=True, text=True)
    return run.returncode, run.stderr.split("\n")[0]


def accepts(validator, scene):
    with open(scene, encoding="utf-8") as file:
        return validator.is_valid(json.load(file))


with open("docs/scene.schema.json", encoding="utf-8") as file:
    schema = json.load(file)
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)

good = sorted(glob.glob("scenes/*.json") + glob.glob("tests/scenes/*.json"))
for scene in good:
    status, error = check(scene)
    expect(status == 0, scene, f"rectray rejects it: {error}")
    expect(accepts(validator, scene), scene, "the schema rejects it")

bad = {}
with open(BAD + "expected.tsv", encoding="utf-8") as file:
    for line in file:
        if not line.startswith("#"):
            kind, name, message = line.rstrip("\n").split("\t")
            bad[BAD + name] = (kind, message)
expect(sorted(bad) == sorted(glob.glob(BAD + "*.json")), BAD, "expected.tsv and the folder hold different scenes")

for scene, (kind, message) in bad.items():
    status, error = check(scene)
    expect(status == 1, scene, f"exit status {status}, not 1")
    expect(error.endswith(message), scene, f"says\n    {error}\n  and not\n    {message}")
    if kind == "schema":
        expect(not accepts(validator, scene), scene, "the schema accepts it")
    elif kind == "meaning":
        expect(accepts(validator, scene), scene, "the schema rejects it, so that its class is `schema`")

print(f"{len(good) + len(bad) - len(failed)} passed, {len(failed)} failed")
sys.exit(1 if failed else 0)
