#!/usr/bin/env python3
"""Draws the paths of docs/strategies.md: plans the parts, draws one SVG for each row of PICTURES.

    docs/strategies/draw.py CAPSTAN [NAME...]      CAPSTAN: the built command; NAMEs: these pictures only

Left: the step from above, with what the cutter sweeps in grey; of drilled holes the height of the tip over time.
Right: the same in cabinet projection, z upright. Lengths in mm. Lines are straightened by half a pixel at most.
Prints for each step its time, and the length and time of moves at feed that cut nothing.
"""
import json
import math
import os
import re
import subprocess
import sys
import tempfile

import meshes

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
# What is planned. {folder} holds the meshes of meshes.py and THROUGH, the generic machining centre with coolant through
# its spindle.
THROUGH = "through_coolant.yaml"
PARTS = {
    "strategies": ["docs/strategies/strategies.p21"],
    "outside": ["docs/strategies/outside.p21"],
    "thread": ["docs/strategies/thread.p21"],
    "router": ["examples/reference_pocket.p21", "--machine", "small_router", "--material", "EN AW-6061"],
    "bracket": ["examples/bracket.p21"],
    "forms": ["tests/door/pipeline/parts/form_features.p21"],
    "open": ["tests/door/pipeline/parts/open_ends.p21"],
    "dovetails": ["tests/door/pipeline/parts/dovetails.p21"],
    "far": ["tests/door/pipeline/parts/far_ends.p21"],
    "leaning": ["docs/strategies/leaning.p21", "--tools", "docs/strategies/leaning_tools.yaml"],
    "surface": ["examples/surface.stl", "--material", "EN AW-6061"],
    "boss": ["{folder}/boss.stl", "--material", "EN AW-6061"],
    "ridge": ["{folder}/ridge.stl", "--material", "EN AW-6061"],
    "bowl": ["{folder}/bowl.stl", "--material", "EN AW-6061"],
    "one_profile": ["docs/strategies/thread.p21", "--forbid", "tool=generic/thread_mill_rows*"],
    "vee": ["docs/strategies/vee.p21", "--tools", "docs/strategies/vee_tools.yaml"],
    "profiles": ["docs/strategies/profiles.p21"],
    "holes": ["docs/strategies/holes.p21"],
    "batch": ["docs/strategies/holes.p21", "--batch", "500"],
    "thin": ["docs/strategies/thin.p21"],
    "slot": ["docs/strategies/slot.p21", "--machine", "small_router"],
    "gun": ["docs/strategies/gun.p21", "--machine", "{folder}/" + THROUGH],
    "open_outside": ["docs/strategies/open_outside.p21"],
    "through": ["docs/strategies/through.p21"],
}
# name of the picture, part, step, left panel ("above", "time", or "end": above, about where the path leaves the wall)
PICTURES = [
    ("rings", "strategies", "RINGS", "above"),
    ("spiral", "strategies", "SPIRAL", "above"),
    ("to_and_fro", "strategies", "TO AND FRO", "above"),
    ("one_way", "strategies", "ONE WAY", "above"),
    ("contour_then_passes", "strategies", "CONTOUR THEN PASSES", "above"),
    ("around_a_boss", "strategies", "AROUND A BOSS area_rough", "above"),
    ("constant_engagement", "router", "POCKET area_rough", "above"),
    ("rest", "strategies", "NARROW CORNERS rest_rough", "above"),
    ("closed_slot", "strategies", "CLOSED SLOT area_rough", "above"),
    ("peck", "strategies", "DEEP HOLE drill", "time"),
    ("helix_in_hole", "strategies", "BORED HOLE mill_rough", "above"),
    ("bore", "strategies", "BORED HOLE bore~2", "time"),
    ("thread_mill", "thread", "THREAD thread_mill", "above"),
    ("face", "bracket", "TOP FACE plane_finish", "above"),
    ("high_feed", "leaning", "TOP FACE plane_rough", "above"),
    ("drill_insert", "leaning", "HOLE drill", "time"),
    ("pocket_finish", "bracket", "POCKET area_finish", "above"),
    ("open_slot", "bracket", "SLOT area_rough", "above"),
    ("spot", "strategies", "DEEP HOLE centre", "time"),
    ("ream", "bracket", "DOWEL HOLE 1 ream", "time"),
    ("tap", "bracket", "M6 tap", "time"),
    ("drill", "bracket", "MOUNTING HOLES[1] drill", "time"),
    ("outside", "outside", "OUTSIDE area_rough", "above"),
    ("outside_finish", "outside", "OUTSIDE area_finish", "above"),
    ("step", "open", "STEP area_rough", "above"),
    ("step_finish", "open", "STEP area_finish", "above"),
    ("t_slot", "forms", "T-SLOT t_slot_finish", "above"),
    ("chamfer", "strategies", "CHAMFER chamfer", "above"),
    ("edge_round", "forms", "POCKET EDGE edge_round", "above"),
    ("dovetail", "dovetails", "DRAWN dovetail_finish", "above"),
    ("back_counterbore", "far", "COUNTERBORED[2] back_mill", "above"),
    ("freeform_rough", "surface", "surface freeform_rough", "above"),
    ("freeform_semi_finish", "surface", "surface freeform_finish", "above"),
    ("freeform_finish", "surface", "surface freeform_finish~2", "above"),
    ("lead_out", "bracket", "POCKET area_finish", "end"),
    ("thin_floor", "thin", "THIN floor_finish", "above"),
    ("thin_wall", "thin", "THIN thin_wall_finish", "above"),
    ("slot_constant_engagement", "slot", "SLOT area_rough", "above"),
    ("open_outside", "open_outside", "OPEN OUTSIDE area_rough", "above"),
    ("wall_rough", "through", "CONTOUR wall_rough", "above"),
    ("wall_finish", "through", "CONTOUR wall_finish", "above"),
    ("vee_rough", "vee", "VEE vee_rough", "above"),
    ("vee_finish", "vee", "VEE vee_finish", "above"),
    ("section_rough", "profiles", "ROUNDED VEE section_rough", "above"),
    ("section_finish", "profiles", "ROUNDED VEE section_finish", "above"),
    ("round_slot", "profiles", "ROUND ball_slot", "above"),
    ("dovetail_rough", "dovetails", "DRAWN dovetail_rough", "above"),
    ("gun_pilot", "gun", "LONG gun_pilot", "time"),
    ("gun_drill", "gun", "LONG gun_drill", "time"),
    ("ball_bottom", "holes", "BALL ball_bottom", "time"),
    ("countersink", "holes", "SUNK[1] countersink", "time"),
    ("countersink_mill", "holes", "SUNK WIDE[1] countersink_mill", "above"),
    ("counterbore", "batch", "BORED[1] counterbore", "time"),
    ("shoulder", "holes", "BORED[1] mill_finish", "above"),
    ("taper_rough", "holes", "TAPERED taper_rough", "above"),
    ("taper_levels", "holes", "TAPERED taper_levels", "above"),
    ("taper_finish", "holes", "TAPERED taper_finish", "above"),
    ("back_chamfer", "far", "COUNTERSUNK[2] back_chamfer", "above"),
    ("thread_mill_one_profile", "one_profile", "THREAD thread_mill", "above"),
    ("freeform_rest", "ridge", "surface freeform_rest", "above"),
    ("freeform_levels", "boss", "surface freeform_levels", "above"),
    ("freeform_heights", "bowl", "surface freeform_finish~2", "above"),
]
# Actions of the rules (rules/strategy/) without a picture of their own, and why.
NOT_DRAWN = {
    "spring_pass": "the path of area_finish, with less left for it",
    "wall_spring_pass": "the path of wall_finish, with less left for it",
    "rest_finish": "the path of rest_rough, to the finished size",
    "break_edge": "the path of chamfer",
    "probe_feature": "a probe cuts nothing",
    "measure": "a probe cuts nothing",
    "back_open": "the path of drill",
    "pilot": "the path of drill",
    "taper_drill": "the path of drill",
    "peck_drill": "the path of drill, deep: picture peck",
    "t_slot_rough": "the path of dovetail_rough",
}
# What a file may state and a rule may ask for (StrategyKind): the picture that shows it.
STRATEGIES = {
    "kBidirectional": "to_and_fro",
    "kUnidirectional": "one_way",
    "kContourParallel": "rings",
    "kContourSpiral": "spiral",
    "kContourBidirectional": "contour_then_passes",
    "kCenterMilling": "round_slot",
}
# A picture that shows a choice of the planner: the reason that must stand in the plan, else the old one stays.
CHOSEN = {"constant_engagement": "path.constant_engagement", "slot_constant_engagement": "path.constant_engagement"}
COLOURS = {  # kind of move: colour, width, dashes
    "rapid": ("#c33", 0.7, "4 3"),
    "way": ("#777", 0.9, ""),  # approach, retract
    "down": ("#e67e00", 1.4, ""),  # plunge, ramp, helix
    "cut": ("#1f5fa8", 1.2, ""),
    "link": ("#1a8f60", 1.2, ""),
    "air": ("#c0399f", 1.4, ""),  # at feed, nothing cut
}
SAID = {"rapid": "rapid", "way": "approach, retract", "down": "plunge, ramp, helix", "cut": "cut", "link": "link",
        "air": "at feed, cuts nothing"}
