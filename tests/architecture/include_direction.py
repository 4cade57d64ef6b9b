#!/usr/bin/env python3
"""Fails on any include against the order of the rooms and on any circle of files, naming file and line.

    include_direction.py [ROOT]

The tables below are the architecture; DESIGN speaks, this decides. Tests are not looked at: they may
include what they like.
"""

import os
import re
import sys

# Floor -> its rooms. A floor is a folder of planner/.
FLOORS = {
    "ground": "base memo vocabulary geometry",
    "model": "nouns features plan",
    "files": "p21 exchange recognise from_cad json",
    "physics": "mechanics motion stock engagement",
    "making": "draft sequence piece toolpath workholding optimise step probing propose given",
    "proof": "verify",
    "door": "pipeline late report service transport facade python app",
}

# Folder -> room. planner/controls is a room with a folder per control, on shared pieces. Of folders that hold each other the deepest counts.
EXCHANGE = "common toolpaths records express conformance iso14649 ap238 brep"
# The check's readers of programs, a room for each control.
READERS = "planner/proof/verify/program"
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
READER_ROOMS = {f"{READERS}/{name}": f"{name}_reader" for name in sorted(os.listdir(os.path.join(ROOT, READERS)))
                if os.path.isdir(os.path.join(ROOT, READERS, name))}
TOOLING = {"tooling": "shop library selection", "tooling/library": "formats"}
FOLDERS = {
    "planner/proof/verify/volumes": "volumes", "planner/proof/verify/compared": "compared",
    "planner/proof/verify/sweep/grid": "grid", "planner/proof/verify/sweep/target": "target",
    "planner/proof/verify/copies": "copies", "planner/proof/verify/touches": "touches",
    "planner/proof/verify/pocket": "pocket", "planner/proof/verify/following": "following",
    "planner/proof/verify/shape": "finished", **READER_ROOMS,
    "planner/model/features/fit": "fit",
    "planner/making/toolpath/freeform": "freeform",
    # What a tool library is made of, whatever file it came from; on it the formats, and on these the reader of any.
    **{f"tooling/library/{name}": "catalogue" for name in "cutters nouns records store words".split()},
    **{f"planner/files/exchange/{name}": name for name in EXCHANGE.split()},
    **{f"{folder}/{name}": name for folder, rooms in reversed(TOOLING.items()) for name in rooms.split()},
    **{f"planner/{floor}/{name}": name for floor, rooms in FLOORS.items() for name in rooms.split()},
    "planner/controls/gcode": "gcode", "planner/controls": "controls",
    "rules": "rules", "casebase/retain": "retain", "casebase/tune": "tune", "casebase": "casebase", "include/capstan": "public",
}

# The rooms of the door; each may include only what its row says.
DOORS = ("pipeline", "late", "report", "service", "transport", "facade", "python", "app", "public")

