#!/usr/bin/env python3
"""Reports as a browser shows them.

    look_test.py CAPSTAN EXAMPLES SCRATCH     plans the examples and opens their reports; screenshots stay in SCRATCH

Ends with 77 where there is no chromium, chromedriver, pdftotext or pdftoppm.
"""
import hashlib
import html
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

import browser

PARTS = {'bracket': 'bracket.p21', 'two_setups': 'two_setups.p21', 'pocket': 'reference_pocket.p21', 'surface': 'surface.stl'}
OPTIONS = {'surface': ['--material', 'EN AW-6061'],
           'two_setups': ['--workholding', 'two_setups_holding.yaml']}
MOST_BYTES = 5_000_000
WIDTHS = (400, 1600)

# How many colours the canvas shows, and a sum that tells one picture from another.
LOOK = '''
const c = document.querySelector('#view canvas'), small = document.createElement('canvas');
small.width = 160; small.height = 80;
const to = small.getContext('2d');
to.drawImage(c, 0, 0, 160, 80);
const d = to.getImageData(0, 0, 160, 80).data, seen = new Set();
let sum = 0;
for (let i = 0; i < d.length; i += 4) { const v = d[i] * 65536 + d[i + 1] * 256 + d[i + 2]; seen.add(v); sum = (sum * 31 + v) % 1000000007; }
return [seen.size, sum];
'''


# Pairs of headings, rows, lists, pictures and paragraphs that lie on each other.
COVERED = '''
const shown = [...document.querySelectorAll('h1, h2, h3, h4, p, tr, dl, figcaption, canvas, svg:not(.tool)')]
  .map(e => [e, e.getBoundingClientRect()]).filter(([, b]) => b.width > 0 && b.height > 0);
const out = [];
for (const [a, p] of shown) for (const [b, q] of shown) {
  if (a === b || a.contains(b) || b.contains(a)) continue;
  const wide = Math.min(p.right, q.right) - Math.max(p.left, q.left), high = Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top);
  if (wide > 1 && high > 1) out.push([a, b].map(e => e.nodeName + ' ' + e.textContent.slice(0, 40)).join(' / '));
}
return [shown.length, out];
'''

# The smallest text that is seen, px on the screen, and words of drawings that lie on each other.
LEGIBLE = '''
let small = [1e9, ''];
const take = (size, text) => { if (size < small[0]) small = [size, text]; };
const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT), over = [];
while (walk.nextNode()) {
  const e = walk.currentNode.parentElement, box = e.getBoundingClientRect();
  if (!walk.currentNode.textContent.trim() || !box.width || !box.height || e.closest('script, style, option, title, pre')) continue;
  const scale = e instanceof SVGElement ? Math.abs(e.getScreenCTM().a) : 1;
  take(parseFloat(getComputedStyle(e).fontSize) * scale, e.textContent);
}
for (const drawing of document.querySelectorAll('svg')) {
  const words = [...drawing.querySelectorAll('text')].map(e => [e.textContent, e.getBoundingClientRect()]).filter(([, b]) => b.width > 0);
  for (let i = 0; i < words.length; ++i) for (let k = 0; k < i; ++k) {
    const p = words[i][1], q = words[k][1];
    if (Math.min(p.right, q.right) - Math.max(p.left, q.left) > 0.5 && Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top) > 4) over.push(words[k][0] + ' / ' + words[i][0]);
  }
}
return [small, over];
'''
LEAST_PX = 10

# Where the bars of time end, s, and px beside the last mark of the axis.
BARS = '''
const svg = document.querySelector('#bars svg'), bars = [...svg.querySelectorAll('rect')], last = [...svg.querySelectorAll('text')].pop();
return {ends: Math.max(...bars.map(b => Number(b.dataset.to))), apart: Math.max(...bars.map(b => b.getBoundingClientRect().right)) - last.getBoundingClientRect().right,
  mark: last.textContent, gaps: bars.slice(1).map((b, i) => Number(b.dataset.from) - Number(bars[i].dataset.to))};
'''


