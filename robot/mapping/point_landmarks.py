"""Marked points that the robot knows: their places on the floor are part of the joint estimate.

A camera tells the bearing of a marker to a pixel and its distance only by its size, which is read too small from afar
(2 % at 3 m, 11 % at 9 m): so the bearing counts for what it is, the distance for little, and far markers not at all.
Slopes are taken at first estimates, as those of lines.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from robot.geometry import Point, Pose, wrap_angle

from .gaussian import Block, Gaussian, Measurement
from .line_landmarks import POSE

Floats = NDArray[np.float64]

FARTHEST_M = 6.0
BEARING_RAD = 0.0006
ACROSS_M = 0.003  # of a marker's middle, however near it is
DISTANCE_SHARE = 0.1
# The squared Mahalanobis distance that two figures exceed once in a thousand times; so often in a row, it was moved.
ELSEWHERE = 13.8
TIMES_ELSEWHERE = 3


@dataclass(frozen=True, slots=True)
class SightedPoint:
    """A marker's middle in the body's frame; the deviation of its distance is one standard deviation."""

    id: int
    place: Point
    distance_deviation_m: float


@dataclass(slots=True, eq=False)
class _Landmark:
    block: Block  # x and y
    first: tuple[float, float]  # as first estimated
    elsewhere: int = 0


class PointLandmarks:
    """The markers met so far, as part of the joint estimate ``state``, whose first columns are the robot's pose."""

    def __init__(self, state: Gaussian) -> None:
        self._state = state
        self._landmarks: dict[int, _Landmark] = {}

    def see(self, sighted: SightedPoint, since: Pose, eye: Pose, expected: Pose) -> None:
        """Correct the joint estimate by one marker, or enter it.

        Args:
            since: where the robot was when it saw it, relative to the pose that is estimated.
            eye: the camera in the body's frame.
            expected: the pose before any correction: the first estimate of it.
        """
        view = since.compose(eye)
        seen = view.to_local(since.to_map(sighted.place))
        distance_m, bearing_rad = math.hypot(seen.x_m, seen.y_m), math.atan2(seen.y_m, seen.x_m)
        if distance_m > FARTHEST_M:
            return
        noise = np.diag(
            [
                sighted.distance_deviation_m**2 + (DISTANCE_SHARE * distance_m) ** 2,
                BEARING_RAD**2 + (ACROSS_M / distance_m) ** 2,
            ]
        )
        known = self._landmarks.get(sighted.id)
        if known is not None and known.elsewhere >= TIMES_ELSEWHERE:
            self._state.forget(known.block)
            known = None
        if known is None:
            self._landmarks[sighted.id] = self._enter(distance_m, bearing_rad, noise, view, expected)
        else:
            self._correct(known, np.array([distance_m, bearing_rad]), noise, view, expected)

    def _correct(self, known: _Landmark, seen: Floats, noise: Floats, view: Pose, expected: Pose) -> None:
        x_m, y_m, yaw_rad = self._state.mean[:3].tolist()
        arm = np.array(_turned(view, yaw_rad))  # from the robot to its camera, map frame
        place = self._state.mean[known.block.columns]
        ahead_m, left_m = (place - (x_m, y_m) - arm).tolist()
        bearing_rad = math.atan2(left_m, ahead_m) - yaw_rad - view.yaw_rad
        residual = np.array([seen[0] - math.hypot(ahead_m, left_m), wrap_angle(seen[1] - bearing_rad)])
        slopes = _slopes(np.array(known.first) - (expected.x_m, expected.y_m) - arm, arm)
        measured = Measurement([*POSE, *known.block.columns], slopes, residual, noise)
        if self._state.distance(measured) > ELSEWHERE:
            known.elsewhere += 1
        else:
            known.elsewhere = 0
            self._state.correct([measured])

    def _enter(self, distance_m: float, bearing_rad: float, noise: Floats, view: Pose, expected: Pose) -> _Landmark:
        x_m, y_m, yaw_rad = self._state.mean[:3].tolist()
        ahead_m, left_m = _turned(view, yaw_rad)
        towards_rad = yaw_rad + view.yaw_rad + bearing_rad
        c, s = math.cos(towards_rad), math.sin(towards_rad)
        place = (x_m + ahead_m + distance_m * c, y_m + left_m + distance_m * s)
        slopes = np.array([[1.0, 0.0, expected.y_m - place[1]], [0.0, 1.0, place[0] - expected.x_m]])
        turn = np.array([[c, -s * distance_m], [s, c * distance_m]])
        return _Landmark(self._state.grow(POSE, slopes, np.array(place), turn @ noise @ turn.T), place)


def _slopes(towards: Floats, arm: Floats) -> Floats:
    """How distance and bearing change with the robot's x, y and yaw and the marker's x and y; shape (2, 5).

    Args:
        towards: from the camera to the marker, map frame.
        arm: from the robot to the camera, map frame.
    """
    distance_m = float(np.hypot(*towards))
    beam = towards / distance_m
    by_place = np.array([beam, [-beam[1] / distance_m, beam[0] / distance_m]])
    by_yaw = by_place @ np.array([arm[1], -arm[0]]) - (0.0, 1.0)
    return np.column_stack([-by_place, by_yaw, by_place])


def _turned(view: Pose, yaw_rad: float) -> tuple[float, float]:
    c, s = math.cos(yaw_rad), math.sin(yaw_rad)
    return c * view.x_m - s * view.y_m, s * view.x_m + c * view.y_m
