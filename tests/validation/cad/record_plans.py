#!/usr/bin/env python3
"""Plans CAD parts of the corpus and records what came of each: docs/validation/cad_plans.csv.

    record_plans.py CAPSTAN CORPUS OUT.csv [--parts N] [--seconds S] [--total S] [--sets nist,mfcad]
                    [--sizes x10,x1] [--only TEXT] [--keep FOLDER]

Each row: set, half, part, size, outcome, features planned, faces planned, faces on the raw piece, groups not
planned, volume that stays mm3, volume cut away mm3, overlap %, CPU s. One process at a time, with a limit of CPU
time for each and for all of them.

Halves   the 32-bit FNV-1a hash of the part's name: even is `seen`, odd is `held`.
Sample   of each half of MFCAD the N parts with the lowest hash. All files of NIST are run.
Size     MFCAD's parts are cubes of 10 mm, whose passages of about 1 mm no mill of the library enters: each is
         also planned ten times as large (x10), its unit of length being read as the centimetre.
Outcome  whole (safe, nothing left out, no plane face of the shape unreached), in_part (safe, something is left out
         or not reached, and named), none (no feature can be planned), unsafe (the check condemns the plan), refused
         (the file is not read), time (over the limit).
"""

import argparse
import os
import re
import resource
import subprocess
import tempfile


def fnv(name):
    h = 2166136261
    for b in name.encode():
        h = (h ^ b) * 16777619 % 2**32
    return h


def figure(pattern, text, none=""):
    found = re.search(pattern, text)
    return found[1] if found else none


def outcome(said):
    last = said.rstrip().rsplit("\n", 1)[-1]
    if last.startswith("Failed"):
        return "none" if "[APP-IMPOSSIBLE]" in said else "refused"
    if last.startswith("Safe, but not whole"):
        return "in_part"
    if last.startswith("Safe"):
        return "whole"
    return "unsafe"


def plan(command, path, seconds):
    """(code, what it said, CPU seconds) of one run; code None: over its time."""
    def limit():
        os.nice(10)
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with tempfile.TemporaryDirectory() as folder:
        run = subprocess.run([command, "plan", path, "--material", "6061", "--threads", "1", "-o", folder + "/part.json",
                              "-o", folder + "/part.ngc"], preexec_fn=limit, capture_output=True, text=True, cwd=folder)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    # The limit ends the command with a signal, or it stops at it in order.
    over = (run.returncode < 0 and cpu >= seconds - 1) or "\nStopped: " in "\n" + run.stderr + run.stdout
    return None if over else run.returncode, run.stderr + run.stdout, cpu


def main():
    asked = argparse.ArgumentParser()
    asked.add_argument("command")
    asked.add_argument("corpus")
    asked.add_argument("out")
    asked.add_argument("--parts", type=int, default=12)
    asked.add_argument("--seconds", type=int, default=60)
    asked.add_argument("--total", type=float, default=480.0)
    asked.add_argument("--sets", default="nist,mfcad")
    asked.add_argument("--sizes", default="x10,x1", help="of MFCAD's parts")
    asked.add_argument("--only", default="", help="parts whose name holds this")
    asked.add_argument("--keep", help="a folder for what each run said")
    a = asked.parse_args()
    command = os.path.abspath(a.command)
    jobs = []
    nist = os.path.join(a.corpus, "cad", "nist")
    for name in sorted(os.listdir(nist)) if "nist" in a.sets.split(",") else []:
        jobs.append(("nist", "all", name.rsplit(".", 1)[0], "x1", os.path.join(nist, name)))
    mfcad = os.path.join(a.corpus, "cad", "mfcad")
    names = sorted((n[:-5] for n in os.listdir(mfcad) if n.endswith(".step")), key=lambda n: (fnv(n), n))
    for half, odd in (("seen", 0), ("held", 1)):
        for name in [n for n in names if fnv(n) % 2 == odd][:a.parts]:
            for size in a.sizes.split(",") if "mfcad" in a.sets.split(",") else []:
                jobs.append(("mfcad", half, name, size, os.path.join(mfcad, name + ".step")))
    jobs = [j for j in jobs if a.only in j[2]]
    jobs.sort(key=lambda j: (j[3] != "x10", j[0] != "nist", j[1] != "held"))
    spent, rows = 0.0, []
    for kind, half, name, size, path in jobs:
        if spent > a.total:
            break
        with tempfile.TemporaryDirectory() as folder:
            if size == "x10":
                text = open(path, encoding="latin-1").read()
                larger = text.replace("SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT(.CENTI.,.METRE.)")
                assert larger != text, name
                path = os.path.join(folder, name + ".step")
                open(path, "w", encoding="latin-1").write(larger)
            code, said, cpu = plan(command, path, a.seconds)
        spent += cpu
        if a.keep:
            open(os.path.join(a.keep, f"{name}.{size}.txt"), "w").write(f"exit {code}\n{said}")
        result = "time" if code is None else outcome(said)
        rows.append([kind, half, name, size, result,
                     figure(r"(\d+) features? of \d+ faces?; ", said), figure(r"\d+ features? of (\d+) faces?; ", said),
                     figure(r"(\d+) faces? lies? on the sides", said),
                     figure(r"(\d+) groups? of faces or volumes?", said),
                     figure(r"about ([\d.]+) mm3 of [\d.]+ stay", said, "0"),
                     figure(r"([\d.]+) mm3 (?:of|are|is) .*CHK-SHAPE-GOUGE", said, "0"),
                     figure(r"([\d.]+) %", figure(r"(finished part against[^\n]*)", said)), f"{cpu:.1f}"])
        print(",".join(str(c) for c in rows[-1]), flush=True)
    with open(a.out, "w") as out:
        out.write("set,half,part,size,outcome,features,faces,raw,left,stays_mm3,gouged_mm3,overlap,cpu_s\n")
        for row in rows:
            out.write(",".join(str(c) for c in row) + "\n")


main()
