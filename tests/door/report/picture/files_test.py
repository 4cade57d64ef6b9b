#!/usr/bin/env python3
"""Pictures of the shipped parts, by the command: read with another's XML reader and zlib.

    files_test.py CAPSTAN EXAMPLES
"""

import json
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml
import zlib
from pathlib import Path

CAPSTAN, EXAMPLES = str(Path(sys.argv[1]).resolve()), Path(sys.argv[2]).resolve()
SVG = '{http://www.w3.org/2000/svg}'
# (part, options, its most megabytes as SVG)
PARTS = [('bracket.p21', [], 0.2), ('two_setups.p21', ['--workholding', str(EXAMPLES / 'two_setups_holding.yaml')], 0.2),
         ('surface.stl', [], 1.0)]


def run(folder, *words):
    return subprocess.run([CAPSTAN, *words], cwd=folder, capture_output=True, text=True, timeout=600)


def pixels_of(png):
    """Width, height and rows of a PNG without filters, its checksums held against zlib's."""
    assert png[:8] == b'\x89PNG\r\n\x1a\n'
    at, data, size = 8, b'', None
    while at < len(png):
        length, kind = struct.unpack('>I4s', png[at:at + 8])
        body = png[at + 8:at + 8 + length]
        assert struct.unpack('>I', png[at + 8 + length:at + 12 + length])[0] == zlib.crc32(kind + body)
        if kind == b'IHDR':
            size = struct.unpack('>II', body[:8])
        if kind == b'IDAT':
            data += body
        at += 12 + length
    wide, high = size
    raw = zlib.decompress(data)
    rows = [raw[y * (3 * wide + 1):(y + 1) * (3 * wide + 1)] for y in range(high)]
    assert len(raw) == high * (3 * wide + 1) and all(row[0] == 0 for row in rows)
    return wide, high, [row[1:] for row in rows]


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.held = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.held.name)
        for part, options, _ in PARTS:
            made = run(cls.folder, 'plan', str(EXAMPLES / part), *options, '-o', part + '.json', '-o', part + '.svg', '-o',
                       part + '.png')
            assert made.returncode == 0, made.stderr

    @classmethod
    def tearDownClass(cls):
        cls.held.cleanup()

    def steps(self, part):
        return [s['id'] for s in json.loads((self.folder / (part + '.json')).read_text())['steps']]

    def test_each_step_is_drawn_and_named_in_well_formed_xml(self):
        for part, _, most in PARTS:
            text = (self.folder / (part + '.svg')).read_bytes()
            self.assertLess(len(text), most * 1e6, part)
            root = xml.fromstring(text)
            steps = self.steps(part)
            for n, step in enumerate(steps, 1):
                groups = root.findall(f'{SVG}g[@data-step="{n}"]')
                titles = [g.find(SVG + 'title').text for g in groups]
                self.assertTrue(any(t.startswith(f'{n} {step}, T') for t in titles), (part, n, titles))
                self.assertTrue(any(step.startswith(t.text.removesuffix('..')) for g in groups for t in g.iter(SVG + 'text')
                                    if len(t.text) > 3), (part, step))
            self.assertEqual([], [e for e in root.iter() if 'href' in str(e.attrib) or e.tag == SVG + 'image'])

    def test_the_pixels_are_of_the_size_of_the_drawing_and_of_many_colours(self):
        for part, _, _ in PARTS:
            root = xml.parse(self.folder / (part + '.svg')).getroot()
            wide, high, rows = pixels_of((self.folder / (part + '.png')).read_bytes())
            self.assertEqual((root.get('width'), root.get('height')), (str(wide), str(high)), part)
            colours = {row[i:i + 3] for row in rows for i in range(0, len(row), 3)}
            for circle in root.iter(SVG + 'circle'):  # each step's own colour is in both
                self.assertIn(bytes.fromhex(circle.get('fill')[1:]), colours, part)
            self.assertGreater(len(colours), 50, part)

    def test_of_a_stored_plan_the_same_bytes_come_out(self):
        for part, _, _ in PARTS:
            for ending in ('.svg', '.png'):
                made = run(self.folder, 'convert', part + '.json', '-o', 'again' + ending)
                self.assertEqual(made.returncode, 0, made.stderr)
                self.assertEqual((self.folder / (part + ending)).read_bytes(), (self.folder / ('again' + ending)).read_bytes(), part + ending)

    def test_only_the_steps_that_are_asked_for_are_drawn(self):
        made = run(self.folder, 'convert', 'bracket.p21.json', '--draw', 'POCKET*', '--draw', '6', '-o', 'some.svg')
        self.assertEqual(made.returncode, 0, made.stderr)
        root = xml.parse(self.folder / 'some.svg').getroot()
        self.assertEqual({g.get('data-step') for g in root.findall(SVG + 'g')} - {None}, {'2', '3', '6'})

    def test_a_step_that_is_not_there_is_refused_and_nothing_written(self):
        made = run(self.folder, 'convert', 'bracket.p21.json', '--draw', 'PCKET*', '-o', 'none.svg', '-o', 'none.json')
        self.assertNotEqual(made.returncode, 0)
        self.assertIn("the plan has no step 'PCKET*' to draw; expected TOP FACE plane_finish, POCKET area_rough", made.stderr)
        self.assertIn('[PIC-STEP]', made.stderr)
        self.assertFalse((self.folder / 'none.svg').exists() or (self.folder / 'none.json').exists())


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1])
