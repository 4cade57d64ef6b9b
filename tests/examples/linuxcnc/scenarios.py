#!/usr/bin/python3
"""Runs every scenario of late binding on one simulated machine, one after the other.

    scenarios.py --library libcapstan_late.so --plan PLAN --while-plan PLAN --bracket-plan PLAN --bracket-tools TABLE
                 --machine FILE --clock libfast_clock.so --out FOLDER [--only NAME ...]

Writes OUT/samples.txt (simulated.py; its ninth column is the scenario's number) and OUT/outcomes.txt: lines of scenario,
what and value, with a tab between. Ends as tests/linuxcnc/run.py does.
"""
import argparse
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys

sys.dont_write_bytecode = True  # the checkout stays as it is
import shop as shops  # noqa: E402
from gcode import (BIND, END, FACE, FIRST, FLOOR_Z, SETTER, SETTER_TOP_NOSE, SPRING, STANDS, STANDS_ROUGHED, TOUCH,  # noqa: E402
                   WALL_TOP_NOSE, WALL_X, WHILE_WALL_STANDS)
from shop import HERE, MILL_8, MILL_10, cut, simulated  # noqa: E402

WORN = 'T1 P1 Z+78.5 D+7.9 ;8 mm carbide end mill, 3 flutes\n'
MILL_16 = 'T4 P4 Z+95 D+16 ;16 mm carbide end mill, 3 flutes\n'
STATES = 'tool.state'  # what is told of the tools beside the table
PROBE = 'T9 P9 Z+100 D+6 ;touch probe\n'
MILL_ON_FLOOR_Z = shops.OFFSET_Z - 10.0 + 80.0  # the nose's height with T1 on the pocket's floor
MID_CUT_X = 65.0  # where the finishing, from the middle outwards, has cut the floor half
REAL_MM = 7.9  # the diameter of T1 in the scenario `measured`, of which the table says 8
SURFACE_Z = -49.3  # of the piece in the scenario `probed_surface`, machine coordinates, mm
DISK_BYTES = 1500  # less than a subroutine has, more than the journal
FAR_X = 200.0  # the pocket is 20 to 80 mm from there, X ends at 254
# Of G54 for the bracket, whose longest tool has 125 mm. Not any: from -60 and a tool of 97 mm LinuxCNC computes its own top, to which
# programs retract, as 1e-14 mm over the axis' limit, and refuses the next move.
BRACKET_Z = -64.0
MEMORY_MB = '8'  # less than planning the pocket takes
NO_TIME_S = '0.001'  # binding takes longer
LAG_GAIN = '0.9'  # of the drives in the scenario `all_there`: 30 mm/s are followed by 3.3 um
# The adapter with a file system of its own, of one page, at FULL; nobody else sees it.
FULL = 'full'
MOUNTED = ('unshare', '--user', '--map-current-user', '--keep-caps', '--mount', 'sh', '-c',
           f'mount -t tmpfs -o size=4k none {FULL} && head -c 4096 /dev/zero > {FULL}/filled && exec "$@"', 'sh')


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


def set_pins(**pins):
    """Pins of the simulated machine; `_` for `-`, `__` for `.`."""
    for pin, value in pins.items():
        name = pin.replace('__', '.').replace('_', '-')
        subprocess.run(['halcmd', 'setp', name, str(value)], check=True, stdin=subprocess.DEVNULL)


def stands_where_the_power_went():
    """Where the machine stood when its last sample was taken, mm."""
    with open('samples.txt', 'rb') as samples:
        samples.seek(-4096, os.SEEK_END)
        return [float(word) for word in samples.read().split(b'\n')[-2].split()[1:4]]


def starts_there(place):
    """The axes have absolute encoders: LinuxCNC, which counts from 0 where it starts, finds them where they stand."""
    sections = pathlib.Path('machine.ini').read_text().split('HOME_SEQUENCE = 0')
    homes = [f'HOME_SEQUENCE = 0\nHOME_OFFSET = {mm}\nHOME = {mm}' for mm in place]
    pathlib.Path('machine.ini').write_text(''.join(a + b for a, b in zip(sections, [*homes, ''])))


