#!/usr/bin/python3
"""Runs every scenario of late binding on one simulated machine, one after the other.

    scenarios.py --library libcapstan_late.so --plan PLAN --machine FILE --clock libfast_clock.so --out FOLDER

Writes OUT/samples.txt (simulated.py; its last column is the scenario's number) and OUT/outcomes.txt: lines of scenario,
what and value, with a tab between. Ends as tests/linuxcnc/run.py does.
"""
import argparse
import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import time

sys.dont_write_bytecode = True  # the checkout stays as it is
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[2] / 'examples' / 'linuxcnc'))
import cut  # noqa: E402
import simulated  # noqa: E402

MILL_8 = 'T1 P1 Z+80 D+8 ;8 mm carbide end mill, 3 flutes\n'
MILL_10 = 'T3 P3 Z+90 D+10 ;10 mm carbide end mill, 3 flutes\n'
WORN = 'T1 P1 Z+78.5 D+7.9 ;8 mm carbide end mill, 3 flutes\n'
MILL_16 = 'T4 P4 Z+95 D+16 ;16 mm carbide end mill, 3 flutes\n'
STATES = 'tool.state'  # what is told of the tools beside the table
PROBE = 'T9 P9 Z+100 D+6 ;touch probe\n'
OFFSET_Z = -50.0
SURFACE_Z = -49.3  # of the piece in the scenario `probed_surface`, machine coordinates, mm
DISK_BYTES = 1500  # less than a subroutine has, more than the journal
HANG_GRACE_S = 1.0
FAR_X = 200.0  # the pocket is 20 to 80 mm from there, X ends at 254
MEMORY_MB = '8'  # less than planning the pocket takes
BIND = '  M101 P#<step>\n'
FIRST = 'M101 P0\n'
# Touches the piece's top where the raw piece is whole, and moves G54 there.
TOUCH = '''T9 M6
G43 H9
G0 X5 Y5
G0 Z10
M64 P0
G38.2 Z-5 F300
M65 P0
G10 L2 P1 Z[#5223 + #5063]
G0 Z10
G49
G53 G0 Z101.6
'''


# Touches the pocket's floor, and cuts the last workingstep again while more than 0.02 mm stands: a spring pass.
FLOOR_Z = OFFSET_Z - 10.0 + 100.0  # the nose's height with the probe, 100 mm long, on the floor
STANDS = 0.05
END = 'M2\n'
SPRING = f'''#<left> = 1
#<passes> = 0
o2 while [[#<left> GT 0.02] AND [#<passes> LT 3]]
  T9 M6
  G43 H9
  G0 X50 Y40
  G0 Z10
  M64 P0
  G38.2 Z-12 F300
  M65 P0
  #<left> = [#5063 + 10]
  G0 Z10
  G49
  G53 G0 Z101.6
  o3 if [#<left> GT 0.02]
    M101 P2
    M66 P0 L0
    M102 P2
    M66 P0 L0
    o1002 call
    M103 P2
    M111 P{FLOOR_Z}
    #<passes> = [#<passes> + 1]
  o3 endif
o2 endwhile
'''


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
        self.lib, self.c, self.s = operator.lib, operator.command, operator.status

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

    def adapter(self, *more, planner=None, **limits):
        arguments = ['--plan', 'plan', '--machine', 'machine.yaml', '--library', './libcapstan_late.so',
                     '--grace', str(HANG_GRACE_S), '--deadline', '4', *more]
        if planner:
            arguments += ['--planner', sys.executable, '-B', 'faulty_planner.py', './libcapstan_late.so', *planner]
        return cut.start_adapter(arguments, **limits)

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
            if time.monotonic() > since + 120.0:
                raise simulated.Failed(f'the program does not end: {said}')
        return said + self.listen()

    def tell(self, name, said):
        self.s.poll()
        lines = [('mark', self.mark), ('rpm', self.s.spindle[0]['speed']), ('tool', self.s.tool_in_spindle)]
        lines += [(axis, self.s.actual_position[i]) for i, axis in enumerate('xyz')]
        lines += [('said', text) for text in said]
        for entry in map(json.loads, journal().splitlines()):
            if 'step' in entry:
                lines.append((entry['event'], f'{entry["step"]}'))
        self.out.writelines(f'{name}\t{key}\t{value}\n' for key, value in lines)

    def new_mark(self):
        self.mark += 1
        subprocess.run(['halcmd', 'sets', 'mark', str(self.mark)], check=True, stdin=subprocess.DEVNULL)

    def scenario(self, name, table=MILL_8 + MILL_10, program=None, ask=None, during=None, until=None, adapter=(), **more):
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


def kill_who_asks():
    """Kills M101 while it waits for its answer."""
    for entry in pathlib.Path('/proc').iterdir():
        try:
            words = (entry / 'cmdline').read_bytes().split(b'\0') if entry.name.isdigit() else []
            if words[1:3] == [b'ask.py', b'bind'] and os.path.samefile(entry / 'cwd', '.'):
                os.kill(int(entry.name), signal.SIGKILL)
        except OSError:
            pass  # it ended meanwhile, or is another user's
    return False


