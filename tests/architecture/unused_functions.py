#!/usr/bin/env python3
"""Fails where a room offers a function that nothing but tests calls, naming the function and its file.

    unused_functions.py ROOT BUILD

What the objects below BUILD define for others is held against what they ask of one another. A function that no
other object asks for is unused where its name stands in the sources only where it is declared and defined, so
that calls which the compiler has put in place of count as calls. Tests count for nothing. Not looked at: what
include/ offers to the world, constructors, destructors, operators. Rows of unused_functions.txt are let pass, each
with its reason; a row whose function is called, or gone, is a fault too.

Ends with 77 (skipped) where an object of a room is missing.
"""

import os
import re
import subprocess
import sys

FOLDERS = ("planner", "rules", "casebase", "tooling")
LIST = os.path.join("tests", "architecture", "unused_functions.txt")
SKIPPED = 77
# Built only with, or only without, a library or a processor.
OPTIONAL = re.compile(r"/(no_\w+|backend|absent|\w+_stub|flann_index|rows_\w+)\.cpp$")


def plain(text):
    """A source without comments and without the contents of strings."""
    text = re.sub(r'"(?:\\.|[^"\\\n])*"', '""', text)
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
    return re.sub(r"//[^\n]*", "", text)


def sources(root):
    """Path and plain text of the rooms' own files."""
    for top in FOLDERS + ("include",):
        for folder, _, names in sorted(os.walk(os.path.join(root, top))):
            for name in sorted(names):
                if name.endswith((".h", ".cpp", ".inc")):
                    path = os.path.join(folder, name)
                    with open(path, encoding="utf-8") as file:
                        yield os.path.relpath(path, root), plain(file.read())


def symbols(objects):
    """{symbol: object} of what is defined for others, and the set of what is asked for."""
    defined, asked = {}, set()
    for first in range(0, len(objects), 50):
        out = subprocess.run(["nm", "-P", "-A"] + objects[first:first + 50], capture_output=True, text=True,
                             check=True).stdout
        for line in out.splitlines():
            path, _, rest = line.partition(": ")
            words = rest.split()
            if len(words) >= 2 and words[1] == "T":
                defined[words[0]] = path
            elif len(words) >= 2 and words[1] == "U":
                asked.add(words[0])
    return defined, asked


def demangled(names):
    out = subprocess.run(["c++filt"], input="\n".join(names), capture_output=True, text=True, check=True).stdout
    return dict(zip(names, out.splitlines()))


def name_of(text):
    """'capstan::a::B::f(int) const' -> 'capstan::a::B::f'."""
    text = text.replace("[abi:cxx11]", "").replace("(anonymous namespace)", "anonymous")
    return text.split("(")[0]


def candidates(defined, asked, names):
    """{qualified name: number of its functions that no other object asks for}."""
    out = {}
    for symbol in defined:
        name = name_of(names[symbol])
        parts = name.split("::")
        boilerplate = len(parts) > 1 and parts[-1].lstrip("~") == parts[-2]
        if symbol in asked or "<" in name or boilerplate or parts[-1].startswith("operator") or name == "main":
            continue
        out[name] = out.get(name, 0) + 1
    return out


def words_of(texts):
    """{word: how often it stands in the texts}."""
    out = {}
    for _, text in texts:
        for word in re.findall(r"\b[A-Za-z_]\w*\b", text):
            out[word] = out.get(word, 0) + 1
    return out


def unused(found, texts):
    """Qualified names whose last part stands in no text more often than declared and defined."""
    every = words_of(texts)
    public = words_of([(path, text) for path, text in texts if path.startswith("include")])
    out = []
    for name, overloads in sorted(found.items()):
        last = name.split("::")[-1]
        if last not in public and every.get(last, 0) <= 2 * overloads:
            out.append(name)
    return out


def inline_unused(texts):
    """(name, path) of functions of headers that are named only once."""
    inline = re.compile(r"^(?:\[\[nodiscard\]\] )?(?:inline|constexpr|template) [\w:<>&*, ]+?[ &*](\w+)\(", re.M)
    every = words_of(texts)
    for path, text in texts:
        if path.endswith(".h") and not path.startswith("include"):
            for match in inline.finditer(text):
                if every[match[1]] == 1:
                    yield match[1], path


def read_list(text):
    rows = {}
    for line in text.splitlines():
        if line.strip() and not line.startswith("#"):
            name, _, reason = line.partition(":  ")
            rows[name.strip()] = reason.strip()
    return rows


def faults(found, allowed):
    """One text per function that is unused and not listed, and per row that is not needed or has no reason."""
    out = [f"{name}, in {where}: nothing but tests calls it; delete it, or move it to the tests"
           for name, where in sorted(found.items()) if name not in allowed]
    out += [f"{LIST}: {name} is called, or gone; delete the row" for name in sorted(allowed) if name not in found]
    return out + [f"{LIST}: {name} has no reason" for name, reason in sorted(allowed.items()) if not reason]


def objects_of(root, build):
    """The objects of the rooms' sources and of those that the build writes (not what is left of sources that are
    gone), and the sources without."""
    built = {}
    for top in FOLDERS:
        for folder, _, names in os.walk(os.path.join(build, top)):
            for name in names:
                if name.endswith(".cpp.o"):
                    path = os.path.join(folder, name)
                    place = re.sub(r"CMakeFiles/[^/]+\.dir/", "", os.path.relpath(path, build))
                    built[place[:-len(".o")]] = path
    own = [path for path, _ in sources(root) if path.endswith(".cpp") and not path.startswith("include")]
    written = [path for path in built if path not in own and os.path.exists(os.path.join(build, path))]
    return sorted(built[path] for path in own + written if path in built), [path for path in own if path not in built]


def main(root, build):
    objects, missing = objects_of(root, build)
    needed = [path for path in missing if not OPTIONAL.search(path)]
    if needed or not objects:
        print(f"skipped: {len(needed)} sources are not built: {', '.join(needed[:3])}")
        return SKIPPED
    defined, asked = symbols(objects)
    names = demangled(sorted(defined))
    texts = list(sources(root))
    where = {name_of(names[s]): os.path.relpath(path, build) for s, path in defined.items()}
    found = {name: where[name] for name in unused(candidates(defined, asked, names), texts)}
    found.update(inline_unused(texts))
    with open(os.path.join(root, LIST), encoding="utf-8") as file:
        out = faults(found, read_list(file.read()))
    print("\n".join(out + [f"{len(objects)} objects, {len(defined)} functions, {len(out)} faults"]))
    return 1 if out else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
