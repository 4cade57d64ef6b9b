#!/usr/bin/python3
"""What the machine did in each workingstep, as a table that `capstan cases import` takes.

    cases.py SAMPLES JOURNAL > log.csv
    capstan cases import shop.db csv log.csv --plan so_far.json

SAMPLES is what `halsampler -t` wrote (machine/machine.hal says which pins; a sample per servo period), JOURNAL the adapter's
journal.jsonl. The following error is that of the axes together: how far the tool was from where it was told to be. The samples
have no clock and no workingstep; but between two workingsteps the tool is retracted and the spindle stands (part.ngc), and
within one neither is: the n-th time that the spindle turned is the n-th workingstep that the journal has as cut. A last one
that the journal has not was broken off, and is left out.
"""
import argparse
import json
import pathlib
import sys
import urllib.parse

PERIOD_S = 0.001  # of the servo thread; machine/machine.ini, SERVO_PERIOD
RETRACTED_MM = 101.6  # machine/machine.ini, AXIS_Z
COLUMNS = 'time_s,workingstep,tool,x_mm,y_mm,z_mm,feed_mm_min,spindle_rpm,lag_mm'


def cut(journal):
    """Names of the workingsteps that were cut, in order."""
    entries = map(json.loads, pathlib.Path(journal).read_text().splitlines())
    return [urllib.parse.unquote(entry['id']) for entry in entries if entry['event'] == 'cut']


def times(samples):
    """The samples of each time that the spindle turned, until the tool was retracted and the spindle stood."""
    now, turned = [], False
    for row in samples:
        word = row.split()
        number, x, y, z, velocity = int(word[0]), *map(float, word[1:5])
        # The ninth is the scenario's mark, which says nothing of a cut; the tenth how far the axes were behind.
        rpm, tool, lag = float(word[6]), int(float(word[7])), float(word[9])
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
    with open(options.samples) as rows:
        done = list(times(rows))
    if len(done) < len(names):
        sys.exit(f'{options.samples}: the spindle turned {len(done)} times, and {options.journal} has {len(names)} '
                 'workingsteps as cut: they are not of one run')
    print(COLUMNS)
    for name, samples in zip(names, done):
        for time, tool, *numbers in samples:
            print(f'{time:.3f},"{name}",{tool},' + ','.join(f'{v:.6g}' for v in numbers))


if __name__ == '__main__':
    main()
