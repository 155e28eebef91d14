#!/usr/bin/env python3
"""Prints our own functions for an exercise, with their comments: `make solution N=3`. There are no others: an exercise
takes a function out of this program, and the solution is the function as it stands in the program's source.

The exercise's file exercise.json names them: "solution" is a list of "FILE: FUNCTION, FUNCTION"; without it, they are
"function" in the file that the exercise "replaces"."""
import json
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent


def wanted(number):
    """[(file, [function])] of the exercise."""
    place = ROOT / "tests" / "exercises" / f"{number:02}" / "exercise.json"
    if not place.is_file():
        sys.exit(f"solution: there is no exercise {number}; docs/exercises has them")
    about = json.loads(place.read_text(encoding="utf-8"))
    functions = ", ".join(re.findall(r"\w+_\w+", about["function"]))
    named = about.get("solution") or [f"src/{about['replaces']}: {functions}"]
    return [(file, [name.strip() for name in names.split(",")])
            for file, _, names in (entry.partition(":") for entry in named)]


def definition_of(text, name):
    """(place in the text, the function with the comment above it)"""
    comment = r"(?:^/\*(?:(?!\*/).)*\*/\n)?"
    found = re.search(rf"(?ms){comment}^(?!typedef|#| |/)[^\n;{{}}=]*?\b{name}\([^;{{}}]*\)\s*(?:\{{[^\n]*\}}$|\{{\n.*?^\}}$)",
                      text)
    return (found.start(), found[0]) if found else None


def solution(number):
    parts = []
    for file, names in wanted(number):
        text = (ROOT / file).read_text(encoding="utf-8")
        found = []
        for name in names:
            definition = definition_of(text, name)
            if not definition:
                sys.exit(f"solution: {file} has no function {name}")
            found.append(definition)
        parts.append(f"/* From {file}: */\n\n" + "\n\n".join(definition for _, definition in sorted(found)))
    return "\n\n\n".join(parts)


def main():
    if len(sys.argv) != 2 or not sys.argv[1].isdigit():
        sys.exit("usage: make solution N=3, for one of the exercises of docs/exercises")
    print(solution(int(sys.argv[1])))


if __name__ == "__main__":
    main()
