"""The program of one workingstep, as Capstan wrote and checked it, as a subroutine that LinuxCNC calls.

It is whole: it begins and ends retracted, spindle and coolant off, and calls its own tool. Its lines are those that were
checked, but for the end of the program. The last line has the SHA-256 of all lines before it: a file without it is cut
short, one that does not fit it was altered.
"""
import hashlib
import math
import re

STEP = re.compile(r'\(CAPSTAN STEP id="(?P<id>[^"]*)" n=(?P<n>\d+) tool=(?P<tool>\d+) ')
TOOL = re.compile(r'\(CAPSTAN TOOL T(?P<t>\d+) H(?P<h>\d+) length=(?P<length>[\d.]+) diameter=(?P<diameter>[\d.]+) ')
END = re.compile(r'\(CAPSTAN END sha256=([0-9a-f]{64})\)\n\Z')
FIRST = 1000  # subroutine 1000 + n is of workingstep n
TABLE_DECIMALS_MM = 1e-6  # numbers in a program's header are as exact as those of the tool table


class Refused(Exception):
    """What must not be cut, and why."""


def digest(text):
    return hashlib.sha256(text.encode()).hexdigest()


class Program:
    """One workingstep, the n-th of its plan: its lines, what stands before and after them, and the tools, by number."""

    def __init__(self, text, n):
        lines = text.splitlines()
        begins = [i for i, line in enumerate(lines) if STEP.match(line)]
        if len(begins) != 1 or lines.count('(end)') != 1:
            raise Refused('the program is not that of one workingstep, or has no end')
        if sum(line.startswith('(CAPSTAN SETUP ') for line in lines) != 1:
            raise Refused('the plan has more than one set-up; this adapter stays in one')
        step, end = STEP.match(lines[begins[0]]), lines.index('(end)')
        self.n, self.id, self.tool = n, step['id'], int(step['tool'])
        self.tools = {int(m['t']): m for m in map(TOOL.match, lines) if m}
        self.head = [line for line in lines[:begins[0]] if line and not line.startswith('(')]
        self.lines = [line for line in lines[begins[0]:end] if line]
        self.tail = [line for line in lines[end + 1:] if line and line != 'M2']
        self.sha256 = digest('\n'.join(self.lines))

    def subroutine(self, binding):
        """The file that LinuxCNC calls, with the mark of the binding that it came from."""
        name = f'o{FIRST + self.n}'
        body = '\n'.join([f'(CAPSTAN BINDING {binding})', f'{name} sub', *self.head, *self.lines, *self.tail,
                          f'{name} endsub', '']) + '\n'
        return body + f'(CAPSTAN END sha256={digest(body)})\n'


def of_answer(answer, n):
    """The program of workingstep n in the planner's answer (binder.py), where it is one to be cut."""
    lines = answer['message'].splitlines()
    if answer['code'] != 0 or not answer['program']:
        raise Refused(first_error(answer) or f'no program (code {answer["code"]})')
    # What the check only warns of is for somebody to decide, and nobody is asked here.
    doubts = [line for line in lines if 'warning: ' in line and '[CHK-' in line]
    if doubts:
        raise Refused(doubts[0].partition('warning: ')[2])
    return Program(answer['program'], n)


def first_error(answer):
    errors = [line for line in answer['message'].splitlines() if 'error: ' in line]
    return errors[0].partition('error: ')[2] if errors else ''


def lines_due(answer):
    """The broadcasts in the planner's answer, each in JSON."""
    if answer['code'] != 0:
        raise Refused('nothing can be broadcast: ' + (first_error(answer) or f'code {answer["code"]}'))
    return answer['lines']


def ways_taken(answer):
    """What the plan's if and while statements were decided to by measured values, in the planner's words."""
    ways = re.findall(r"^note: ((?:if|while) '.*) \[LATE-REOPENED\]$", answer['message'], re.M)
    return ways if answer['code'] == 0 else []


def check_text(text, expected):
    """Fails unless a subroutine is whole, unaltered, and the one that was bound."""
    mark = END.search(text)
    if not mark:
        raise Refused('it has no end mark: it is cut short')
    if digest(text[:mark.start()]) != mark[1]:
        raise Refused('its lines are not those that its end mark was made for: it was altered')
    if mark[1] != expected:
        raise Refused('it was not bound now: it is stale')


def wear_of(told):
    """Wear of edges by tool number, mm, radial, that the states of tools tell and that a table may still have."""
    wear = {}
    for line in told.splitlines():
        words = re.split('[;#]', line)[0].split()
        if 'wear' in words and 'in-table' not in words:
            wear[int(words[0].lstrip('T'))] = float(words[words.index('wear') + 1])
    return wear


def check_tools(step, table, wear=None):
    """Fails unless a workingstep uses one tool, loaded, with its own offset, as long and wide as the table says.

    It may be less wide by the wear of its edge (wear_of), which the path follows; what a length wears has to be in the table,
    which is what the control offsets by.
    """
    numbers = set()
    for line in step.lines:
        if not line.startswith('('):
            numbers.update(int(n) for n in re.findall(r'[TH](\d+)', line))
    for number in numbers | {step.tool}:
        stated, loaded = step.tools.get(number), table.get(number)
        if number != step.tool or stated is None or int(stated['h']) != number:
            raise Refused(f'workingstep {step.n} is of T{step.tool}, but names {number}')
        if loaded is None:
            raise Refused(f'T{number} is not in the tool table')
        less = 2.0 * (wear or {}).get(number, 0.0)
        for what, may_mm in (('length', [loaded['z']]), ('diameter', [loaded['d'], round(loaded['d'] - less, 6)])):
            if all(abs(float(stated[what]) - mm) > TABLE_DECIMALS_MM for mm in may_mm):
                raise Refused(f'T{number} has {what} {may_mm[-1]} mm, the program takes it for {stated[what]} mm')


def reach(step):
    """Least and greatest X, Y, Z in the work offset, mm, without retracts; an arc counts as its whole circle."""
    at = dict.fromkeys('XYZ')
    box = {axis: [] for axis in at}
    for line in step.lines:
        if line.startswith('(') or 'G53' in line:
            continue
        words = {letter: float(value) for letter, value in re.findall(r'([XYZIJ])(-?[\d.]+)', line)}
        for axis, offset in (('X', 'I'), ('Y', 'J')):
            if re.match(r'G[23]\b', line) and at[axis] is not None:
                centre = at[axis] + words.get(offset, 0.0)
                radius = math.hypot(words.get('I', 0.0), words.get('J', 0.0))
                box[axis] += [centre - radius, centre + radius]
        for axis in at:
            if axis in words:
                at[axis] = words[axis]
                box[axis].append(words[axis])
    return {axis: (min(values), max(values)) for axis, values in box.items() if values}


def check_travel(step, offset, length, limits):
    """Fails when an axis would leave its travel: limits by axis in machine coordinates, mm."""
    shift = {'X': offset[0], 'Y': offset[1], 'Z': offset[2] + length}
    for axis, (low, high) in reach(step).items():
        least, most = limits[axis]
        if low + shift[axis] < least or high + shift[axis] > most:
            raise Refused(f'{axis} would go from {low + shift[axis]:.3f} to {high + shift[axis]:.3f} mm on the machine, '
                          f'its travel is {least} to {most} mm: move the work offset or the piece')
