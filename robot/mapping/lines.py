"""Line segments from one scan: break at gaps, split and merge, fit.

Breakpoints follow Borges and Aldon, "Line extraction in 2D range images for mobile robotics" (Journal of Intelligent
and Robotic Systems 40, 2004); splitting is Ramer's and Douglas-Peucker's. All in the body's frame.
"""

from __future__ import annotations

import itertools
import math

import numpy as np
from numpy.typing import NDArray

from robot.body import Scan
from robot.geometry import Point, Segment

GRAZING_RAD = math.radians(8.0)  # the flattest incidence at which two neighbouring echoes still join
GAP_NOISE_M = 0.08
SPLIT_M = 0.045  # about three standard deviations of the LDS-01's range noise
MIN_POINTS = 6
MIN_LENGTH_M = 0.15
MAX_RMS_M = 0.025

Floats = NDArray[np.float64]


def beam_points(scan: Scan, beams: NDArray[np.intp]) -> Floats:
    """Where these beams of ``scan`` met something, body frame; shape (beams, 2), metres."""
    ranges_m, angles_rad = scan.ranges_m[beams], scan.angles_rad[beams]
    return np.column_stack([ranges_m * np.cos(angles_rad), ranges_m * np.sin(angles_rad)])


def echo_points(scan: Scan) -> Floats:
    """All echoes of ``scan``, as :func:`beam_points`, in the beams' order."""
    return beam_points(scan, _echoes(scan))


def _echoes(scan: Scan) -> NDArray[np.intp]:
    """The beams that met something."""
    return np.flatnonzero(np.isfinite(scan.ranges_m) & (scan.ranges_m <= scan.max_range_m))


def extract_segments(scan: Scan) -> tuple[Segment, ...]:
    """Straight pieces of wall in ``scan``, body frame, each directed so that the robot is on its left.

    The beams must be in counter-clockwise order.
    """
    return tuple(s for s in (_fit(beam_points(scan, run)) for run in straight_runs(scan)) if s is not None)


def straight_runs(scan: Scan) -> list[NDArray[np.intp]]:
    """Beams whose echoes lie along one line, by their places in the scan; each run counter-clockwise."""
    echo = _echoes(scan)
    if len(echo) < MIN_POINTS:
        return []
    points = beam_points(scan, echo)
    breaks = _breaks(points, scan.ranges_m[echo], scan.angles_rad[echo])
    # Start behind a gap, so that a wall across the first beam stays whole; all around closed, in the farthest corner.
    first = int(breaks[0]) if len(breaks) else int(scan.ranges_m[echo].argmax())
    points, echo = np.roll(points, -first, axis=0), np.roll(echo, -first)
    bounds = [0, *(breaks[1:] - first).tolist(), len(points)]
    pieces = [piece for first, end in itertools.pairwise(bounds) for piece in _split(points, first, end)]
    return [echo[first:end] for first, end in _join(points, pieces)]


def _breaks(points: Floats, ranges_m: Floats, angles_rad: Floats) -> NDArray[np.intp]:
    """Indices of points that do not join the point before them (around the circle)."""
    step_m = np.hypot(*(points - np.roll(points, 1, axis=0)).T)
    turn_rad = np.abs(np.remainder(angles_rad - np.roll(angles_rad, 1) + math.pi, math.tau) - math.pi)
    nearest_m = np.minimum(ranges_m, np.roll(ranges_m, 1))
    usable = turn_rad < GRAZING_RAD * 0.75
    allowed_m = nearest_m * np.sin(turn_rad) / np.sin(np.maximum(GRAZING_RAD - turn_rad, 0.01)) + GAP_NOISE_M
    return np.flatnonzero(~usable | (step_m > allowed_m))


def _split(points: Floats, first: int, end: int) -> list[tuple[int, int]]:
    """Ranges [first, end) of points that lie along straight chords, in order."""
    done: list[tuple[int, int]] = []
    waiting = [(first, end)]
    while waiting:
        first, end = waiting.pop()
        if end - first < MIN_POINTS:
            continue
        corner = _farthest(points[first:end])
        if corner is None:
            done.append((first, end))
        else:
            waiting.append((first + corner, end))
            waiting.append((first, first + corner + 1))
    return done


def _farthest(points: Floats) -> int | None:
    """Index of the point farthest from the chord, if it is farther than the noise allows."""
    x0, y0 = points[0].tolist()
    x1, y1 = points[-1].tolist()
    chord_m = math.hypot(x1 - x0, y1 - y0)
    if chord_m < 1e-6:
        return len(points) // 2
    offset = np.abs((points[:, 0] - x0) * ((y1 - y0) / chord_m) - (points[:, 1] - y0) * ((x1 - x0) / chord_m))
    corner = int(offset.argmax())
    return corner if offset[corner] > SPLIT_M and 0 < corner < len(points) - 1 else None


def _join(points: Floats, pieces: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """Neighbouring pieces that are straight together become one again: noise splits some at random places."""
    joined: list[tuple[int, int]] = []
    for first, end in pieces:
        if joined and first - joined[-1][1] in (-1, 0) and _rms(points[joined[-1][0] : end]) < MAX_RMS_M * 0.6:
            joined[-1] = (joined[-1][0], end)
        else:
            joined.append((first, end))
    return joined


def _line(points: Floats) -> tuple[Floats, float, float]:
    """Centroid, direction (radians, half circle) and rms offset of the total-least-squares line."""
    centre = points.mean(axis=0)
    dx, dy = (points - centre).T
    sxx, sxy, syy = float(dx @ dx), float(dx @ dy), float(dy @ dy)
    spread = math.hypot(sxx - syy, 2.0 * sxy)
    smallest = max((sxx + syy - spread) / 2.0, 0.0)
    return centre, 0.5 * math.atan2(2.0 * sxy, sxx - syy), math.sqrt(smallest / len(points))


def _rms(points: Floats) -> float:
    return _line(points)[2]


def _fit(points: Floats) -> Segment | None:
    # The points at the ends may belong to the corner's other side.
    core = points[1:-1] if len(points) >= MIN_POINTS + 2 else points
    centre, direction, rms_m = _line(core)
    along = (points[[0, -1]] - centre) @ np.array([math.cos(direction), math.sin(direction)])
    start, end = along.tolist()
    if rms_m > MAX_RMS_M or abs(end - start) < MIN_LENGTH_M:
        return None
    middle = Point(float(centre[0]), float(centre[1]))
    return Segment(middle.moved(start, direction), middle.moved(end, direction))
