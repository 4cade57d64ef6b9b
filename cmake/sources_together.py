#!/usr/bin/env python3
"""Which sources of a target can be compiled together.

sources_together.py MOST SOURCE...   prints a line a source: the number of its group, a blank, its path

Sources compiled together share one unnamed namespace and one set of includes, so that two of them may not give a name
two meanings. Each source goes, in its order, into the first group that has room and in which none of the names that
it declares for itself is declared yet. Names are found by the layout of the tree (.clang-format): a declaration of an
unnamed namespace begins in the first column.
"""

import re
import sys

BEGINS = re.compile(r"^namespace \{")
ENDS = re.compile(r"^\}  // namespace$")
TYPE = re.compile(r"^(?:struct|class|enum class|enum|union) (\w+)")
ALIAS = re.compile(r"^using (?:namespace )?([\w:]+)")
MACRO = re.compile(r"^#define (\w+)")
# What declares no name of the source's: assertions, and tests, whose names the program holds once in any case.
NAMELESS = re.compile(r"^(?:static_assert|TEST|TEST_F|TEST_P|TYPED_TEST|INSTANTIATE_TEST_SUITE_P)\(")
# The last word before what follows a name: a value, a list of parameters, a size.
NAMED = re.compile(r"([A-Za-z_]\w*)(?:<[^;={(]*>)?\s*(?:\(|=|\{|\[|;)")
CONSTANT = re.compile(r"\b(k[A-Z]\w*) = ")


def names_of(text):
    """Of each name that a source declares for itself alone what it means: for an alias its line, since it may stand
    twice where it means the same, and for all others the source itself."""
    own = {}
    unnamed = False
    for line in text.split("\n"):
        if BEGINS.match(line):
            unnamed = True
        elif ENDS.match(line):
            unnamed = False
        elif found := ALIAS.match(line):
            own[found.group(1).split("::")[-1]] = line
        elif found := MACRO.match(line):
            own[found.group(1)] = None
        elif unnamed and (line[:1].isalpha() or line[:2] == "[[") and not NAMELESS.match(line):
            if found := TYPE.match(line) or NAMED.search(line):
                own[found.group(1)] = None
            own.update(dict.fromkeys(CONSTANT.findall(line)))  # of several in a line, each
    return own


def groups(sources, most):
    """(group, source) in the order of the sources."""
    taken = []  # of each group: how many sources it has, and what its names mean
    for source in sources:
        with open(source, encoding="utf-8") as file:
            own = names_of(file.read())
        for number, (count, names) in enumerate(taken):
            if count < most and all(name not in names or meant is not None and names[name] == meant
                                    for name, meant in own.items()):
                break
        else:
            number = len(taken)
            taken.append((0, {}))
        taken[number] = (taken[number][0] + 1, taken[number][1] | own)
        yield number, source


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit("usage: sources_together.py MOST SOURCE...")
    for group, path in groups(sys.argv[2:], int(sys.argv[1])):
        print(group, path)
