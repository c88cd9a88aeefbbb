"""Which ground the robot has seen: swept by its laser from where it stood, as far as the walls let it look."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from robot.geometry import Point, Segment

RANGE_M = 3.5  # LDS-01, the TurtleBot3's laser
CELL_M = 0.1
BEAMS = 360

Cells = NDArray[np.bool_]


def _no_cells() -> Cells:
    return np.zeros((0, 0), dtype=np.bool_)


@dataclass(frozen=True, eq=False)
class Explored:
    """Seen cells, map frame: ``cells[i, j]`` begins at x = (i + first[0]) * CELL_M, y = (j + first[1]) * CELL_M."""

    first: tuple[int, int] = (0, 0)
    cells: Cells = field(default_factory=_no_cells, repr=False)

    def seen_from(self, eye: Point, walls: tuple[Segment, ...]) -> Explored:
        """What was seen before, and what is seen from ``eye`` past these walls."""
        reach = math.ceil(RANGE_M / CELL_M) + 1
        row, column = math.floor(eye.x_m / CELL_M), math.floor(eye.y_m / CELL_M)
        grown = self._covering((row - reach, column - reach), (row + reach + 1, column + reach + 1))
        side = np.arange(-reach, reach + 1)
        dx_m = ((side + row + 0.5) * CELL_M - eye.x_m)[:, None]
        dy_m = ((side + column + 0.5) * CELL_M - eye.y_m)[None, :]
        beam = np.floor(np.arctan2(dy_m, dx_m) / math.tau * BEAMS).astype(np.intp) % BEAMS
        seen = np.hypot(dx_m, dy_m) <= _ranges(eye, walls)[beam]
        cells = grown.cells.copy()
        i, j = row - reach - grown.first[0], column - reach - grown.first[1]
        cells[i : i + len(side), j : j + len(side)] |= seen
        return Explored(grown.first, cells)

    @property
    def area_m2(self) -> float:
        """How much ground was seen."""
        return float(self.cells.sum()) * CELL_M**2

    def rectangles_m(self) -> tuple[tuple[float, float, float, float], ...]:
        """The seen ground as rectangles (x from, y from, x to, y to), map frame: runs along y, joined along x."""
        done: list[tuple[int, int, int, int]] = []
        growing: dict[tuple[int, int], int] = {}  # a run's columns -> the row it began in
        for row, line in enumerate(np.vstack((self.cells, np.zeros((1, self.cells.shape[1]), dtype=np.bool_)))):
            edges = np.flatnonzero(np.diff(np.concatenate(([False], line, [False])).astype(np.int8)))
            runs = set(zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True))
            ended = [run for run in growing if run not in runs]
            done += ((growing.pop(run), run[0], row, run[1]) for run in ended)
            for run in runs:
                growing.setdefault(run, row)
        x, y = self.first
        return tuple(
            ((a + x) * CELL_M, (b + y) * CELL_M, (c + x) * CELL_M, (d + y) * CELL_M) for a, b, c, d in sorted(done)
        )

    def _covering(self, low: tuple[int, int], high: tuple[int, int]) -> Explored:
        """The same cells in an array that reaches from ``low`` to ``high`` at least."""
        if not self.cells.size:
            return Explored(low, np.zeros((high[0] - low[0], high[1] - low[1]), dtype=np.bool_))
        rows, columns = self.cells.shape
        before = [max(0, self.first[axis] - low[axis]) for axis in (0, 1)]
        after = [max(0, high[axis] - self.first[axis] - size) for axis, size in ((0, rows), (1, columns))]
        if not any(before + after):
            return self
        first = (self.first[0] - before[0], self.first[1] - before[1])
        return Explored(first, np.pad(self.cells, tuple(zip(before, after, strict=True))))


def _ranges(eye: Point, walls: tuple[Segment, ...]) -> NDArray[np.float64]:
    """How far each beam gets, shape (BEAMS,): beam i looks along the middle of its slice of the circle."""
    angles = (np.arange(BEAMS) + 0.5) / BEAMS * math.tau
    if not walls:
        return np.full(BEAMS, RANGE_M)
    ends = np.array([(w.start.x_m, w.start.y_m, w.end.x_m, w.end.y_m) for w in walls], dtype=np.float64)
    start = ends[:, :2] - (eye.x_m, eye.y_m)
    along = ends[:, 2:] - ends[:, :2]
    x, y = np.cos(angles)[:, None], np.sin(angles)[:, None]
    # Solve t * (x, y) = start + s * along for every beam and wall at once.
    across = x * along[:, 1] - y * along[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        distance = (start[:, 0] * along[:, 1] - start[:, 1] * along[:, 0]) / across
        share = (start[:, 0] * y - start[:, 1] * x) / across
    hit = (distance > 0) & (share >= 0) & (share <= 1)
    nearest: NDArray[np.float64] = np.where(hit, distance, RANGE_M).min(axis=1)
    return nearest.clip(max=RANGE_M)
