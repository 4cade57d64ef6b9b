#!/usr/bin/python3
"""Stands between LinuxCNC and Capstan: binds each workingstep for the machine as it is when its turn comes.

A program calls M101 P<n>; ask.py hands the question on to this process, which reads the live tool table and work offset,
has the planner (binder.py) bind that workingstep before a deadline, checks what comes back, writes its subroutine
to a temporary file, syncs it, renames it, and remembers its hash and the machine's state. M102 P<n> fails unless file and
state are still those. Any doubt is a refusal with its reason on the screen: the program ends, and the machine stands as it
stood while it waited, retracted and with its spindle stopped.

Watchdog: a planner that does not answer within its deadline and `--grace` is killed. ask.py watches this process.
Broadcasts: at the start and end of a workingstep the planner gives the lines that the plan's broadcasts ask for
(`--broadcast`). A line that waits for a reply holds the control, retracted and stopped, until somebody replies (`ask.py
reply NUMBER`).
Measured values: what M105 tells by number the plan's if and while statements read by name (`--values`), until the next
workingstep is cut: then what was measured is of a piece that is no more.
Restart: `journal.jsonl` has what was cut, measured of tools and reported of the material, line by line, and
`so_far.json` the plan as far as it was cut; M101 P0 says which workingstep is the next one.
"""
import argparse
import datetime
import errno
import hashlib
import json
import math
import os
import pathlib
import re
import select
import signal
import socket
import struct
import subprocess
import sys
import time
import urllib.parse

import linuxcnc

import program as programs
from program import Refused

SOCKET = 'capstan.socket'
LOADED = 'loaded.tbl'
TOLD = 'told.state'  # the states of tools that the planner is given
SO_FAR = 'so_far.json'  # the plan with the paths that were cut
SHOWN_S = 5.0  # within which the control shows an input: its periods are milliseconds, a busy machine holds them up. Default, unsourced
ENDS_S = 2.0  # that a process whose pipe is closed may take to be gone. Default, unsourced
REPLIES_S = 10.0  # within which somebody replies to a broadcast that waits: as long as `capstan serve` waits
MEASURED_DECIMALS = 4  # of a diameter in mm: finer than a setter measures, and as a program in mm has it (decimals of the machine's control)
SCREEN = 220  # characters of a message that LinuxCNC's screen takes (256 with its own words)


