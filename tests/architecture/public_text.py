#!/usr/bin/env python3
"""No text in the tree that means something only to whoever typed it.

    public_text.py [ROOT]

Paths of one machine, its name, marks of unfinished work.
"""

import os
import re
import socket
import sys

FOLDERS = "planner rules casebase tooling include tests examples docs cmake .ci".split()
# Written in pieces, for this file is looked at too.
FORBIDDEN = [
    (re.compile(r"\b(" + "|".join(("TO" + "DO", "FIX" + "ME", "X" * 3)) + r")\b"), "unfinished work"),
    (re.compile(r"(?<![\w.])/(" + "|".join(("work", "root", "home", "Users")) + r")/"), "a path of one machine"),
    (re.compile(r"https?://[^/\s\"']*(:\d+|\.(internal|intranet|local|lan|corp))\b"), "an address of one network"),
    (re.compile(r"shared/" + "reference"), "a folder that is not in the project"),
]


def patterns():
    host = socket.gethostname()
    # A short name may well be a word of the language.
    named = [(re.compile(r"\b" + re.escape(host) + r"\b"), "the name of this machine")] if len(host) >= 8 else []
    return FORBIDDEN + (named if host != "localhost" else [])


def texts(root):
    for name in sorted(os.listdir(root)):
        path = os.path.join(root, name)
        if os.path.isfile(path):
            yield path
    for top in FOLDERS:
        for folder, folders, names in os.walk(os.path.join(root, top)):
            folders[:] = sorted(set(folders) - {"__pycache__"})
            for name in sorted(names):
                yield os.path.join(folder, name)


def main(root):
    status = 0
    forbidden = patterns()
    for path in texts(root):
        with open(path, "rb") as file:
            text = file.read()
        if b"\0" in text:  # not a text
            continue
        for number, line in enumerate(text.decode("utf-8", "replace").splitlines(), 1):
            for pattern, why in forbidden:
                if pattern.search(line):
                    print(f"{os.path.relpath(path, root)}:{number}: {why}: {line.strip()[:100]}")
                    status = 1
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1] if len(sys.argv) > 1 else "."))
