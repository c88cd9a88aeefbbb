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
# The search knows eight directions, so its path is up to a twelfth too long: it is drawn straight afterwards.
PICKED = 24
SAMPLES_MAX = 500
CORNER_M = 0.01  # a corner counts as so much way: of equals the path with fewer corners
NOT_STRAIGHT_M = 0.05
TAUT_STEPS_M = (0.1, 0.05, 0.025)

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
    return Plan(_taut(costmap, _shortened(costmap, places, along)), cost * costmap.resolution_m)


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
    """Corners only: of evenly spread places on the path, the cheapest sequence joined by straight lines.

    Where even neighbours are not in sight of each other, all of the path between them is kept. ``along`` is the cost of
    the path up to each place.
    """
    last = len(places) - 1
    picked = np.unique(np.linspace(0, last, min(last + 1, PICKED)).round().astype(int)).tolist()
    lines = _line_costs(costmap, [places[number] for number in picked])
    best, before = [0.0], [0]
    for end in range(1, len(picked)):
        path_m = float(along[picked[end]] - along[picked[end - 1]])
        through = [best[start] + float(lines[start, end]) + CORNER_M for start in range(end)]
        through[-1] = min(through[-1], best[-1] + path_m + NOT_STRAIGHT_M)
        before.append(int(np.argmin(through)))
        best.append(through[before[-1]])
    corners, here = [places[-1]], len(picked) - 1
    while here > 0:
        start, end = picked[before[here]], picked[here]
        if not math.isfinite(lines[before[here], here]):
            corners.extend(reversed(places[start + 1 : end]))
        corners.append(places[start])
        here = before[here]
    return tuple(reversed(corners))


def _line_costs(costmap: Costmap, places: list[Point]) -> NDArray[np.float64]:
    """As :meth:`Costmap.line_cost` from every place to every later one, shape (places, places); inf elsewhere."""
    rows = np.array([(place.y_m - costmap.bottom_m) / costmap.resolution_m for place in places])
    columns = np.array([(place.x_m - costmap.left_m) / costmap.resolution_m for place in places])
    starts, ends = np.triu_indices(len(places), 1)
    cells = np.hypot(rows[ends] - rows[starts], columns[ends] - columns[starts])
    share = np.linspace(0.0, 1.0, min(math.ceil(float(cells.max(initial=0.0)) * 1.5) + 2, SAMPLES_MAX))[:, None]
    crossed = costmap.costs[
        (rows[starts] + share * (rows[ends] - rows[starts])).astype(np.intp),
        (columns[starts] + share * (columns[ends] - columns[starts])).astype(np.intp),
    ]
    found = np.full((len(places), len(places)), np.inf)
    found[starts, ends] = np.where(crossed.min(axis=0) < 0.0, np.inf, crossed.mean(axis=0) * cells)
    return found * costmap.resolution_m


def _taut(costmap: Costmap, path: tuple[Point, ...]) -> tuple[Point, ...]:
    """The path with its corners drawn across their neighbours' chord, by ever smaller steps, while that is cheaper."""
    places = list(path)
    for step_m in TAUT_STEPS_M:
        for corner in range(1, len(places) - 1):
            before, after = places[corner - 1], places[corner + 1]
            across = before.bearing_to(after) + math.pi / 2.0
            for sign in (1.0, -1.0):
                places[corner] = _drawn(costmap, before, places[corner], after, sign * step_m, across)
    return tuple(places)


def _drawn(costmap: Costmap, before: Point, corner: Point, after: Point, step_m: float, direction_rad: float) -> Point:
    cost_m = costmap.line_cost(before, corner) + costmap.line_cost(corner, after)
    while True:
        trial = corner.moved(step_m, direction_rad)
        trial_m = costmap.line_cost(before, trial) + costmap.line_cost(trial, after)
        if not trial_m < cost_m:
            return corner
        corner, cost_m = trial, trial_m
