"""The cheapest path over a costmap, shortened where a straight line costs no more."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from skimage.graph import MCP_Geometric

from robot.geometry import Point

from .costmap import Costmap
from .goals import Reason

GOAL_TOLERANCE_M = 0.3  # how far a goal inside an obstacle may be moved
DETOUR = 1.001  # a straight line may cost this much more than the path it replaces: rounding

Cell = tuple[int, int]


@dataclass(frozen=True, slots=True)
class Plan:
    """A way from where the robot is to ``path[-1]``; ``moved_to`` is that place if it is not the one asked for."""

    path: tuple[Point, ...]
    cost_m: float
    moved_to: Point | None = None


def plan(costmap: Costmap, start: Point, goal: Point) -> Plan | Reason:
    """The cheapest way, or why there is none even through unknown space."""
    if costmap.is_free(goal):
        return _plan_to(costmap, start, goal, costmap.cell_of(goal)) or Reason.CUT_OFF
    cell = _stand_in(costmap, start, goal)
    if cell is None:
        return Reason.OCCUPIED
    place = costmap.place_of(*cell)
    found = _plan_to(costmap, start, place, cell)
    return Reason.CUT_OFF if found is None else Plan(found.path, found.cost_m, place)


def _plan_to(costmap: Costmap, start: Point, goal: Point, goal_cell: Cell) -> Plan | None:
    search = MCP_Geometric(costmap.costs)
    costs, _ = search.find_costs([costmap.cell_of(start)], [goal_cell])
    cost = float(costs[goal_cell])
    if not math.isfinite(cost):
        return None
    cells = search.traceback(goal_cell)
    places = [start, *(costmap.place_of(*cell) for cell in cells[1:-1]), goal]
    along = np.array([costs[cell] for cell in cells], np.float64) * costmap.resolution_m
    if len(places) > len(along):
        along = np.array([0.0, along[-1]])
    return Plan(_shortened(costmap, places, along), cost * costmap.resolution_m)


def _stand_in(costmap: Costmap, start: Point, goal: Point) -> Cell | None:
    """The cell nearest to ``goal``, within the tolerance, that can be reached; the first in row order of equals."""
    row, column = costmap.cell_of(goal)
    reach = math.ceil(GOAL_TOLERANCE_M / costmap.resolution_m)
    bottom, left = max(row - reach, 0), max(column - reach, 0)
    costs, _ = MCP_Geometric(costmap.costs).find_costs([costmap.cell_of(start)])
    near = costs[bottom : row + reach + 1, left : column + reach + 1]
    rows, columns = np.nonzero(np.isfinite(near))
    if not len(rows):
        return None
    away = np.hypot(rows + bottom - row, columns + left - column) * costmap.resolution_m
    best = int(away.argmin())
    return (int(rows[best]) + bottom, int(columns[best]) + left) if away[best] <= GOAL_TOLERANCE_M else None


def _shortened(costmap: Costmap, places: list[Point], along: NDArray[np.float64]) -> tuple[Point, ...]:
    """Corners only: from each, the farthest place that a straight line reaches at no more than the path's cost."""
    corners, here, last = [places[0]], 0, len(places) - 1
    while here < last:
        step = 1
        while here + step * 2 <= last and _straight(costmap, places, along, here, here + step * 2):
            step *= 2
        reached, beyond = here + step, min(last, here + 2 * step)
        while reached < beyond:
            middle = (reached + beyond + 1) // 2
            if _straight(costmap, places, along, here, middle):
                reached = middle
            else:
                beyond = middle - 1
        corners.append(places[reached])
        here = reached
    return tuple(corners)


def _straight(costmap: Costmap, places: list[Point], along: NDArray[np.float64], first: int, last: int) -> bool:
    limit_m = float(along[last] - along[first]) * DETOUR + costmap.resolution_m
    return costmap.line_cost(places[first], places[last]) <= limit_m
