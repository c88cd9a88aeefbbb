"""Where each person looks from: bird's-eye or with the robot's eyes, turned and drawn back by gesture, word or key."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from enum import Enum

from dialogue.events import CameraMove
from robot.geometry import Point, Pose

from .motion import Vector

TURN_RAD = math.radians(30)
BACK_MAX = 4
ELEVATION_RAD = math.radians(62)
ROBOT_EYE_M = (0.10, 0.22)  # ahead of the turning centre, above the floor
CHASE_M = (0.55, 0.28)  # each step back: behind, and up
MARGIN_M = 1.0  # also how much must be found before the picture is drawn back
RADIUS_MIN_M = 2.0


class View(Enum):
    """The two views of the paper's figure."""

    BIRDS_EYE = "bird's eye"
    ROBOT = "Kirby's view"


@dataclass(frozen=True, slots=True)
class Camera:
    """An eye and what it looks at, map frame with z up, metres."""

    position_m: Vector
    look_at_m: Vector


@dataclass(frozen=True, slots=True)
class Bounds:
    """A box on the floor that holds what is worth seeing, map frame."""

    low: Point
    high: Point

    @property
    def centre(self) -> Point:
        return Point((self.low.x_m + self.high.x_m) / 2, (self.low.y_m + self.high.y_m) / 2)

    def holds(self, place: Point) -> bool:
        """Whether a place lies within."""
        return self.low.x_m <= place.x_m <= self.high.x_m and self.low.y_m <= place.y_m <= self.high.y_m


@dataclass(frozen=True, slots=True)
class Viewpoint:
    """A view, how far it was turned (counter-clockwise), and how many steps it was drawn back."""

    view: View = View.BIRDS_EYE
    turned_rad: float = 0.0
    steps_back: int = 0

    @property
    def watching(self) -> bool:
        """Whether the robot's own picture belongs beside it."""
        return self.view is View.ROBOT

    def moved(self, move: CameraMove) -> Viewpoint:
        """After a push (the other view), a servo (turned or drawn back), or a word for a view."""
        match move:
            case CameraMove.BIRDS_EYE:
                return Viewpoint(View.BIRDS_EYE)
            case CameraMove.ROBOT_VIEW:
                return Viewpoint(View.ROBOT)
            case CameraMove.SWITCH_LEFT | CameraMove.SWITCH_RIGHT:
                return Viewpoint(View.ROBOT if self.view is View.BIRDS_EYE else View.BIRDS_EYE)
            case CameraMove.ROTATE_LEFT:
                return replace(self, turned_rad=self.turned_rad + TURN_RAD)
            case CameraMove.ROTATE_RIGHT:
                return replace(self, turned_rad=self.turned_rad - TURN_RAD)
            case CameraMove.BACK:
                return replace(self, steps_back=min(self.steps_back + 1, BACK_MAX))

    def camera(self, robot: Pose, bounds: Bounds, fov_rad: float, aspect: float) -> Camera:
        """The eye for this viewpoint; ``fov_rad`` is vertical, ``aspect`` the picture's width by its height."""
        if self.view is View.ROBOT:
            return self._with_the_robot(robot)
        return self._from_above(bounds, fov_rad, aspect)

    def _with_the_robot(self, robot: Pose) -> Camera:
        eye = robot.turned(self.turned_rad)
        ahead_m, height_m = ROBOT_EYE_M
        ahead_m -= self.steps_back * CHASE_M[0]
        height_m += self.steps_back * CHASE_M[1]
        seat, focus = eye.ahead(ahead_m), eye.ahead(ahead_m + 2.0)
        # A little downwards, so that the floor ahead fills the lower half.
        drop_m = 0.12 + 0.35 * self.steps_back
        return Camera((seat.x_m, seat.y_m, height_m), (focus.x_m, focus.y_m, height_m - drop_m))

    def _from_above(self, bounds: Bounds, fov_rad: float, aspect: float) -> Camera:
        """Just far enough to hold the bounds, and one fifth farther for each step back.

        The nearest edge, ``ahead_m`` before the centre, is what needs the room.
        """
        centre, half = bounds.centre, math.tan(fov_rad / 2)
        ahead_m, across_m = self._extents(bounds)
        reach_m = max(ahead_m * math.sin(ELEVATION_RAD) / half, across_m / (half * aspect), RADIUS_MIN_M)
        distance_m = (reach_m + ahead_m * math.cos(ELEVATION_RAD)) * 1.2**self.steps_back
        away = Pose(centre.x_m, centre.y_m, self.turned_rad).ahead(-distance_m * math.cos(ELEVATION_RAD))
        return Camera((away.x_m, away.y_m, distance_m * math.sin(ELEVATION_RAD)), (centre.x_m, centre.y_m, 0.0))

    def _extents(self, bounds: Bounds) -> tuple[float, float]:
        """Half of the bounds' extent along and across the looking direction."""
        half_x_m = (bounds.high.x_m - bounds.low.x_m) / 2
        half_y_m = (bounds.high.y_m - bounds.low.y_m) / 2
        c, s = abs(math.cos(self.turned_rad)), abs(math.sin(self.turned_rad))
        return half_x_m * c + half_y_m * s, half_x_m * s + half_y_m * c


def bounds_of(points: tuple[Point, ...]) -> Bounds:
    """What holds all these places with a margin; a few metres around the start when there are none."""
    xs = [point.x_m for point in points] or [0.0]
    ys = [point.y_m for point in points] or [0.0]
    return Bounds(
        Point(min(xs) - MARGIN_M, min(ys) - MARGIN_M),
        Point(max(xs) + MARGIN_M, max(ys) + MARGIN_M),
    )