PANEL, HEIGHT, MARGIN = 400.0, 300.0, 14.0
STRAIGHT_PX = 0.5


def points_of(path, i):
    """Points of move i, its first left out."""
    x0, y0, z0 = path["x"][i - 1], path["y"][i - 1], path["z"][i - 1]
    x1, y1, z1 = path["x"][i], path["y"][i], path["z"][i]
    kind = path["kind"][i]
    if kind not in "WC":
        return [(x1, y1, z1)]
    cx, cy = path["cx"][i], path["cy"][i]
    r = math.hypot(x0 - cx, y0 - cy)
    a, b = math.atan2(y0 - cy, x0 - cx), math.atan2(y1 - cy, x1 - cx)
    sweep = b - a
    if kind == "W":
        while sweep >= -1e-9:
            sweep -= 2 * math.pi
    else:
        while sweep <= 1e-9:
            sweep += 2 * math.pi
    n = max(2, int(math.ceil(abs(sweep) / 0.1)))
    out = []
    for k in range(1, n + 1):
        t = k / n
        out.append((cx + r * math.cos(a + sweep * t), cy + r * math.sin(a + sweep * t), z0 + (z1 - z0) * t))
    out[-1] = (x1, y1, z1)
    return out


def straightened(points, tolerance):
    """Douglas and Peucker, without recursion."""
    if len(points) < 3:
        return points
    keep = [False] * len(points)
    keep[0] = keep[-1] = True
    todo = [(0, len(points) - 1)]
    while todo:
        a, b = todo.pop()
        (ax, ay), (bx, by) = points[a], points[b]
        length = math.hypot(bx - ax, by - ay)
        worst, at = 0.0, -1
        for k in range(a + 1, b):
            px, py = points[k]
            if length < 1e-9:
                d = math.hypot(px - ax, py - ay)
            else:
                t = max(0.0, min(1.0, ((px - ax) * (bx - ax) + (py - ay) * (by - ay)) / length ** 2))
                d = math.hypot(px - ax - t * (bx - ax), py - ay - t * (by - ay))
            if d > worst:
                worst, at = d, k
        if worst > tolerance:
            keep[at] = True
            todo += [(a, at), (at, b)]
    return [p for p, k in zip(points, keep) if k]


