#!/usr/bin/env python3
"""Fails where an action of the rules or a strategy has no picture in docs/strategies.md and no reason for having none.

    strategies_drawn.py [ROOT]

Pictures are the rows of PICTURES in docs/strategies/draw.py. The step of a picture ends in the name of its action. Each row
has a file and a place in the page, each file and each place a row.
"""

import importlib.util
import os
import re
import sys

sys.dont_write_bytecode = True
ACTION = re.compile(r'\{"(\w+)",\s*TypeId::')
KIND = re.compile(r"enum class StrategyKind[^{]*\{([^}]*)\}")
SHOWN = re.compile(r"\]\(strategies/(\w+)\.svg\)")


def actions_of(sources):
    """Names of the actions that the texts of rules/strategy/*.cpp list."""
    return {name for text in sources for name in ACTION.findall(text)}


def strategies_of(header):
    """Enumerators of StrategyKind but that of none."""
    found = KIND.search(header)
    return set(re.findall(r"\bk\w+", found.group(1))) - {"kNone"} if found else set()


def faults(actions, strategies, drawn, page, files):
    """One text per gap; `drawn` has PICTURES, NOT_DRAWN and STRATEGIES, `files` are names of pictures without .svg."""
    rows = [row[0] for row in drawn.PICTURES]
    with_picture = {row[2].split("~")[0].rsplit(" ", 1)[-1] for row in drawn.PICTURES}
    reasons, shown = drawn.NOT_DRAWN, SHOWN.findall(page)
    out = []
    for name in sorted(actions - with_picture - set(reasons)):
        out.append(f"action {name} of rules/strategy has no picture: add a row to PICTURES of docs/strategies/draw.py, "
                   "or to NOT_DRAWN with the reason")
    out += [f"NOT_DRAWN names {name}, which is no action of the rules: delete its row" for name in sorted(set(reasons) - actions)]
    out += [f"NOT_DRAWN names {name}, which has a picture: delete its row" for name in sorted(set(reasons) & with_picture)]
    out += [f"NOT_DRAWN gives no reason for {name}" for name in sorted(reasons) if not reasons[name].strip()]
    for name in sorted(strategies - set(drawn.STRATEGIES)):
        out.append(f"strategy {name} of planner/model/plan/proposal.h has no picture: add it to STRATEGIES of "
                   "docs/strategies/draw.py")
    out += [f"STRATEGIES names {name}, which is no StrategyKind: delete its row" for name in sorted(set(drawn.STRATEGIES) - strategies)]
    out += [f"STRATEGIES of {name} names picture {picture}, which PICTURES has not"
            for name, picture in sorted(drawn.STRATEGIES.items()) if picture not in rows]
    out += [f"picture {name} stands twice in PICTURES" for name in sorted({n for n in rows if rows.count(n) > 1})]
    for where, names in (("docs/strategies.md", shown), ("docs/strategies/", files)):
        out += [f"picture {name} of PICTURES is not in {where}" for name in sorted(set(rows) - set(names))]
        out += [f"{where} has picture {name}, which PICTURES has not" for name in sorted(set(names) - set(rows))]
    return out


def load(path):
    """draw.py as a module; it lies beside what it imports."""
    sys.path.insert(0, os.path.dirname(path))
    spec = importlib.util.spec_from_file_location("draw", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def read(path):
    with open(path, encoding="utf-8") as f:
        return f.read()


def main():
    root = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else ".")
    rules, pictures = os.path.join(root, "rules", "strategy"), os.path.join(root, "docs", "strategies")
    actions = actions_of(read(os.path.join(rules, n)) for n in sorted(os.listdir(rules)) if n.endswith(".cpp"))
    strategies = strategies_of(read(os.path.join(root, "planner", "model", "plan", "proposal.h")))
    if not actions or not strategies:
        print("no action or no strategy found: the sources read otherwise now; correct strategies_drawn.py", file=sys.stderr)
        return 1
    found = faults(actions, strategies, load(os.path.join(pictures, "draw.py")),
                   read(os.path.join(root, "docs", "strategies.md")),
                   [n[:-4] for n in os.listdir(pictures) if n.endswith(".svg")])
    for text in found:
        print(text, file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
