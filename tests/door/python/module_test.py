#!/usr/bin/env python3
"""The module of Python: what the library gives comes out, paths as arrays, errors as exceptions."""

import json
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed (Debian: python3-numpy)")
    sys.exit(77)

import capstan
from capstan import _capstan

SOURCE = None  # the tree


def example(name):
    return os.path.join(SOURCE, "examples", name)


class Options(unittest.TestCase):
    def test_are_the_fields_of_the_header(self):
        with open(os.path.join(SOURCE, "include/capstan/capstan.h"), encoding="utf-8") as file:
            struct = re.search(r"struct PlanOptions \{(.*?)\n\};", file.read(), re.S).group(1)
        struct = re.sub(r"///.*", "", struct)
        wanted = set()
        for line in struct.split(";"):
            # A type, then names with commas between them, each with a value or without.
            line = re.sub(r"<.*>|\{.*?\}", "", line.replace("\n", " ").strip())
            names = re.sub(r"^[\w:]+ ", "", line).split(",")
            wanted |= {name.partition("=")[0].strip() for name in names if name.strip()}
        wanted -= {"progress", "stop"}  # a parameter of the calls; Ctrl-C
        wanted = {"from_" if name == "from" else name for name in wanted}
        self.assertEqual(sorted(wanted), capstan._OPTIONS)  # pylint: disable=protected-access

    def test_are_those_of_the_command(self):
        other = {"edges": "edge_break_mm", "spindle_power": "spindle_power_kw", "from": "from_"}
        for name in _capstan.option_names():
            name = name.replace("-", "_")
            self.assertIn(other.get(name, name), capstan._OPTIONS)  # pylint: disable=protected-access

    def test_of_a_wrong_name_are_refused_with_the_nearest(self):
        with self.assertRaisesRegex(TypeError, "'machin' is no option; did you mean 'machine'?"):
            capstan.plan(example("bracket.p21"), machin="generic_vmc")

    def test_of_a_wrong_type_are_refused_with_the_type(self):
        with self.assertRaisesRegex(TypeError, "option 'set' is a list, not 'POCKET"):
            capstan.plan(example("bracket.p21"), set="POCKET*/tool=T5")

    def test_of_a_wrong_value_are_an_error_of_the_library(self):
        with self.assertRaisesRegex(capstan.Error, "OPTION-VALUE|margin"):
            capstan.plan(example("bracket.p21"), margin="reckless")


