#!/usr/bin/env python3
"""Which sources of a target can be compiled together.

sources_together.py MOST LIST   LIST has a line a source: its target, a blank, its path; printed is a line a source: its
                                target, the number of its group there, its path

Sources compiled together share one unnamed namespace and one set of includes, so that two of them may not give a name
two meanings. Each source goes, in its order, into the first group that has room and in which no name that one source
declares for itself alone stands in another, or in a header of the tree that only the other includes, whatever it means
there. Names are found by the layout of the tree (.clang-format): a declaration of an
unnamed namespace begins in the first column.
"""

import functools
import os
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


# Types and constants, wherever they stand; functions where they are called, but for members and qualified ones.
WORD = re.compile(r"\b[A-Za-z]\w*[A-Z]\w*|\b[A-Z]\w*|(?<![\w.>:])[a-z]\w*(?=\s*\()")
# Of a header the functions that are declared from the first column on.
FREE = re.compile(r"^(?![ /#]).*$", re.MULTILINE)
INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")


@functools.cache
def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


@functools.cache
def words_of(path):
    text = re.sub(r"//.*", "", read(path))
    if path.endswith(".h"):
        types = {word for word in WORD.findall(text) if word != word.lower()}
        return frozenset(types.union(*(WORD.findall(line) for line in FREE.findall(text))))
    return frozenset(WORD.findall(text))


def headers_of(path):
    """The headers of the tree that a source includes, and theirs."""
    found, left = set(), [path]
    while left:
        for name in INCLUDE.findall(read(left.pop())):
            header = os.path.join(ROOT, name)
            if header not in found and os.path.exists(header):
                found.add(header)
                left.append(header)
    return found


def may_join(one, other):
    """Whether no own name of `one` stands in `other`, or in a header that only `other` includes; an alias of one
    meaning may."""
    own, _, headers = one
    others_own, words, others_headers = other
    for name, meant in own.items():
        if name in others_own and meant is not None and others_own[name] == meant:
            continue
        if name in words or any(name in words_of(header) for header in others_headers - headers):
            return False
    return True


def groups(sources, most):
    """(group, source) in the order of the sources."""
    taken = []  # the sources of each group: own names, words, headers
    for source in sources:
        this = (names_of(read(source)), words_of(source), headers_of(source))
        for number, group in enumerate(taken):
            if len(group) < most and all(may_join(this, other) and may_join(other, this) for other in group):
                break
        else:
            number = len(taken)
            taken.append([])
        taken[number].append(this)
        yield number, source


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: sources_together.py MOST LIST")
    of_target = {}
    for line in read(sys.argv[2]).splitlines():
        target, path = line.split(" ", 1)
        of_target.setdefault(target, []).append(path)
    for target, paths in of_target.items():
        for group, path in groups(paths, int(sys.argv[1])):
            print(target, group, path)
