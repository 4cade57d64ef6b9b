#!/usr/bin/env python3
"""The guard of .ci/run says no exactly when corpus tests are missing from a report."""

import os
import subprocess
import sys
import tempfile
import unittest

GUARD = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", ".ci", "corpus_ran.py")
ABSENT = "<skipped message=''/><system-out>corpus is absent</system-out>"


class CorpusRan(unittest.TestCase):
    def verdict(self, *cases):
        body = "".join(f'<testcase name="{name}" status="{status}">{rest}</testcase>' for name, status, rest in cases)
        with tempfile.NamedTemporaryFile("w", suffix=".xml") as report:
            report.write(f"<testsuite>{body}</testsuite>")
            report.flush()
            done = subprocess.run([sys.executable, GUARD, report.name], capture_output=True, check=False)
        return done.returncode

    def test_accepts_a_report_whose_corpus_tests_ran(self):
        self.assertEqual(self.verdict(("Base.Works", "run", ""), ("CorpusNist.Reads", "run", "")), 0)

    def test_leaves_other_skipped_tests_alone(self):
        self.assertEqual(
            self.verdict(("Solver/Ipopt.Solves/0", "notrun", "<skipped/>"), ("CorpusNist.Reads", "run", "")), 0)

    def test_refuses_a_report_without_any(self):
        self.assertEqual(self.verdict(("Base.Works", "run", "")), 1)

    def test_refuses_one_that_was_skipped(self):
        self.assertEqual(
            self.verdict(("CorpusNist.Reads", "run", ""), ("All/CorpusUfsc.Reads/3", "notrun", "<skipped/>")), 1)

    def test_refuses_one_that_says_so_under_another_name(self):
        self.assertEqual(self.verdict(("CorpusNist.Reads", "run", ""), ("Exchange.Reads", "notrun", ABSENT)), 1)

    def test_refuses_a_missing_report(self):
        self.assertEqual(subprocess.run([sys.executable, GUARD, "no-such-report"], capture_output=True,
                                        check=False).returncode, 1)


if __name__ == "__main__":
    unittest.main()
