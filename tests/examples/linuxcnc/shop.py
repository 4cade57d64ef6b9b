"""The simulated machine between and during scenarios of late binding, and what its operator does there."""
import json
import os
import pathlib
import subprocess
import sys
import time
import urllib.parse

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[2] / 'examples' / 'linuxcnc'))
import cut  # noqa: E402
import simulated  # noqa: E402

MILL_8 = 'T1 P1 Z+80 D+8 ;8 mm carbide end mill, 3 flutes\n'
MILL_10 = 'T3 P3 Z+90 D+10 ;10 mm carbide end mill, 3 flutes\n'
OFFSET_Z = -50.0  # of G54: the piece's top, machine coordinates, mm
HANG_GRACE_S = 1.0


def forget():
    """What an adapter before knew of a part."""
    for file in ('journal.jsonl', 'so_far.json'):
        pathlib.Path(file).unlink(missing_ok=True)


def journal():
    file = pathlib.Path('journal.jsonl')
    return file.read_text() if file.exists() else ''


class Shop:
    """The machine between and during scenarios."""

    def __init__(self, operator, options, out):
        self.operator, self.options, self.out, self.mark = operator, options, out, 0
        self.take_operator()

    def take_operator(self):
        """The control's channels; others after it was started again."""
        self.lib, self.c, self.s = self.operator.lib, self.operator.command, self.operator.status

    def listen(self):
        said = []
        while (message := self.operator.errors.poll()) is not None:
            said.append(' '.join(str(message[1]).split()))
        return said

    def ready(self, table):
        """Retracted, no tool, the table loaded, G54 where the piece is."""
        c, lib = self.c, self.lib
        c.abort()
        c.wait_complete(5.0)
        pathlib.Path('tools.tbl').write_text(table)
        c.load_tool_table()
        c.mode(lib.MODE_MDI)
        c.wait_complete(5.0)
        for words in ('G21 G90 G49', 'G53 G0 Z101.6', 'M5', 'T0 M6', f'G10 L2 P1 X0 Y0 Z{OFFSET_Z}', 'G53 G0 X0 Y0'):
            c.mdi(words)
            if c.wait_complete(20.0) != lib.RCS_DONE:
                raise simulated.Failed(f'{words}: {self.listen()}')
        for file in pathlib.Path('.').glob('100?.ngc'):
            file.unlink()
        self.listen()

    def adapter(self, *more, planner=None, plan='plan', before=(), **limits):
        arguments = ['--plan', plan, '--machine', 'machine.yaml', '--library', './libcapstan_late.so',
                     '--grace', str(HANG_GRACE_S), '--deadline', '4', *more]
        if planner:
            arguments += ['--planner', sys.executable, '-B', 'faulty_planner.py', './libcapstan_late.so', *planner]
        return cut.start_adapter(arguments, before, **limits)

    def execute(self, program, until=None):
        """Runs a program until the control is idle, or a condition holds; what the screen said."""
        c, s, lib = self.c, self.s, self.lib
        c.mode(lib.MODE_AUTO)
        c.wait_complete(5.0)
        pathlib.Path('run.ngc').write_text(program)
        c.program_open(os.path.abspath('run.ngc'))
        c.wait_complete(5.0)
        c.auto(lib.AUTO_RUN, 0)
        said, idle, begun, since = [], 0, False, time.monotonic()
        while idle < 20:
            time.sleep(0.01)
            s.poll()
            said += self.listen()
            if until and until():
                break
            running = s.interp_state != lib.INTERP_IDLE or s.queue != 0 or not s.inpos
            begun = begun or running or time.monotonic() > since + 2.0
            idle = 0 if running or not begun else idle + 1
            if time.monotonic() > since + 180.0:
                raise simulated.Failed(f'the program does not end: {said}')
        return said + self.listen()

    def tell(self, name, said, alive=True):
        """How a scenario ended; of a control that is not `alive` any more, as its status was last."""
        if alive:
            self.s.poll()
        lines = [('mark', self.mark), ('rpm', self.s.spindle[0]['speed']), ('tool', self.s.tool_in_spindle)]
        lines += [(axis, self.s.actual_position[i]) for i, axis in enumerate('xyz')]
        lines += [('said', text) for text in said]
        for entry in map(json.loads, journal().splitlines()):
            if 'step' in entry:
                lines.append((entry['event'], f'{entry["step"]}'))
            if entry['event'] == 'bound':
                lines += [('bound_id', urllib.parse.unquote(entry['id'])), ('bound_tool', entry['tool'])]
            if entry['event'] == 'measured':
                lines.append(('diameter', entry['diameter_mm']))
            if entry['event'] == 'decided':
                lines.append(('decided', f'{entry["question"]} {entry["way"]}'))
        self.out.writelines(f'{name}\t{key}\t{value}\n' for key, value in lines)

    def new_mark(self):
        self.mark += 1
        subprocess.run(['halcmd', 'sets', 'mark', str(self.mark)], check=True, stdin=subprocess.DEVNULL)

    def scenario(self, name, table=MILL_8 + MILL_10, program=None, ask=None, during=None, until=None, adapter=(), **more):
        if self.options.only and name not in self.options.only:
            return
        forget()
        self.ready(table)
        self.new_mark()
        process = self.adapter(*adapter, **more)
        try:
            if ask:
                subprocess.run([sys.executable, '-B', 'ask.py', *ask], check=True)
            if during:
                during(process)
            self.tell(name, self.execute(program or self.options.program, until))
        finally:
            process.kill()
            process.wait()
