"""Where the robot believes it is against where it truly is, after 200 m of driving in each world.

A robot with the noise of its senses on is sent to one random place after another in a world that it does not know.
Errors are taken after every leg, at rest; the last is the one after the whole distance.
"""

from __future__ import annotations

import math
import random
from collections.abc import Sequence

from robot.geometry import wrap_angle

from ._course import Course
from ._drive import WITH_CAMERA, WORLDS, Driver, driver, progress, world

DISTANCE_M = 200.0
LEG_LIMIT_S = 600.0


def run(worlds: Sequence[str] = WORLDS, distance_m: float = DISTANCE_M, seed: int = 1) -> dict[str, float]:
    """Errors in metres and degrees: at the end in each world, and the worst of them."""
    figures: dict[str, float] = {"distance_m": distance_m}
    for name in worlds:
        figures |= {f"{name}_{key}": value for key, value in _drive(name, distance_m, seed).items()}
    for key in ("final_error_m", "final_error_deg", "largest_error_m", "largest_error_deg"):
        figures[f"worst_{key}"] = max(figures[f"{name}_{key}"] for name in worlds)
    return figures


def _drive(name: str, distance_m: float, seed: int) -> dict[str, float]:
    scene = world(name)
    course = Course(scene, random.Random(f"{name} {seed}"))
    errors: list[tuple[float, float]] = []
    with driver(scene, seed=seed, camera=name in WITH_CAMERA) as drive:
        while drive.driven_m < distance_m:
            drive.go_to(course.anywhere().point, LEG_LIMIT_S)
            errors.append(_error(drive))
            progress(f"{name}: {errors[-1][0]:.3f} m, {errors[-1][1]:.2f} degrees after {drive.driven_m:.0f} m")
        contacts = len(drive.body.contacts())
    return {
        "final_error_m": round(errors[-1][0], 4),
        "final_error_deg": round(errors[-1][1], 3),
        "largest_error_m": round(max(error_m for error_m, _ in errors), 4),
        "largest_error_deg": round(max(error_deg for _, error_deg in errors), 3),
        "contacts": float(contacts),
    }


def _error(drive: Driver) -> tuple[float, float]:
    """Metres and degrees."""
    believed, true = drive.robot.pose, drive.body.truth()
    off_deg = math.degrees(abs(wrap_angle(believed.yaw_rad - true.yaw_rad)))
    return believed.point.distance_to(true.point), off_deg