def power_goes(shop):
    """LinuxCNC and the adapter are killed as the second workingstep is cut; both are started anew, and go on."""
    shops.forget()
    shop.ready(MILL_8 + MILL_10)
    shop.new_mark()
    process = shop.adapter()

    def cutting_the_second():
        x, _, z = shop.s.actual_position[:3]
        return ('"event": "bound", "step": 2' in shops.journal()
                and shop.s.spindle[0]['speed'] != 0 and z < MILL_ON_FLOOR_Z + 0.05 and x > MID_CUT_X)

    shop.execute(shop.options.program, cutting_the_second)
    shop.operator.machine.lose_power()
    process.wait()
    shop.tell('power_lost', [], alive=False)
    place = stands_where_the_power_went()
    pathlib.Path('stood.txt').write_text(' '.join(map(str, place)))
    starts_there(place)
    shop.operator.machine.start()
    shop.operator.connect()
    shop.operator.switch_on()
    shop.take_operator()
    shop.new_mark()
    shop.ready(MILL_8 + MILL_10)
    shop.tell('lifted', shop.listen())
    shop.new_mark()
    process = shop.adapter()
    shop.tell('restarted', shop.execute(shop.options.program))
    process.kill()
    process.wait()
    shutil.copyfile('journal.jsonl', 'power_lost.jsonl')


def full_disk(shop):
    """A file system without a free page where subroutines are written; where none can be mounted, why."""
    pathlib.Path(FULL).mkdir(exist_ok=True)
    tried = subprocess.run([*MOUNTED, 'true'], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if tried.returncode != 0:
        shop.out.write('disk_full\tcannot\t' + ' '.join(tried.stderr.split()) + '\n')
        return
    shop.scenario('disk_full', adapter=('--subroutines', FULL), before=MOUNTED)


def work(operator, options):
    plan = options.program = pathlib.Path('part.ngc').read_text()
    assert all(text in plan for text in (BIND, FIRST, END))
    with open('outcomes.txt', 'w') as out:
        shop = shops.Shop(operator, options, out)
        set_pins(lag_x__gain=LAG_GAIN, lag_y__gain=LAG_GAIN, lag_z__gain=LAG_GAIN)
        shop.scenario('all_there', adapter=('--broadcast', 'broadcast.jsonl'))
        set_pins(lag_x__gain=1, lag_y__gain=1, lag_z__gain=1)
        if not options.only or 'all_there' in options.only:
            shutil.copyfile('1001.ngc', 'earlier.ngc')
            shutil.copyfile('journal.jsonl', 'all_there.jsonl')
            shutil.copyfile('so_far.json', 'all_there.json')
        shop.scenario('missing', table=MILL_10)
        shop.scenario('worn', table=WORN)
        # The real cutter trips the setter.
        set_pins(side_at__in0=FACE - 0.5 * REAL_MM, side_below__in1=SETTER_TOP_NOSE)
        shop.scenario('measured', program=plan.replace(FIRST, SETTER + FIRST))
        for name, told in (('worn_told', 'T1 wear 0.05\n'), ('broken_told', 'T1 broken\n')):
            pathlib.Path(STATES).write_text(told)
            shop.scenario(name, adapter=('--tool-state', STATES))
        shop.scenario('told_since', adapter=('--tool-state', STATES), program=plan.replace(BIND, BIND + '  M112\n'),
                      table=MILL_10)
        shop.scenario('harder', ask=('material', 'mild_steel'))
        set_pins(probe_at__in1=SURFACE_Z + 100.0)
        shop.scenario('probed_surface', table=MILL_8 + PROBE, program=plan.replace(FIRST, TOUCH + FIRST))
        set_pins(probe_at__in1=FLOOR_Z + STANDS)
        shop.scenario('spring_pass', table=MILL_8 + PROBE, program=plan.replace(END, SPRING + END))
        set_pins(side_at__in0=WALL_X - STANDS_ROUGHED, side_below__in1=WALL_TOP_NOSE)
        shop.scenario('while_of_the_plan', table=MILL_8 + PROBE, program=plan.replace(END, WHILE_WALL_STANDS + END),
                      plan='while_plan', adapter=('--values', 'wall'))
        shop.scenario('bracket', table=pathlib.Path('bracket.tbl').read_text(), plan='bracket_plan',
                      program=plan.replace(FIRST, f'G10 L2 P1 Z{BRACKET_Z}\n' + FIRST))
        shop.scenario('no_tool', table=MILL_16)
        shop.scenario('no_time', adapter=('--deadline', NO_TIME_S))
        for fault in ('killed', 'hung'):
            shop.scenario(fault, planner=(fault, '3'))
        shop.scenario('memory', adapter=('--memory', MEMORY_MB))
        limit = (DISK_BYTES, DISK_BYTES)
        shop.scenario('disk', preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, limit))
        full_disk(shop)
        for number, name in ((1, 'altered'), (2, 'cut_short'), (3, 'stale')):
            shop.scenario(name, program=plan.replace(BIND, BIND + f'  M110 P{number}\n'))
        shop.scenario('offset_moved', program=plan.replace(BIND, BIND + '  G10 L2 P1 Z-49\n'))
        shop.scenario('out_of_travel', program=plan.replace(FIRST, f'G10 L2 P1 X{FAR_X}\n' + FIRST))
        shop.scenario('adapter_hung', during=lambda process: process.send_signal(signal.SIGSTOP))
        shop.scenario('adapter_killed', during=lambda process: process.kill())
        shop.scenario('asker_killed', during=lambda process: process.send_signal(signal.SIGSTOP), until=kill_who_asks)
        if not options.only or 'power_lost' in options.only:
            power_goes(shop)  # the last one: behind it the simulation counts its axes from elsewhere


