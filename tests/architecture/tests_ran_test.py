#!/usr/bin/env python3
"""The count of tests is that of the reports, and the guard of .ci/run says no exactly when corpus tests are missing."""

import os
import subprocess
import sys
import tempfile
import unittest

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", ".ci", "tests_ran.py")
ABSENT = "<skipped message='corpus_test.cpp:12&#x0A;corpus is absent'/>"


def case(name, rest="", result="completed"):
    suite, test = name.rsplit(".", 1)
    return f'<testcase classname="{suite}" name="{test}" status="run" result="{result}">{rest}</testcase>'


def skipped(name, rest="<skipped message='no solver'/>"):
    return case(name, rest, "skipped")


class TestsRan(unittest.TestCase):
    def run_script(self, cases, *options):
        with tempfile.TemporaryDirectory() as folder:
            for number, one in enumerate(cases):  # each in a report of its own
                with open(os.path.join(folder, f"{number}.xml"), "w", encoding="utf-8") as report:
                    report.write(f"<testsuites><testsuite>{one}</testsuite></testsuites>")
            return subprocess.run([sys.executable, SCRIPT, *options, folder], capture_output=True, text=True,
                                  check=False)

    def verdict(self, *cases):
        return self.run_script(cases, "--corpus").returncode

    def test_accepts_reports_whose_corpus_tests_ran(self):
        self.assertEqual(self.verdict(case("Base.Works"), case("CorpusNist.Reads")), 0)

    def test_leaves_other_skipped_tests_alone(self):
        self.assertEqual(self.verdict(skipped("Solver/Ipopt.Solves/0"), case("CorpusNist.Reads")), 0)

    def test_refuses_reports_without_any(self):
        self.assertEqual(self.verdict(case("Base.Works")), 1)

    def test_refuses_one_that_was_skipped(self):
        self.assertEqual(self.verdict(case("CorpusNist.Reads"), skipped("All/CorpusUfsc.Reads/3")), 1)

    def test_refuses_one_that_says_so_under_another_name(self):
        self.assertEqual(self.verdict(case("CorpusNist.Reads"), skipped("Exchange.Reads", ABSENT)), 1)

    def test_refuses_a_folder_without_reports(self):
        self.assertEqual(self.verdict(), 1)
        self.assertEqual(self.run_script([]).returncode, 1)

    def test_counts_what_passed_failed_and_was_skipped_with_its_reason(self):
        said = self.run_script([case("A.Works") + case("A.Fails", "<failure message='no'/>"),
                                skipped("Exchange.Reads", ABSENT)]).stdout.splitlines()
        self.assertEqual(said, ["3 tests in suites that ended: 1 passed, 1 failed, 1 skipped", "  skipped: Exchange.Reads: corpus is absent"])


if __name__ == "__main__":
    unittest.main()
