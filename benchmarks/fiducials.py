"""How well markers are found, and where: random views of one, up to 2.5 m away and 60 degrees oblique.

Each view is a world of its own with a 10 cm marker of random id on a box before a wall, drawn by the simulated camera
with its noise. A marker's size in the image is that of its shorter side, projected by the pinhole's rule here.
"""

from __future__ import annotations

import math
import random
import statistics
from dataclasses import dataclass

from robot.fiducials import FiducialDetector
from robot.geometry import Pose, wrap_angle
from robot.pybullet_body import PybulletBody
from voxml.scene import Face, FiducialMount, Scene, SceneObject, Start, Wall

from ._drive import progress

SIDE_M = 0.10
NEAREST_M, FARTHEST_M = 0.4, 2.5
OBLIQUE_DEG = 60.0
LARGE_PX = 24.0
# The camera of the Waffle Pi: 62.2 degrees across 640 pixels, 7.6 cm ahead of the turning centre, 10.3 cm up.
FOCAL_PX = 320 / math.tan(math.radians(31.1))
CAMERA_AHEAD_M, CAMERA_UP_M = 0.076, 0.103


@dataclass(frozen=True, slots=True)
class View:
    """One picture: the shorter side of the marker in it, whether it was found, errors if so, and false ids."""

    shorter_px: float
    found: bool
    wrong: int
    error_m: float
    error_deg: float


def run(views: int = 500, seed: int = 1) -> dict[str, float]:
    """Shares found, wrong ids, and errors in metres and degrees over the markers found."""
    chance = random.Random(seed)
    seen = []
    for number in range(views):
        seen.append(_view(chance, seed * 10_000 + number))
        if (number + 1) % 50 == 0:
            progress(f"{number + 1} of {views} views")
    large = [view for view in seen if view.shorter_px >= LARGE_PX]
    found = [view for view in seen if view.found]
    return {
        "views": views,
        "found_share": round(len(found) / views, 4),
        "large_views": len(large),
        "large_found_share": round(statistics.fmean(view.found for view in large), 4),
        "wrong_ids": sum(view.wrong for view in seen),
        **_figures("error_m", [view.error_m for view in found]),
        **_figures("error_deg", [view.error_deg for view in found]),
    }


def _figures(key: str, errors: list[float]) -> dict[str, float]:
    tenths = statistics.quantiles(errors, n=10)
    return {
        f"{key}_median": round(statistics.median(errors), 4),
        f"{key}_p90": round(tenths[-1], 4),
        f"{key}_max": round(max(errors), 4),
    }


def _view(chance: random.Random, seed: int) -> View:
    number, pose, scene = _random_view(chance)
    body = PybulletBody(scene, start=pose, seed=seed)
    image, detector = body.image(), FiducialDetector(body.camera, SIDE_M)
    body.close()
    assert image is not None
    sightings = detector.detect(image)
    marker = scene.objects[0].marker
    assert marker is not None
    truth = Pose(marker.x_m, marker.y_m, marker.yaw_rad).relative_to(pose)
    right = [sighting for sighting in sightings if sighting.id == number]
    wrong = len(sightings) - len(right)
    if not right:
        return View(_shorter_px(truth, marker.z_m), False, wrong, math.nan, math.nan)
    error_m = math.dist(right[0].position_m, (truth.x_m, truth.y_m, marker.z_m))
    error_deg = math.degrees(abs(wrap_angle(right[0].yaw_rad - truth.yaw_rad)))
    return View(_shorter_px(truth, marker.z_m), True, wrong, error_m, error_deg)


def _random_view(chance: random.Random) -> tuple[int, Pose, Scene]:
    """A marker near the origin that looks along +x, and the robot before it, the marker well inside the picture."""
    number, up_m = chance.randrange(1000), chance.uniform(0.08, 0.2)
    away_m = chance.uniform(NEAREST_M, FARTHEST_M)
    oblique_rad = math.radians(chance.uniform(-OBLIQUE_DEG, OBLIQUE_DEG))
    aside_rad = chance.uniform(-1.0, 1.0) * math.radians(22)
    camera = Pose(0.0, 0.0, oblique_rad).ahead(away_m).turned(math.pi + aside_rad)
    box = SceneObject("box", "box", -0.1, 0.0, 0.0, (0.2, 0.2, 0.3), (), (), FiducialMount(number, up_m, Face.FRONT))
    scene = Scene("view", 1, Start(3.0, 0.0, math.pi), (Wall(-1.0, -4.0, -1.0, 4.0),), (box,), SIDE_M)
    return number, camera.ahead(-CAMERA_AHEAD_M), scene


def _shorter_px(marker: Pose, up_m: float) -> float:
    """The shortest of the marker's four sides in the picture; ``marker`` is its pose in the robot's frame."""
    corners = []
    for left_m, above_m in ((-1, 1), (1, 1), (1, -1), (-1, -1)):
        corner = marker.point.moved(left_m * SIDE_M / 2, marker.yaw_rad + math.pi / 2)
        ahead_m = corner.x_m - CAMERA_AHEAD_M
        up = up_m + above_m * SIDE_M / 2 - CAMERA_UP_M
        corners.append((FOCAL_PX * corner.y_m / ahead_m, FOCAL_PX * up / ahead_m))
    return min(math.dist(corners[n], corners[n - 1]) for n in range(4))
