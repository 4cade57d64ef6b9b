#!/usr/bin/env python3
"""Sources that give a name two meanings are not compiled together, and as few groups are made as that allows."""

import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "cmake"))
import sources_together  # noqa: E402


def unnamed(body):
    return f"namespace capstan {{\nnamespace {{\n{body}\n}}  // namespace\n}}  // namespace capstan\n"


class SourcesTogether(unittest.TestCase):
    def groups(self, *texts, most=10):
        with tempfile.TemporaryDirectory() as folder:
            paths = []
            for number, text in enumerate(texts):
                paths.append(os.path.join(folder, f"{number}.cpp"))
                with open(paths[-1], "w", encoding="utf-8") as file:
                    file.write(text)
            return [group for group, _ in sources_together.groups(paths, most)]

    def test_parts_functions_constants_and_types_of_one_name(self):
        for body in ("double unit(double v) { return v; }", "constexpr double kSame = 1e-6;", "struct Row {\n  int a;\n};",
                     "constexpr std::array<int, 2> kRows = {1, 2};", "[[noreturn]] void malformed(int line) {\n}",
                     "constexpr double kFirst = 1.0, kSecond = 2.0;"):
            self.assertEqual(self.groups(unnamed(body), unnamed(body)), [0, 1], body)

    def test_parts_the_second_constant_of_a_line(self):
        self.assertEqual(self.groups(unnamed("constexpr double kA = 1.0, kB = 2.0;"), unnamed("constexpr int kB = 2;")),
                         [0, 1])

    def test_leaves_together_what_differs_in_name_or_is_local(self):
        self.assertEqual(self.groups(unnamed("int first() {\n  int same = 1;\n}"), unnamed("int second() {\n  int same = 1;\n}")),
                         [0, 0])

    def test_leaves_aliases_of_one_meaning_together_and_parts_two(self):
        one, other = unnamed("using Rows = std::vector<int>;"), unnamed("using Rows = std::vector<double>;")
        self.assertEqual(self.groups(one, one), [0, 0])
        self.assertEqual(self.groups(one, other), [0, 1])

    def test_leaves_tests_together(self):
        self.assertEqual(self.groups(unnamed("TEST(A, Works) {\n}"), unnamed("TEST(B, Works) {\n}")), [0, 0])

    def test_goes_back_to_the_first_group_with_room(self):
        a, b = unnamed("int f() {"), unnamed("int g() {")
        self.assertEqual(self.groups(a, a, b, b), [0, 1, 0, 1])
        self.assertEqual(self.groups(b, unnamed("int h() {"), unnamed("int i() {"), most=2), [0, 0, 1])


if __name__ == "__main__":
    unittest.main()
