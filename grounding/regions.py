"""Free space on a grid: walls drawn into cells, and the regions that they part."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from robot.geometry import Point, Segment

from .entities import Mask

CELL_M = 0.1
_MARGIN_CELLS = 5.5  # around the walls, so that what lies outside is one region; a wall runs through middles of cells
OUTSIDE = 0


@dataclass(frozen=True, slots=True)
class Grid:
    """Cells of `CELL_M` a side; row 0 and column 0 lie at the least y and x, whose corner is ``origin``."""

    origin: Point
    shape: tuple[int, int]

    @classmethod
    def around(cls, walls: tuple[Segment, ...]) -> Grid:
        """The grid that holds all of the walls, which there must be."""
        ends = np.array([(p.x_m, p.y_m) for wall in walls for p in (wall.start, wall.end)])
        low = ends.min(axis=0) - _MARGIN_CELLS * CELL_M
        columns, rows = np.ceil((ends.max(axis=0) - low) / CELL_M + _MARGIN_CELLS).astype(int)
        return cls(Point(float(low[0]), float(low[1])), (int(rows), int(columns)))

    def cells(self, xy_m: NDArray[np.float64]) -> NDArray[np.intp]:
        """Row and column of each place, shape (n, 2), cut off at the border."""
        columns_rows = np.floor((xy_m - (self.origin.x_m, self.origin.y_m)) / CELL_M).astype(np.intp)
        return np.clip(columns_rows[:, ::-1], 0, np.array(self.shape) - 1)

    def centers_m(self, cells: NDArray[np.intp]) -> NDArray[np.float64]:
        """Middles of cells given as rows and columns, shape (n, 2)."""
        return np.asarray((cells[:, ::-1] + 0.5) * CELL_M + (self.origin.x_m, self.origin.y_m), dtype=np.float64)

    def drawn(self, lines: tuple[Segment, ...]) -> Mask:
        """The cells that lines run through."""
        canvas = np.zeros(self.shape, dtype=np.bool_)
        if lines:
            rows, columns = self.cells(np.concatenate([sampled(line) for line in lines])).T
            canvas[rows, columns] = True
        return canvas


def sampled(line: Segment, step_m: float = CELL_M / 2) -> NDArray[np.float64]:
    """Places along a line, shape (n, 2)."""
    share = np.linspace(0.0, 1.0, max(2, math.ceil(line.length_m / step_m) + 1))[:, None]
    start, end = np.array([line.start.x_m, line.start.y_m]), np.array([line.end.x_m, line.end.y_m])
    return np.asarray(start + share * (end - start))


def thickened(cells: Mask) -> Mask:
    """With the eight neighbours of each: closes the slits that a mapped corner has."""
    padded = np.pad(cells, 1)
    rows, columns = cells.shape
    shifts = [padded[r : r + rows, c : c + columns] for r in range(3) for c in range(3)]
    return np.asarray(np.logical_or.reduce(shifts))


def labelled(free: Mask) -> NDArray[np.intp]:
    """Regions of 4-connected free cells, numbered from 1; `OUTSIDE` is what reaches the border, and what is not free.

    Every cell takes the greatest number in its row and column that no wall parts it from, until nothing changes.
    """
    numbers = np.where(free, np.arange(1, free.size + 1).reshape(free.shape), 0)
    while True:
        spread = numbers
        for turned in range(4):
            spread = np.rot90(_swept(np.rot90(spread, turned), np.rot90(free, turned)), -turned)
        if (spread == numbers).all():
            break
        numbers = spread
    border = np.concatenate([numbers[0], numbers[-1], numbers[:, 0], numbers[:, -1]])
    inside = np.where(np.isin(numbers, border), 0, numbers)
    kept, compact = np.unique(inside, return_inverse=True)
    return np.asarray(compact.reshape(free.shape) + (0 if kept[0] == 0 else 1), dtype=np.intp)


def _swept(numbers: NDArray[np.intp], free: Mask) -> NDArray[np.intp]:
    """Along each row, what was met since the last wall."""
    base = numbers.size + 1
    since_wall = np.cumsum(~free, axis=1) * base + numbers
    return np.asarray(np.where(free, np.maximum.accumulate(since_wall, axis=1) % base, 0))
