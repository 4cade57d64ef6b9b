#!/usr/bin/env python3
"""Fails where the build would not run on every processor that Debian's amd64 and arm64 take.

    portable.py ROOT BUILD     flags of BUILD/compile_commands.json, objects, and sources
    portable.py --arm64 ROOT   compiles the vector kernels for arm64; 77 (skipped) without a cross compiler

Options for one kind of processor belong to the files that are called only after that processor was asked. What
those files define for others is one function each: an inline function of the standard library, compiled with
AVX2 and kept by the linker for all callers, would crash where nobody asked. Intrinsics stand in the kernels only,
and there only inside an #if on the processor's macro.
"""

import json
import os
import re
import shlex
import subprocess
import sys

SWEEP = "planner/physics/stock/sweep/"
# Called when the processor has what they are compiled for.
DISPATCHED = {SWEEP + "rows_avx2.cpp", SWEEP + "rows_avx512.cpp"}
# Where intrinsics may be named. SSE2 is part of amd64; beside it each has a branch for other processors.
KERNELS = DISPATCHED | {SWEEP + "rows_portable.cpp", SWEEP + "lanes.h", "planner/files/p21/read/lexer.h",
                        # The check's own: one function is compiled for AVX2, and called where that is there.
                        "planner/proof/verify/sweep/grid/line_cells.cpp"}
FOLDERS = ("planner", "rules", "casebase", "tooling", "include", "tests", "examples")

INTRINSIC = re.compile(
    r'#\s*include\s*[<"](?:\w*mmintrin|\w*intrin|cpuid|arm_\w+)\.h[>"]|\b_mm\d*_\w+\s*\(|\b__m(?:128|256|512)\w*'
    r"|\b__builtin_(?:ia32|aarch64|cpu)_\w+|\b(?:__)?asm(?:__)?\s*(?:volatile\s*)?\(|\btarget(?:_clones)?\(\"")
GUARD = re.compile(r"__(?:SSE|AVX)\w*__")
# What is in the dynamic linker's way: a definition that other objects share.
SHARED_DEFINITION = re.compile(r"^[0-9a-f]* *([WVuw]) (.*)$")


def flag_faults(commands):
    """`commands` are (path from the root, arguments)."""
    return [f"{path}: compiled with {flag}, and called on any processor"
            for path, arguments in commands if path not in DISPATCHED
            for flag in arguments if flag.startswith("-m") or flag.startswith("-Xassembler")]


def source_faults(path, text):
    found, guards = [], []
    for number, line in enumerate(text.split("\n"), 1):
        directive = re.match(r"\s*#\s*(if|ifdef|ifndef|elif|else|endif)\b(.*)", line)
        if directive:
            word, condition = directive.groups()
            if word in ("elif", "else", "endif") and guards:
                guards.pop()
            if word != "endif":
                guards.append(word in ("if", "ifdef", "elif") and bool(GUARD.search(condition)))
            continue
        match = INTRINSIC.search(line)
        if match and path not in KERNELS:
            found.append(f"{path}:{number}: {match[0]} stands outside of the vector kernels")
        elif match and not any(guards):
            found.append(f"{path}:{number}: {match[0]} stands outside of an #if on the processor's macro")
    return found


def object_faults(path, symbols):
    """`symbols` is what nm says of the object of a dispatched file."""
    return [f"{path}: defines {match[2]} for every caller, compiled for one kind of processor"
            for match in map(SHARED_DEFINITION.match, symbols.split("\n")) if match and match[1] in "WVu"]


def read_all(root):
    for top in FOLDERS:
        for folder, folders, names in os.walk(os.path.join(root, top)):
            folders.sort()
            for name in sorted(names):
                if name.endswith((".h", ".c", ".cpp", ".inc")):
                    path = os.path.join(folder, name)
                    with open(path, encoding="utf-8") as file:
                        yield os.path.relpath(path, root), file.read()


def look(root, build):
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        entries = json.load(file)
    commands = [(os.path.relpath(entry["file"], root), shlex.split(entry["command"])) for entry in entries]
    found = flag_faults(commands)
    missing = DISPATCHED - {path for path, _ in commands}
    found += [f"{path}: is not compiled; the table of this test is out of date" for path in sorted(missing)]
    for path, text in read_all(root):
        found += source_faults(path, text)
    looked = 0
    for entry, (path, arguments) in zip(entries, commands):
        if path not in DISPATCHED:
            continue
        built = os.path.join(entry["directory"], arguments[arguments.index("-o") + 1])
        if os.path.exists(built):
            looked += 1
            found += object_faults(path, subprocess.run(
                ["nm", "-C", "--defined-only", built], check=True, capture_output=True, text=True).stdout)
    return found, f"{len(commands)} commands, {looked} dispatched objects"


def compile_for_arm64(root):
    compiler = "aarch64-linux-gnu-g++"
    try:
        subprocess.run([compiler, "--version"], check=True, capture_output=True)
    except FileNotFoundError:
        print(f"{compiler} is not there (Debian: g++-aarch64-linux-gnu)")
        return 77
    folder = os.path.join(root, SWEEP)
    status = 0
    for name in sorted(os.listdir(folder)):
        if name.endswith(".cpp"):
            status |= subprocess.run(
                [compiler, "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror",
                 "-I", root, os.path.join(folder, name)]).returncode
    return 1 if status else 0


def main(arguments):
    if arguments[0] == "--arm64":
        return compile_for_arm64(arguments[1])
    found, looked = look(*arguments)
    for fault in found:
        print(fault)
    print(f"{looked}: {len(found)} faults")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