def restart(shop):
    """The power goes while the second workingstep is cut; another adapter goes on from the journal."""
    forget()
    shop.ready(MILL_8 + MILL_10)
    shop.new_mark()
    process = shop.adapter()

    def cutting_the_second():
        return ('"event": "bound", "step": 2' in journal()
                and shop.s.spindle[0]['speed'] != 0 and shop.s.actual_position[2] < 30.0 - 0.1)

    shop.execute(shop.options.program, cutting_the_second)
    process.kill()
    process.wait()
    shop.c.state(shop.lib.STATE_ESTOP)
    shop.c.wait_complete(5.0)
    time.sleep(0.1)
    shop.tell('power_lost', shop.listen())
    shop.c.state(shop.lib.STATE_ESTOP_RESET)
    shop.c.wait_complete(5.0)
    shop.c.state(shop.lib.STATE_ON)
    shop.c.wait_complete(5.0)
    shop.ready(MILL_8 + MILL_10)
    shop.new_mark()
    process = shop.adapter()
    shop.tell('restarted', shop.execute(shop.options.program))
    process.kill()
    process.wait()


def work(operator, options):
    plan = options.program = pathlib.Path('part.ngc').read_text()
    assert all(text in plan for text in (BIND, FIRST, END))
    with open('outcomes.txt', 'w') as out:
        shop = Shop(operator, options, out)
        shop.scenario('all_there')
        shutil.copyfile('1001.ngc', 'earlier.ngc')
        shutil.copyfile('journal.jsonl', 'all_there.jsonl')
        shutil.copyfile('so_far.json', 'all_there.json')
        shop.scenario('missing', table=MILL_10)
        shop.scenario('worn', table=WORN)
        shop.scenario('measured', program=plan.replace(FIRST, 'M104 P1 Q7.9\n' + FIRST))
        for name, told in (('worn_told', 'T1 wear 0.05\n'), ('broken_told', 'T1 broken\n')):
            pathlib.Path(STATES).write_text(told)
            shop.scenario(name, adapter=('--tool-state', STATES))
        shop.scenario('told_since', adapter=('--tool-state', STATES), program=plan.replace(BIND, BIND + '  M112\n'),
                      table=MILL_10)
        shop.scenario('harder', ask=('material', 'mild_steel'))
        subprocess.run(['halcmd', 'setp', 'probe-at.in1', str(SURFACE_Z + 100.0)], check=True)
        shop.scenario('probed_surface', table=MILL_8 + PROBE, program=plan.replace(FIRST, TOUCH + FIRST))
        subprocess.run(['halcmd', 'setp', 'probe-at.in1', str(FLOOR_Z + STANDS)], check=True)
        shop.scenario('spring_pass', table=MILL_8 + PROBE, program=plan.replace(END, SPRING + END))
        shop.scenario('no_tool', table=MILL_16)
        for fault in ('killed', 'hung'):
            shop.scenario(fault, planner=(fault, '3'))
        shop.scenario('memory', adapter=('--memory', MEMORY_MB))
        limit = (DISK_BYTES, DISK_BYTES)
        shop.scenario('disk', preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, limit))
        for number, name in ((1, 'altered'), (2, 'cut_short'), (3, 'stale')):
            shop.scenario(name, program=plan.replace(BIND, BIND + f'  M110 P{number}\n'))
        shop.scenario('offset_moved', program=plan.replace(BIND, BIND + '  G10 L2 P1 Z-49\n'))
        shop.scenario('out_of_travel', program=plan.replace(FIRST, f'G10 L2 P1 X{FAR_X}\n' + FIRST))
        shop.scenario('adapter_hung', during=lambda process: process.send_signal(signal.SIGSTOP))
        shop.scenario('adapter_killed', during=lambda process: process.kill())
        shop.scenario('asker_killed', during=lambda process: process.send_signal(signal.SIGSTOP), until=kill_who_asks)
        restart(shop)


def of_mark(samples, mark, out):
    """The samples of one scenario, as they are."""
    with open(samples) as rows, open(out, 'w') as file:
        file.writelines(row for row in rows if row.split()[-1] == str(mark))


def changes(samples, out):
    """The samples at which the machine did anything, numbered anew."""
    last, expected, count = '', None, 0
    with open(samples) as rows, open(out, 'w') as file:
        for row in rows:
            number, _, rest = row.partition(' ')
            if expected is not None and int(number) != expected:
                raise simulated.Failed('samples were lost')
            expected = int(number) + 1
            if rest != last:
                file.write(f'{count} {rest}')
                last, count = rest, count + 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ('library', 'plan', 'machine', 'clock', 'out'):
        parser.add_argument(f'--{name}', required=True)
    parser.add_argument('--rate', type=float, default=24.0)
    parser.add_argument('--keep')
    options = parser.parse_args()
    # Read by ask.py below the control: the watchdog over the adapter.
    os.environ['CAPSTAN_PATIENCE'] = '8'
    files = {**cut.files(cut.HERE / 'tools.tbl', options.clock), 'plan': options.plan, 'machine.yaml': options.machine,
             'libcapstan_late.so': options.library, **{name: HERE / name for name in ('M110', 'M111', 'M112', 'faulty_planner.py')}}

    def collect(folder):
        for name in ('outcomes.txt', 'all_there.jsonl', 'all_there.json'):
            shutil.copyfile(folder / name, pathlib.Path(options.out) / name)
        of_mark(folder / 'samples.txt', 1, pathlib.Path(options.out) / 'all_there.txt')
        changes(folder / 'samples.txt', pathlib.Path(options.out) / 'samples.txt')

    return simulated.session(lambda operator: work(operator, options), files, clock_rate=options.rate, collect=collect,
                             keep=options.keep)


if __name__ == '__main__':
    sys.exit(main())