def number(v):
    text = "%.1f" % v
    return text[:-2] if text.endswith(".0") else text


def line_of(points):
    """The straightened line; steps from one rounded point to the next are shorter than places."""
    tenths = [(round(10 * x), round(10 * y)) for x, y in straightened(points, STRAIGHT_PX)]
    steps = ((x - px, y - py) for (px, py), (x, y) in zip(tenths, tenths[1:]))
    first = "M%s %s" % (number(0.1 * tenths[0][0]), number(0.1 * tenths[0][1]))
    rest = " ".join(number(0.1 * dx) + " " + number(0.1 * dy) for dx, dy in steps)
    # A sign parts two numbers by itself, and no number needs the zero before its point.
    rest = re.sub(r"\b0\.", ".", rest).replace(" -", "-")
    return first + ("l" if rest else "") + rest


class Step:
    def __init__(self, plan, step):
        find = lambda name, key: plan[name][int(step[key].split(":")[1]) - 1]
        self.path, self.schedule = find("paths", "path"), find("schedules", "schedule")
        self.sections = find("sections", "sections") if step.get("sections") else {"move": [], "csa_mm2": []}
        self.cutter = next(c for c in plan["cutters"] if c["id"] == step["cutter_id"])
        self.step = step
        self.rapid_mm_min = min(a["rapid_mm_min"] for a in plan["machine"]["axes"] if a["name"] in "XYZ")
        cuts = {m for m, a in zip(self.sections["move"], self.sections["csa_mm2"]) if a > 0.0}
        self.measured = bool(cuts)
        self.kinds = [""]
        for i in range(1, len(self.path["x"])):
            self.kinds.append(self.kind_of(i, i in cuts))

    def kind_of(self, i, cuts):
        role = self.path["role"][i]
        if self.path["kind"][i] == "R":
            return "rapid"
        if self.measured and not cuts and role in "PMCL":
            return "air"
        if role in "AR":
            return "way"
        return {"P": "down", "M": "down", "C": "cut", "L": "link"}.get(role, "cut")

    def length(self, i):
        p = (self.path["x"][i - 1], self.path["y"][i - 1], self.path["z"][i - 1])
        total = 0.0
        for q in points_of(self.path, i):
            total += math.dist(p, q)
            p = q
        return total

    def seconds(self, i):
        if self.path["kind"][i] == "D":
            return self.schedule["dwell_s"][i]
        rate = self.rapid_mm_min if self.path["kind"][i] == "R" else self.schedule["feed_mm_min"][i]
        return 60.0 * self.length(i) / rate if rate > 0.0 else 0.0

    def runs(self, point):
        """(kind, points) of runs of one kind, in the panel's coordinates; `point(p, t)` projects."""
        out, t = [], 0.0
        here = (self.path["x"][0], self.path["y"][0], self.path["z"][0])
        for i in range(1, len(self.path["x"])):
            if not out or out[-1][0] != self.kinds[i]:
                out.append((self.kinds[i], [point(here, t)]))
            ahead = self.seconds(i)
            pts = points_of(self.path, i)
            for k, p in enumerate(pts):
                out[-1][1].append(point(p, t + ahead * (k + 1) / len(pts)))
            here, t = pts[-1], t + ahead
        return out