class Planner:
    """The planner's process: begun when it is needed, killed when it is late, never waited for."""

    def __init__(self, command, memory_mb=None):
        self.command, self.memory_mb, self.process = command, memory_mb, None

    def end(self):
        if self.process:
            self.process.kill()
            self.process.wait()
            for pipe in (self.process.stdin, self.process.stdout):
                try:
                    pipe.close()
                except BrokenPipeError:
                    pass  # it was asked more than it read
            self.process = None

    def ask(self, request, seconds):
        if self.process is None or self.process.poll() is not None:
            self.process = subprocess.Popen(self.command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        try:
            self.process.stdin.write((json.dumps(request) + '\n').encode())
            self.process.stdin.flush()
            return json.loads(self.answer(seconds))
        except (OSError, ValueError) as error:
            raise Refused(self.how_it_ended()) from error

    def how_it_ended(self):
        """Why there is no answer of a planner that ended; it is ended in any case."""
        try:
            status = self.process.wait(ENDS_S)
        except subprocess.TimeoutExpired:
            status = None  # it closed its end of the pipe and stayed
        self.end()
        limit = f', with a limit of {self.memory_mb} MB of memory (--memory)' if self.memory_mb else ''
        if status == errno.ENOMEM:
            return f'the planner ran out of memory before it answered{limit}; allow it more'
        if status == -signal.SIGKILL:
            return 'the planner was killed from outside (SIGKILL) before it answered'
        if status is not None and status < 0:
            return f'the planner broke down ({signal.Signals(-status).name}) before it answered{limit}'
        return f'the planner ended before it answered (exit status {status})'

    def answer(self, seconds):
        end, text = time.monotonic() + seconds, b''
        while not text.endswith(b'\n'):
            left = end - time.monotonic()
            if left <= 0.0 or not select.select([self.process.stdout], [], [], left)[0]:
                self.end()
                raise Refused(f'the planner did not answer within {seconds:g} s and was ended')
            part = os.read(self.process.stdout.fileno(), 65536)
            if not part:
                raise ValueError('no answer')
            text += part
        return text


class Machine:
    """LinuxCNC as it is now."""

    def __init__(self, ini):
        nml = linuxcnc.ini(ini).find('EMC', 'NML_FILE')
        if nml:
            linuxcnc.nmlfile = os.path.abspath(nml)
        self.table_file = linuxcnc.ini(ini).find('EMCIO', 'TOOL_TABLE')
        self.stat, self.command = linuxcnc.stat(), linuxcnc.command()

    def say(self, text):
        self.command.error_msg(text[:SCREEN])

    def state(self, measured):
        """Tools by number (Z, D in mm), work offset and axis limits in mm."""
        s = self.stat
        s.poll()
        if abs(s.linear_units - 1.0) > 1e-9:
            raise Refused('the machine is not in millimetres; this adapter knows no other unit')
        if s.g5x_index != 1 or any(s.g92_offset) or s.rotation_xy != 0.0:
            raise Refused(f'work offset {s.g5x_index} with G92 {list(s.g92_offset)} and rotation {s.rotation_xy} is '
                          'active; expected the first one, G54, with neither')
        # The first row is the tool in the spindle.
        tools = {t.id: {'z': round(t.zoffset, 6), 'd': round(measured.get(t.id, t.diameter), 6)}
                 for t in s.tool_table[1:] if t.id > 0}
        limits = {name: (s.axis[i]['min_position_limit'], s.axis[i]['max_position_limit'])
                  for i, name in enumerate('XYZ')}
        return {'tools': tools, 'offset': [round(v, 6) for v in s.g5x_offset[:3]], 'limits': limits}

    def standing(self):
        """Fails while the spindle turns."""
        self.stat.poll()
        if self.stat.spindle[0]['enabled']:
            raise Refused('the spindle turns; a workingstep is bound while it stands')

    def tell_program(self, first, steps):
        """What the running program reads with M66 E0 and E1: inputs of the control that nothing else drives.

        Returns when the control's status shows both. It copies its inputs once a servo period; a program that read
        before would take the number that a part before it left.
        """
        for number, value in ((0, first), (1, steps)):
            subprocess.run(['halcmd', 'setp', f'motion.analog-in-{number:02}', str(value)], check=True,
                           stdin=subprocess.DEVNULL)
        until = time.monotonic() + SHOWN_S
        while True:
            self.stat.poll()
            if tuple(self.stat.ain[:2]) == (first, steps):
                return
            if time.monotonic() > until:
                raise Refused(f'the control does not show its inputs after {SHOWN_S:g} s; expected '
                              f'motion.analog-in-00 {first} and -01 {steps}')
            time.sleep(0.002)

    def comments(self):
        """What the tool table's file says of each tool beside its numbers: what kind of tool it is."""
        out = {}
        for line in pathlib.Path(self.table_file).read_text().splitlines():
            number = re.match(r'T(\d+)\b', line)
            if number:
                pocket = re.search(r'\bP(\d+)\b', line.split(';')[0])
                out[int(number[1])] = (pocket[1] if pocket else number[1], line.partition(';')[2])
        return out


def written(path, text):
    """The whole file or none: temporary, synced, renamed, and the folder synced."""
    temporary = f'{path}.tmp'
    try:
        with open(temporary, 'w') as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        os.rename(temporary, path)
        folder = os.open(os.path.dirname(path) or '.', os.O_RDONLY)
        os.fsync(folder)
        os.close(folder)
    except OSError as error:
        pathlib.Path(temporary).unlink(missing_ok=True)
        raise Refused(f'{path} cannot be written: {error.strerror}') from error


def sent(path, line):
    """A line behind the others in a file, or in a FIFO: where nobody reads that, or its reader is full, it is lost."""
    try:
        file = os.open(path, os.O_WRONLY | os.O_APPEND | os.O_CREAT | os.O_NONBLOCK, 0o600)
        try:
            rest = (line + '\n').encode()
            while rest:
                rest = rest[os.write(file, rest):]
        finally:
            os.close(file)
    except (BlockingIOError, BrokenPipeError):
        pass
    except OSError as error:
        if error.errno != errno.ENXIO:
            raise Refused(f'nothing can be broadcast: {path} cannot be written: {error.strerror}') from error


class ToolStates:
    """What the shop tells of its tools beside the table: broken, worn, life left (docs/late_binding.md); the planner reads it."""

    def __init__(self, path):
        self.path = path

    def text(self):
        if not self.path:
            return ''
        try:
            return pathlib.Path(self.path).read_text(encoding='utf-8')
        except OSError as error:
            raise Refused(f'{self.path} cannot be read: {error.strerror}') from error
        except UnicodeDecodeError as error:
            raise Refused(f'{self.path} is not UTF-8, byte {error.start + 1}; save it as UTF-8') from error


class Journal:
    """What was bound, cut, told and refused, one line each.

    A restart keeps what was cut, and what was told of tools and material.
    """

    def __init__(self, path):
        self.path = pathlib.Path(path)
        # Hashes by workingstep, diameters in mm by tool, and the name that was reported last.
        self.cut, self.measured, self.material = {}, {}, None
        try:
            text = self.path.read_text() if self.path.exists() else ''
        except (OSError, UnicodeDecodeError) as error:
            raise Refused(f'{path} cannot be read: {error}; what was cut is not known without it') from error
        for line in text.splitlines():
            try:
                self.take(**json.loads(line))
            except ValueError:
                continue  # the power went while it was written
        self.cut_short = text != '' and not text.endswith('\n')

    def take(self, event, **what):
        if event == 'cut':
            self.cut[what['step']] = what['lines_sha256']
        elif event == 'measured' and what['diameter_mm'] == 0.0:
            self.measured.pop(what['tool'], None)
        elif event == 'measured':
            self.measured[what['tool']] = what['diameter_mm']
        elif event == 'material':
            self.material = what['name']

    def add(self, event, **what):
        now = datetime.datetime.now(datetime.timezone.utc).isoformat(timespec='milliseconds')
        with open(self.path, 'a') as file:
            # Behind a line that is cut short it would be no line of its own, and be lost with that.
            file.write('\n' * self.cut_short + json.dumps({'time': now, 'event': event, **what}) + '\n')
            file.flush()
            os.fsync(file.fileno())
        self.cut_short = False
        self.take(event, **what)


class Adapter:
    def __init__(self, options):
        self.options = options
        self.machine = Machine(options.ini)
        self.planner = Planner(options.planner, options.memory)
        self.journal = Journal(options.journal)
        self.values = {}
        self.names = options.values.split(',') if options.values else []
        self.door, self.since = None, time.monotonic()
        self.tool_states = ToolStates(options.tool_state)
        self.bound = {}  # n -> (program, state, hash, plan)

    @property
    def material(self):
        return self.journal.material or self.options.material

    def state(self):
        """The machine as it is, with what is told of its tools, and of the piece."""
        return {**self.machine.state(self.journal.measured), 'told': self.tool_states.text(),
                'material': self.material, 'values': dict(self.values)}

    def next(self):
        """The first workingstep that was not cut."""
        return 1 + len(self.journal.cut)

    def plan(self, n, state):
        """Workingstep n bound for the machine as it is, how many there are, and the plan with it. 0: the first open one."""
        comments = self.machine.comments()
        rows = [f'T{t} P{comments.get(t, (t, ""))[0]} Z{v["z"]:+.6f} D{v["d"]:+.6f} ;{comments.get(t, (t, ""))[1]}'
                for t, v in sorted(state['tools'].items())]
        written(LOADED, '\n'.join(rows) + '\n')
        options = {'machine': self.options.machine, 'tools': LOADED}
        if self.material:
            options['material'] = self.material
        if self.options.tool_state:
            written(TOLD, state['told'])
            options['tool-state'] = TOLD
        if self.values:
            options['measured'] = ','.join(f'{name}={value!r}' for name, value in sorted(self.values.items()))
        request = {'plan': SO_FAR if self.journal.cut else self.options.plan, 'from': n, 'options': options,
                   'deadline_ms': int(1000 * self.options.deadline)}
        answer = self.planner.ask(request, self.options.deadline + self.options.grace)
        for way in programs.ways_taken(answer):
            self.journal.add('decided', question=n, way=way)
        return programs.of_answer(answer, n or self.next()), answer['steps'], answer['plan']

    def bind(self, n):
        self.machine.standing()
        state = self.state()
        step, steps, plan = self.plan(n, state)
        self.machine.tell_program(first=self.next(), steps=steps)
        if n == 0:
            return
        programs.check_tools(step, state['tools'], programs.wear_of(state['told']))
        programs.check_travel(step, state['offset'], state['tools'][step.tool]['z'], state['limits'])
        text = step.subroutine(self.binding(state))
        written(self.subroutine(n), text)
        self.bound[n] = (step, state, programs.END.search(text)[1], plan)
        self.journal.add('bound', step=n, id=step.id, tool=step.tool, file_sha256=self.bound[n][2], **state)

    def subroutine(self, n):
        return os.path.join(self.options.subroutines, f'{programs.FIRST + n}.ngc')

    def binding(self, state):
        """Names the machine's state and the moment: two bindings have different subroutines."""
        seen = hashlib.sha256(json.dumps(state).encode()).hexdigest()
        return f'state={seen[:16]} at={time.time_ns()}'

    def check(self, n):
        if n not in self.bound:
            raise Refused(f'workingstep {n} was not bound')
        step, state, expected, plan = self.bound[n]
        name = self.subroutine(n)
        try:
            programs.check_text(pathlib.Path(name).read_text(), expected)
        except Refused as error:
            raise Refused(f'{name}: {error}') from error
        now = self.state()
        for key, what in (('told', 'what is told of the tools'), ('material', 'the material'),
                          ('values', 'a measured value')):
            if now[key] != state[key]:
                raise Refused(f'{name}: {what} changed since it was bound')
        if now != state:
            raise Refused(f'{name}: tool table or work offset changed since it was bound')
        self.broadcast('start', step)

    def done(self, n):
        if n not in self.bound:
            raise Refused(f'workingstep {n} was not bound')
        step, _, _, plan = self.bound.pop(n)
        written(SO_FAR, plan)
        self.values = {}
        s = self.machine.stat
        s.poll()
        self.journal.add('cut', step=n, id=step.id, lines_sha256=step.sha256, tool_in_spindle=s.tool_in_spindle,
                         position_mm=[round(v, 6) for v in s.actual_position[:3]],
                         following_error_max_mm=[s.joint[i]['ferror_highmark'] for i in range(s.joints)])
        # The step is cut and in the journal, whoever hears of it.
        self.broadcast('end', step)

    def broadcast(self, event, step):
        """Sends what is due, of what the control's status has now. Names are those of the AP238 edition 4 mapping."""
        if not self.options.broadcast:
            return
        s = self.machine.stat
        s.poll()
        tip = [round(s.actual_position[i] - s.g5x_offset[i] - s.tool_offset[i], 6) for i in range(3)]  # mm, of G54
        measured = {'location': tip, 'spindle speed': s.spindle[0]['speed'], 'feedrate': round(60.0 * s.current_vel, 6)}
        now = datetime.datetime.now(datetime.timezone.utc).isoformat(timespec='milliseconds')
        answer = self.planner.ask({'event': event, 'workingstep': urllib.parse.unquote(step.id), 'time': now,
                                   'elapsed_s': time.monotonic() - self.since, 'measured': measured},
                                  self.options.deadline + self.options.grace)
        lines = programs.lines_due(answer)
        for line in lines:
            sent(self.options.broadcast, line)
        waits = [str(number) for number in (json.loads(line).get('reply_to') for line in lines) if number is not None]
        self.wait_for_replies(waits)

    def wait_for_replies(self, numbers):
        """Hears `reply` to each of these broadcasts, and refuses all else meanwhile."""
        until = time.monotonic() + REPLIES_S
        while numbers:
            try:
                self.door.settimeout(max(until - time.monotonic(), 0.001))
                caller = self.door.accept()[0]
            except TimeoutError as error:
                raise Refused(f'nobody replied to broadcast {numbers[0]} within {REPLIES_S:g} s; expected '
                              f'`ask.py reply {numbers[0]}`') from error
            finally:
                self.door.settimeout(None)
            with caller:
                try:
                    words = self.heard(caller)
                    if words and words[0] == 'reply' and words[-1] in numbers:
                        numbers.remove(words[-1])
                        reply = 'ok'
                    else:
                        reply = f'the control waits for a reply to broadcast {numbers[0]}; ask again behind it'
                    caller.sendall((reply + '\n').encode())
                except (OSError, ValueError):
                    pass  # who asked waits no longer, or asked in no words

    def take_value(self, number, value):
        """Measured value `number` of the plan's statements, as --values names them from 1."""
        if not 1 <= number <= len(self.names):
            raise Refused(f'measured value {number} has no name; --values names {len(self.names)}, from 1')
        self.values[self.names[number - 1]] = value
        self.journal.add('value', name=self.names[number - 1], value=value)

    def answer(self, words):
        verb, numbers = words[0], words[1:]
        if verb == 'material':
            self.journal.add('material', name=numbers[0])
        elif verb == 'measured':
            tool, told = int(float(numbers[0])), float(numbers[1])
            diameter = round(told, MEASURED_DECIMALS) if math.isfinite(told) else -1.0
            if told != 0.0 and not diameter > 0.0:
                raise Refused(f'T{tool} measures {told:g} mm; expected more than 0 mm, or 0 to take the measure back')
            self.journal.add('measured', tool=tool, diameter_mm=diameter)
        elif verb == 'value':
            self.take_value(int(float(numbers[0])), float(numbers[1]))
        elif verb == 'reply':
            raise Refused(f'no broadcast of number {" ".join(numbers)} waits for a reply')
        elif verb in ('bind', 'check', 'done'):
            getattr(self, verb)(int(float(numbers[0])))
        else:
            raise Refused(f'nobody knows what {verb} is')

    def serve(self):
        unheard = SOCKET + '.new'
        pathlib.Path(unheard).unlink(missing_ok=True)
        with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as door:
            self.door = door
            # Under its name only when it listens: who sees it may ask.
            door.bind(unheard)
            os.chmod(unheard, 0o600)
            door.listen()
            os.rename(unheard, SOCKET)
            while True:
                with door.accept()[0] as caller:
                    self.one(caller)

    def heard(self, caller):
        """The words of a question; None of who may not ask."""
        uid = struct.unpack('3i', caller.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, 12))[1]
        caller.settimeout(5.0)
        return caller.makefile().readline(200).split() if uid in (0, os.geteuid()) else None

    def one(self, caller):
        words = []
        try:
            words = self.heard(caller)
            if words is None:
                return
            self.answer(words)
            reply = 'ok'
        except (Refused, OSError, IndexError, ValueError, KeyError,
                subprocess.CalledProcessError) as error:
            reply = str(error) if isinstance(error, Refused) else f'{type(error).__name__}: {error}'
            reply = ' '.join(reply.split())
            try:
                self.journal.add('refused', question=words, why=reply)
            except OSError:
                pass  # the disk is full, which the reply says
            self.machine.say('capstan: ' + reply)
        try:
            caller.sendall((reply + '\n').encode())
        except OSError:
            pass  # who asked waits no longer


