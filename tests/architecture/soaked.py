#!/usr/bin/env python3
"""Fails where a test takes a sample in CI, and `./dev soak` does not run it, so that nothing takes the whole.

    soaked.py ROOT

A test takes a sample where it asks `soaking()` or `rounds()` (tests/support/soak.h). `./dev soak` runs what
SOAK_FILTER in dev names. A helper that asks stands for the tests of its file, of which one must be named.
"""

import fnmatch
import os
import re
import sys

TEST = re.compile(r"^(?:TYPED_)?TEST(?:_[FP])?\((\w+), (\w+)\)", re.MULTILINE)
ASKS = re.compile(r"\b(?:soaking|rounds)\(")


def filter_of(root):
    with open(os.path.join(root, "dev"), encoding="utf-8") as file:
        return re.search(r"^SOAK_FILTER=\$\{CAPSTAN_SOAK_FILTER:-(.*)\}$", file.read(), re.MULTILINE)[1].split(":")


def named(test, patterns):
    return any(fnmatch.fnmatchcase(test, pattern) for pattern in patterns)


def faults(path, text, patterns):
    tests = [(m.start(), f"{m[1]}.{m[2]}") for m in TEST.finditer(text)]
    ends = [text.find("\n}\n", start) for start, _ in tests]
    for use in ASKS.finditer(text):
        own = [name for (start, name), end in zip(tests, ends) if start < use.start() < end]
        if not any(named(name, patterns) for name in own or [name for _, name in tests]):
            line = text.count("\n", 0, use.start()) + 1
            yield f"{path}:{line}: takes a sample, and ./dev soak names none of {', '.join(own) or 'the tests of the file'}"


def main(root):
    patterns, found, looked = filter_of(root), [], 0
    for folder, folders, names in os.walk(os.path.join(root, "tests")):
        folders.sort()
        for name in sorted(names):
            if name.endswith("_test.cpp"):
                path = os.path.join(folder, name)
                with open(path, encoding="utf-8") as file:
                    found += faults(os.path.relpath(path, root), file.read(), patterns)
                looked += 1
    for fault in found:
        print(fault)
    print(f"{looked} files, {len(found)} faults")
    return 1 if found or not looked else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