def cabinet(p, _t):
    a = math.radians(38.0)
    return (p[0] + 0.5 * p[1] * math.cos(a), p[2] + 0.5 * p[1] * math.sin(a))


def panel(step, point, left, same_scale, swept_mm, out, widest_mm=0.0, window=None, name=""):
    """Draws the runs, fitted into the panel; gives its scale and width. `window`: lowest and highest corner of what is
    shown, else all of it; `name`: of the picture, in the ids of its lines."""
    widest_mm = max(widest_mm, swept_mm)
    runs = step.runs(point)
    xs = [p[0] for _, pts in runs for p in pts]
    ys = [p[1] for _, pts in runs for p in pts]
    grow = widest_mm / 2.0
    lo, hi = (min(xs) - grow, min(ys) - grow), (max(xs) + grow, max(ys) + grow)
    if window:
        lo, hi = window
    w, h = max(hi[0] - lo[0], 1e-3), max(hi[1] - lo[1], 1e-3)
    sx, sy = (PANEL - 2 * MARGIN) / w, (HEIGHT - 2 * MARGIN) / h
    if same_scale:
        sx = sy = min(sx, sy)
    ox, oy = left + (PANEL - sx * w) / 2, (HEIGHT - sy * h) / 2
    at = lambda p: (ox + sx * (p[0] - lo[0]), HEIGHT - oy - sy * (p[1] - lo[1]))
    if window:  # a viewport of its own cuts off what lies outside
        out.append('<svg x="%s" y="0" width="%s" height="%s" viewBox="%s 0 %s %s">' %
                   (*(number(v) for v in (left, PANEL, HEIGHT, left, PANEL, HEIGHT)),))
    drawn = {}  # of each kind its lines, and what draws them once more
    for kind in ("rapid", "way", "cut", "link", "down", "air"):
        lines = [line_of([at(p) for p in pts]) for k, pts in runs if k == kind]
        if lines:
            drawn[kind] = 'path d="%s"' % " ".join(lines)
    if swept_mm > 0.0:
        swept = [kind for kind in drawn if kind not in ("rapid", "way")]
        out.append("<defs>%s</defs>" % "".join('<path id="%s-%s" %s/>' % (name, k, drawn[k][len("path "):]) for k in swept))
        drawn.update({kind: 'use href="#%s-%s"' % (name, kind) for kind in swept})
        for wide, grey in ((widest_mm, "#eceef1"), (swept_mm, "#d9dde2")):
            if grey == "#d9dde2" or wide > swept_mm:
                out += ['<%s stroke="%s" stroke-width="%s" stroke-linecap="round"/>' % (drawn[k], grey, number(sx * wide))
                        for k in swept]
    for kind, lines in drawn.items():
        colour, width, dashes = COLOURS[kind]
        out.append('<%s stroke="%s" stroke-width="%s"%s/>' %
                   (lines, colour, width, ' stroke-dasharray="%s"' % dashes if dashes else ""))
    if window:
        out.append("</svg>")
    return sx, w


