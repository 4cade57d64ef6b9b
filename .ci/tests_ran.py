#!/usr/bin/env python3
"""What the tests of the reports in a folder (GoogleTest's XML, one a suite) came to, and which were skipped, and why.

tests_ran.py FOLDER            prints it; fails where a report cannot be read or there is none
tests_ran.py --corpus FOLDER   fails, too, unless the tests of the corpus ran, every one: those whose suite has
                               "Corpus" in its name, or that were skipped saying "corpus is absent"
"""

import glob
import os
import sys
import xml.etree.ElementTree as ET

MOST_NAMED = 20  # a longer list is not read


def read(folder):
    """(suite.name, failed, message where it was skipped or None) of each test of the folder's reports."""
    tests = []
    paths = sorted(glob.glob(os.path.join(folder, "*.xml")))
    if not paths:
        raise OSError(f"{folder} holds no report")
    for path in paths:
        for case in ET.parse(path).getroot().iter("testcase"):
            skipped = case.find("skipped")
            is_skipped = skipped is not None or case.get("result") in ("skipped", "suppressed")
            said = (skipped.get("message") or skipped.text or "") if skipped is not None else ""
            tests.append((f"{case.get('classname')}.{case.get('name')}", case.find("failure") is not None,
                          said.strip() if is_skipped else None))
    return tests


def summary(tests):
    """Lines: a count, then each skipped test with its reason."""
    skipped = [(name, said) for name, _, said in tests if said is not None]
    failed = sum(1 for _, is_failed, _ in tests if is_failed)
    # A suite that crashed has no report: ctest names it.
    yield f"{len(tests)} tests in suites that ended: {len(tests) - failed - len(skipped)} passed, {failed} failed, {len(skipped)} skipped"
    for name, said in skipped[:MOST_NAMED]:
        # GoogleTest puts the place of the skip on a line of its own before the reason.
        yield f"  skipped: {name}: {said.splitlines()[-1] if said else 'no reason given'}"
    if len(skipped) > MOST_NAMED:
        yield f"  and {len(skipped) - MOST_NAMED} more"


def corpus_missed(tests):
    """Of the tests of the corpus: how many there are, and the names of those that did not run."""
    corpus = [(name, said) for name, _, said in tests
              if "Corpus" in name.rsplit(".", 1)[0] or "corpus is absent" in (said or "")]
    return len(corpus), [name for name, said in corpus if said is not None]


def main(arguments):
    with_corpus = arguments[:1] == ["--corpus"]
    folder = arguments[-1]
    try:
        tests = read(folder)
    except (OSError, ET.ParseError) as error:
        print(f"tests: no report can be read: {error}")
        return 1
    if not with_corpus:
        print("\n".join(summary(tests)))
        return 0
    number, missed = corpus_missed(tests)
    for name in missed:
        print(f"ci: the corpus is there, but {name} did not run")
    if number == 0:
        print("ci: the corpus is there, but there is no corpus test in the reports")
        return 1
    print(f"ci: {number - len(missed)} of {number} corpus tests ran")
    return 1 if missed else 0


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit("usage: tests_ran.py [--corpus] FOLDER")
    sys.exit(main(sys.argv[1:]))
