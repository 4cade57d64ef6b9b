#!/usr/bin/env python3
"""room_sizes.py passes a tree at its limits and names the planted room, folder and README that go beyond."""

import contextlib
import io
import os
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import room_sizes  # noqa: E402

BASE = "planner/ground/base"


class RoomSizes(unittest.TestCase):
    def told(self, files):
        """The exit code and the text for a tree of these files."""
        with tempfile.TemporaryDirectory() as root:
            for path, text in files.items():
                path = os.path.join(root, path)
                os.makedirs(os.path.dirname(path), exist_ok=True)
                with open(path, "w", encoding="utf-8") as file:
                    file.write(text)
            text = io.StringIO()
            with contextlib.redirect_stdout(text):
                status = room_sizes.main(root)
            return status, text.getvalue()

    def test_a_room_may_have_ten_thousand_lines_and_no_more(self):
        half = "\n" * (room_sizes.MOST_LINES // 2)
        status, _ = self.told({f"{BASE}/a.h": half, f"{BASE}/b.cpp": half})
        self.assertEqual(status, 0)
        status, text = self.told({f"{BASE}/a.h": half, f"{BASE}/b.cpp": half + "\n"})
        self.assertEqual(status, 1)
        self.assertIn(f"base: {room_sizes.MOST_LINES + 1} lines", text)

    def test_a_folder_may_have_twenty_files_and_no_more(self):
        full = {f"{BASE}/f{i}.h": "" for i in range(room_sizes.MOST_FILES)}
        self.assertEqual(self.told(full)[0], 0)
        self.assertEqual(self.told({**full, f"{BASE}/below/one_more.h": ""})[0], 0)
        status, text = self.told({**full, f"{BASE}/one_more.txt": ""})
        self.assertEqual(status, 1)
        self.assertIn(f"{BASE}: {room_sizes.MOST_FILES + 1} files", text)

    def test_a_folder_of_tests_counts_too(self):
        crowd = {f"tests/base/f{i}_test.cpp": "" for i in range(room_sizes.MOST_FILES + 1)}
        self.assertIn("tests/base: ", self.told({f"{BASE}/a.h": "", **crowd})[1])

    def test_a_file_that_a_readme_names_must_be_there(self):
        files = {f"{BASE}/a.h": "", f"{BASE}/README.md": "Begin at `a.h`, then `gone.h`.\n"}
        status, text = self.told(files)
        self.assertEqual(status, 1)
        self.assertIn("names gone.h", text)
        self.assertNotIn("names a.h", text)

    def test_an_empty_tree_is_no_success(self):
        self.assertEqual(self.told({})[0], 1)


if __name__ == "__main__":
    unittest.main()