# Room -> what it may include besides itself.
GROUND = "base memo vocabulary geometry"
MODEL = GROUND + " nouns fit features plan"
# What the check reads by itself: nothing of what the planner takes features for.
PROVEN = GROUND + " nouns fit plan"
EXCHANGE_COMMON = MODEL + " p21 common toolpaths"
SHOP = "shop library selection"
ALLOWED = {
    "base": "", "memo": "base", "vocabulary": "base",
    "geometry": "base",
    "nouns": GROUND, "fit": GROUND + " nouns", "features": GROUND + " nouns fit",
    "plan": GROUND + " nouns fit features",
    "p21": "base",
    "common": MODEL + " p21", "toolpaths": MODEL + " p21 common", "records": EXCHANGE_COMMON,
    "express": GROUND + " p21 common", "conformance": MODEL + " p21 common express",
    "iso14649": EXCHANGE_COMMON + " records", "ap238": EXCHANGE_COMMON + " records express",
    # The shapes of CAD files; of a plan it knows nothing.
    "brep": GROUND + " p21",
    "exchange": EXCHANGE_COMMON + " iso14649 ap238 brep",
    "recognise": GROUND + " brep",
    # From faces to the nouns of a plan, held against the planner's own reading of them.
    "from_cad": MODEL + " brep recognise",
    "json": MODEL + " motion",
    "mechanics": MODEL, "motion": MODEL, "stock": MODEL, "engagement": MODEL + " stock",
    "rules": MODEL, "casebase": MODEL, "retain": MODEL + " casebase", "tune": MODEL + " casebase",
    "shop": MODEL + " mechanics",
    "catalogue": MODEL + " shop", "formats": MODEL + " p21 shop catalogue",
    "library": MODEL + " shop formats catalogue",
    "selection": MODEL + " mechanics shop catalogue",
    "sequence": MODEL + " motion", "draft": MODEL,
    "piece": MODEL + " mechanics shop rules sequence draft",
    "workholding": MODEL + " shop draft toolpath",
    "probing": MODEL + " catalogue draft piece step",
    "step": MODEL + " toolpaths casebase tune catalogue selection mechanics motion stock engagement toolpath freeform optimise"
    " draft piece workholding",
    "propose": MODEL + " rules casebase catalogue selection optimise draft piece step",
    "given": MODEL + " mechanics motion rules shop catalogue selection draft piece step",
    "toolpath": MODEL + " stock",
    # Paths over surfaces: of the others it takes what moves are.
    "freeform": MODEL + " stock toolpath",
    "optimise": MODEL + " mechanics motion",
    # A control's own pocket cycle takes a path that nobody has planned: its feed is one that keeps the limits in a slot.
    "gcode": MODEL + " motion optimise",
    # A conformance profile is a data file, read as those of the shop are.
    "controls": MODEL + " gcode shop",
    "volumes": PROVEN,
    # What the check says of kinds of things by itself.
    "copies": GROUND + " nouns plan",
    # The one place that looks at the planner's shapes: to hold them against the own reading.
    "compared": MODEL + " volumes verify",
    # Heights that moves cut: of the check it knows what a move is.
    "grid": GROUND + " nouns plan copies verify",
    # What the part's features leave, as the check reads them, and what stands above it.
    "target": PROVEN + " volumes copies verify grid",
    # A program's text beside the plan's path, move by move.
    "following": PROVEN + " verify",
    # The finished part against a CAD shape: moves as the check reads them, swept over its own points.
    "finished": PROVEN + " copies verify grid target",
    # Macros of touches: the plan's touches, where the piece lies, and what a text does around them.
    "touches": PROVEN + " volumes verify target",
    **{room: GROUND + " plan copies verify" for room in READER_ROOMS.values()},
    # Pockets as cycles of a control: a step of a program beside the plan's, of the check's own kinds.
    "pocket": PROVEN + " mechanics volumes copies verify grid target following",
    "verify": " ".join([PROVEN, "p21", EXCHANGE, "exchange mechanics volumes compared copies grid target touches pocket following", *READER_ROOMS.values()]),
    "pipeline": " ".join(r for r in FOLDERS.values() if r not in DOORS),
    "late": MODEL + " motion given pipeline",
    "report": MODEL + " mechanics motion optimise step",
    "service": " ".join(r for r in FOLDERS.values() if r not in DOORS) + " pipeline late report",
    "transport": "base service public",
    "facade": MODEL + " motion optimise service public",
    # Another language's way into the library: of the project it knows the public header.
    "python": "public",
    # The command shows what others do: the rooms after `service` are what its lists and texts are of.
    "app": MODEL + " brep recognise service transport motion mechanics optimise json rules casebase retain tune controls shop catalogue library formats",
    "public": "",
}
ALLOWED = {room: set(names.split()) for room, names in ALLOWED.items()}

# Of these rooms only such headers: the checker shares numbers with the planner, never its reasoning.
ONLY = {("verify", "mechanics"): re.compile(r"constants?\.h$"),
        ("pocket", "mechanics"): re.compile(r"constants?\.h$"),
        # The tables of ISO 286, not what a file's tolerance is read as.
        ("volumes", "fit"): re.compile(r"fit/(fit|deviation|grade)\.h$"),
        ("verify", "fit"): re.compile(r"fit/(fit|deviation|grade)\.h$")}

# External library -> what its includes look like, and how many .cpp files may have them (None: any number).
# No header may: it would hand the library's names and its compile time to everyone.
FENCES = {
    "NLopt": (r"nlopt\.h(pp)?$", 1),
    "Ipopt": (r"(coin(-or)?/)?Ip[A-Z]\w*\.(hpp|h)$", 1),
    "FLANN": (r"flann/", 1),
    "Clipper": (r"(polyclipping/)?clipper\.hpp$", 1),
    "SQLite": (r"sqlite3(ext)?\.h$", 3),
    "libpqxx": (r"pqxx/|libpq-fe\.h$", 1),
    "CLI11": (r"CLI/", None),
    "nlohmann-json": (r"nlohmann/", None),
    "yaml-cpp": (r"yaml-cpp/", None),
    "valijson": (r"valijson/", None),
    "xxHash": (r"xxhash\.h$", 3),
    "Eigen": (r"(unsupported/)?Eigen/", None),
    "Boost": (r"boost/", 1),
    "OpenSSL": (r"openssl/", 2),  # the second makes certificates for the tests
    "pybind11": (r"pybind11/", 1),
    "OpenCASCADE": (r"(opencascade/)?\w+\.hxx$", 2),
}
FENCES = {name: (re.compile(pattern), limit) for name, (pattern, limit) in FENCES.items()}

