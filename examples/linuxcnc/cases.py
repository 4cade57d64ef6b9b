#!/usr/bin/python3
"""What the machine did in each workingstep, as a table that `capstan cases import` takes.

    cases.py SAMPLES JOURNAL > log.csv
    capstan cases import shop.db csv log.csv --plan so_far.json

SAMPLES is what `halsampler -t` wrote (machine/machine.hal says which pins; a sample per servo period), JOURNAL the adapter's
journal.jsonl. The following error is that of the axes together: how far the tool was from where it was told to be. The samples
have no clock and no workingstep; but between two workingsteps the tool is retracted and the spindle stands (part.ngc), and
within one neither is: the n-th time that the spindle turned is the n-th workingstep that the journal has as cut. A last one
that the journal has not was broken off, and is left out. So is one in which the power went: samples are numbered from 0
again behind it. A workingstep that was broken off while the control ran on, and cut again in the same run, is not told
from one that was cut: leave its samples out.
"""
import argparse
import json
import pathlib
import sys
import urllib.parse

PERIOD_S = 0.001  # of the servo thread; machine/machine.ini, SERVO_PERIOD
RETRACTED_MM = 101.6  # machine/machine.ini, AXIS_Z
WORDS = 11  # of a sample: its number, and the ten pins of machine/machine.hal
COLUMNS = 'time_s,workingstep,tool,x_mm,y_mm,z_mm,feed_mm_min,spindle_rpm,lag_mm'


def cut(journal):
    """Names of the workingsteps that were cut, in order."""
    names = []
    for line in pathlib.Path(journal).read_text().splitlines():
        try:
            entry = json.loads(line)
        except ValueError:
            continue  # the power went while it was written
        if entry['event'] == 'cut':
            names.append(urllib.parse.unquote(entry['id']))
    return names


def numbers(row):
    """Number, X, Y, Z, velocity, spindle speed, tool and following error of a sample; None of a row cut short."""
    word = row.split()
    if len(word) != WORDS or not row.endswith('\n'):
        return None
    try:
        # The ninth is the scenario's mark, which says nothing of a cut; the tenth how far the axes were behind.
        return int(word[0]), *map(float, word[1:5]), float(word[6]), int(float(word[7])), float(word[9])
    except ValueError:
        return None


def whole(samples):
    """The numbers of each sample. The last row, and the last before a restart, may be cut short."""
    short, last = None, -1
    for line, row in enumerate(samples, 1):
        found = numbers(row)
        # Started anew, the sampler goes on in the line that was cut short: its sample 0 is lost with it.
        if short and (not found or found[0] > last):
            raise ValueError(f'line {short} is no sample; expected {WORDS} numbers, as machine/machine.hal has them')
        short = None if found else line
        if found:
            last = found[0]
            yield found


def times(samples):
    """The samples of each time that the spindle turned, until the tool was retracted and the spindle stood."""
    now, turned, before, last = [], False, 0, -1
    for number, x, y, z, velocity, rpm, tool, lag in whole(samples):
        if number <= last:  # the control was started anew: what it did before was broken off, and time goes on
            now, turned, before = [], False, before + last + 1
        last = number
        number += before
        if rpm == 0.0 and z >= RETRACTED_MM - 1e-6:
            if turned:  # the machine stands: the workingstep is over
                yield now + [(number * PERIOD_S, tool, x, y, z, 0.0, rpm, lag)]
            now, turned = [], False
            continue
        turned = turned or rpm != 0.0
        now.append((number * PERIOD_S, tool, x, y, z, velocity * 60.0, rpm, lag))
    if turned:
        yield now


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('samples')
    parser.add_argument('journal')
    options = parser.parse_args()
    names = cut(options.journal)
    try:
        with open(options.samples) as rows:
            done = list(times(rows))
    except ValueError as error:
        sys.exit(f'{options.samples}: {error}')
    if len(done) < len(names):
        sys.exit(f'{options.samples}: the spindle turned {len(done)} times, and {options.journal} has {len(names)} '
                 'workingsteps as cut: they are not of one run')
    print(COLUMNS)
    for name, samples in zip(names, done):
        for time, tool, *numbers in samples:
            print(f'{time:.3f},"{name}",{tool},' + ','.join(f'{v:.6g}' for v in numbers))


if __name__ == '__main__':
    main()
