#!/usr/bin/env python3
"""What generate.py makes of small schemas.

    generate_test.py GENERATE.py
"""

import os
import subprocess
import sys
import tempfile
import unittest

GENERATE = sys.argv.pop() if len(sys.argv) > 1 else "generate.py"


def run(*schemas):
    with tempfile.TemporaryDirectory() as folder:
        paths = []
        for text in schemas:
            paths.append(os.path.join(folder, f"{len(paths)}.exp"))
            with open(paths[-1], "w", encoding="ascii") as file:
                file.write(text)
        return subprocess.run([sys.executable, GENERATE, *paths], capture_output=True, text=True, check=False)


def lines(*schemas):
    done = run(*schemas)
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()[1:]


class Generate(unittest.TestCase):
    def test_keeps_attributes_in_order_and_sorts_by_upper_case(self):
        self.assertEqual(lines("""SCHEMA s; -- a remark
            ENTITY b_c; x, y : REAL; z : OPTIONAL LIST [1:?] OF UNIQUE STRING (22) FIXED; END_ENTITY; (* an (* inner *) one *)
            ENTITY bd ABSTRACT SUPERTYPE OF (ONEOF (be, bf)) SUBTYPE OF (b_c); WHERE wr1: 'END_ENTITY;' <> 'x'; END_ENTITY;
            ENTITY be; END_ENTITY; ENTITY bf; END_ENTITY;
            END_SCHEMA;"""),
                         ["entity bd abstract : b_c ; ! be bf", "entity be :", "entity bf :", "entity b_c : ; x real ; y real ; z ? list 1:? unique string"])

    def test_keeps_redeclarations_renamings_and_what_is_derived(self):
        self.assertEqual(lines("""SCHEMA s; ENTITY a; p : NUMBER; q : a; r : REAL; END_ENTITY;
            ENTITY b SUBTYPE OF (a); SELF\\a.p RENAMED n : INTEGER; SELF\\a.q : b;
            DERIVE SELF\\a.r : REAL := 1.0; own : REAL := r * 2.0; INVERSE i : SET OF a FOR q; UNIQUE ur1: p; END_ENTITY;
            END_SCHEMA;"""),
                         ["entity a : ; p number ; q a ; r real",
                          "entity b : a ; a\\p=n integer ; a\\q b ; * a\\r"])

    def test_extends_extensible_types_across_files(self):
        self.assertEqual(lines("SCHEMA s; TYPE e = EXTENSIBLE ENUMERATION OF (one); END_TYPE; ENTITY a; END_ENTITY;"
                               "TYPE t = EXTENSIBLE GENERIC_ENTITY SELECT (a); END_TYPE; END_SCHEMA;",
                               "SCHEMA x; TYPE f = ENUMERATION BASED_ON e WITH (two); END_TYPE; ENTITY c; END_ENTITY;"
                               "TYPE u = SELECT BASED_ON t WITH (c); END_TYPE; END_SCHEMA;"),
                         ["entity a :", "entity c :", "enum e = one two", "enum f = two one",
                          "select t = a c", "select u = a c"])

    def test_keeps_ranges_of_numbers_alone(self):
        self.assertEqual(lines("""SCHEMA s; TYPE h = INTEGER; WHERE w: {0 <= SELF < 24}; END_TYPE;
            TYPE k = INTEGER; WHERE w: (0 <= SELF) AND (SELF < 24); END_TYPE;
            TYPE m = REAL; WHERE w: SELF > 0.0; END_TYPE; TYPE n = STRING; WHERE w: LENGTH(SELF) <= 80; END_TYPE;
            END_SCHEMA;"""),
                         ["type h = integer in [0,24)", "type k = integer in [0,24)", "type m = real in (0,?)",
                          "type n = string"])

    def test_keeps_which_subtypes_exclude_each_other(self):
        self.assertEqual(lines("""SCHEMA s; ENTITY a SUPERTYPE OF (ONEOF (b, c) ANDOR ONEOF (d, (b ANDOR c), e)); END_ENTITY;
            ENTITY b SUBTYPE OF (a); END_ENTITY; ENTITY c SUBTYPE OF (a); END_ENTITY; ENTITY d SUBTYPE OF (a); END_ENTITY;
            ENTITY e SUBTYPE OF (a); END_ENTITY; END_SCHEMA;""")[0], "entity a : ; ! b c ; ! d e")

    def test_refuses_names_that_are_not_declared_or_twice(self):
        self.assertNotEqual(run("SCHEMA s; ENTITY a; x : unknown; END_ENTITY; END_SCHEMA;").returncode, 0)
        self.assertNotEqual(run("SCHEMA s; ENTITY a; END_ENTITY; END_SCHEMA;",
                                "SCHEMA t; ENTITY a; END_ENTITY; END_SCHEMA;").returncode, 0)

    def test_gives_the_same_bytes_twice(self):
        schema = "SCHEMA s; ENTITY b; END_ENTITY; ENTITY a; END_ENTITY; TYPE t = SELECT (b, a); END_TYPE; END_SCHEMA;"
        self.assertEqual(run(schema).stdout, run(schema).stdout)


if __name__ == "__main__":
    unittest.main()
