#!/usr/bin/env python3
"""docs/late_binding.md, the page for a builder of controls: its program compiles against the header, its calls and
codes are those of the header, and each of its options is one of `capstan bind`.

    page_test.py SOURCE CC CAPSTAN
"""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

SOURCE, CC, CAPSTAN = pathlib.Path('.'), 'cc', 'capstan'


def page():
    return (SOURCE / 'docs/late_binding.md').read_text()


def header():
    return (SOURCE / 'include/capstan/capstan_late.h').read_text()


class Page(unittest.TestCase):
    def test_its_program_compiles(self):
        programs = re.findall(r'^```c\n(.*?)^```', page(), re.M | re.S)
        self.assertEqual(len(programs), 1)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, 'page.c')
            path.write_text(programs[0])
            subprocess.run([CC, '-std=c99', '-Wall', '-Wextra', '-Werror', '-fsyntax-only', f'-I{SOURCE}/include', path],
                           check=True)

    def test_names_each_call_of_the_header_and_no_other(self):
        declared = set(re.findall(r'\b(capstan_late_\w+)\(', header()))
        self.assertGreater(len(declared), 15)
        told = set(re.findall(r'\b(capstan_late_\w+)\b', page())) - {'capstan_late_code'}
        self.assertEqual(told, declared)

    def test_tells_each_code_of_the_header_with_its_number(self):
        codes = re.search(r'typedef enum capstan_late_code \{(.*?)\}', header(), re.S).group(1)
        declared = re.findall(r'(CAPSTAN_LATE_\w+) = (\d+)', codes)
        self.assertEqual(re.findall(r'^\| `(CAPSTAN_LATE_\w+)` (\d+) \|', page(), re.M), declared)

    def test_its_options_are_those_of_bind(self):
        told = set(re.findall(r'`set` "([a-z-]+)"', page()))
        self.assertGreater(len(told), 5)
        listed = subprocess.run([CAPSTAN, 'bind', '--help'], capture_output=True, text=True, check=True).stdout
        self.assertEqual(told - set(re.findall(r'--([a-z-]+)', listed)), set())


if __name__ == '__main__':
    SOURCE, CC, CAPSTAN = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3]
    unittest.main(argv=sys.argv[:1])
