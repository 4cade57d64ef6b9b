#!/usr/bin/python3
"""Runs one program on a machine simulated by LinuxCNC, without a screen, faster than real time.

    run.py --program PART.ngc --tools PART.tbl --clock libfast_clock.so --samples OUT.txt
           [--rate N] [--limit SECONDS] [--offset G54:X,Y,Z ...]

Writes one line per servo period (1 ms of the machine's time): its number, machine x y z in mm, the velocity along
the path in mm/s, the line of the program, and what else examples/linuxcnc/machine/machine.hal samples. Ends with 0
when the program ran to its end; 77 with the reason when LinuxCNC is not here or cannot start; 1 with what LinuxCNC
said otherwise.
"""
import argparse
import pathlib
import shutil
import sys

sys.dont_write_bytecode = True  # the checkout stays as it is
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / 'examples' / 'linuxcnc'))
import simulated  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ('program', 'tools', 'clock', 'samples'):
        parser.add_argument(f'--{name}', required=True)
    parser.add_argument('--rate', type=float, default=15.0, help='how many times faster than real time')
    parser.add_argument('--limit', type=float, default=300.0, help='seconds of real time at most')
    parser.add_argument('--offset', action='append', default=[], help='a work offset, e.g. G54:0,0,-50')
    parser.add_argument('--keep', help='a folder for all that the run left, to look for faults')
    options = parser.parse_args()
    return simulated.session(
        work=lambda operator: operator.execute('program.ngc', options.limit),
        files={'program.ngc': options.program, 'tools.tbl': options.tools, 'fast_clock.so': options.clock},
        offsets=options.offset, clock_rate=options.rate, keep=options.keep,
        collect=lambda folder: shutil.copyfile(folder / 'samples.txt', options.samples))


if __name__ == '__main__':
    sys.exit(main())
