#!/usr/bin/python3
"""Cuts a plan on a machine that LinuxCNC simulates, each workingstep bound when its turn comes.

    cut.py --library build/dev/planner/door/transport/libcapstan_late.so [--plan PLAN] [--machine FILE] [--tools TABLE]
           [--offset G54:X,Y,Z] [--material NAME] [--tool-state FILE] [--clock libcapstan_fast_clock.so --rate 16]

Prints the journal: what was bound with which tools and offsets, and where the machine stood when it was cut. Without
--plan it is the reference pocket with everything open. --keep has the whole journal, journal.jsonl.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import time
import urllib.parse

sys.dont_write_bytecode = True  # the checkout stays as it is
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import simulated  # noqa: E402

ADAPTER = ('adapter.py', 'ask.py', 'binder.py', 'program.py', 'part.ngc', 'M101', 'M102', 'M103', 'M104',
           'M105')


def files(tools, clock):
    """What the machine's folder needs: name -> file."""
    out = {name: HERE / name for name in ADAPTER}
    out['tools.tbl'] = tools
    if clock:
        out['fast_clock.so'] = clock
    return out


def start_adapter(arguments, before=(), **more):
    """The adapter as a process, when it answers. `before`: a command that starts it, as `nice -n 5`."""
    pathlib.Path('capstan.socket').unlink(missing_ok=True)
    with open('adapter.log', 'ab') as log:
        process = subprocess.Popen([*before, sys.executable, '-B', 'adapter.py', '--ini', 'machine.ini', *arguments],
                                   stdin=subprocess.DEVNULL, stdout=log, stderr=log, **more)
    end = time.monotonic() + 20.0
    while not os.path.exists('capstan.socket'):
        if process.poll() is not None or time.monotonic() > end:
            raise simulated.Failed('the adapter does not start:\n' + pathlib.Path('adapter.log').read_text())
        time.sleep(0.02)
    return process


def tell(journal):
    """The journal in lines for people."""
    for entry in map(json.loads, pathlib.Path(journal).read_text().splitlines()):
        if entry['event'] == 'refused':
            text = f'refused: {entry["why"]}'
        elif entry['event'] == 'bound':
            tool, place = entry['tools'][str(entry['tool'])], ' '.join(f'{v:g}' for v in entry['offset'])
            text = (f'workingstep {entry["step"]} {urllib.parse.unquote(entry["id"])}: bound to T{entry["tool"]}, '
                    f'{tool["d"]:g} mm wide and {tool["z"]:g} mm long, G54 at {place}')
        elif entry['event'] == 'cut':
            place = ' '.join(f'{v:g}' for v in entry['position_mm'])
            text = f'workingstep {entry["step"]} cut; the machine stands at {place}'
        else:  # somebody told it something
            text = ', '.join(f'{key} {value}' for key, value in entry.items() if key != 'time')
        print(entry['time'][11:23], text, flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--library', required=True, help='libcapstan_late.so')
    parser.add_argument('--plan', default=HERE.parent / 'reference_pocket.p21')
    parser.add_argument('--machine', default=HERE.parent / 'reference_pocket_machine.yaml')
    parser.add_argument('--tools', default=HERE / 'tools.tbl')
    parser.add_argument('--offset', action='append', help='a work offset, by default G54:0,0,-50')
    parser.add_argument('--material', help="instead of the plan's")
    parser.add_argument('--tool-state', help='what is told of the tools beside the table')
    parser.add_argument('--clock', help='makes the simulation faster (tests/linuxcnc/fast_clock.c)')
    parser.add_argument('--rate', type=float, default=16.0, help='how much faster')
    parser.add_argument('--keep', help='a folder for all that the run left')
    options = parser.parse_args()

    def work(operator):
        adapter = start_adapter(['--plan', 'plan', '--machine', 'machine.yaml', '--library', './libcapstan_late.so',
                                 *(['--material', options.material] if options.material else []),
                                 *(['--tool-state', 'tool.state'] if options.tool_state else [])])
        try:
            operator.execute('part.ngc', 3600.0)
        finally:
            adapter.terminate()
            adapter.wait()
            tell('journal.jsonl')

    more = {'plan': options.plan, 'machine.yaml': options.machine, 'libcapstan_late.so': options.library,
            **({'tool.state': options.tool_state} if options.tool_state else {})}
    return simulated.session(work, {**files(options.tools, options.clock), **more},
                             offsets=options.offset or ['G54:0,0,-50'], clock_rate=options.rate, keep=options.keep)


if __name__ == '__main__':
    sys.exit(main())