def bar(left, scale, out):
    """A scale bar, mm, at the bottom of a panel."""
    for length in (100, 50, 20, 10, 5, 2, 1):
        if length * scale <= PANEL / 3:
            break
    x, y = left + MARGIN, HEIGHT + 6
    out.append('<path d="M%s %sh%s" stroke="#000" stroke-width="2"/>' % (number(x), number(y), number(length * scale)))
    out.append('<text x="%s" y="%s">%d mm</text>' % (number(x + length * scale + 5), number(y + 4), length))


def widest(step):
    """The circle where leaning edges of a face mill leave the material; its diameter is that at the tip."""
    lean = step.cutter.get("lead_angle_rad", 0.0) if step.cutter["cutter_class"] == "facemill" else 0.0
    return step.cutter["cutting_diameter_mm"] + 2.0 * step.step["axial_depth_mm"] * math.tan(lean)


def about_its_end(step):
    """The corners of a square about the last arc of the path, 0.8 diameters to either side."""
    last = max(i for i in range(1, len(step.path["x"])) if step.path["kind"][i] in "WC")
    at, room = (step.path["x"][last - 1], step.path["y"][last - 1]), 0.8 * step.cutter["cutting_diameter_mm"]
    return (at[0] - room, at[1] - room), (at[0] + room, at[1] + room)


