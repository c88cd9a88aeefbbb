"""Patrols: concentric polygons around the place where they start (section 3.1 of the paper), as a pure state machine."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import Enum

from robot.geometry import Point, Pose


class Mark(Enum):
    """What a patrol says between waypoints; the names are the bridge's feedback codes."""

    PLAN_LOOP = "planning the next loop"
    COMPLETED_LOOP = "completed a loop"
    FINISH_PATROL = "no more explorable waypoints"


PatrolStep = Point | Mark


@dataclass(frozen=True, slots=True)
class PatrolState:
    """How far a patrol is. The first vertex of every loop lies straight ahead, the others follow counter-clockwise.

    ``vertex`` is the next one to try, None before the loop is announced. ``visited`` counts those of this loop that were
    reached.
    """

    centre: Pose
    sides: int
    radius_m: float
    increment_m: float
    loop: int = 0
    vertex: int | None = None
    visited: int = 0

    def place(self, vertex: int) -> Point:
        """A corner of the present loop, map frame."""
        radius_m = self.radius_m + self.loop * self.increment_m
        return self.centre.point.moved(radius_m, self.centre.yaw_rad + vertex * math.tau / self.sides)

    def arrived(self) -> PatrolState:
        """The waypoint that :meth:`next` last gave was reached. (If it was not, simply go on.)"""
        return replace(self, visited=self.visited + 1)

    def next(self, explorable: Callable[[Point], bool]) -> tuple[PatrolState, PatrolStep]:
        """What comes next: a waypoint to go to, or something to say.

        ``explorable`` tells of a place whether the map leaves a way to it. A loop of which no waypoint was reached ends
        the patrol, since the loops around it lie farther out still.
        """
        if self.vertex is None:
            return replace(self, vertex=0), Mark.PLAN_LOOP
        for vertex in range(self.vertex, self.sides):
            if explorable(self.place(vertex)):
                return replace(self, vertex=vertex + 1), self.place(vertex)
        if not self.visited:
            return replace(self, vertex=self.sides), Mark.FINISH_PATROL
        return replace(self, loop=self.loop + 1, vertex=None, visited=0), Mark.COMPLETED_LOOP
