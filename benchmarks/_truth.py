"""What is true of a world, for measuring against: its surfaces, and what a laser can see of them.

Computed from the scene alone, by shapely; nothing of the robot's own code takes part.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import Geometry, Polygon, affinity

from robot.body import Scan
from robot.geometry import Pose
from voxml.scene import Scene, Wall

Floats = NDArray[np.float64]

LASER_AHEAD_M = -0.064  # of the turning centre: the Waffle Pi's laser (ROBOTIS, turtlebot3_waffle_pi.urdf)
LASER_RANGE_M = 3.5
BEAMS_RAD = np.arange(360) * (math.tau / 360)
SAMPLE_M = 0.02
ROBOT_RADIUS_M = 0.24  # the circle around the turning centre that holds the whole Waffle Pi
_FACE_MIN_M = 0.2  # shorter edges are the ends of thin walls


def walls_of(scene: Scene) -> Geometry:
    """The ground that walls cover; they meet at corners."""
    return shapely.union_all([_wall(wall) for wall in scene.walls])


def things_of(scene: Scene) -> Geometry:
    """The ground that objects cover."""
    return shapely.union_all([_upright(o.x_m, o.y_m, o.yaw_rad, *o.size_m[:2]) for o in scene.objects])


def solid_of(scene: Scene) -> Geometry:
    """The ground that anything covers."""
    return walls_of(scene).union(things_of(scene))


def _wall(wall: Wall) -> Polygon:
    x_m, y_m = (wall.x1_m + wall.x2_m) / 2, (wall.y1_m + wall.y2_m) / 2
    return _upright(x_m, y_m, wall.direction_rad, wall.length_m + wall.thickness_m, wall.thickness_m)


def _upright(x_m: float, y_m: float, yaw_rad: float, length_m: float, width_m: float) -> Polygon:
    outline = shapely.box(-length_m / 2, -width_m / 2, length_m / 2, width_m / 2)
    return affinity.translate(affinity.rotate(outline, yaw_rad, origin=(0, 0), use_radians=True), x_m, y_m)


# ------------------------------------------------------------------ surfaces and what is seen of them
@dataclass(frozen=True, slots=True)
class Faces:
    """Straight surfaces, free space on their left: starts and ends of shape (faces, 2), and which are walls."""

    starts: Floats
    ends: Floats
    is_wall: NDArray[np.bool_]

    @staticmethod
    def of(scene: Scene) -> Faces:
        """Every face of the scene's walls and objects."""
        walls = walls_of(scene)
        edges = _edges(walls)
        things = _edges(things_of(scene).difference(walls))
        rows = np.array(edges + things)
        longer = np.hypot(rows[:, 2] - rows[:, 0], rows[:, 3] - rows[:, 1]) >= _FACE_MIN_M
        is_wall = (np.arange(len(rows)) < len(edges)) & longer
        return Faces(rows[:, :2], rows[:, 2:], is_wall)

    @property
    def lengths_m(self) -> Floats:
        return np.asarray(np.hypot(*(self.ends - self.starts).T))

    @property
    def directions_rad(self) -> Floats:
        along = self.ends - self.starts
        return np.asarray(np.arctan2(along[:, 1], along[:, 0]))

    def samples(self, face: int) -> Floats:
        """Places along a face, a sample apart, shape (samples, 2)."""
        count = max(1, round(float(self.lengths_m[face]) / SAMPLE_M))
        share = (np.arange(count)[:, None] + 0.5) / count
        return np.asarray(self.starts[face] + share * (self.ends[face] - self.starts[face]))


def _edges(ground: Geometry) -> list[tuple[float, float, float, float]]:
    """The straight edges around ``ground``, each with the free side on its left."""
    edges = []
    for part in shapely.get_parts(ground):
        outline = shapely.orient_polygons(part.simplify(1e-6), exterior_cw=True)
        for ring in (outline.exterior, *outline.interiors):
            edges += [(*a, *b) for a, b in itertools.pairwise(ring.coords)]
    return edges