def draw(name, step, view):
    out, kinds = [], [k for k in COLOURS if k in step.kinds]
    diameter = step.cutter["cutting_diameter_mm"]
    if view == "time":
        panel(step, lambda p, t: (t, p[2]), 0.0, False, 0.0, out)
        total = sum(step.seconds(i) for i in range(1, len(step.path["x"])))
        out.append('<text x="%s" y="%s">height of the tip over %.1f s</text>' % (number(MARGIN), number(HEIGHT + 10), total))
    else:
        scale, _ = panel(step, lambda p, t: (p[0], p[1]), 0.0, True, diameter, out, widest(step),
                         about_its_end(step) if view == "end" else None, name)
        bar(0.0, scale, out)
    scale, _ = panel(step, cabinet, PANEL + 10, True, 0.0, out)
    bar(PANEL + 10, scale, out)
    x = MARGIN
    for k in kinds:
        colour, width, dashes = COLOURS[k]
        out.append('<path d="M%s %sh18" stroke="%s" stroke-width="%s"%s/>' %
                   (number(x), number(HEIGHT + 30), colour, width + 0.6, ' stroke-dasharray="%s"' % dashes if dashes else ""))
        out.append('<text x="%s" y="%s">%s</text>' % (number(x + 22), number(HEIGHT + 34), SAID[k]))
        x += 34 + 6.2 * len(SAID[k])
    s = step.step
    said = "%s; %s %s mm" % (s["id"], step.cutter["cutter_class"].replace("_", " "), number(diameter))
    if s["axial_depth_mm"] > 0.0 and view != "time":
        said += "; %s deep, %s wide" % (number(s["axial_depth_mm"]), number(s["radial_depth_mm"]))
    said += "; %.0f 1/min, %.0f mm/min; %.1f s" % (s["spindle_rpm"], s["feed_mm_min"], s["cutting_s"] + s["rapid_s"])
    out.append('<text x="%s" y="%s">%s</text>' % (number(MARGIN), number(HEIGHT + 54), said.replace("&", "&amp;")))
    width, height = number(2 * PANEL + 10), number(HEIGHT + 64)
    return ('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 %s %s" width="%s" height="%s" fill="none" '
            'stroke-linejoin="round" font-family="sans-serif" font-size="11">\n'
            '<style>text{fill:#000;stroke:none}</style><rect width="100%%" height="100%%" fill="#fff"/>\n%s\n</svg>\n' %
            (width, height, width, height, "\n".join(out)))


def main():
    command, wanted = sys.argv[1], sys.argv[2:]
    pictures = [p for p in PICTURES if not wanted or p[0] in wanted]
    plans, status = {}, 0
    with tempfile.TemporaryDirectory() as folder:
        meshes.write(folder)
        machine = subprocess.run([os.path.abspath(command), "machines", "show", "generic_vmc"], check=True,
                                 capture_output=True, encoding="utf-8").stdout
        with open(os.path.join(folder, THROUGH), "w", encoding="utf-8") as f:
            f.write(machine.replace("through: false", "through: true"))
        for part in sorted({p[1] for p in pictures}):
            name = os.path.join(folder, part + ".json")
            subprocess.run([os.path.abspath(command), "plan", *(a.format(folder=folder) for a in PARTS[part]), "-o", name], cwd=ROOT,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            if not os.path.exists(name):
                print("%s: no plan is made of it" % part, file=sys.stderr)
                plans[part] = {"steps": []}
                continue
            with open(name, encoding="utf-8") as f:
                plans[part] = json.load(f)
    for name, part, wanted_step, view in pictures:
        found = [s for s in plans[part]["steps"] if s["id"] == wanted_step]
        if not found or not found[0].get("path"):
            print("%s: the plan of %s has no path of a step '%s'" % (name, part, wanted_step), file=sys.stderr)
            status = 1
            continue
        if name in CHOSEN and not any(CHOSEN[name] in json.dumps(r) for r in plans[part]["reasons"]):
            print("%s: not chosen for %s now; its picture stays" % (name, part), file=sys.stderr)
            continue
        step = Step(plans[part], found[0])
        text = draw(name, step, view)
        with open(os.path.join(HERE, name + ".svg"), "w", encoding="utf-8") as f:
            f.write(text)
        air = [i for i in range(1, len(step.kinds)) if step.kinds[i] == "air"]
        print("%-22s %6.1f s, %3d kB; at feed through nothing %7.1f mm, %5.1f s" %
              (name, found[0]["cutting_s"] + found[0]["rapid_s"], len(text) // 1000 + 1,
               sum(step.length(i) for i in air), sum(step.seconds(i) for i in air)))
    return status


if __name__ == "__main__":
    sys.exit(main())
