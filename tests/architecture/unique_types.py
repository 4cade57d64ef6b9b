#!/usr/bin/env python3
"""Fails where two types of one name stand in one namespace, naming both places.

    unique_types.py [ROOT]

Two such types with different members break C++'s one definition rule without a word from compiler or linker.
Types of anonymous namespaces belong to their file and may share a name. The layout that clang-format gives is
relied on: what stands in a namespace begins its line.
"""

import os
import re
import sys

OPENS = re.compile(r"^(?:inline )?namespace(?: ([\w:]+))? \{$")
TYPE = re.compile(r"^(?:struct|class|union|enum class|enum) (?:alignas\(\w+\) )?(\w+)(?: final)?(?: : [^;]+)? \{")
FOLDERS = ("planner", "rules", "casebase", "tooling", "include")


def types_of(text):
    """(namespace, type, line) of each type that a file defines for others, too."""
    inside = []
    for number, line in enumerate(text.split("\n"), 1):
        match = OPENS.match(line)
        if match:
            inside.append(match[1])
        elif line.startswith("}  // namespace") and inside:
            inside.pop()
        match = TYPE.match(line)
        if match and inside and None not in inside:
            yield "::".join(inside), match[1], number


def faults(files):
    """One text per second definition; `files` are (path, text)."""
    seen, found = {}, []
    for path, text in files:
        for space, name, number in types_of(text):
            first = seen.setdefault((space, name), (path, number))
            if first != (path, number):
                found.append(f"{path}:{number}: {space}::{name} stands in {first[0]}:{first[1]}, too")
    return found


def read_all(root):
    for top in FOLDERS:
        for folder, folders, names in os.walk(os.path.join(root, top)):
            folders.sort()
            for name in sorted(names):
                if name.endswith((".h", ".cpp")):
                    path = os.path.join(folder, name)
                    with open(path, encoding="utf-8") as file:
                        yield os.path.relpath(path, root), file.read()


def main(root):
    files = list(read_all(root))
    if not files:
        print(f"{root}: there is nothing to look at")
        return 1
    found = faults(files)
    print("\n".join(found + [f"{len(files)} files, {len(found)} faults"]))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1] if len(sys.argv) > 1 else "."))
