#!/usr/bin/env python3
"""unused_functions.py finds a planted function that nothing calls, and lets called and listed ones alone."""

import os
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import unused_functions  # noqa: E402

HEADER = ("planner/a/a.h", unused_functions.plain("int lost(int x);  // lost(1) is never called\nint kept(int x);\n"))
SOURCE = ("planner/a/a.cpp", "int lost(int x) { return x; }\nint kept(int x) { return x; }\nint y = kept(2);\n")


class UnusedFunctions(unittest.TestCase):
    def test_a_function_named_only_where_it_is_declared_and_defined_is_unused(self):
        names = {"s1": "capstan::a::lost(int)", "s2": "capstan::a::kept(int)", "s3": "capstan::a::B::B()"}
        found = unused_functions.candidates({s: "a.o" for s in names}, set(), names)
        self.assertEqual(found, {"capstan::a::lost": 1, "capstan::a::kept": 1})
        self.assertEqual(unused_functions.unused(found, [HEADER, SOURCE]), ["capstan::a::lost"])

    def test_what_another_object_asks_for_is_used(self):
        names = {"s1": "capstan::a::lost(int)"}
        self.assertEqual(unused_functions.candidates({"s1": "a.o"}, {"s1"}, names), {})

    def test_what_the_world_is_offered_is_used(self):
        public = ("include/capstan/a.h", "int lost(int x);\n")
        self.assertEqual(unused_functions.unused({"capstan::lost": 1}, [SOURCE, public]), [])

    def test_an_inline_function_that_is_named_once_is_unused(self):
        header = ("planner/a/b.h", "[[nodiscard]] inline double alone(double x) {\n  return x;\n}\n")
        self.assertEqual(list(unused_functions.inline_unused([header])), [("alone", "planner/a/b.h")])
        self.assertEqual(list(unused_functions.inline_unused([header, ("planner/a/b.cpp", "alone(1.0)")])), [])

    def test_a_row_lets_its_function_pass_and_is_a_fault_without_one_or_without_a_reason(self):
        found = {"capstan::a::lost": "a.cpp.o"}
        self.assertEqual(len(unused_functions.faults(found, {})), 1)
        self.assertEqual(unused_functions.faults(found, unused_functions.read_list("capstan::a::lost:  why\n")), [])
        self.assertIn("called, or gone", unused_functions.faults({}, {"capstan::a::lost": "why"})[0])
        self.assertIn("no reason", unused_functions.faults(found, {"capstan::a::lost": ""})[0])


if __name__ == "__main__":
    unittest.main()