class Seen:
    """Which stretches of the faces a laser of 360 beams has swept: between two neighbouring beams on the same face."""

    def __init__(self, faces: Faces) -> None:
        self._faces = faces
        self.swept = [np.zeros(len(faces.samples(face)), bool) for face in range(len(faces.starts))]
        self._last: Pose | None = None

    def look(self, robot: Pose) -> None:
        """Sweep the laser once with the robot truly at ``robot``; from where it just looked nothing is added."""
        if (
            self._last is not None
            and self._last.point.distance_to(robot.point) < SAMPLE_M / 2
            and (abs(math.remainder(self._last.yaw_rad - robot.yaw_rad, math.tau)) < math.radians(0.5))
        ):
            return
        self._last = robot
        face, share, _ = cast(self._faces, robot.ahead(LASER_AHEAD_M))
        for beam in np.flatnonzero((face == np.roll(face, -1)) & (face >= 0)).tolist():
            swept = self.swept[face[beam]]
            first, last = sorted((share[beam], share[(beam + 1) % len(share)]))
            swept[math.floor(first * len(swept)) : math.ceil(last * len(swept))] = True


def cast(faces: Faces, laser: Pose) -> tuple[NDArray[np.int64], Floats, Floats]:
    """The face that each beam meets first (-1 for none in range), where along it (0 to 1), and the range (or inf)."""
    angles = laser.yaw_rad + BEAMS_RAD
    direction = np.stack([np.cos(angles), np.sin(angles)])[:, :, None]
    origin = np.array([laser.x_m, laser.y_m])
    starts, along = faces.starts - origin, faces.ends - faces.starts
    near = np.flatnonzero(_distance_to(starts, along) <= LASER_RANGE_M)
    if not len(near):
        return np.full(len(angles), -1), np.zeros(len(angles)), np.full(len(angles), np.inf)
    starts, along = starts[near].T[:, None, :], along[near].T[:, None, :]
    with np.errstate(divide="ignore", invalid="ignore"):
        cross = direction[0] * along[1] - direction[1] * along[0]
        range_m = (starts[0] * along[1] - starts[1] * along[0]) / cross
        share = (starts[0] * direction[1] - starts[1] * direction[0]) / cross
    hit = (cross != 0) & (range_m > 0) & (range_m <= LASER_RANGE_M) & (share >= 0) & (share <= 1)
    range_m = np.where(hit, range_m, np.inf)
    beams, first = np.arange(len(angles)), range_m.argmin(axis=1)
    range_m = range_m[beams, first]
    found = np.isfinite(range_m)
    return np.where(found, near[first], -1), np.where(found, share[beams, first], 0.0), range_m


def laser_scan(faces: Faces, robot: Pose, noise: np.random.Generator, time_s: float) -> Scan:
    """What the laser would tell of the faces from ``robot``, in the body's frame, with its noise of a centimetre."""
    _, _, range_m = cast(faces, robot.ahead(LASER_AHEAD_M))
    echoes_m = np.where(np.isfinite(range_m), range_m + 0.01 * noise.standard_normal(len(range_m)), 0.0)
    x_m, y_m = LASER_AHEAD_M + echoes_m * np.cos(BEAMS_RAD), echoes_m * np.sin(BEAMS_RAD)
    heard = np.isfinite(range_m)
    angles_rad = np.where(heard, np.arctan2(y_m, x_m) % math.tau, BEAMS_RAD)
    return Scan(time_s, angles_rad, np.where(heard, np.hypot(x_m, y_m), np.inf), 0.12, LASER_RANGE_M)


def _distance_to(starts: Floats, along: Floats) -> Floats:
    """From the origin to segments, shape (n,)."""
    squared = np.maximum((along**2).sum(axis=1), 1e-12)
    share = np.clip(-(starts * along).sum(axis=1) / squared, 0.0, 1.0)
    return np.asarray(np.hypot(*(starts + share[:, None] * along).T))
