#!/usr/bin/env python3
"""Plans a part by the command and lists its steps, as other programs take them from the plan's JSON.

    steps.py PART [ARGUMENTS OF capstan plan ...]      CAPSTAN names the command where it is not on the path
"""

import json
import os
import subprocess
import sys

# What a step takes of the plan's time, s. Of all steps it adds up to summary["total_s"]. The cutting and the
# rapids stand in every plan, the others only where the plan's time is known: steps that are not bound have no
# paths.
TIMES = ("cutting_s", "rapid_s", "link_s", "tool_change_s", "spindle_s")


def planned(part, arguments):
    """The plan of a part, as docs/plan.schema.json describes it. Code 1 has findings, and a plan all the same."""
    command = [os.environ.get("CAPSTAN", "capstan"), "plan", part, "--without", "sections", *arguments, "-o", "-"]
    run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    if run.returncode not in (0, 1):
        sys.exit(run.stderr)
    return json.loads(run.stdout)


def main():
    plan = planned(sys.argv[1], sys.argv[2:])
    whole = plan["summary"].get("total_s")
    total = 0.0
    for step in plan["steps"]:
        time = "time unknown"
        if whole is not None:
            seconds = sum(step.get(name, 0.0) for name in TIMES)
            total += seconds
            time = f"{seconds:6.1f} s, {step.get('tool_change_s', 0.0):.1f} s of it tool change"
        print(f"{step['id']:32} {step.get('operation', ''):30} T{step['tool_number']:<2} {step['spindle_rpm']:6.0f} 1/min "
              f"{step['feed_mm_min']:5.0f} mm/min {time}")
    print(f"{len(plan['steps'])} steps: " +
          ("time unknown" if whole is None else f"{total:.1f} s, of {whole:.1f} s of the whole"))


if __name__ == "__main__":
    main()
