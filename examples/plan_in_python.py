#!/usr/bin/env python3
"""A plan looked at and changed from Python, cell by cell (editors run the parts between '# %%' one at a time).

    plan_in_python.py [PART]
"""

# %% Plan a part
import sys

import numpy as np

import capstan

part = sys.argv[1] if len(sys.argv) > 1 else "bracket.p21"
plan = capstan.plan(part)
print(plan)
for message in plan.findings:
    print(f"{message.severity}: {message}")

# %% The steps, as the plan's JSON has them (docs/plan.schema.json)
for step in plan.steps[:3]:
    print(f"{step['id']:20} T{step['tool_number']:<3} {step['operation']:30} {step['cutting_s']:6.1f} s")

# %% The path of a step as arrays: where it cuts, how far, how fast
pocket = next(s["id"] for s in plan.steps if s["operation"] == "bottom_and_side_rough_milling")
path = plan.path(pocket)
length, feed = path.length_mm, path.feed_mm_min
print(f"{pocket}: {len(path)} moves, {length[path.cuts].sum():.0f} mm at feed, "
      f"{np.average(feed[path.cuts], weights=length[path.cuts]):.0f} mm/min on average, "
      f"deepest {path.z[path.cuts].min():.3f} mm")
points, _ = path.points(chord_mm=0.01)
print(f"as a polyline {len(points)} points, from {np.round(points.min(axis=0), 3)} to {np.round(points.max(axis=0), 3)}")

# %% A person decides: no feed above 1500 mm/min. What depends on it is planned anew
slower = plan.edited(limit=["feed<=1500"])
print(f"{plan.time_s:.1f} s, with feeds of 1500 mm/min at most {slower.time_s:.1f} s")

# %% Why is a value what it is?
print("\n".join(slower.explain(pocket).splitlines()[:4]))

# %% Checked anew, and written
checked = slower.check()
print(checked)
slower.write("slower.json")
slower.write("slower.ngc")
