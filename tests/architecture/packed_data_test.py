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


def packed(folder, texts):
    """Exit code, messages, and what stands for each file in the source; nothing when there is none."""
    for name, text in texts.items():
        (folder / name).write_text(text)
    out = folder / "out.cpp"
    out.unlink(missing_ok=True)
    done = subprocess.run([PACK_TREES, out, "n", folder, *(folder / name for name in texts)],
                          capture_output=True, text=True)
    source = out.read_text() if out.exists() else ""
    parts = re.split(r'  if \(name == "([^"]+)"\)', source)[1:]
    return done.returncode, done.stderr, dict(zip(parts[::2], parts[1::2])) or None


class PackedData(unittest.TestCase):
    def test_an_edit_of_each_file_changes_the_source(self):
        for room in ("rules", "tooling"):
            texts = {file.name: file.read_text() for file in sorted((ROOT / room / "data").rglob("*.yaml"))}
            edited = {}
            for name, text in texts.items():
                edited[name], count = re.subn(r": (\d+)", lambda m: f": {int(m[1]) + 1}", text, count=1)
                self.assertEqual(count, 1, name)
            with tempfile.TemporaryDirectory() as folder:
                code, said, before = packed(pathlib.Path(folder), texts)
                self.assertEqual(code, 0, said)
                self.assertEqual(sorted(before), sorted(texts))
                self.assertEqual(packed(pathlib.Path(folder), texts)[2], before)
                after = packed(pathlib.Path(folder), edited)[2]
                for name in texts:
                    self.assertNotEqual(after[name], before[name], name)

    def test_a_file_that_cannot_be_read_ends_the_build(self):
        with tempfile.TemporaryDirectory() as folder:
            code, said, out = packed(pathlib.Path(folder), {"a.yaml": "a: 1\na: 2\n"})
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