def seconds(text):
    """Of "2 min 13.2 s"."""
    minutes, rest = re.fullmatch(r'(?:(\d+) min )?([0-9.]+) s', text.strip()).groups()
    return 60 * int(minutes or 0) + float(rest)


# Of the text that a sheet is pinned to the machine for.
SHEETS = '''
return [...document.querySelectorAll('.sheet')].map(s => ({
  pictures: [...s.querySelectorAll('canvas, figure svg')].map(e => e.getBoundingClientRect()).filter(b => b.width > 100 && b.height > 60).length,
  text: s.innerText, tables: [...s.querySelectorAll('table')].map(t => [...t.tBodies[0].rows].map(r => r.innerText))}));
'''


class Page:
    """A page of a PDF in grey, and its words in points."""

    def __init__(self, picture, width, height):
        self.wide, self.high = width, height
        kind, size, _, self.pixels = picture.split(b'\n', 3)
        assert kind == b'P5'
        self.columns, self.rows = map(int, size.split())

    def contrast(self, box):
        """Between the darkest and the lightest pixel of a box."""
        x0, y0, x1, y1 = (round(v * self.columns / self.wide) if i % 2 == 0 else round(v * self.rows / self.high) for i, v in enumerate(box))
        seen = b''.join(self.pixels[y * self.columns + max(0, x0):y * self.columns + x1 + 1] for y in range(max(0, y0), min(self.rows, y1 + 1)))
        return max(seen) - min(seen) if seen else 0


def pages_of(pdf):
    """Pages with their words, as they look."""
    boxes = subprocess.run(['pdftotext', '-bbox', pdf, '-'], capture_output=True, text=True, check=True).stdout
    for n, page in enumerate(boxes.split('<page ')[1:], 1):
        width, height = (float(v) for v in re.search(r'width="([0-9.]+)" height="([0-9.]+)"', page).groups())
        picture = subprocess.run(['pdftoppm', '-gray', '-r', '100', '-f', str(n), '-l', str(n), pdf], capture_output=True, check=True).stdout
        words = [(html.unescape(w[4]), tuple(float(v) for v in w[:4])) for w in
                 re.findall(r'<word xMin="([0-9.-]+)" yMin="([0-9.-]+)" xMax="([0-9.-]+)" yMax="([0-9.-]+)">(.*?)</word>', page)]
        yield Page(picture, width, height), words


