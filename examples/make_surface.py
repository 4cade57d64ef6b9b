#!/usr/bin/env python3
"""Writes surface.stl: a smooth bump beside a shallow dish on a block of 60 x 40 mm, closed all round.

    python3 examples/make_surface.py > examples/surface.stl

The top is z(x, y) = 8 exp(-((x-20)^2 + (y-20)^2) / 90) - 3 exp(-((x-42)^2 + (y-20)^2) / 120), in mm, on a grid of
two millimetres; the bottom lies at z = -15. Same program, same bytes.
"""
import math
import struct
import sys

LENGTH, WIDTH, BOTTOM, STEP = 60, 40, -15.0, 2


def top(x, y):
    bump = 8.0 * math.exp(-((x - 20) ** 2 + (y - 20) ** 2) / 90.0)
    dish = 3.0 * math.exp(-((x - 42) ** 2 + (y - 20) ** 2) / 120.0)
    return round(bump - dish, 6)


def quad(a, b, c, d):
    return [(a, b, c), (a, c, d)]


def triangles():
    out = []
    xs = range(0, LENGTH, STEP)
    ys = range(0, WIDTH, STEP)
    up = lambda x, y: (x, y, top(x, y))
    down = lambda x, y: (x, y, BOTTOM)
    for x in xs:
        for y in ys:
            x1, y1 = x + STEP, y + STEP
            out += quad(up(x, y), up(x1, y), up(x1, y1), up(x, y1))
            out += quad(down(x, y), down(x, y1), down(x1, y1), down(x1, y))
    for x in xs:
        x1 = x + STEP
        out += quad(down(x, 0), down(x1, 0), up(x1, 0), up(x, 0))
        out += quad(down(x1, WIDTH), down(x, WIDTH), up(x, WIDTH), up(x1, WIDTH))
    for y in ys:
        y1 = y + STEP
        out += quad(down(0, y1), down(0, y), up(0, y), up(0, y1))
        out += quad(down(LENGTH, y), down(LENGTH, y1), up(LENGTH, y1), up(LENGTH, y))
    return out


def normal(a, b, c):
    u = [b[i] - a[i] for i in range(3)]
    v = [c[i] - a[i] for i in range(3)]
    n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    size = math.sqrt(sum(k * k for k in n))
    return [k / size for k in n]


def main():
    faces = triangles()
    out = b"Capstan example: bump and dish, mm".ljust(80, b" ") + struct.pack("<I", len(faces))
    for a, b, c in faces:
        out += struct.pack("<12fH", *normal(a, b, c), *a, *b, *c, 0)
    sys.stdout.buffer.write(out)


main()
