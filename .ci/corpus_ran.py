#!/usr/bin/env python3
"""Fails unless the corpus tests of a ctest JUnit report ran, every one.

A corpus test is one whose suite has "Corpus" in its name, or that was skipped saying "corpus is absent".
"""

import sys
import xml.etree.ElementTree as ET


def main(report):
    try:
        cases = list(ET.parse(report).getroot().iter("testcase"))
    except (OSError, ET.ParseError) as error:
        print(f"ci: no test report: {error}")
        return 1
    corpus = 0
    missed = []
    for case in cases:
        name = case.get("name", "")
        skipped = case.get("status") == "notrun" or case.find("skipped") is not None
        suite = name.rsplit(".", 1)[0]
        is_corpus = "Corpus" in suite or (skipped and "corpus is absent" in (case.findtext("system-out") or ""))
        corpus += is_corpus
        if is_corpus and skipped:
            missed.append(name)
    for name in missed:
        print(f"ci: the corpus is there, but {name} did not run")
    if corpus == 0:
        print("ci: the corpus is there, but there is no corpus test in the report")
        return 1
    print(f"ci: {corpus - len(missed)} of {corpus} corpus tests ran")
    return 1 if missed else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: corpus_ran.py REPORT.xml")
    sys.exit(main(sys.argv[1]))