def planned(part, out, options, program='.ngc'):
    """The report of a part, with its plan and program beside it."""
    files = [out.with_suffix(end) for end in ('.html', '.json', program)]
    call = [CAPSTAN, 'plan', part, *options, *(word for f in files for word in ('-o', str(f)))]
    done = subprocess.run(call, capture_output=True, text=True, cwd=EXAMPLES)
    if done.returncode not in (0, 1):
        raise AssertionError(f'{call}: {done.stderr}')
    warned = [line for line in done.stderr.splitlines() if ' warning: ' in line or line.startswith('warning: ')]
    return files[0], json.loads(files[1].read_text()), {code for line in warned for code in re.findall(r'\[([A-Z0-9-]+)\]', line)}


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        SCRATCH.mkdir(parents=True, exist_ok=True)
        cls.reports = {name: planned(part, SCRATCH / name, OPTIONS.get(name, [])) for name, part in PARTS.items()}
        cls.window = browser.Browser()

    @classmethod
    def tearDownClass(cls):
        cls.window.close()

    def opened(self, name, width=900):
        self.window.size(width, 700)
        self.window.open(self.reports[name][0])
        return self.reports[name][1]

    def test_shows_draws_and_prints_each_plan_and_asks_for_nothing(self):
        for name in PARTS:
            with self.subTest(name):
                self.window.requests()
                plan = self.opened(name)
                self.has_a_row_for_each_step_and_their_times_add_up(plan)
                self.says_what_the_command_warned_of(name)
                self.draws_something_else_for_each_step(name)
                self.prints_every_step(plan, name)
                self.window.run('pick(DATA.steps.length - 1)')
                for colour in ('feed', 'power', 'force') if name == 'pocket' else ():
                    self.window.run('by("colour").value = arguments[0]; shown()', colour)
                self.assertEqual(self.window.said(), [])
                foreign = [u for u in self.window.requests() if not u.startswith(('file:', 'data:', 'blob:'))]
                self.assertEqual(foreign, [])

    def says_what_the_command_warned_of(self, name):
        said = self.window.run('return document.getElementById("findings").innerText')
        self.assertEqual([code for code in sorted(self.reports[name][2]) if f'[{code}]' not in said], [])

    def has_a_row_for_each_step_and_their_times_add_up(self, plan):
        self.assertEqual(self.window.run('return document.querySelectorAll("#operations tbody tr").length'), len(plan['steps']))
        # What a person would add up: the cells as they are printed, to a tenth each.
        cells = self.window.run('return [...document.querySelectorAll("#operations tbody tr")].map(r => r.lastElementChild.textContent)')
        slack = 0.05 * (len(cells) + 1) + 0.001
        steps, between, total = (seconds(t) for t in self.window.run('return [...document.querySelectorAll("#operations tfoot tr")].map(r => r.lastElementChild.textContent)'))
        self.assertAlmostEqual(sum(map(seconds, cells)), steps, delta=slack)
        self.assertAlmostEqual(steps, sum(s['cutting_s'] + s['rapid_s'] for s in plan['steps']), delta=slack)
        self.assertAlmostEqual(steps + between, total, delta=0.151)
        printed = self.window.run('return [...document.querySelectorAll("#about dd")].map(d => d.textContent).find(t => t.includes(": cutting "))')
        self.assertAlmostEqual(total, seconds(printed.split(':')[0]), delta=0.051)

    def draws_something_else_for_each_step(self, name):
        if not self.window.run('return !view.flat'):
            self.skipTest('built without three.js, or no WebGL here')
        seen = []
        for step in range(min(3, self.window.run('return DATA.steps.length'))):
            self.window.run('pick(arguments[0])', step)
            colours, picture = self.window.run(LOOK)
            self.assertGreater(colours, 20)
            seen.append(picture)
        self.assertEqual(len(set(seen)), len(seen))
        self.window.screenshot(SCRATCH / f'{name}.png')

    def prints_every_step(self, plan, name, file=None):
        if file is None:
            file = SCRATCH / f'{name}.pdf'
            file.write_bytes(self.window.pdf())
        text = subprocess.run(['pdftotext', '-layout', file, '-'], capture_output=True, text=True, check=True).stdout
        text = ' '.join(text.split())
        for step in plan['steps']:
            for word in step['id'].split():
                self.assertIn(word, text)

    def test_prints_nothing_over_anything_else(self):
        for name in PARTS:
            with self.subTest(name):
                self.opened(name, 720)
                self.window.as_printed()
                number, covered = self.window.run(COVERED)
                self.window.as_on_screen()
                self.assertGreater(number, 10)
                self.assertEqual(covered, [])
                # What a picture lies on is in the PDF, and is not seen.
                file = SCRATCH / f'{name}.pdf'
                file.write_bytes(self.window.pdf())
                pages = list(pages_of(file))
                self.assertGreater(sum(len(words) for _, words in pages), 50)
                self.assertEqual([word for page, words in pages for word, box in words if page.contrast(box) < 60], [])

    def test_prints_a_sheet_to_pin_to_the_machine_for_each_setup(self):
        for name in PARTS:
            with self.subTest(name):
                plan = self.opened(name, 720)
                self.window.as_printed()
                sheets = self.window.run(SHEETS)
                self.window.as_on_screen()
                self.assertEqual(len(sheets), len(plan['setups']))
                for n, sheet in enumerate(sheets):
                    data = self.window.run('return DATA.setups[arguments[0]]', n)
                    steps = [s for s in plan['steps'] if s['setup'] == n]
                    self.assertGreaterEqual(sheet['pictures'], 1)
                    self.assertIn(data['holding']['pickup_text'] or '-', sheet['text'])
                    self.assertIn(data['zero'], sheet['text'])
                    tools, operations = sheet['tables']
                    self.assertEqual(len(tools), len({s['cutter_id'] for s in steps}))
                    self.assertEqual(len(operations), len(steps))
                    for step, row in zip(steps, operations, strict=True):
                        self.assertIn(step['id'], row)

    def test_cuts_the_stock_as_the_scrubber_moves(self):
        self.opened('pocket')
        volumes = []
        for share in (0, 300, 600, 1000):
            self.window.run('by("way").value = arguments[0]; moved()', str(share))
            volumes.append(self.window.run('return view.stock.volume()'))
        self.assertEqual(volumes, sorted(volumes, reverse=True))
        pocket = self.window.run('''const [lo, hi] = DATA.stock.box;
            return (hi[0] - lo[0]) * (hi[1] - lo[1]) * (hi[2] - lo[2]) - view.stock.volume()''')
        # The plan's own simulation is another program.
        removed = sum(sum(s['removed_mm3']) for s in self.reports['pocket'][1]['sections'])
        self.assertAlmostEqual(pocket / removed, 1.0, delta=0.02)

    def test_says_what_the_command_says_of_a_part_of_the_plan_too(self):
        plan, page = SCRATCH / 'open.json', SCRATCH / 'part.html'
        calls = [('plan', PARTS['bracket'], '--may', 'all', '-o', plan), ('bind', plan, '--next', '2', '--from', '4', '-o', page)]
        for call in calls:
            done = subprocess.run([CAPSTAN, *call], capture_output=True, text=True, cwd=EXAMPLES)
        self.window.open(page)
        verdict = self.window.run('return by("verdict").textContent')
        self.assertTrue(done.stderr.splitlines()[-1].startswith(verdict), (verdict, done.stderr))
        self.assertEqual(self.window.run('return DATA.steps.length'), 2)

    def test_shows_a_path_of_any_length(self):
        page = self.reports['pocket'][0].read_text()
        data = json.loads(page[page.index('id="data">') + 10:].split('</script>')[0])
        path = data['steps'][0]['path']
        for column in path.values():
            column.extend(column[-1:] * 200_000)
        long = SCRATCH / 'long.html'
        at = page.index('id="data">') + 10
        long.write_text(page[:at] + json.dumps(data).replace('<', '\\u003c') + page[page.index('</script>', at):])
        self.window.open(long)
        self.assertEqual(self.window.said(), [])
        self.assertEqual(self.window.run('return document.querySelectorAll("#tools tbody tr").length'), len(data['tools']))

    def test_shows_the_loads_of_a_step_below_their_limits(self):
        plan = self.opened('pocket')
        self.window.run('pick(0)')
        self.assertEqual(self.window.run('return document.querySelectorAll("#charts svg").length'), 7)
        loads = self.window.run('return DATA.steps[0].loads')
        for name in ('torque', 'power'):
            for load, limit in zip(loads['columns'][name], loads['limits'][name], strict=True):
                self.assertLessEqual(load * loads['margin'], 1.02 * limit, name)
        # The plan's own largest torque, margin in it.
        stated = plan['steps'][0]['loads']['torque_nm']
        self.assertAlmostEqual(max(loads['columns']['torque']) * loads['margin'] / stated, 1.0, delta=0.05)

    def test_leads_from_a_line_of_the_program_to_its_step(self):
        self.opened('bracket')
        self.assertEqual(self.window.run('''
            const line = [...document.querySelectorAll('.line')].find(l => l.textContent.includes('CAPSTAN STEP') && l.textContent.includes('n=3 '));
            line.click();
            return document.querySelector('#operations tr.picked').rowIndex'''), 3)

    def test_knows_the_step_of_each_line_in_capitals_too(self):
        report, plan, _ = planned(PARTS['bracket'], SCRATCH / 'fanuc', ['--control', 'fanuc'], '.nc')
        self.window.open(report)
        steps = self.window.run('return [...new Set(programSteps())].filter(s => s >= 0)')
        self.assertEqual(steps, list(range(len(plan['steps']))))

    def test_is_no_wider_than_the_window(self):
        for width in WIDTHS:
            for name in PARTS:
                self.opened(name, width)
                wide, there = self.window.run('return [document.documentElement.scrollWidth, window.innerWidth]')
                self.assertLessEqual(wide, there, f'{name} at {width}')
                self.assertGreaterEqual(self.window.run('return parseFloat(getComputedStyle(document.body).fontSize)'), 12)
                self.window.screenshot(SCRATCH / f'{name}.{width}.png')

    def test_is_legible_at_every_width(self):
        for width in WIDTHS:
            for name in PARTS:
                with self.subTest(f'{name} at {width}'):
                    self.opened(name, width)
                    self.window.run('pick(0)')
                    (size, text), over = self.window.run(LEGIBLE)
                    self.assertGreaterEqual(size, LEAST_PX, text)
                    self.assertEqual(over, [])

    def test_draws_bars_of_time_that_end_at_the_printed_time(self):
        for name in PARTS:
            with self.subTest(name):
                self.opened(name)
                bars, time = self.window.run(BARS), self.window.run('return DATA.time')
                self.assertEqual(bars['mark'], time['text'].split(':')[0])
                self.assertAlmostEqual(bars['ends'], time['total_s'], delta=0.01)
                self.assertAlmostEqual(bars['apart'], 0, delta=1)
                self.assertEqual([gap for gap in bars['gaps'] if abs(gap) > 1e-6], [])

    def test_ends_the_operations_as_explain_does(self):
        plan = SCRATCH / 'two_setups.json'
        said = subprocess.run([CAPSTAN, 'explain', plan], capture_output=True, text=True, check=True).stdout
        steps, total = re.search(r'the steps together (.+?); with what lies between them (.+)', said).groups()
        self.opened('two_setups')
        rows = self.window.run('return [...document.querySelectorAll("#operations tfoot tr")].map(r => r.lastElementChild.textContent)')
        self.assertEqual([rows[0], rows[2]], [steps, total])

    def test_shows_each_limit_that_is_known_however_far_it_is(self):
        for name in ('pocket', 'bracket'):
            self.opened(name)
            for step in range(self.window.run('return DATA.steps.length')):
                charts = self.window.run('''pick(arguments[0]);
                    return [...document.querySelectorAll('#charts figure')].map((f, i) => {
                      const inside = f.querySelector('svg').getBoundingClientRect(), stated = DATA.steps[arguments[0]].loads.limits[CHARTS[i][0]];
                      const seen = [...f.querySelectorAll('.limit')].map(e => e.getBoundingClientRect()).filter(b => b.width > 0 && b.top >= inside.top && b.bottom <= inside.bottom && b.right <= inside.right);
                      return {name: CHARTS[i][0], known: [].concat(stated || 0).some(v => v > 0), seen: seen.length, number: (f.querySelector('text.limit') || {}).textContent};
                    })''', step)
                for chart in charts:
                    self.assertEqual(chart['seen'], 2 if chart['known'] else 0, (name, step, chart))
                    if chart['known']:
                        self.assertRegex(chart['number'], r'limit.* [0-9.]+$')
                self.assertIn('feed', [chart['name'] for chart in charts if chart['known']])

    def test_leads_from_each_finding_to_its_step_or_feature(self):
        report, plan, _ = planned(PARTS['bracket'], SCRATCH / 'limited', ['--limit', 'tool.diameter<=6'])
        self.window.open(report)
        unplanned = [u['feature'] for u in self.window.run('return DATA.unplanned')]
        self.assertGreaterEqual(len(unplanned), 2)
        self.assertEqual(self.window.run('return state.feature'), None)
        # Of what planning warned: the quoted feature.
        for n, name in enumerate(unplanned):
            self.assertEqual(self.window.run('document.querySelectorAll("#findings .told.step")[arguments[0]].click(); return state.feature', n), name)
            self.assertIn('marked: ' + name, self.window.run('return by("legend").textContent'))
        # Of the list of what is not planned; its region is marked in the view.
        for n, name in enumerate(unplanned):
            self.window.run('by("step").value = "all0"; chosen()')
            before = self.window.run(LOOK) if not self.window.run('return view.flat') else None
            self.assertEqual(self.window.run('document.querySelectorAll("#findings tr.unplanned")[arguments[0]].click(); return state.feature', n), name)
            if before:
                self.assertEqual(self.window.run('return view.marked.children.length'), 1)
                self.assertNotEqual(self.window.run(LOOK), before)
        # Of the check: the step that it names.
        found = self.window.run('return DATA.findings.map(f => f.step)')
        self.assertGreater(len(found), 0)
        ids = [s['id'] for s in plan['steps']]
        for n, step in enumerate(found):
            self.assertEqual(self.window.run('document.querySelectorAll("#findings .finding.step")[arguments[0]].click(); return [by("step").value, state.feature]', n), [str(ids.index(step)), None])
            self.assertEqual(self.window.run('return document.querySelector("#operations tr.picked").rowIndex'), ids.index(step) + 1)

    def test_draws_part_zero_and_the_cutter_in_its_holder(self):
        self.opened('two_setups')
        if self.window.run('return view.flat'):
            self.skipTest('built without three.js, or no WebGL here')
        seen = []
        for part in (True, False):
            self.window.run('pick(0); by("way").value = "300"; moved(); by("part").checked = arguments[0]; shown()', part)
            seen.append(self.window.run(LOOK)[1])
        self.assertNotEqual(*seen)
        # The part is what the features ask for; what the paths leave at the end is no other.
        volumes = self.window.run('''
            const part = new Part(), sum = p => { let v = 0; for (let n = 0; n < p.top.length; ++n) v += p.top[n] - p.bottom[n]; return v / p.top.length; };
            view.stock.cutTo(DATA.steps.length - 1, lastPoint(DATA.steps.length - 1));
            return [sum(part), sum(view.stock)]''')
        self.assertAlmostEqual(volumes[0] / volumes[1], 1.0, delta=0.01)
        self.assertEqual(self.window.run('return view.fixed.children.filter(c => c.isSprite).length'), 4)
        parts = self.window.run('return [toolParts(toolOf(DATA.steps[0])).map(p => p[0]), view.cutter.children.length]')
        self.assertEqual(parts[0][:3], ['edge', 'shank', 'holder'])
        self.assertEqual(parts[1], len(parts[0]))

    def test_lists_tools_with_the_offsets_of_the_program_and_the_life_that_is_left(self):
        self.opened('bracket')
        program = (SCRATCH / 'bracket.ngc').read_text()
        head = self.window.run('return [...document.querySelectorAll("#tools th")].map(t => t.textContent)')
        rows = self.window.run('return [...document.querySelectorAll("#tools tbody tr")].map(r => [...r.cells].map(c => c.textContent))')
        tools = self.window.run('return DATA.tools')
        self.assertEqual({row[head.index('H')] for row in rows}, set(re.findall(r'G43 H(\d+)', program)))
        for row, tool in zip(rows, tools, strict=True):
            left = tool['life_min'] - tool['life_used_min'] - tool['used_min']
            self.assertAlmostEqual(float(row[-1].split()[0]), left, delta=0.0051)
        report, _, _ = planned(PARTS['pocket'], SCRATCH / 'siemens', ['--control', 'siemens'], '.mpf')
        self.window.open(report)
        self.assertEqual(self.window.run('return DATA.tools.map(offsetsOf)'), [{'H': '-', 'D': '1'}])

    def test_names_the_files_that_it_was_made_from_with_their_hashes(self):
        machine, part = SCRATCH / 'mill.yaml', pathlib.Path(EXAMPLES) / PARTS['pocket']
        machine.write_text(subprocess.run([CAPSTAN, 'machines', 'show', 'generic_vmc'], capture_output=True, text=True, check=True).stdout)
        report, _, _ = planned(PARTS['pocket'], SCRATCH / 'made', ['--machine', str(machine)])
        self.window.open(report)
        rows = {row[0]: row for row in self.window.run('return [...document.querySelectorAll("#inputs tbody tr")].map(r => [...r.cells].map(c => c.textContent))')}
        self.assertEqual(rows['part'][1], PARTS['pocket'])
        self.assertEqual(rows['part'][3], hashlib.sha256(part.read_bytes()).hexdigest())
        self.assertEqual(rows['machine'][3], hashlib.sha256(machine.read_bytes()).hexdigest())
        self.assertEqual(rows['tools'][3], '')

    def test_is_written_as_pdf_too_the_same_bytes_each_time(self):
        first, second = SCRATCH / 'sheet.pdf', SCRATCH / 'again' / 'sheet.pdf'
        call = [CAPSTAN, 'plan', PARTS['bracket'], '-o']
        for file in (first, second):
            subprocess.run([*call, file], capture_output=True, cwd=EXAMPLES, check=True)
        self.prints_every_step(self.reports['bracket'][1], 'bracket', first)
        self.assertEqual(first.read_bytes(), second.read_bytes())
        none = SCRATCH / 'none.pdf'
        refused = subprocess.run([*call, none], capture_output=True, text=True, cwd=EXAMPLES, env={**os.environ, 'PATH': '/nonexistent'})
        self.assertEqual(refused.returncode, 2)
        self.assertIn('[OUT-BROWSER]', refused.stderr)
        self.assertFalse(none.exists())

    def test_takes_names_for_text(self):
        name = "<script>window.ran=1</script><b>&amp;"
        part = SCRATCH / 'named.p21'
        text = (pathlib.Path(EXAMPLES) / 'reference_pocket.p21').read_text()
        feature = next(line for line in text.splitlines() if 'CLOSED_POCKET(' in line)
        at = feature.index("('") + 2
        part.write_text(text.replace(feature, feature[:at] + name + feature[feature.index("'", at):]))
        report, _, _ = planned(str(part), SCRATCH / 'named', [])
        self.window.open(report)
        self.assertIsNone(self.window.run('return window.ran || null'))
        self.assertIn(name, self.window.run('return document.querySelector("#operations").textContent'))

    def test_is_the_same_bytes_for_the_same_plan_and_small(self):
        first = self.reports['bracket'][0].read_bytes()
        again, _, _ = planned(PARTS['bracket'], SCRATCH / 'again' / 'bracket', [])
        self.assertEqual(again.read_bytes().replace(b'again/bracket', b'bracket'), first)
        self.assertLess(len(first), MOST_BYTES)

    def test_draws_flat_without_webgl(self):
        other = browser.Browser('--disable-3d-apis')
        try:
            other.open(self.reports['bracket'][0])
            self.assertTrue(other.run('return view.flat'))
            self.assertGreater(other.run('return document.querySelectorAll("#view svg path").length'), 5)
            self.assertEqual([m for m in other.said() if 'WebGL' not in m], [])
        finally:
            other.close()


if __name__ == '__main__':
    CAPSTAN, EXAMPLES, SCRATCH = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3]).resolve()
    if not (browser.DRIVER and browser.BROWSER and shutil.which('pdftotext') and shutil.which('pdftoppm')):
        print('skipped: chromium, chromedriver, pdftotext or pdftoppm is not here')
        sys.exit(77)
    (SCRATCH / 'again').mkdir(parents=True, exist_ok=True)
    unittest.main(argv=sys.argv[:1], verbosity=2)
