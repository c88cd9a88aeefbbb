"""Random goals in every world: reached, refused where there is no way, never a touch, and how long the way was.

Each goal is given to a fresh robot somewhere in a world. Half of them know the map (scans taken all over the world were
entered into it before), the other half have never seen the world. A goal counts as reachable when a circle a little
larger than the robot can be brought there, as unreachable when even one a little smaller cannot come near, by the
scene's geometry; goals in between are drawn anew. A third of the goals is drawn among places that cannot be reached:
inside things, beyond the walls, in closed rooms.

The length is the way truly driven, once over the shortest way for the robot's circle when everything is known, and with
the map unknown also over the way of the ideal explorer (:mod:`benchmarks._explorer`), which finds out as it goes; ways
under a metre are left out of both. What became of each goal is told on the error stream, one JSON object a line.
"""

from __future__ import annotations

import json
import math
import random
import statistics
from collections.abc import Sequence
from dataclasses import asdict, dataclass

import numpy as np

from robot.body import Scan
from robot.geometry import Pose
from robot.messages import FeedbackCode
from voxml.scene import Scene

from ._course import Course, Task
from ._drive import WITH_CAMERA, WORLDS, Trip, driver, progress, world
from ._explorer import explored_m
from ._truth import Faces, laser_scan

THERE_M = 0.10  # from the goal to where the robot truly stands when it says that it is there
SHORTEST_M = 1.0
LIMIT_S = 1800.0
SURVEY_SCANS = 4
SURVEY_PERIOD_S = 0.25
RATIO_MAX = 1.15
NO_WAY = {FeedbackCode.UNREACHABLE, FeedbackCode.STRAYED}


@dataclass(frozen=True, slots=True)
class Result:
    """What became of a goal. ``off_m`` is from the goal to where the robot truly ended.

    The shortest way and the ideal explorer's lead to that end; None where lengths are not compared.
    """

    world: str
    number: int
    known: bool
    reachable: bool
    right: bool
    codes: tuple[str, ...]
    start: tuple[float, float]
    goal: tuple[float, float]
    off_m: float
    seconds: float
    contacts: int
    driven_m: float
    shortest_m: float | None
    explored_m: float | None


def run(worlds: Sequence[str] = WORLDS, goals: int = 300, seed: int = 1) -> dict[str, float]:
    """Shares and counts over all goals; length ratios with the map known and unknown."""
    results: list[Result] = []
    for name in worlds:
        place = Place(world(name), seed)
        for number in range(goals // len(worlds)):
            results.append(place.attempt(number, known=number % 2 == 0))
            progress(json.dumps(asdict(results[-1])))
    return figures_of(results)


class Place:
    """One world, what is true of it, and its map for those who are to know it."""

    def __init__(self, scene: Scene, seed: int) -> None:
        self._scene = scene
        self._seed = seed
        self._faces = Faces.of(scene)
        self._views: list[tuple[Pose, Scan]] = []

    def attempt(self, number: int, known: bool) -> Result:
        """The goal of that number; its start, its place and the noise depend on nothing else."""
        course = Course(self._scene, random.Random(f"{self._scene.name} {self._seed} {number}"))
        task = course.task(course.anywhere())
        seed = self._seed * 1000 + number
        with driver(self._scene, start=task.start, seed=seed, camera=self._scene.name in WITH_CAMERA) as drive:
            if known:
                drive.robot.survey(self._views or self._look_around())
            begun = drive.body.truth()
            trip = drive.go_to(task.goal, LIMIT_S)
            here = drive.body.truth()
            contacts = len(drive.body.contacts())
        off_m = here.point.distance_to(task.goal)
        shortest_m = course.ways.length_m(begun.point, here.point) if task.reachable else math.inf
        counted = SHORTEST_M <= shortest_m < math.inf
        return Result(
            world=self._scene.name,
            number=number,
            known=known,
            reachable=task.reachable,
            right=_is_right(task, trip, off_m),
            codes=tuple(code.value for code in trip.codes),
            start=(round(task.start.x_m, 3), round(task.start.y_m, 3)),
            goal=(round(task.goal.x_m, 3), round(task.goal.y_m, 3)),
            off_m=round(off_m, 3),
            seconds=round(trip.seconds, 1),
            contacts=contacts,
            driven_m=round(trip.driven_m, 3),
            shortest_m=round(shortest_m, 3) if counted else None,
            explored_m=round(explored_m(self._faces, begun.point, here.point), 3) if counted and not known else None,
        )

    def _look_around(self) -> list[tuple[Pose, Scan]]:
        """Scans with the laser's noise from all over the world, and where they were truly taken."""
        noise = np.random.default_rng(self._scene.seed)
        places = Course(self._scene, random.Random(self._scene.name)).places()
        poses = [
            Pose(place.x_m, place.y_m, math.tau * turn / SURVEY_SCANS)
            for place in places
            for turn in range(SURVEY_SCANS)
        ]
        for number, pose in enumerate(poses):
            time_s = SURVEY_PERIOD_S * (number - len(poses))
            self._views.append((pose, laser_scan(self._faces, pose, noise, time_s)))
        return self._views


def _is_right(task: Task, trip: Trip, off_m: float) -> bool:
    if task.reachable:
        return FeedbackCode.SUCCESS_GO_TO in trip.codes and off_m <= THERE_M
    return bool(NO_WAY & set(trip.codes))


# ------------------------------------------------------------------ figures
def figures_of(results: Sequence[Result]) -> dict[str, float]:
    """Shares and counts over all, and over the known and the unknown half with their lengths."""
    figures: dict[str, float] = {"goals": len(results)} | _shares("", results)
    for key, known in (("known_", True), ("unknown_", False)):
        some = [result for result in results if result.known is known]
        driven = [result for result in some if result.right]
        figures |= _shares(key, some)
        figures |= _ratios(f"{key}driven_to_shortest", [(each.driven_m, each.shortest_m) for each in driven])
        figures |= _ratios(f"{key}driven_to_explorer", [(each.driven_m, each.explored_m) for each in driven])
        figures |= _ratios(f"{key}explorer_to_shortest", [(each.explored_m, each.shortest_m) for each in driven])
    return figures


def _shares(key: str, results: Sequence[Result]) -> dict[str, float]:
    reachable = [result for result in results if result.reachable]
    rest = [result for result in results if not result.reachable]
    return {
        f"{key}reachable": len(reachable),
        f"{key}reached_share": _share(reachable),
        f"{key}unreachable": len(rest),
        f"{key}reported_share": _share(rest),
        f"{key}reported_longest_s": max((each.seconds for each in rest), default=0.0),
        f"{key}contacts": sum(result.contacts for result in results),
    }


def _share(results: Sequence[Result]) -> float:
    return round(statistics.fmean(result.right for result in results), 4) if results else 1.0


def _ratios(key: str, pairs: Sequence[tuple[float | None, float | None]]) -> dict[str, float]:
    """Median, 95th percentile and greatest of the first over the second, where there are both."""
    ratios = sorted(way_m / than_m for way_m, than_m in pairs if way_m is not None and than_m is not None)
    if not ratios:
        return {}
    return {
        f"{key}_median": round(statistics.median(ratios), 3),
        f"{key}_p95": round(ratios[math.ceil(0.95 * len(ratios)) - 1], 3),
        f"{key}_max": round(ratios[-1], 3),
        f"{key}_within_1_15": round(statistics.fmean(ratio <= RATIO_MAX for ratio in ratios), 3),
    }