C_HEADERS = {"stdbool.h", "stddef.h", "stdint.h"}
EXTERNAL_NAME = re.compile(r"\b(boost|Eigen|nlohmann|YAML|CLI|tl|fmt|nlopt|Ipopt|flann|pqxx|ClipperLib|pybind11)::|\bsqlite3\b")
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')


def room_of(path):
    """The room a path from the root lies in, or None."""
    for folder, room in FOLDERS.items():
        if path.startswith(folder + "/"):
            return room
    return None


def fence_of(name):
    return next((library for library, (pattern, _) in FENCES.items() if pattern.match(name)), None)


def sources(root):
    """The sources of all rooms, as paths from the root, in a fixed order."""
    found = []
    for top in sorted({folder.split("/")[0] for folder in FOLDERS}):
        for folder, _, names in os.walk(os.path.join(root, top)):
            for name in names:
                if name.endswith((".h", ".hpp", ".cpp", ".cc", ".c")):
                    found.append(os.path.relpath(os.path.join(folder, name), root).replace(os.sep, "/"))
    return sorted(found)


def fault_of_include(root, path, name, quoted):
    """What is wrong with one include, or None; and the external library it belongs to, or None."""
    room = room_of(path)
    library = fence_of(name)
    if library:
        fault = None
        if room == "public":
            fault = f"an installed header names {library}"
        elif not path.endswith(".cpp"):
            fault = f"{library} belongs into a .cpp, not into a header"
        return fault, library
    # Installed headers are included as consumers do, or from the root.
    own = "include/" + name if name.startswith("capstan/") else name
    target = room_of(own)
    if target is None:
        if quoted:
            return f'"{name}" is not a path from the root into a room', None
        if room == "public" and not re.fullmatch(r"[a-z_0-9]+", name) and name not in C_HEADERS:
            return f"an installed header includes <{name}>, which is not the standard library's", None
        return None, None
    if not os.path.exists(os.path.join(root, own)):
        return f"{own} does not exist", None
    if target == room:
        return None, None
    if target not in ALLOWED[room]:
        return f"{room} may not include {target} ({name})", None
    only = ONLY.get((room, target))
    if only and not only.search(name):
        return f"{room} may include of {target} only its constants, not {name}", None
    return None, None


def circle(includes):
    """The files of one circle of includes, first named again at the end; None where there is none."""
    done, way = set(), []

    def visit(path):
        if path in way:
            return way[way.index(path):] + [path]
        if path in done:
            return None
        way.append(path)
        for name in includes.get(path, ()):
            found = visit(name)
            if found:
                return found
        way.pop()
        done.add(path)
        return None

    return next((found for found in map(visit, sorted(includes)) if found), None)


def faults(root):
    """All faults, as (path, line, text), in the order of the files."""
    found = []
    users = {}
    includes = {}
    for path in sources(root):
        if room_of(path) is None:
            found.append((path, 1, "lies in no room of the table"))
            continue
        with open(os.path.join(root, path), encoding="utf-8") as file:
            for number, line in enumerate(file, 1):
                if room_of(path) == "public" and EXTERNAL_NAME.search(line.split("//")[0]):
                    found.append((path, number, "an installed header names an external type"))
                match = INCLUDE.match(line)
                if not match:
                    continue
                includes.setdefault(path, []).append(match[1] or match[2])
                fault, library = fault_of_include(root, path, match[1] or match[2], match[1] is not None)
                if fault:
                    found.append((path, number, fault))
                if library:
                    users.setdefault(library, {}).setdefault(path, number)
    for library, places in users.items():
        limit = FENCES[library][1]
        if limit is not None and len(places) > limit:
            for path, number in list(places.items()):
                found.append((path, number, f"{library} is included by {len(places)} files, {limit} is allowed"))
    round_trip = circle(includes)
    if round_trip:
        found.append((round_trip[0], 1, "files include each other in a circle: " + " -> ".join(round_trip)))
    return found


def main(root):
    looked_at = len(sources(root))
    if looked_at == 0:
        print(f"{root}: there is nothing to look at")
        return 1
    found = faults(root)
    for path, number, text in found:
        print(f"{path}:{number}: {text}")
    print(f"{looked_at} files, {len(found)} faults")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1] if len(sys.argv) > 1 else "."))
