#!/usr/bin/env python3
"""unique_types.py finds a type that two files define in one namespace, and lets those of one file alone."""

import os
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import unique_types  # noqa: E402


def in_space(space, body):
    return f"namespace {space} {{\n{body}\n}}  // namespace {space}\n"


class UniqueTypes(unittest.TestCase):
    def test_finds_two_types_of_one_name_in_one_namespace(self):
        one = in_space("capstan::a", "struct Touch {\n  int x;\n};")
        self.assertEqual(
            unique_types.faults([("one.h", one), ("two.cpp", one)]),
            ["two.cpp:2: capstan::a::Touch stands in one.h:2, too"])

    def test_lets_other_namespaces_and_files_alone(self):
        anonymous = in_space("capstan::a", "namespace {\nclass Touch {\n};\n}  // namespace")
        self.assertEqual(
            unique_types.faults([
                ("one.h", in_space("capstan::a", "struct Touch {\n};\nstruct Only;")),
                ("two.h", in_space("capstan::b", "struct Touch {\n};")),
                ("three.cpp", anonymous), ("four.cpp", anonymous)]), [])

    def test_names_an_enumeration_too(self):
        one = in_space("capstan::a", "enum class Touch : int { kOne };")
        self.assertEqual(len(unique_types.faults([("one.h", one), ("two.h", one)])), 1)


if __name__ == "__main__":
    unittest.main()
