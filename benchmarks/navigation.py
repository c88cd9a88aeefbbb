"""Random goals in every world: reached, refused where there is no way, never a touch, and how long the way was.

Half of the goals are given to a robot that knows the map (scans taken all over the world were entered into it before),
one after another; the other half each to a fresh robot somewhere in a world it has never seen. A goal counts as
reachable when a circle a little larger than the robot can be brought there, as unreachable when even one a little
smaller cannot come near, by the scene's geometry; goals in between are drawn anew. A third of the goals is drawn among
places that cannot be reached: inside things, beyond the walls, in closed rooms. The length is the way truly driven,
over the shortest way for the robot's circle when everything is known; ways under a metre are left out of it.
"""

from __future__ import annotations

import math
import random
import statistics
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from robot.geometry import Pose
from robot.mapping import Mapper
from robot.messages import FeedbackCode
from voxml.scene import Scene

from ._course import Course, Task
from ._drive import WORLDS, Driver, driver, progress, world
from ._truth import Faces, laser_scan

THERE_M = 0.10  # from the goal to where the robot truly stands when it says that it is there
SHORTEST_M = 1.0
LIMIT_S = 900.0
SURVEY_SCANS = 4
NO_WAY = {FeedbackCode.UNREACHABLE, FeedbackCode.STRAYED}


@dataclass(frozen=True, slots=True)
class Result:
    """What became of a goal; ``ratio`` is the way driven over the shortest, None where it is not counted."""

    task: Task
    known: bool
    right: bool
    seconds: float
    ratio: float | None
    contacts: int


def run(worlds: Sequence[str] = WORLDS, goals: int = 300, seed: int = 1) -> dict[str, float]:
    """Shares and counts over all goals; length ratios with the map known and unknown."""
    results: list[Result] = []
    for name in worlds:
        results += in_world(name, goals // len(worlds), seed)
    figures: dict[str, float] = {"goals": len(results)}
    figures |= _shares("", results)
    for key, known in (("known_", True), ("unknown_", False)):
        some = [result for result in results if result.known is known]
        figures |= _shares(key, some) | _ratios(key, some)
    return figures


def in_world(name: str, goals: int, seed: int) -> list[Result]:
    """Half of the goals with the map known, half without."""
    scene = world(name)
    course = Course(scene, random.Random(f"{name} {seed}"))
    results = _with_map(scene, course, goals - goals // 2)
    for number in range(goals // 2):
        task = course.task(course.anywhere())
        with driver(scene, start=task.start, seed=seed * 1000 + number) as drive:
            results.append(_try(drive, course, task, known=False))
        _report(name, results[-1])
    return results


def _with_map(scene: Scene, course: Course, goals: int) -> list[Result]:
    results: list[Result] = []
    with driver(scene) as drive:
        survey(drive.robot.mapper, scene, course)
        for _ in range(goals):
            task = course.task(drive.body.truth())
            result = _try(drive, course, task, known=True)
            results.append(result)
            _report(scene.name, result)
    return results


def _try(drive: Driver, course: Course, task: Task, known: bool) -> Result:
    before = len(drive.body.contacts())
    begun = drive.body.truth()
    trip = drive.go_to(task.goal, LIMIT_S)
    here = drive.body.truth()
    off_m = here.point.distance_to(task.goal)
    if task.reachable:
        right = FeedbackCode.SUCCESS_GO_TO in trip.codes and off_m <= THERE_M
    else:
        right = bool(NO_WAY & set(trip.codes))
    ratio = None
    if task.reachable and right:
        shortest_m = course.ways.length_m(begun.point, here.point)
        ratio = trip.driven_m / shortest_m if SHORTEST_M <= shortest_m < math.inf else None
    return Result(task, known, right, trip.seconds, ratio, len(drive.body.contacts()) - before)


def survey(mapper: Mapper, scene: Scene, course: Course) -> None:
    """Make the map known: scans with the laser's noise from all over the world, entered where they were truly taken."""
    noise = np.random.default_rng(scene.seed)
    faces = Faces.of(scene)
    places = course.places()
    time_s = -0.25 * SURVEY_SCANS * len(places)
    for place in places:
        for turn in range(SURVEY_SCANS):
            pose = Pose(place.x_m, place.y_m, turn * math.tau / SURVEY_SCANS)
            mapper.update(pose, laser_scan(faces, pose, noise, time_s))
            time_s += 0.25


# ------------------------------------------------------------------ figures
def _shares(key: str, results: Sequence[Result]) -> dict[str, float]:
    reachable = [result for result in results if result.task.reachable]
    rest = [result for result in results if not result.task.reachable]
    return {
        f"{key}reachable": len(reachable),
        f"{key}reached_share": _share(reachable),
        f"{key}unreachable": len(rest),
        f"{key}reported_share": _share(rest),
        f"{key}reported_longest_s": round(max((each.seconds for each in rest), default=0.0), 1),
        f"{key}contacts": sum(result.contacts for result in results),
    }


def _share(results: Sequence[Result]) -> float:
    return round(statistics.fmean(result.right for result in results), 4) if results else 1.0


def _ratios(key: str, results: Sequence[Result]) -> dict[str, float]:
    ratios = sorted(result.ratio for result in results if result.ratio is not None)
    if not ratios:
        return {}
    return {
        f"{key}length_ratio_median": round(statistics.median(ratios), 3),
        f"{key}length_ratio_p95": round(ratios[math.ceil(0.95 * len(ratios)) - 1], 3),
        f"{key}length_ratio_max": round(ratios[-1], 3),
    }


def _report(name: str, result: Result) -> None:
    task = result.task
    outcome = ("reached" if task.reachable else "reported") if result.right else "WRONG"
    ratio = "" if result.ratio is None else f", {result.ratio:.3f} of the shortest way"
    touch = f", {result.contacts} TOUCHED" if result.contacts else ""
    progress(
        f"{name} {'known' if result.known else 'unknown'} ({task.start.x_m:.2f}, {task.start.y_m:.2f}) to "
        f"({task.goal.x_m:.2f}, {task.goal.y_m:.2f}): {outcome} in {result.seconds:.0f} s{ratio}{touch}"
    )