def of_mark(samples, mark, out):
    """The samples of one scenario, as they are."""
    with open(samples) as rows, open(out, 'w') as file:
        file.writelines(row for row in rows if row.split()[8] == str(mark))


def behind(place, stood):
    """X, Y, Z of a sample, as words. A simulation that is started where the axes `stood`, mm, counts from there."""
    return [f'{float(word) + mm:.6f}' for word, mm in zip(place, stood)]


def to_the_end(samples, mark, stood, out):
    """The samples from a scenario on, as a machine has them whose axes are where they were when it is started again."""
    begun, last, again = False, -1, False
    with open(samples) as rows, open(out, 'w') as file:
        for row in rows:
            number, *words = row.split()
            begun = begun or words[7] == str(mark)
            again = again or int(number) <= last
            last = int(number)
            if again:
                words[:3] = behind(words, stood)
            if begun:
                file.write(' '.join([number, *words]) + '\n')


def changes(samples, out, stood):
    """The samples at which the machine did anything, numbered anew. `stood`: where it stood when LinuxCNC was started again, mm."""
    last, expected, count, again = '', None, 0, False
    with open(samples) as rows, open(out, 'w') as file:
        for row in rows:
            number, _, rest = row.partition(' ')
            if expected is not None and int(number) != expected:
                if int(number) != 0 or again or not stood:
                    raise simulated.Failed('samples were lost')
                again = True
            expected = int(number) + 1
            if again:
                words = rest.split()
                rest = ' '.join([*behind(words, stood), *words[3:]]) + '\n'
            if rest != last:
                file.write(f'{count} {rest}')
                last, count = rest, count + 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ('library', 'plan', 'while-plan', 'bracket-plan', 'bracket-tools', 'machine', 'clock', 'out'):
        parser.add_argument(f'--{name}', required=True)
    parser.add_argument('--rate', type=float, default=24.0)
    parser.add_argument('--keep')
    parser.add_argument('--only', nargs='+', help='names of scenarios; power_lost has the restart with it')
    options = parser.parse_args()
    # Read by ask.py below the control: the watchdog over the adapter.
    os.environ['CAPSTAN_PATIENCE'] = '8'
    files = {**cut.files(cut.HERE / 'tools.tbl', options.clock), 'plan': options.plan, 'machine.yaml': options.machine,
             'while_plan': options.while_plan, 'bracket_plan': options.bracket_plan, 'bracket.tbl': options.bracket_tools,
             'libcapstan_late.so': options.library,
             **{name: HERE / name for name in ('M110', 'M111', 'M112', 'M113', 'faulty_planner.py')}}

    def collect(folder):
        out = pathlib.Path(options.out)
        for name in ('outcomes.txt', 'all_there.jsonl', 'all_there.json', 'power_lost.jsonl', 'broadcast.jsonl'):
            if (folder / name).exists():
                shutil.copyfile(folder / name, out / name)
        of_mark(folder / 'samples.txt', 1, out / 'all_there.txt')
        stood = folder / 'stood.txt'
        place = [float(word) for word in stood.read_text().split()] if stood.exists() else []
        if place:
            mark = dict(line.split('\t')[1:] for line in (folder / 'outcomes.txt').read_text().splitlines()
                        if line.startswith('power_lost\tmark\t'))['mark']
            to_the_end(folder / 'samples.txt', mark, place, out / 'power_lost.txt')
        changes(folder / 'samples.txt', out / 'samples.txt', place)

    return simulated.session(lambda operator: work(operator, options), files, clock_rate=options.rate, collect=collect,
                             keep=options.keep)


if __name__ == '__main__':
    sys.exit(main())
