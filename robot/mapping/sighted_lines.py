"""Straight surfaces in one scan as measurements: where each line runs seen from the robot, and how surely."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from robot.body import Scan

from .lines import MIN_LENGTH_M, beam_points, straight_runs

Floats = NDArray[np.float64]

RANGE_NOISE_M = 0.0105  # of one echo, one standard deviation: the scanner's 10 mm and a little for corners and paint
# What remains of the error however many echoes a line has: a surface is not quite straight, a beam not quite thin.
LEAST_OFFSET_M = 0.0005
LEAST_ANGLE_RAD = 0.0005
MIN_ECHOES = 6
# The outermost echoes of a piece may have met its corner; they turn the line by up to a third of a degree.
TRIMMED, TRIMMED_IF_SHORT = 2, 1
# Seen along its length a surface is a few echoes far apart, of which the corner's are the most.
MIN_SINE_OF_INCIDENCE = 0.3
# Of the echoes from the line, in standard deviations along the beam: more, and the surface is not one straight line.
MAX_RMS, MAX_RESIDUAL = 1.6, 3.5
# A surface ends where the next beam goes on for so much farther; how surely, whatever the beams' distance.
PAST_END_M = 0.06
LEAST_END_M = 0.005
FARTHEST_SHARE = 0.95  # of the scanner's reach: beyond, silence does not say that a beam went past
STRAY = 2.5  # an outermost echo so many standard deviations behind the line has missed it
# How far an end is from where the line is nearest to the robot, over that distance. At an end on the near side of that
# place the next surface may be seen around the corner and taken for this one (3 cm of it, on average); far on the other
# side the beams are too flat to tell.
MIN_FLATNESS, MAX_FLATNESS = 0.0, 2.0
# Anywhere between two beams is a variance of a twelfth of the square of their distance; noise moves them as well.
BETWEEN_BEAMS = 1 / 6


@dataclass(frozen=True, slots=True)
class SightedEnd:
    """Where a surface ends, along its line from the centre: between its last beam and the first that went past."""

    along_m: float
    variance_m2: float


@dataclass(frozen=True, slots=True)
class SightedLine:
    """A line in the body's frame, directed so that the robot is on its left.

    ``centre_m`` is the mean of its echoes, brought onto it: there the errors of offset and direction are independent.
    """

    centre_m: tuple[float, float]
    direction_rad: float
    first_m: float  # the outermost echoes, along the line from the centre
    last_m: float
    offset_variance_m2: float
    direction_variance_rad2: float
    ends: tuple[SightedEnd | None, SightedEnd | None]  # at the first and at the last; None where that is not seen


def sight_lines(scan: Scan) -> tuple[SightedLine, ...]:
    """The lines of ``scan`` that are worth measuring by, counter-clockwise."""
    sighted = (_sighted(scan, run) for run in straight_runs(scan) if len(run) >= MIN_ECHOES)
    return tuple(line for line in sighted if line is not None)


def _sighted(scan: Scan, run: NDArray[np.intp]) -> SightedLine | None:
    ends = beam_points(scan, run[[0, -1]])
    if math.dist(ends[0], ends[1]) < MIN_LENGTH_M:
        return None
    trimmed = TRIMMED if len(run) >= MIN_ECHOES + 2 * TRIMMED else TRIMMED_IF_SHORT
    points = beam_points(scan, run[trimmed:-trimmed])
    ranges_m = np.hypot(points[:, 0], points[:, 1])
    beams = points / ranges_m[:, None]
    normal, distance_m = _fitted(beams, ranges_m)
    residuals = (points @ normal + distance_m) / np.abs(beams @ normal) / RANGE_NOISE_M
    if math.sqrt(float(residuals @ residuals) / len(points)) > MAX_RMS or np.abs(residuals).max() > MAX_RESIDUAL:
        return None
    centre = points.mean(axis=0)
    centre -= normal * (centre @ normal + distance_m)
    sine = abs(float(centre @ normal)) / math.hypot(*centre.tolist())
    if sine < MIN_SINE_OF_INCIDENCE:
        return None
    along = np.array([normal[1], -normal[0]])
    along_m = (points - centre) @ along
    variance_m2 = (RANGE_NOISE_M * sine) ** 2
    offset_variance_m2 = variance_m2 / len(points) + LEAST_OFFSET_M**2
    middle_m = float(centre @ along)
    return SightedLine(
        (float(centre[0]), float(centre[1])),
        math.atan2(-normal[0], normal[1]),
        float(along_m.min()),
        float(along_m.max()),
        offset_variance_m2,
        variance_m2 / float(along_m @ along_m) + LEAST_ANGLE_RAD**2,
        (
            _end(scan, run[::-1], -1, normal, distance_m, middle_m, offset_variance_m2),
            _end(scan, run, 1, normal, distance_m, middle_m, offset_variance_m2),
        ),
    )


def _fitted(beams: Floats, ranges_m: Floats) -> tuple[Floats, float]:
    """The line's normal towards the robot and its distance, by least squares of the errors along the beams.

    A line is ``beam @ (a, b) = 1 / range``, linear in a and b, and the error of 1 / range is that of the range over its
    square.
    """
    weighted = beams * (ranges_m**2)[:, None]
    parameters, *_ = np.linalg.lstsq(weighted, ranges_m, rcond=None)
    distance_m = 1.0 / float(np.hypot(*parameters))
    return np.asarray(-parameters * distance_m, dtype=np.float64), distance_m


def _end(
    scan: Scan,
    run: NDArray[np.intp],
    onward: int,
    normal: Floats,
    distance_m: float,
    middle_m: float,
    offset_variance_m2: float,
) -> SightedEnd | None:
    """The end behind the last beam of ``run``, where the beams' numbers change by ``onward``."""
    outer = run[-3:]
    angles_rad = scan.angles_rad[outer]
    beams = np.column_stack([np.cos(angles_rad), np.sin(angles_rad)])
    reach_m = -distance_m / (beams @ normal)
    along_m = reach_m * (beams @ (normal[1], -normal[0])) - middle_m
    if (scan.ranges_m[outer[-1]] - reach_m[-1]) / RANGE_NOISE_M > STRAY:
        inner_m, outer_m = along_m[-2], along_m[-1]
    else:
        inner_m, outer_m = along_m[-1], 2 * along_m[-1] - along_m[-2]
        past_m = math.hypot(distance_m, middle_m + outer_m) + PAST_END_M
        beyond_m = scan.ranges_m[(outer[-1] + onward) % len(scan.ranges_m)]
        if beyond_m < past_m or past_m > FARTHEST_SHARE * scan.max_range_m:
            return None
    flatness = onward * (middle_m + outer_m) / distance_m
    if not MIN_FLATNESS <= flatness <= MAX_FLATNESS:
        return None
    variance_m2 = BETWEEN_BEAMS * (outer_m - inner_m) ** 2 + flatness**2 * offset_variance_m2 + LEAST_END_M**2
    return SightedEnd(float(inner_m + outer_m) / 2, float(variance_m2))
