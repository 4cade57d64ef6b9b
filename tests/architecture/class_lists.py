#!/usr/bin/env python3
"""Fails where a statement or a switch outside the vocabulary tells more than three classes of cutter apart.

    class_lists.py [ROOT]

What is true of a class is a column of planner/ground/vocabulary/cutter_classes.inc. A list of classes elsewhere is
a place that whoever adds a class would have to know of. Allowed are the folders of ALLOWED, each with its reason.
"""

import os
import re
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import unique_types  # noqa: E402

MOST = 3
ALLOWED = {
    "planner/proof/verify/copies/class_copies.cpp": "what the check says of each class by itself, so that a wrong row is found",
    "tooling/library/formats/din4000/codes.cpp": "figures of one format's tables: several for one class",
}
CLASS = re.compile(r"\bCutterClass::(k\w+)")
CASE = re.compile(r"\bcase (?:\w+::)*CutterClass::(k\w+)")
COMMENT = re.compile(r"//[^\n]*")


def parts_of(text):
    """(offset, enumerators) of each statement and of each switch."""
    at = 0
    for statement in text.split(";"):
        yield at, set(CLASS.findall(statement))
        at += len(statement) + 1
    for match in re.finditer(r"\bswitch \(", text):
        end = text.find("\n}\n", match.start())
        yield match.start(), set(CASE.findall(text[match.start():end]))


def lists(files):
    """(path, text) of each list of more than MOST classes; `files` are (path, text)."""
    for path, text in files:
        text = COMMENT.sub("", text)
        for at, classes in parts_of(text):
            if len(classes) <= MOST:
                continue
            first = text.index("CutterClass::", at)
            line = text.count("\n", 0, first) + 1
            yield path, (f"{path}:{line}: {len(classes)} classes of cutter in one list; make it a trait of "
                         "planner/ground/vocabulary/cutter_classes.inc")


def faults(files, allowed=ALLOWED):
    """One text per list outside the folders that are allowed, and per such folder that has none."""
    found = list(lists(files))
    out = [text for path, text in found if not path.startswith(tuple(allowed))]
    out += [f"{folder}: has no list of classes any more; delete its row of ALLOWED"
            for folder in allowed if not any(path.startswith(folder) for path, _ in found)]
    return out


def main(root):
    files = list(unique_types.read_all(root))
    if not files:
        print(f"{root}: there is nothing to look at")
        return 1
    found = faults(files)
    for text in found:
        print(text)
    print(f"{len(files)} files, {len(found)} faults")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1] if len(sys.argv) > 1 else "."))
