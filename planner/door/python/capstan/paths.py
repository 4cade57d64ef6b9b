"""Paths of a plan as arrays of numpy."""

import dataclasses
import math

import numpy as np

LEAST_CHORD_MM = 1e-5  # below what a control resolves; a finer one makes millions of points of an arc

# Letters of `kind` (docs/plan.schema.json).
RAPID, LINE, CLOCKWISE, COUNTER_CLOCKWISE, DWELL = "RLWCD"


@dataclasses.dataclass(frozen=True)
class Path:
    """The moves of a step, a row each, in the frame of its set-up. A move ends at (x, y, z) and begins where the one
    before it ends; the first only has its end. An arc turns about (cx, cy), its z runs evenly along the turn (a
    helix), and one that ends where it began is a whole turn."""

    x: np.ndarray  # mm
    y: np.ndarray
    z: np.ndarray
    cx: np.ndarray  # mm; 0 where the move is no arc
    cy: np.ndarray
    kind: np.ndarray  # a letter: R rapid, L line, W arc clockwise, C arc counter-clockwise, D dwell
    role: np.ndarray  # a letter: A approach, P plunge, M ramp, C cut, L link, R retract, D drill, T tap
    feed_mm_min: np.ndarray  # 0 of rapids
    spindle_rpm: np.ndarray
    dwell_s: np.ndarray

    @classmethod
    def of(cls, path, schedule):
        """A path and its schedule, as the plan's JSON holds them; without a schedule, feeds and speeds are not a number."""
        count = len(path["kind"])
        numbers = {name: np.asarray(path[name], dtype=float) for name in ("x", "y", "z", "cx", "cy")}
        for name in ("feed_mm_min", "spindle_rpm", "dwell_s"):
            numbers[name] = np.asarray(schedule[name], dtype=float) if schedule else np.full(count, np.nan)
        letters = {name: np.frombuffer(path[name].encode("ascii"), dtype="S1").astype("U1") for name in ("kind", "role")}
        for name, column in {**numbers, **letters}.items():
            if len(column) != count:
                raise ValueError(f"column '{name}' of the path has {len(column)} rows, not {count}")
            column.setflags(write=False)
        return cls(**numbers, **letters)

    def __len__(self):
        return len(self.kind)

    @property
    def xyz(self):
        """Where the moves end, mm: an array of n rows and 3 columns."""
        return np.column_stack((self.x, self.y, self.z))

    @property
    def cuts(self):
        """Whether the move is at feed: an array of truth values."""
        return (self.kind == LINE) | self._arcs

    @property
    def _arcs(self):
        return (self.kind == CLOCKWISE) | (self.kind == COUNTER_CLOCKWISE)

    def _sweeps(self):
        """The angle that each move turns, rad, above 0 counter-clockwise; 0 where it is no arc."""
        out = np.zeros(len(self))
        for i in np.flatnonzero(self._arcs):
            sign = 1.0 if self.kind[i] == COUNTER_CLOCKWISE else -1.0
            begin = math.atan2(self.y[i - 1] - self.cy[i], self.x[i - 1] - self.cx[i])
            end = math.atan2(self.y[i] - self.cy[i], self.x[i] - self.cx[i])
            whole = self.x[i] == self.x[i - 1] and self.y[i] == self.y[i - 1]
            out[i] = sign * (2.0 * math.pi if whole else (sign * (end - begin)) % (2.0 * math.pi))
        return out

    @property
    def length_mm(self):
        """How long each move is, mm; 0 of the first, whose begin is not known."""
        out = np.zeros(len(self))
        step = np.diff(self.xyz, axis=0)
        out[1:] = np.sqrt((step**2).sum(axis=1))
        turned = np.abs(self._sweeps())
        radius = np.hypot(self.x - self.cx, self.y - self.cy)
        arcs = self._arcs
        out[arcs] = np.hypot(turned * radius, np.diff(self.z, prepend=self.z[:1]))[arcs]
        return out

    def points(self, chord_mm=0.01):
        """The path as a polyline that leaves no arc by more than `chord_mm`: points of n rows and 3 columns, mm, and
        the move that each ends or lies on."""
        if not chord_mm >= LEAST_CHORD_MM:
            raise ValueError(f"chord_mm is {chord_mm}, and must be at least {LEAST_CHORD_MM} mm")
        xyz, sweeps, points, moves = self.xyz, self._sweeps(), [], []
        for i in range(len(self)):
            if sweeps[i] != 0.0:
                radius = math.hypot(self.x[i] - self.cx[i], self.y[i] - self.cy[i])
                # The sagitta of a chord over the angle a is radius (1 - cos(a / 2)).
                most = 2.0 * math.acos(1.0 - chord_mm / radius) if chord_mm < radius else math.pi
                parts = max(1, math.ceil(abs(sweeps[i]) / most))
                begin = math.atan2(self.y[i - 1] - self.cy[i], self.x[i - 1] - self.cx[i])
                share = np.arange(1, parts) / parts
                angle = begin + share * sweeps[i]
                points.append(np.column_stack((self.cx[i] + radius * np.cos(angle), self.cy[i] + radius * np.sin(angle),
                                               self.z[i - 1] + share * (self.z[i] - self.z[i - 1]))))
                moves.append(np.full(parts - 1, i))
            points.append(xyz[i:i + 1])
            moves.append(np.array([i]))
        if not points:
            return np.zeros((0, 3)), np.zeros(0, dtype=int)
        return np.concatenate(points), np.concatenate(moves)
