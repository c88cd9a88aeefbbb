"""A log-odds occupancy grid that grows with what is seen.

Cells lie on a fixed lattice: cell (column i, row j) covers ``[i, i + 1) x [j, j + 1)`` times the resolution in the map
frame, so growing never resamples. The inverse sensor model and the clamping, which lets the map forget, follow
Hornung et al., "OctoMap" (Autonomous Robots 34, 2013).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from robot.body import Scan
from robot.geometry import Point, Pose

HIT_LOG_ODDS = 0.85
MISS_LOG_ODDS = -0.4
MIN_LOG_ODDS = -2.0
MAX_LOG_ODDS = 3.5
OCCUPIED_LOG_ODDS = 0.5
# Without an echo a beam counts as free to this far before the greatest range: a wall just there may stay unheard.
NO_ECHO_MARGIN_M = 0.1
GRAZING = math.sin(math.radians(2.0))  # what is flatter is a gap between two surfaces, not one surface
RESERVE_CELLS = 100  # room left on every side whenever the array has to grow


@dataclass(frozen=True, slots=True)
class Window:
    """A rectangle of lattice cells: columns [left, right), rows [bottom, top)."""

    left: int
    bottom: int
    right: int
    top: int

    @property
    def shape(self) -> tuple[int, int]:
        return self.top - self.bottom, self.right - self.left

    def union(self, other: Window) -> Window:
        """The smallest window that holds both."""
        return Window(
            min(self.left, other.left),
            min(self.bottom, other.bottom),
            max(self.right, other.right),
            max(self.top, other.top),
        )

    def holds(self, other: Window) -> bool:
        """Whether ``other`` lies inside."""
        return self.union(other) == self

    def grown(self, cells: int) -> Window:
        """This window with ``cells`` more on every side."""
        return Window(self.left - cells, self.bottom - cells, self.right + cells, self.top + cells)


class OccupancyGrid:
    """What is free, occupied and unknown. Log-odds 0 is unknown; above :data:`OCCUPIED_LOG_ODDS` is occupied."""

    def __init__(self, resolution_m: float = 0.05) -> None:
        self.resolution_m = resolution_m
        self.known_cells = 0
        self._room = Window(-RESERVE_CELLS, -RESERVE_CELLS, RESERVE_CELLS, RESERVE_CELLS)
        self._cells: NDArray[np.float32] = np.zeros(self._room.shape, np.float32)
        self._window: Window | None = None

    @property
    def window(self) -> Window:
        """The cells that any beam has reached so far; one cell at the origin before the first scan."""
        return self._window or Window(0, 0, 1, 1)

    @property
    def log_odds(self) -> NDArray[np.float32]:
        """The cells of :attr:`window`, shape (rows, columns), row 0 at its bottom. A view: copy it to keep it."""
        return self._view(self.window)

    def cell_of(self, place: Point) -> tuple[int, int]:
        """Lattice (column, row) of the cell that holds ``place``."""
        return math.floor(place.x_m / self.resolution_m), math.floor(place.y_m / self.resolution_m)

    def window_around(self, place: Point, radius_m: float) -> Window:
        """The cells within ``radius_m`` of ``place`` in the maximum norm."""
        column, row = self.cell_of(place)
        return Window(column, row, column + 1, row + 1).grown(math.ceil(radius_m / self.resolution_m))

    def at(self, place: Point) -> float:
        """Log-odds at ``place``; 0 where nothing is known."""
        column, row = self.cell_of(place)
        return float(self.cells(Window(column, row, column + 1, row + 1))[0, 0])

    def cells(self, window: Window) -> NDArray[np.float32]:
        """A copy of the log-odds in any window, zero beyond what is known; shape ``window.shape``."""
        found: NDArray[np.float32] = np.zeros(window.shape, np.float32)
        room = self._room
        left, right = max(window.left, room.left), min(window.right, room.right)
        bottom, top = max(window.bottom, room.bottom), min(window.top, room.top)
        if left < right and bottom < top:
            target = found[bottom - window.bottom : top - window.bottom, left - window.left : right - window.left]
            target[:] = self._view(Window(left, bottom, right, top))
        return found

    def update(self, pose: Pose, scan: Scan) -> None:
        """Enter one scan taken at ``pose``: every cell changes at most once, and an echo outweighs passing beams."""
        echo = np.isfinite(scan.ranges_m) & (scan.ranges_m <= scan.max_range_m)
        reach_m = np.where(echo, scan.ranges_m, scan.max_range_m - NO_ECHO_MARGIN_M)
        patch = self.window_around(pose.point, scan.max_range_m + self.resolution_m)
        self._make_room(patch)
        bearings = scan.angles_rad + pose.yaw_rad
        directions = np.stack([np.cos(bearings), np.sin(bearings)])
        origin = np.array([[pose.x_m], [pose.y_m]])
        change: NDArray[np.float32] = np.zeros(patch.shape, np.float32)
        ends = origin + directions * reach_m
        # A beam counts as free while it is a cell away from the surface it ends on: noise must not eat into walls, nor
        # must beams that graze along them.
        margin_m = np.where(echo, self.resolution_m / _incidence(directions, ends, echo), self.resolution_m)
        self._mark_free(change, patch, origin, directions, reach_m - margin_m)
        ends = ends[:, echo]
        change.ravel()[self._flat_cells(ends, patch)] = HIT_LOG_ODDS
        cells = self._view(patch)
        _spare_skimmed(change, cells, self._flat_cells(origin, patch)[0])
        known_before = np.count_nonzero(cells)
        np.clip(cells + change, MIN_LOG_ODDS, MAX_LOG_ODDS, out=cells)
        # Hits and misses could cancel to exactly 0, which stands for unknown: what was seen stays known.
        cells[(cells == 0.0) & (change != 0.0)] = 1e-6
        self.known_cells += int(np.count_nonzero(cells) - known_before)

    def _mark_free(
        self,
        change: NDArray[np.float32],
        patch: Window,
        origin: NDArray[np.float64],
        directions: NDArray[np.float64],
        clear_m: NDArray[np.float64],
    ) -> None:
        steps_m = np.arange(0.0, float(clear_m.max(initial=0.0)), self.resolution_m)
        passed = steps_m[None, :] < clear_m[:, None]
        beam, step = np.nonzero(passed)
        places = origin + directions[:, beam] * steps_m[step]
        change.ravel()[self._flat_cells(places, patch)] = MISS_LOG_ODDS

    def _flat_cells(self, places: NDArray[np.float64], patch: Window) -> NDArray[np.intp]:
        """Flat indices into an array over ``patch`` of the cells that hold ``places``, shape (2, n)."""
        # Shifted to be positive first: truncation is then floor, and much cheaper.
        columns = (places[0] / self.resolution_m - patch.left).astype(np.intp)
        rows = (places[1] / self.resolution_m - patch.bottom).astype(np.intp)
        flat: NDArray[np.intp] = rows * patch.shape[1] + columns
        return flat

    def _view(self, window: Window) -> NDArray[np.float32]:
        room = self._room
        return self._cells[
            window.bottom - room.bottom : window.top - room.bottom, window.left - room.left : window.right - room.left
        ]

    def _make_room(self, patch: Window) -> None:
        self._window = patch if self._window is None else self._window.union(patch)
        if self._room.holds(patch):
            return
        # Growing by half of the present size keeps the number of copies logarithmic in the size of the world.
        room = self._room.union(patch).grown(RESERVE_CELLS + max(self._room.shape) // 4)
        cells: NDArray[np.float32] = np.zeros(room.shape, np.float32)
        old = self._room
        cells[old.bottom - room.bottom : old.top - room.bottom, old.left - room.left : old.right - room.left] = (
            self._cells
        )
        self._room, self._cells = room, cells


def _spare_skimmed(change: NDArray[np.float32], cells: NDArray[np.float32], robot: int) -> None:
    """Take back the misses of occupied cells that beams did not pass on both sides, seen from the cell ``robot``.

    Beams that skim along a surface pass its cells on one side only: they say nothing about it.
    """
    row, column = np.nonzero((cells > OCCUPIED_LOG_ODDS) & (change < 0.0))
    away_rows, away_columns = row - robot // cells.shape[1], column - robot % cells.shape[1]
    farther = np.maximum(np.maximum(np.abs(away_rows), np.abs(away_columns)), 1)
    aside_rows = np.rint(-away_columns / farther).astype(np.intp)
    aside_columns = np.rint(away_rows / farther).astype(np.intp)
    both = (change[row + aside_rows, column + aside_columns] < 0.0) & (
        change[row - aside_rows, column - aside_columns] < 0.0
    )
    change[row[~both], column[~both]] = 0.0


def _incidence(
    directions: NDArray[np.float64], ends: NDArray[np.float64], echo: NDArray[np.bool_]
) -> NDArray[np.float64]:
    """Sine of the angle, shape (beams,), between each beam and the surface that it and its neighbours end on."""
    before, after = np.roll(ends, 1, axis=1), np.roll(ends, -1, axis=1)
    before, after = np.where(np.roll(echo, 1), before, ends), np.where(np.roll(echo, -1), after, ends)
    along = after - before
    length_m = np.hypot(along[0], along[1])
    across_m = np.abs(along[0] * directions[1] - along[1] * directions[0])
    sine: NDArray[np.float64] = np.where(length_m > 0.0, across_m / np.maximum(length_m, 1e-9), 1.0)
    return np.maximum(sine, GRAZING)
