"""What it costs to drive where: the occupancy grid, inflated by the robot's radius, graded further out.

The layout is Nav2's (Macenski et al., "The Marathon 2", IROS 2020): cells nearer to an obstacle than the robot's radius
are forbidden, beyond it the cost falls off exponentially, and unknown space may be crossed at a surcharge.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from robot.geometry import Point
from robot.mapping.grid import OCCUPIED_LOG_ODDS, OccupancyGrid

FORBIDDEN = -1.0  # what scikit-image's MCP takes as impassable
MARGIN_M = 0.03  # on top of the robot's radius: half a cell of the grid's rounding
NEAR_COST = 0.3
NEAR_FALLOFF_M = 0.03  # steep: enough to keep clear of the shield, too little to make wide curves
UNKNOWN_COST = 0.1
ESCAPE_COST = 20.0
ESCAPE_RADIUS_M = 0.4
FAR_M = 30.0  # a place farther than this from all that is known is left off the map
SAMPLES_MAX = 4_000
BORDER_M = 1.2  # of unknown space around everything known, so that the outside can be tried


@dataclass(frozen=True, slots=True)
class Costmap:
    """Cost per cell, shape (rows, columns), row 0 at the bottom; a metre of free space costs one metre.

    ``distances_m`` is each cell's distance to the nearest occupied one; ``seen`` says where anything is known.
    ``left_m`` and ``bottom_m`` are the map coordinates of the lower left corner.
    """

    left_m: float
    bottom_m: float
    resolution_m: float
    costs: NDArray[np.float64]
    distances_m: NDArray[np.float32]
    seen: NDArray[np.bool_]

    def cell_of(self, place: Point) -> tuple[int, int]:
        """(row, column) of the cell that holds ``place``, which must lie on the map."""
        return (
            math.floor((place.y_m - self.bottom_m) / self.resolution_m),
            math.floor((place.x_m - self.left_m) / self.resolution_m),
        )

    def place_of(self, row: int, column: int) -> Point:
        """The centre of a cell."""
        return Point(self.left_m + (column + 0.5) * self.resolution_m, self.bottom_m + (row + 0.5) * self.resolution_m)

    def holds(self, place: Point) -> bool:
        """Whether ``place`` is on the map."""
        row, column = self.cell_of(place)
        rows, columns = self.costs.shape
        return bool(0 <= row < rows and 0 <= column < columns)

    def edge_towards(self, start: Point, goal: Point) -> Point:
        """Where the straight line from ``start``, on the map, to ``goal``, off it, leaves the map: a cell inside."""
        rows, columns = self.costs.shape
        shares = [1.0]
        for here, there, first, count in (
            (start.x_m, goal.x_m, self.left_m, columns),
            (start.y_m, goal.y_m, self.bottom_m, rows),
        ):
            edge = first + self.resolution_m * (count - 1 if there > here else 1)
            if there != here:
                shares.append(max((edge - here) / (there - here), 0.0))
        return start.moved(min(shares) * start.distance_to(goal), start.bearing_to(goal))

    def is_free(self, place: Point) -> bool:
        """Whether the robot's centre may be at ``place``."""
        return bool(self.costs[self.cell_of(place)] >= 0.0)

    def line_cost(self, start: Point, end: Point) -> float:
        """The cost of the straight way, in metres of free space; inf when it crosses forbidden cells.

        Beyond its edges the map goes on as it is there.
        """
        length_m = start.distance_to(end)
        count = min(max(2, math.ceil(length_m / self.resolution_m * 2.0) + 1), SAMPLES_MAX)
        along = np.linspace(0.0, 1.0, count)
        columns = (start.x_m - self.left_m + along * (end.x_m - start.x_m)) / self.resolution_m
        rows = (start.y_m - self.bottom_m + along * (end.y_m - start.y_m)) / self.resolution_m
        rows = np.clip(rows, 0, self.costs.shape[0] - 1)
        columns = np.clip(columns, 0, self.costs.shape[1] - 1)
        costs = self.costs[rows.astype(np.intp), columns.astype(np.intp)]
        return math.inf if float(costs.min()) < 0.0 else float(costs.mean()) * length_m


def build_costmap(grid: OccupancyGrid, start: Point, places: tuple[Point, ...], radius_m: float) -> Costmap:
    """The costmap over all that is known and those of ``places`` that are not far from it.

    The robot, of ``radius_m``, stands at ``start``.
    """
    window = grid.window.union(grid.window_around(start, 0.0))
    farthest = window.grown(math.ceil(FAR_M / grid.resolution_m))
    for place in places:
        cell = grid.window_around(place, 0.0)
        if farthest.holds(cell):
            window = window.union(cell)
    window = window.grown(math.ceil(BORDER_M / grid.resolution_m))
    cells = grid.cells(window)
    distances_m = _distances(cells > OCCUPIED_LOG_ODDS, grid.resolution_m)
    left_m, bottom_m = window.left * grid.resolution_m, window.bottom * grid.resolution_m
    hard_m = radius_m + MARGIN_M
    costs = 1.0 + NEAR_COST * np.exp((hard_m - distances_m) / NEAR_FALLOFF_M, dtype=np.float32)
    seen = cells != 0.0
    costs[~seen] += UNKNOWN_COST
    costs[distances_m < hard_m] = FORBIDDEN
    costmap = Costmap(left_m, bottom_m, grid.resolution_m, costs.astype(np.float64), distances_m, seen)
    _open_around(costmap, start)
    return costmap


def _distances(occupied: NDArray[np.bool_], resolution_m: float) -> NDArray[np.float32]:
    if not occupied.any():
        return np.full(occupied.shape, 1e3, np.float32)
    cells = cv2.distanceTransform((~occupied).astype(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    return np.asarray(cells, np.float32) * np.float32(resolution_m)


def _open_around(costmap: Costmap, start: Point) -> None:
    """Let a robot that stands too near to something leave: outwards is allowed, at a price."""
    row, column = costmap.cell_of(start)
    if costmap.costs[row, column] >= 0.0:
        return
    reach = math.ceil(ESCAPE_RADIUS_M / costmap.resolution_m)
    rows = slice(max(row - reach, 0), row + reach + 1)
    columns = slice(max(column - reach, 0), column + reach + 1)
    distances, costs = costmap.distances_m[rows, columns], costmap.costs[rows, columns]
    outwards = distances >= costmap.distances_m[row, column] - costmap.resolution_m / 2.0
    costs[outwards & (costs < 0.0)] = ESCAPE_COST
    costmap.costs[row, column] = ESCAPE_COST
