"""Surfaces for the pictures of docs/strategies.md, as STL meshes in mm. Same call, same bytes."""
import math
import os
import struct


def boss():
    """A block of 60 x 40 mm with a boss of 30 x 16 x 8 mm: walls and level floors only."""
    xs, ys, under = (0.0, 15.0, 45.0, 60.0), (0.0, 12.0, 28.0, 40.0), -15.0
    height = lambda i, j: (8.0 if (i, j) == (1, 1) else 0.0) if 0 <= i < 3 and 0 <= j < 3 else under
    out = []
    for i in range(3):
        for j in range(3):
            x0, x1, y0, y1, z = xs[i], xs[i + 1], ys[j], ys[j + 1], height(i, j)
            out += quad((x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z))
            out += quad((x0, y0, under), (x0, y1, under), (x1, y1, under), (x1, y0, under))
            for di, dj, p, q in ((1, 0, (x1, y0), (x1, y1)), (-1, 0, (x0, y1), (x0, y0)),
                                 (0, 1, (x1, y1), (x0, y1)), (0, -1, (x0, y0), (x1, y0))):
                low = height(i + di, j + dj)
                if low < z:
                    out += quad((*p, low), (*q, low), (*q, z), (*p, z))
    return out


def ridge():
    """A block of 60 x 40 mm whose top is a parabola, 20 mm high: steeper than 47 degrees at its ends."""
    step, under = 2.0, -22.0
    top = lambda x: round(-20.0 * ((x - 30.0) / 30.0) ** 2, 6)
    out = []
    for i in range(30):
        x0, x1 = step * i, step * (i + 1)
        out += quad((x0, 0.0, top(x0)), (x1, 0.0, top(x1)), (x1, 40.0, top(x1)), (x0, 40.0, top(x0)))
        out += quad((x0, 0.0, under), (x0, 40.0, under), (x1, 40.0, under), (x1, 0.0, under))
        out += quad((x0, 0.0, under), (x1, 0.0, under), (x1, 0.0, top(x1)), (x0, 0.0, top(x0)))
        out += quad((x1, 40.0, under), (x0, 40.0, under), (x0, 40.0, top(x0)), (x1, 40.0, top(x1)))
    out += quad((0.0, 40.0, under), (0.0, 0.0, under), (0.0, 0.0, top(0.0)), (0.0, 40.0, top(0.0)))
    out += quad((60.0, 0.0, under), (60.0, 40.0, under), (60.0, 40.0, top(60.0)), (60.0, 0.0, top(60.0)))
    return out


def bowl():
    """A disc of 34 mm with a round cavity: 28 mm wide above, 8 mm deep, walls of 70 degrees, R5.5 along the floor."""
    wall, fillet, depth, sides = math.radians(70.0), 5.5, 8.0, 72
    middle = 14.0 - (depth - fillet + fillet * math.cos(wall)) / math.tan(wall) - fillet * math.sin(wall)
    profile = [(0.0, -depth)]
    profile += [(middle + fillet * math.sin(wall * k / 8), -depth + fillet - fillet * math.cos(wall * k / 8)) for k in range(9)]
    profile += [(14.0, 0.0), (17.0, 0.0), (17.0, -14.0), (0.0, -14.0)]
    at = lambda p, k: (p[0] * math.cos(2 * math.pi * k / sides), p[0] * math.sin(2 * math.pi * k / sides), p[1])
    out = []
    for p, q in zip(profile, profile[1:]):
        for k in range(sides):
            if q[0] > 0.0:
                out.append((at(p, k), at(q, k), at(q, k + 1)))
            if p[0] > 0.0:
                out.append((at(p, k), at(q, k + 1), at(p, k + 1)))
    return out


def quad(a, b, c, d):
    return [(a, b, c), (a, c, d)]


def write(folder):
    """Writes NAME.stl of each into the folder; normals are left to the vertices."""
    for made in (boss, ridge, bowl):
        faces = made()
        with open(os.path.join(folder, made.__name__ + ".stl"), "wb") as f:
            f.write(made.__name__.encode().ljust(80, b" ") + struct.pack("<I", len(faces)))
            for a, b, c in faces:
                f.write(struct.pack("<12fH", 0.0, 0.0, 0.0, *a, *b, *c, 0))