class Planned(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stages = []
        cls.plan = capstan.plan(example("reference_pocket.p21"), progress=lambda *at: cls.stages.append(at))

    def test_has_the_steps_of_its_json_and_their_times_sum_to_its_own(self):
        names = ("cutting_s", "rapid_s", "link_s", "tool_change_s", "spindle_s")
        self.assertEqual(len(self.plan.steps), 2)
        self.assertAlmostEqual(sum(s.get(n, 0.0) for s in self.plan.steps for n in names), self.plan.time_s, 9)

    def test_told_how_far_it_is(self):
        self.assertTrue(self.stages)
        for stage, fraction in self.stages:
            self.assertIsInstance(stage, str)
            self.assertTrue(0.0 <= fraction <= 1.0)

    def test_has_no_finding_and_checks_clean(self):
        self.assertEqual((self.plan.findings, self.plan.condemned), ([], []))
        self.assertTrue(self.plan.check().clean)

    def test_whose_program_is_altered_is_not_clean(self):
        deeper = self.plan.program.replace(b"Z-", b"Z-1")
        self.assertNotEqual(deeper, self.plan.program)
        with tempfile.TemporaryDirectory() as folder:
            plan, program = os.path.join(folder, "p.json"), os.path.join(folder, "p.ngc")
            self.plan.write(plan)
            with open(program, "wb") as file:
                file.write(deeper)
            checked = capstan.check(plan, program)
        self.assertFalse(checked.clean)
        self.assertTrue(all(f.code.startswith("CHK-") for f in checked.findings))

    def test_paths_have_the_columns_of_the_json(self):
        for i, step in enumerate(self.plan.steps):
            column = self.plan.data["paths"][i]
            path = self.plan.path(step["id"])
            np.testing.assert_array_equal(path.xyz, np.array([column["x"], column["y"], column["z"]]).T)
            self.assertEqual("".join(path.kind), column["kind"])
            self.assertEqual("".join(path.role), column["role"])
            self.assertIs(self.plan.path(i + 1).x.flags.writeable, False)

    def test_time_at_feed_is_not_below_length_over_feed(self):
        """The time of a step is that of its moves with the machine's accelerations, which only add to it."""
        for step in self.plan.steps:
            path = self.plan.path(step["id"])
            least = (path.length_mm[path.cuts] / path.feed_mm_min[path.cuts]).sum() * 60.0
            self.assertLessEqual(least, step["cutting_s"] * 1.001)
            self.assertGreater(least, 0.5 * step["cutting_s"])

    def test_points_leave_no_arc_by_more_than_the_chord(self):
        path = self.plan.path(1)
        for chord in (0.1, 0.01):
            points, moves = path.points(chord)
            arcs = np.isin(path.kind[moves], ["W", "C"])
            self.assertTrue(arcs.any())
            np.testing.assert_array_equal(points[np.flatnonzero(np.diff(moves, append=len(path)))], path.xyz)
            for i in np.flatnonzero(arcs):
                move, centre = moves[i], np.array([path.cx[moves[i]], path.cy[moves[i]]])
                radius = math.hypot(*(path.xyz[move, :2] - centre))
                middle = (points[i, :2] + points[i - 1, :2]) / 2.0
                self.assertAlmostEqual(math.hypot(*(points[i, :2] - centre)), radius, 9)
                self.assertLessEqual(radius - math.hypot(*(middle - centre)), chord * 1.0001)
        for chord in (0, -1.0, 1e-9, math.nan):
            with self.assertRaisesRegex(ValueError, f"chord_mm is {chord}, and must be at least"):
                path.points(chord)

    def test_points_are_as_long_as_the_moves(self):
        path = self.plan.path(1)
        points, moves = path.points(1e-4)
        along = np.sqrt((np.diff(points, axis=0) ** 2).sum(axis=1))
        by_move = np.bincount(moves[1:], along, len(path))
        np.testing.assert_allclose(by_move[1:], path.length_mm[1:], rtol=1e-4, atol=1e-9)

    def test_step_that_is_not_there_is_told_with_those_that_are(self):
        with self.assertRaisesRegex(KeyError, "no step 'NONE'; steps are POCKET area_rough, POCKET area_finish"):
            self.plan.path("NONE")
        for number in (0, 3, -1):
            with self.assertRaises(KeyError):
                self.plan.step(number)

    def test_is_explained(self):
        self.assertIn("POCKET area_rough", self.plan.explain())
        self.assertIn("axial_cutting_depth", self.plan.explain(1, "axial_cutting_depth"))
        with self.assertRaises(capstan.Error):
            self.plan.explain("NONE")

    def test_edited_keeps_the_limit_and_is_the_plan_of_the_command(self):
        slower = self.plan.edited(limit=["feed<=500"])
        self.assertGreater(slower.time_s, self.plan.time_s)
        for i in (1, 2):
            path = slower.path(i)
            self.assertLessEqual(path.feed_mm_min[path.cuts].max(), 500.0)

    def test_is_the_same_from_bytes_as_from_a_file(self):
        with open(example("reference_pocket.p21"), "rb") as file:
            again = capstan.plan(file.read(), name=example("reference_pocket.p21"))
        self.assertEqual(again.forms["json"], self.plan.forms["json"])

    def test_left_open_has_no_path_and_is_bound_later(self):
        open_ = capstan.plan(example("reference_pocket.p21"), bind="strategy")
        self.assertIsNone(open_.program)
        with self.assertRaisesRegex(ValueError, "has no steps, for its decisions are open; bind it first"):
            open_.path(1)
        bound = open_.bind(tools=example("reference_pocket_tools.yaml"))
        self.assertEqual([s["id"] for s in bound.steps], [s["id"] for s in self.plan.steps])
        self.assertIsNotNone(bound.program)

    def test_writes_a_form_whole_or_not_at_all(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "p.json")
            self.plan.write(path)
            with open(path, "rb") as file:
                self.assertEqual(file.read(), self.plan.forms["json"])
            for ending, begins in ((".svg", b"<?xml "), (".png", b"\x89PNG"), (".html", b"<!DOCTYPE html>")):
                self.plan.write(os.path.join(folder, "p" + ending))
                with open(os.path.join(folder, "p" + ending), "rb") as file:
                    self.assertTrue(file.read().startswith(begins), ending)
            with self.assertRaisesRegex(KeyError, "no form 'siemens'; the plan has"):
                self.plan.write(path, "siemens")
            with self.assertRaisesRegex(ValueError, "names no form"):
                self.plan.write(os.path.join(folder, "p.foo"))
            with self.assertRaises(OSError):
                self.plan.write(os.path.join(folder, "none", "p.json"))
            self.assertEqual(sorted(os.listdir(folder)), ["p.html", "p.json", "p.png", "p.svg"])
            self.plan.write(os.path.join(folder, "p.ngc"))
            with open(os.path.join(folder, "p.ngc"), "rb") as file:
                self.assertEqual(file.read(), self.plan.program)

    def test_is_not_written_over_its_part(self):
        with tempfile.TemporaryDirectory() as folder:
            part = os.path.join(folder, "part.p21")
            shutil.copy(example("reference_pocket.p21"), part)
            plan = capstan.plan(part)
            with self.assertRaisesRegex(ValueError, "is the part that was planned"):
                plan.write(part)
            with open(part, "rb") as file, open(example("reference_pocket.p21"), "rb") as source:
                self.assertEqual(file.read(), source.read())


class Failing(unittest.TestCase):
    def test_file_is_an_error_with_its_diagnostics(self):
        with self.assertRaisesRegex(capstan.Error, "none.p21") as caught:
            capstan.plan("none.p21")
        self.assertTrue(any(m.severity == "error" for m in caught.exception.diagnostics))

    def test_bytes_are_an_error(self):
        with self.assertRaises(capstan.Error):
            capstan.plan(b"this is no part", name="nothing")
        with self.assertRaises(capstan.Error):
            capstan.explain(b"{}")
        with self.assertRaises(capstan.Error):
            capstan.check("none.json")

    def test_bytes_that_are_no_utf8_do_not_break_messages(self):
        with self.assertRaises(capstan.Error):
            capstan.plan(b"ISO-10303-21;\nHEADER;\xff\xfe", name="odd")

    def test_progress_ends_the_call_with_its_own_exception(self):
        def progress(stage, fraction):
            raise ZeroDivisionError(stage)
        with self.assertRaises(ZeroDivisionError):
            capstan.plan(example("bracket.p21"), progress=progress)

    def test_ctrl_c_ends_the_call(self):
        program = "import capstan, sys\nprint('go', flush=True)\ncapstan.plan(sys.argv[1], reopen='all')\n"
        run = subprocess.Popen([sys.executable, "-B", "-c", program, example("surface.stl")], stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True)
        self.assertEqual(run.stdout.readline(), "go\n")
        time.sleep(0.1)
        run.send_signal(signal.SIGINT)
        _, said = run.communicate(timeout=60)
        self.assertIn("KeyboardInterrupt", said)
        self.assertNotEqual(run.returncode, 0)


class Example(unittest.TestCase):
    def test_runs_and_its_numbers_are_those_of_its_files(self):
        with tempfile.TemporaryDirectory() as folder:
            said = subprocess.run([sys.executable, "-B", example("plan_in_python.py"), example("bracket.p21")],
                                  cwd=folder, check=True, capture_output=True, text=True).stdout
            self.assertIn("<Checked: clean, 0 errors, ", said)
            with open(os.path.join(folder, "slower.json"), encoding="utf-8") as file:
                total = json.load(file)["summary"]["total_s"]
            self.assertIn(f"at most {total:.1f} s", said)
            self.assertTrue(capstan.check(os.path.join(folder, "slower.json"), os.path.join(folder, "slower.ngc")).clean)


if __name__ == "__main__":
    SOURCE = sys.argv.pop()
    unittest.main()
