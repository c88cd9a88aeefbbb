"""The cheapest path over a costmap, shortened where a straight line costs no more."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from skimage.graph import MCP_Geometric

from robot.geometry import Point

from .costmap import FORBIDDEN, UNKNOWN_COST, Costmap
from .goals import Reason

GOAL_TOLERANCE_M = 0.3  # how far a goal inside an obstacle may be moved
BLOCKS_MAX = 120_000  # searched in one plan
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
    search = _Search(costmap, start)
    if not costmap.holds(goal):
        return search.plan_beyond(goal) or Reason.CUT_OFF
    if costmap.is_free(goal):
        return search.plan(goal) or Reason.CUT_OFF
    place = search.stand_in(goal)
    if place is None:
        return Reason.OCCUPIED
    found = search.plan(place)
    return Reason.CUT_OFF if found is None else replace(found, moved_to=place)


class _Search:
    """Dijkstra's search from one place, over blocks of cells where the map is large.

    A block costs what its cheapest cell does, and the path goes through that cell.
    """

    def __init__(self, costmap: Costmap, start: Point) -> None:
        self._costmap = costmap
        self._start = start
        rows, columns = costmap.costs.shape
        self._side = math.ceil(math.sqrt(rows * columns / BLOCKS_MAX))
        self._blocks = _cheapest(costmap.costs, self._side)
        self._mcp = MCP_Geometric(self._blocks)

    def plan(self, goal: Point) -> Plan | None:
        start, end = self._block_of(self._start), self._block_of(goal)
        costs, _ = self._mcp.find_costs([start], [end])
        if not math.isfinite(costs[end]):
            return None
        blocks = self._mcp.traceback(end)
        metres = self._costmap.resolution_m * self._side
        along = [float(costs[block]) * metres for block in blocks]
        between = [(self._place_of(block), cost) for block, cost in zip(blocks, along, strict=True)][1:-1]
        places = [self._start, *(place for place, _ in between), goal]
        path = _shortened(self._costmap, places, [0.0, *(cost for _, cost in between), along[-1]])
        return Plan(_taut(self._costmap, path), along[-1])

    def plan_beyond(self, goal: Point) -> Plan | None:
        """A way to a place off the map: to the map's edge in its direction, and straight on."""
        edge = self._costmap.edge_towards(self._start, goal)
        found = self.plan(edge)
        if found is None:
            return None
        return Plan((*found.path, goal), found.cost_m + edge.distance_to(goal) * (1.0 + UNKNOWN_COST))

    def stand_in(self, goal: Point) -> Point | None:
        """The reachable place nearest to ``goal``, within the tolerance; of equals the first in row order.

        It must have been seen: there is always some unknown ground behind a wall, and a goal in the wall is no reason
        to search for a way to its other side.
        """
        costmap, (row, column) = self._costmap, self._costmap.cell_of(goal)
        reach = math.ceil(GOAL_TOLERANCE_M / costmap.resolution_m)
        rows, columns = np.mgrid[row - reach : row + reach + 1, column - reach : column + reach + 1]
        costs, _ = self._mcp.find_costs([self._block_of(self._start)])
        open_cells = (costmap.costs[rows, columns] >= 0.0) & costmap.seen[rows, columns]
        reached = open_cells & np.isfinite(costs[rows // self._side, columns // self._side])
        away_m = np.where(reached, np.hypot(rows - row, columns - column) * costmap.resolution_m, np.inf)
        best = int(away_m.argmin())
        if away_m.flat[best] > GOAL_TOLERANCE_M:
            return None
        return costmap.place_of(int(rows.flat[best]), int(columns.flat[best]))

    def _block_of(self, place: Point) -> Cell:
        row, column = self._costmap.cell_of(place)
        return row // self._side, column // self._side

    def _place_of(self, block: Cell) -> Point:
        row, column = block[0] * self._side, block[1] * self._side
        cells = self._costmap.costs[row : row + self._side, column : column + self._side]
        best = int(np.where(cells < 0.0, np.inf, cells).argmin())
        return self._costmap.place_of(row + best // cells.shape[1], column + best % cells.shape[1])


def _cheapest(costs: NDArray[np.float64], side: int) -> NDArray[np.float64]:
    """The least cost in each block of ``side`` by ``side`` cells; forbidden where all of them are."""
    if side == 1:
        return costs
    rows, columns = costs.shape
    open_costs = np.where(costs < 0.0, np.inf, costs)
    padded = np.pad(open_costs, ((0, -rows % side), (0, -columns % side)), constant_values=np.inf)
    least = np.minimum.reduce([padded[i::side, j::side] for i in range(side) for j in range(side)])
    blocks: NDArray[np.float64] = np.where(np.isfinite(least), least, FORBIDDEN)
    return blocks


def _shortened(costmap: Costmap, places: list[Point], along: list[float]) -> tuple[Point, ...]:
    """Corners only: of evenly spread places on the path, the cheapest sequence joined by straight lines.

    Where even neighbours are not in sight of each other, all of the path between them is kept. ``along`` is the cost of
    the path up to each place.
    """
    last = len(places) - 1
    picked = np.unique(np.linspace(0, last, min(last + 1, PICKED)).round().astype(int)).tolist()
    lines = _line_costs(costmap, [places[number] for number in picked])
    best, before = [0.0], [0]
    for end in range(1, len(picked)):
        path_m = along[picked[end]] - along[picked[end - 1]]
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
