"""Marked points that the robot knows: their places on the floor are part of the joint estimate.

A camera tells the bearing of a marker to a pixel and its distance only by its size, which is read too small from afar
(2 % at 3 m, 11 % at 9 m): so the bearing counts for what it is, the distance for little, and far markers not at all.
Slopes are taken at first estimates, as those of lines.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from robot.geometry import Point, Pose, wrap_angle

from .gaussian import POSE, Block, Gaussian, Measurement

Floats = NDArray[np.float64]

NEAREST_M, FARTHEST_M = 0.1, 6.0
BEARING_RAD = 0.0006
ACROSS_M = 0.003  # of a marker's middle, however near it is
DISTANCE_SHARE = 0.1
# The squared Mahalanobis distance that two figures exceed once in a thousand times; so often in a row, it was moved.
ELSEWHERE = 13.8
TIMES_ELSEWHERE = 3
SEVERAL = 2


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


@dataclass(frozen=True, slots=True)
class _Reading:
    """A marker's distance and bearing from the camera; ``noise`` is their covariance, shape (2, 2)."""

    id: int
    distance_m: float
    bearing_rad: float
    noise: Floats


class PointLandmarks:
    """The markers met so far, as part of the joint estimate ``state``, whose first columns are the robot's pose."""

    def __init__(self, state: Gaussian) -> None:
        self._state = state
        self._landmarks: dict[int, _Landmark] = {}

    def contested(self, sighted: Iterable[SightedPoint], since: Pose, eye: Pose, expected: Pose) -> bool:
        """Whether most of several known markers are elsewhere, so that it is the robot that was moved.

        The arguments are those of :meth:`see`.
        """
        view = since.compose(eye)
        readings = [reading for point in sighted if (reading := _reading(point, eye)) is not None]
        known = [(self._landmarks[reading.id], reading) for reading in readings if reading.id in self._landmarks]
        elsewhere = [self._state.distance(self._measured(*each, view, expected)) > ELSEWHERE for each in known]
        return len(known) >= SEVERAL and sum(elsewhere) > len(known) / 2

    def see(self, sighted: Iterable[SightedPoint], since: Pose, eye: Pose, expected: Pose) -> None:
        """Correct the joint estimate by the markers of one image, and enter those not known.

        Args:
            since: where the robot was when it saw them, relative to the pose that is estimated.
            eye: the camera in the body's frame.
            expected: the pose before any correction: the first estimate of it.
        """
        view = since.compose(eye)
        for point in sighted:
            reading = _reading(point, eye)
            if reading is None:
                continue
            landmark = self._landmarks.get(reading.id)
            if landmark is not None and landmark.elsewhere >= TIMES_ELSEWHERE:
                self._state.forget(landmark.block)
                landmark = None
            if landmark is None:
                self._landmarks[reading.id] = self._enter(reading, view, expected)
            else:
                self._correct(landmark, reading, view, expected)

    def _correct(self, known: _Landmark, seen: _Reading, view: Pose, expected: Pose) -> None:
        measured = self._measured(known, seen, view, expected)
        if self._state.distance(measured) > ELSEWHERE:
            known.elsewhere += 1
        else:
            known.elsewhere = 0
            self._state.correct([measured])

    def _measured(self, known: _Landmark, seen: _Reading, view: Pose, expected: Pose) -> Measurement:
        camera = self._camera(view)
        to_marker = camera.to_local(Point(*self._state.mean[known.block.columns].tolist()))
        expected_rad = math.atan2(to_marker.y_m, to_marker.x_m)
        residual = np.array(
            [seen.distance_m - math.hypot(to_marker.x_m, to_marker.y_m), wrap_angle(seen.bearing_rad - expected_rad)]
        )
        arm = np.array([camera.x_m, camera.y_m]) - self._state.mean[:2]
        slopes = _slopes(np.array(known.first) - (expected.x_m, expected.y_m) - arm, arm)
        return Measurement([*POSE, *known.block.columns], slopes, residual, seen.noise)

    def _enter(self, seen: _Reading, view: Pose, expected: Pose) -> _Landmark:
        camera = self._camera(view)
        towards_rad = camera.yaw_rad + seen.bearing_rad
        place = camera.point.moved(seen.distance_m, towards_rad)
        slopes = np.array([[1.0, 0.0, expected.y_m - place.y_m], [0.0, 1.0, place.x_m - expected.x_m]])
        c, s = math.cos(towards_rad), math.sin(towards_rad)
        turn = np.array([[c, -s * seen.distance_m], [s, c * seen.distance_m]])
        at = (place.x_m, place.y_m)
        return _Landmark(self._state.grow(POSE, slopes, np.array(at), turn @ seen.noise @ turn.T), at)

    def _camera(self, view: Pose) -> Pose:
        return Pose(*self._state.mean[POSE].tolist()).compose(view)


def _reading(point: SightedPoint, eye: Pose) -> _Reading | None:
    """What the camera at ``eye`` (body frame) makes of a marker; None where that is too little, or no number."""
    seen = eye.to_local(point.place)
    distance_m = math.hypot(seen.x_m, seen.y_m)
    if not (NEAREST_M <= distance_m <= FARTHEST_M and math.isfinite(point.distance_deviation_m)):
        return None
    far_m2 = point.distance_deviation_m**2 + (DISTANCE_SHARE * distance_m) ** 2
    aside_rad2 = BEARING_RAD**2 + (ACROSS_M / distance_m) ** 2
    return _Reading(point.id, distance_m, math.atan2(seen.y_m, seen.x_m), np.diag([far_m2, aside_rad2]))


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
