#!/usr/bin/env python3
"""No room above 10,000 lines of sources, no folder of more than 20 files, no path in a README that is not there.

    room_sizes.py [ROOT]

Rooms are those of include_direction.py. A file counts for the deepest room that it lies in.
"""

import collections
import os
import re
import subprocess
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import include_direction  # noqa: E402

FOLDERS = "planner rules casebase tooling include tests".split()
MOST_LINES, MOST_FILES = 10_000, 20
# A file that a README names in backquotes: `step/record.cpp`, `../noun_faults.h`.
NAMED = re.compile(r"`((?:\.\./)*[\w/]+\.(?:h|cpp|py|inc|map))`")


def lines_of(root):
    """Room -> its lines of sources."""
    out = collections.Counter()
    for path in include_direction.sources(root):
        with open(os.path.join(root, path), "rb") as file:
            out[include_direction.room_of(path)] += sum(1 for _ in file)
    return out


def crowded(root):
    """Folders with more files than a person reads as a list, as (folder, number)."""
    for top in FOLDERS:
        for folder, folders, names in os.walk(os.path.join(root, top)):
            folders[:] = sorted(f for f in folders if f not in ("__pycache__", "seeds", "corpus_seeds"))
            if len(names) > MOST_FILES:
                yield os.path.relpath(folder, root), len(names)


def named_and_gone(root):
    """Files that a room's README names and nobody has, as (README, name)."""
    for top in ("planner", "rules", "casebase", "tooling"):
        for folder, folders, names in os.walk(os.path.join(root, top)):
            folders.sort()
            if "README.md" not in names:
                continue
            below = {n for _, _, ns in os.walk(folder) for n in ns}
            with open(os.path.join(folder, "README.md"), encoding="utf-8") as file:
                text = file.read()
            for name in NAMED.findall(text):
                tried = [os.path.join(base, name) for base in
                         (folder, os.path.dirname(folder), os.path.join(root, "planner"), root)]
                if not any(os.path.exists(t) for t in tried) and os.path.basename(name) not in below:
                    yield os.path.relpath(os.path.join(folder, "README.md"), root), name


def main(root):
    status = 0
    sizes = lines_of(root)
    if not sizes:
        print(f"{root}: there is nothing to look at")
        return 1
    for room, lines in sorted(sizes.items(), key=lambda x: -x[1]):
        if lines > MOST_LINES:
            print(f"{room}: {lines} lines, at most {MOST_LINES}: part it")
            status = 1
    for folder, number in crowded(root):
        print(f"{folder}: {number} files, at most {MOST_FILES}: open sub-folders")
        status = 1
    for readme, name in named_and_gone(root):
        print(f"{readme}: names {name}, which is nowhere")
        status = 1
    room, lines = sizes.most_common(1)[0]
    print(f"{len(sizes)} rooms, the largest is {room} with {lines} lines")
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1] if len(sys.argv) > 1 else "."))
