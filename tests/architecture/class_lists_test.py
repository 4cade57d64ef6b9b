#!/usr/bin/env python3
"""class_lists.py finds lists and switches of classes of cutter, and lets the table and short ones alone."""

import os
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import class_lists  # noqa: E402

FOUR = ("kEndmill", "kTap", "kReamer", "kFacemill")


class ClassLists(unittest.TestCase):
    def test_finds_a_statement_of_four_classes(self):
        text = "bool f(C c) {\n  return " + " ||\n    ".join(f"c == CutterClass::{k}" for k in FOUR) + ";\n}\n"
        self.assertEqual(len(class_lists.faults([("planner/x.cpp", text)], {})), 1)
        self.assertIn("planner/x.cpp:2: 4 classes", class_lists.faults([("planner/x.cpp", text)], {})[0])

    def test_finds_a_switch_whose_cases_return(self):
        cases = "\n".join(f"    case CutterClass::{k}:\n      return 1;" for k in FOUR)
        text = "int f(C c) {\n  switch (c) {\n" + cases + "\n  }\n}\n"
        self.assertEqual(len(class_lists.faults([("tooling/x.cpp", text)], {})), 1)

    def test_lets_three_and_the_table_alone(self):
        three = "x = " + " + ".join(f"CutterClass::{k}" for k in FOUR[:3]) + ";\ny = CutterClass::kTap;\n"
        four = "x = " + " + ".join(f"CutterClass::{k}" for k in FOUR) + ";\n"
        allowed = {"planner/ground/vocabulary/": "the table", "rules/strategy/": "an order of preference"}
        self.assertEqual(
            class_lists.faults([("planner/x.cpp", three), ("planner/ground/vocabulary/x.cpp", four),
                                ("rules/strategy/x.cpp", four)], allowed), [])

    def test_finds_an_allowance_that_nothing_needs(self):
        three = "x = " + " + ".join(f"CutterClass::{k}" for k in FOUR[:3]) + ";\n"
        found = class_lists.faults([("rules/strategy/x.cpp", three)], {"rules/strategy/": "a reason"})
        self.assertEqual(len(found), 1)
        self.assertIn("rules/strategy/", found[0])


if __name__ == "__main__":
    unittest.main()
