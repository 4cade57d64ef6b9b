"""Makes the programs of another planner that ours are compared with: FreeCAD's Path workbench, its operations
Pocket Shape (offset pattern) and Adaptive. To be run by FreeCAD without a screen:

    cd tests/validation/freecad && freecadcmd make_programs.py        (Debian 12: package freecad, 0.20.2)

The parts are those of rivals.h: a pocket of 60 x 40 mm with corners R6, 10 and 20 mm deep, plain and with a round boss
of 14 mm in its middle; a 10 mm end mill; 0.3 mm left on walls, 0.2 mm on the floor. Entries at 3 and at 5 degrees, a
helix (Adaptive) or a ramp along the first ring (Pocket, with the dressup RampEntry). Step-overs and levels: of 10, 15,
20, 30, 40, 50 % (Adaptive) and 40, 50, 60 % (Pocket), of 1 and 2, or 1, 2, 3, 4 and 6 levels those that were fastest
in aluminium and in steel at the limits of the comparison, with entries at 7 degrees; and Pocket in two and three levels,
which at lower angles and shallower slots may be faster. Feeds are not taken from here: F is a placeholder.
"""
import os

import FreeCAD
import Part
import Path
import PathScripts.PathAdaptive as PathAdaptive
import PathScripts.PathDressupRampEntry as RampEntry
import PathScripts.PathJob as PathJob
import PathScripts.PathPocketShape as PathPocketShape
from FreeCAD import Vector

LENGTH, WIDTH, CORNER, DIAMETER = 60.0, 40.0, 6.0, 10.0
ON_WALLS, ON_FLOOR = 0.3, 0.2
# degrees: what the generic end mills with four and with three flutes bear
ANGLES = (3, 5)
# How its pocket operation ramps: "RampMethod1" to and fro along its first sides, at the angle; "Helix" goes down each
# level in one round of each ring it begins with, whatever the angle, and is too steep but for one part.
GENTLE_ROUND = (10, 0, "pocket", 60, 1)
# depth, boss, operation, step-over in percent, levels
PROGRAMS = [(depth, boss, "pocket", 60, 1) for depth in (10, 20) for boss in (0, 14)] + [
    (10, 0, "adaptive", 50, 1), (10, 0, "adaptive", 20, 1),
    (10, 14, "adaptive", 50, 1), (10, 14, "adaptive", 20, 1),
    (20, 0, "adaptive", 30, 1), (20, 0, "adaptive", 20, 2),
    (20, 14, "adaptive", 40, 1), (20, 14, "adaptive", 20, 2),
    (10, 0, "pocket", 60, 2), (10, 14, "pocket", 60, 2), (20, 0, "pocket", 60, 2), (20, 14, "pocket", 60, 2),
    (20, 0, "pocket", 60, 3)]  # beside the boss its third level cuts into it


def part_shape(depth, boss):
    """The block, its pocket in the middle of the top, z = 0 the top."""
    block = Part.makeBox(100, 80, depth + 15, Vector(0, 0, -depth - 15))
    hollow = Part.makeBox(LENGTH, WIDTH, depth, Vector(50 - LENGTH / 2, 40 - WIDTH / 2, -depth))
    upright = [e for e in hollow.Edges if abs(e.Vertexes[0].Z - e.Vertexes[1].Z) > depth / 2]
    part = block.cut(hollow.makeFillet(CORNER, upright))
    if boss:
        part = part.fuse(Part.makeCylinder(boss / 2.0, depth, Vector(50, 40, -depth))).removeSplitter()
    return part


def operation(doc, depth, boss, kind, stepover, levels, angle, way):
    shape = doc.addObject("Part::Feature", "Part")
    shape.Shape = part_shape(depth, boss)
    doc.recompute()
    job = PathJob.Create("Job", [shape], None)
    job.GeometryTolerance.Value = 0.01
    tool = job.Tools.Group[0]
    tool.Tool.Diameter = DIAMETER
    model = job.Model.Group[0]
    floors = ["Face%d" % (i + 1) for i, f in enumerate(model.Shape.Faces)
              if abs(f.BoundBox.ZMin + depth) < 1e-6 and abs(f.BoundBox.ZMax + depth) < 1e-6]
    op = (PathAdaptive if kind == "adaptive" else PathPocketShape).Create("Op")
    op.Base = [(model, floors)]
    for name in ("StepDown", "FinalDepth", "StartDepth", "ClearanceHeight", "SafeHeight"):
        op.setExpression(name, None)
    op.ToolController = tool
    op.StartDepth.Value, op.FinalDepth.Value = 0.0, ON_FLOOR - depth
    op.StepDown.Value = float(depth) / levels
    op.ClearanceHeight.Value, op.SafeHeight.Value = 5.0, 0.5
    op.StepOver = stepover
    op.UseOutline = False
    if kind == "adaptive":
        op.StockToLeave, op.Tolerance = ON_WALLS, 0.1
        op.Side, op.OperationType, op.FinishingProfile = "Inside", "Clearing", True
        op.HelixAngle, op.UseHelixArcs = float(angle), True
        op.KeepToolDownRatio, op.LiftDistance = 3.0, 0.5
        doc.recompute()
        return op
    op.ExtraOffset.Value, op.OffsetPattern = ON_WALLS, "Offset"
    op.CutMode, op.StartAt, op.KeepToolDown = "Climb", "Center", True
    doc.recompute()
    ramp = doc.addObject("Path::FeaturePython", "Ramp")
    RampEntry.ObjectDressup(ramp)
    ramp.Base = op
    job.Proxy.addOperation(ramp, op)
    ramp.Angle, ramp.Method = 90.0 - angle, way  # it is measured from the tool axis
    doc.recompute()
    return ramp


def number(value):
    text = ("%.3f" % value).rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def program(commands):
    """RS274/NGC: moves only, each word once."""
    out, last, motion = ["G21 G17 G90 G94", "F1000"], {}, ""
    for c in commands:
        if c.Name not in ("G0", "G1", "G2", "G3"):
            continue
        words = []
        for axis in "XYZ":
            if axis in c.Parameters and last.get(axis) != number(c.Parameters[axis]):
                last[axis] = number(c.Parameters[axis])
                words.append(axis + last[axis])
        if not words and c.Name in ("G0", "G1"):
            continue
        if c.Name in ("G2", "G3"):
            words += [a + number(c.Parameters.get(a, 0.0)) for a in "IJ"]
        out.append((c.Name if c.Name != motion else "") + "".join(words))
        motion = c.Name
    return "\n".join(out + ["M2"]) + "\n"


folder = os.path.join(os.getcwd(), "programs")
for depth, boss, kind, stepover, levels in PROGRAMS:
    ways = [(angle, "RampMethod1", str(angle)) for angle in ANGLES]
    if (depth, boss, kind, stepover, levels) == GENTLE_ROUND:
        ways.append((ANGLES[0], "Helix", "round"))
    for angle, way, ends in ways:
        doc = FreeCAD.newDocument("rival")
        made = operation(doc, depth, boss, kind, stepover, levels, angle, way)
        name = "%s_%d_%d_%d_%d_%s.ngc" % (kind, depth, boss, stepover, levels, ends)
        with open(os.path.join(folder, kind, name), "w") as f:
            f.write(program(made.Path.Commands))
        FreeCAD.closeDocument(doc.Name)
