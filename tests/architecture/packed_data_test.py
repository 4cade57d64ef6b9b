#!/usr/bin/env python3
"""What is compiled in follows the YAML files.

    packed_data_test.py PACK_TREES ROOT BUILD

An edit of a value changes the source that PACK_TREES writes; a file that cannot be read ends the build; and each
YAML file of rules/data and tooling/data is an input of the command that writes its room's source.
"""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PACK_TREES, ROOT, BUILD = (pathlib.Path(p) for p in sys.argv[1:4])


def packed(folder, text):
    (folder / "a.yaml").write_text(text)
    out = folder / "out.cpp"
    out.unlink(missing_ok=True)
    done = subprocess.run([PACK_TREES, out, "n", folder, folder / "a.yaml"], capture_output=True, text=True)
    return done.returncode, done.stderr, out.read_text() if out.exists() else None


class PackedData(unittest.TestCase):
    def test_an_edit_changes_the_source(self):
        for room in ("rules", "tooling"):
            for file in sorted((ROOT / room / "data").rglob("*.yaml")):
                text = file.read_text()
                edited, count = re.subn(r": (\d+)", lambda m: f": {int(m[1]) + 1}", text, count=1)
                self.assertEqual(count, 1, file)
                with tempfile.TemporaryDirectory() as folder:
                    folder = pathlib.Path(folder)
                    code, said, before = packed(folder, text)
                    self.assertEqual(code, 0, said)
                    self.assertEqual(packed(folder, text)[2], before, file)
                    self.assertNotEqual(packed(folder, edited)[2], before, file)

    def test_a_file_that_cannot_be_read_ends_the_build(self):
        with tempfile.TemporaryDirectory() as folder:
            code, said, out = packed(pathlib.Path(folder), "a: 1\na: 2\n")
            self.assertEqual(code, 1)
            self.assertIn("a.yaml:2: error: 'a' is given twice", said)
            self.assertIsNone(out)

    def test_each_file_is_an_input_of_the_build(self):
        for room in ("rules", "tooling"):
            source = f"{room}/capstan_{room}_trees.cpp"
            said = subprocess.run(["ninja", "-C", BUILD, "-t", "query", source],
                                  capture_output=True, text=True, check=True).stdout
            for file in sorted((ROOT / room / "data").rglob("*.yaml")):
                self.assertIn(str(file), said)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
