#!/usr/bin/env python3
"""Plans a part by the command and lists its steps, as other programs take them from the plan's JSON.

    steps.py PART [ARGUMENTS OF capstan plan ...]      CAPSTAN names the command where it is not on the path
"""

import json
import os
import subprocess
import sys


def planned(part, arguments):
    """The plan of a part, as docs/plan.schema.json describes it. Code 1 has findings, and a plan all the same."""
    command = [os.environ.get("CAPSTAN", "capstan"), "plan", part, *arguments, "-o", "-"]
    run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    if run.returncode not in (0, 1):
        sys.exit(run.stderr)
    return json.loads(run.stdout)


def main():
    plan = planned(sys.argv[1], sys.argv[2:])
    tools = {cutter["id"]: cutter for cutter in plan["cutters"]}
    for step in plan["steps"]:
        tool = tools[step["cutter_id"]]
        print(f"{step['id']:32} T{tool['pocket']:<2} {step['cutter_id']:36} {step['spindle_rpm']:6.0f} 1/min "
              f"{step['feed_mm_min']:5.0f} mm/min {step['cutting_s'] + step['rapid_s']:6.1f} s")
    cutting, rapid = (sum(step[name] for step in plan["steps"]) for name in ("cutting_s", "rapid_s"))
    print(f"{len(plan['steps'])} steps: {cutting:.1f} s with feed and waits, {rapid:.1f} s rapid")


if __name__ == "__main__":
    main()
