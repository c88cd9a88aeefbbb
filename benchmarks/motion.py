"""How exactly the robot drives a metre ahead and turns in place, noise on.

Each trial is a fresh robot with noise of its own, somewhere in the world with room ahead: it is told to go forward by
one metre and then to turn by a random angle. Errors are those of where it truly stands and looks at rest, against where
it was told to.
"""

from __future__ import annotations

import math
import random
import statistics
from collections.abc import Sequence

from robot.geometry import Pose, wrap_angle
from robot.messages import GoForward, Side, Turn, encode_command

from ._course import Course
from ._drive import driver, progress, world

AHEAD_M = 1.0
LIMIT_S = 60.0


def run(trials: int = 100, name: str = "apartment", seed: int = 1) -> dict[str, float]:
    """Errors in metres and degrees over all trials, and how many stay within 2 cm and 1 degree."""
    chance = random.Random(seed)
    course = Course(world(name), chance)
    places: list[float] = []
    headings: list[float] = []
    turns: list[float] = []
    for number in range(trials):
        place_m, heading_deg, turn_deg = _trial(course, name, chance, seed * 1000 + number)
        places.append(place_m)
        headings.append(heading_deg)
        turns.append(turn_deg)
        progress(f"trial {number + 1}: {place_m:.4f} m, {heading_deg:.2f} degrees; turn {turn_deg:.2f} degrees")
    return {
        "trials": trials,
        **_figures("forward_error_m", places),
        **_figures("forward_error_deg", headings),
        **_figures("turn_error_deg", turns),
        "forward_within": statistics.fmean(p <= 0.02 and h <= 1.0 for p, h in zip(places, headings, strict=True)),
        "turn_within": statistics.fmean(turn <= 1.0 for turn in turns),
    }


def _trial(course: Course, name: str, chance: random.Random, seed: int) -> tuple[float, float, float]:
    start = course.with_room_ahead(AHEAD_M)
    turn = Turn(chance.choice(list(Side)), float(chance.randint(10, 360)))
    with driver(world(name), start=start, seed=seed) as drive:
        drive.send(encode_command(GoForward(AHEAD_M)), LIMIT_S)
        there = drive.body.truth()
        drive.send(encode_command(turn), LIMIT_S)
        turned = drive.body.truth()
    asked_deg = turn.angle_deg if turn.side is Side.LEFT else -turn.angle_deg
    goal = start.ahead(AHEAD_M)
    return (
        there.point.distance_to(goal.point),
        _off_deg(there, goal),
        _off_deg(turned, goal.turned(math.radians(asked_deg))),
    )


def _off_deg(there: Pose, goal: Pose) -> float:
    return math.degrees(abs(wrap_angle(there.yaw_rad - goal.yaw_rad)))


def _figures(key: str, errors: Sequence[float]) -> dict[str, float]:
    return {f"{key}_median": round(statistics.median(errors), 4), f"{key}_max": round(max(errors), 4)}
