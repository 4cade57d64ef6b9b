#!/usr/bin/env python3
"""No source over 600 lines: past 500 it is time to open a sub-folder.

    file_length.py [ROOT]
"""

import os
import sys

FOLDERS = "planner rules casebase tooling include tests examples cmake .ci".split()
ENDINGS = (".h", ".hpp", ".cpp", ".c", ".py", ".cmake", "CMakeLists.txt")
WARN, FAIL = 500, 600


def main(root):
    status = 0
    for top in FOLDERS:
        for folder, folders, names in os.walk(os.path.join(root, top)):
            folders.sort()
            for name in sorted(names):
                if not name.endswith(ENDINGS):
                    continue
                path = os.path.join(folder, name)
                with open(path, "rb") as file:
                    lines = sum(1 for _ in file)
                if lines > WARN:
                    word = "error" if lines > FAIL else "warning"
                    print(f"{os.path.relpath(path, root)}: {word}: {lines} lines")
                status |= lines > FAIL
    return int(status)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1] if len(sys.argv) > 1 else "."))