def main():
    here = pathlib.Path(__file__).resolve().parent
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--ini', required=True, help="LinuxCNC's ini file")
    parser.add_argument('--plan', required=True, help='the plan with open decisions, as any form that Capstan reads')
    parser.add_argument('--machine', required=True, help="Capstan's machine: a file or the id of a built-in one")
    parser.add_argument('--library', default='libcapstan_late.so.0')
    parser.add_argument('--material', help="instead of the plan's")
    parser.add_argument('--tool-state', help='file in which the shop tells which tools broke, wore, or have how much life')
    parser.add_argument('--values', help='names of the values that M105 P1, P2, ... measure, for the plan\'s if and while: wall,floor')
    parser.add_argument('--broadcast', help='file or FIFO that gets a line of JSON at the start and end of each workingstep')
    parser.add_argument('--deadline', type=float, default=10.0, help='seconds for one binding')
    parser.add_argument('--grace', type=float, default=2.0, help='seconds after it until the planner is killed')
    parser.add_argument('--memory', help='MB that planning may take')
    parser.add_argument('--subroutines', default='', help='folder for them, of those in SUBROUTINE_PATH; by default this one')
    parser.add_argument('--journal', default='journal.jsonl')
    parser.add_argument('--planner', nargs=argparse.REMAINDER, help='last: another planner, asked as binder.py is')
    options = parser.parse_args()
    if not options.planner:
        options.planner = [sys.executable, str(here / 'binder.py'), options.library,
                           *([options.memory] if options.memory else [])]
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    try:
        adapter = Adapter(options)
    except Refused as error:
        sys.exit(f'capstan: the adapter cannot begin: {error}')
    try:
        adapter.serve()
    finally:
        adapter.planner.end()


if __name__ == '__main__':
    main()
