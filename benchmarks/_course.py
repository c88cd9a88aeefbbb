"""Random starts and goals in a world; whether a goal can be reached is settled by the scene's geometry alone."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass

from robot.geometry import Point, Pose
from voxml.scene import Scene

from ._truth import ROBOT_RADIUS_M, solid_of
from ._ways import Ways, reach

EASY_M = 0.08  # a circle so much larger than the robot still gets to a goal that counts as reachable
TIGHT_M = 0.04  # and one so much smaller does not come near one that counts as unreachable
NEAR_M = 0.40  # the robot may take a place up to 0.3 m from a goal inside something; and a cell of its map
UNREACHABLE_SHARE = 1 / 3
SURVEY_M = 0.8  # between the places from which a known map is made
SURVEY_MISSES = 100  # places drawn in a row that were too near to another


@dataclass(frozen=True, slots=True)
class Task:
    """A goal, where it is asked for, and whether it can be reached."""

    start: Pose
    goal: Point
    reachable: bool


class Course:
    """Draws starts and goals in a scene; what can be reached is settled by geometry."""

    def __init__(self, scene: Scene, chance: random.Random) -> None:
        solid = solid_of(scene)
        self.ways = Ways(solid, ROBOT_RADIUS_M, solid.envelope)
        self._chance = chance
        home = Point(scene.start.x_m, scene.start.y_m)
        self._easy = reach(solid, home, ROBOT_RADIUS_M + EASY_M)
        self._possible = reach(solid, home, ROBOT_RADIUS_M - TIGHT_M)
        self._bounds = solid.bounds

    def anywhere(self) -> Pose:
        """A place from which everything reachable can be reached, facing any way."""
        while True:
            place = self._point()
            if self._easy(place) == 0.0:
                return Pose(place.x_m, place.y_m, self._chance.uniform(-math.pi, math.pi))

    def with_room_ahead(self, distance_m: float) -> Pose:
        """A pose from which the robot can drive straight ahead by ``distance_m`` with nothing near."""
        while True:
            pose = self.anywhere()
            if all(self._easy(pose.ahead(distance_m * part / 10).point) == 0.0 for part in range(11)):
                return pose

    def task(self, start: Pose) -> Task:
        """A goal that certainly can or certainly cannot be reached from ``start``."""
        reachable = self._chance.random() >= UNREACHABLE_SHARE
        while True:
            goal = self._point()
            if self._easy(goal) == 0.0 if reachable else self._possible(goal) > NEAR_M:
                return Task(start, goal, reachable)

    def places(self) -> list[Point]:
        """All over the free ground, no two nearer to each other than they need be to see everything."""
        places: list[Point] = []
        misses = 0
        while misses < SURVEY_MISSES:
            place = self.anywhere().point
            near = any(place.distance_to(other) < SURVEY_M for other in places)
            misses = misses + 1 if near else 0
            if not near:
                places.append(place)
        return places

    def _point(self) -> Point:
        left, bottom, right, top = self._bounds
        return Point(self._chance.uniform(left, right), self._chance.uniform(bottom, top))
