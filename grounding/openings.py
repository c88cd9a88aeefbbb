"""Openings in walls: where a wall ends and, after the width of a door, another goes on or stands across."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

from robot.geometry import Point, Segment, wrap_angle

WIDTH_MIN_M, WIDTH_MAX_M = 0.6, 1.4
"""From what the robot fits through (0.31 m wide, with room to steer) to a double door."""

_IN_LINE_RAD = math.radians(15.0)
_ACROSS_RAD = math.radians(60.0)  # a wall that the gap runs into stands at least so much across it
_SAME_M = 0.4  # both faces of a wall show the same opening
_WALL_MIN_M = 0.25
_LONG_M = 2.0
_CLEAR_M = 0.15  # what a mapped wall's end may be off
_WAY_M = 0.45  # clear way before and behind an opening


@dataclass(frozen=True, slots=True)
class Gap:
    """``is_in_wall`` says that a long wall goes on behind it, so that it is hardly the space between two things."""

    line: Segment
    is_in_wall: bool


def gaps(walls: tuple[Segment, ...]) -> tuple[Gap, ...]:
    """Every gap through which one can go straight, each once. Things that stand in a room make some too."""
    solid = tuple(wall for wall in walls if wall.length_m >= _WALL_MIN_M)
    found = sorted((*_in_line(solid), *_to_side(solid)), key=lambda gap: (not gap.is_in_wall, gap.line.length_m))
    kept: list[Gap] = []
    for gap in found:
        if not any(_same(gap.line, other.line) for other in kept) and _is_clear(gap.line, walls):
            kept.append(gap)
    return tuple(kept)


def _is_clear(gap: Segment, walls: tuple[Segment, ...]) -> bool:
    """Nothing stands in it, nor right before or behind it."""
    inner = Segment(gap.start.moved(_CLEAR_M, gap.direction_rad), gap.end.moved(-_CLEAR_M, gap.direction_rad))
    before, behind = sides(gap, _WAY_M)
    way = Segment(before, behind)
    return not any(meeting(line, wall) for wall in walls for line in (inner, way))


def sides(gap: Segment, away_m: float) -> tuple[Point, Point]:
    """The places so far before and behind its middle."""
    across_rad = gap.direction_rad + math.pi / 2
    return gap.midpoint.moved(-away_m, across_rad), gap.midpoint.moved(away_m, across_rad)


def _ends(wall: Segment) -> tuple[tuple[Point, float], tuple[Point, float]]:
    """Each end, and the way on from there."""
    return (wall.start, wrap_angle(wall.direction_rad + math.pi)), (wall.end, wall.direction_rad)


def _in_line(walls: tuple[Segment, ...]) -> Iterator[Gap]:
    """Between two ends that look at each other."""
    for first, second in combinations(walls, 2):
        for here, onward_rad in _ends(first):
            for there, backward_rad in _ends(second):
                way_rad = here.bearing_to(there)
                faces = abs(wrap_angle(way_rad - onward_rad)) <= _IN_LINE_RAD
                is_faced = abs(wrap_angle(way_rad + math.pi - backward_rad)) <= _IN_LINE_RAD
                if faces and is_faced and WIDTH_MIN_M <= here.distance_to(there) <= WIDTH_MAX_M:
                    yield Gap(Segment(here, there), first.length_m + second.length_m >= _LONG_M)


def _to_side(walls: tuple[Segment, ...]) -> Iterator[Gap]:
    """From an end straight on to a wall that stands across."""
    for wall in walls:
        for here, onward_rad in _ends(wall):
            for other in walls:
                turn_rad = abs(math.sin(other.direction_rad - onward_rad))
                if other is wall or turn_rad < math.sin(_ACROSS_RAD):
                    continue
                far = Segment(here.moved(WIDTH_MIN_M, onward_rad), here.moved(WIDTH_MAX_M, onward_rad))
                met = meeting(far, other)
                if met is not None:
                    yield Gap(Segment(here, met), False)


def meeting(a: Segment, b: Segment) -> Point | None:
    """Where two segments cross; None where they do not."""
    ax, ay = a.end.x_m - a.start.x_m, a.end.y_m - a.start.y_m
    bx, by = b.end.x_m - b.start.x_m, b.end.y_m - b.start.y_m
    across = ax * by - ay * bx
    if abs(across) < 1e-12:
        return None
    dx, dy = b.start.x_m - a.start.x_m, b.start.y_m - a.start.y_m
    along_a, along_b = (dx * by - dy * bx) / across, (dx * ay - dy * ax) / across
    if not (0.0 <= along_a <= 1.0 and 0.0 <= along_b <= 1.0):
        return None
    return Point(a.start.x_m + along_a * ax, a.start.y_m + along_a * ay)


def _same(a: Segment, b: Segment) -> bool:
    turned_rad = abs(math.sin(a.direction_rad - b.direction_rad))
    return a.midpoint.distance_to(b.midpoint) <= _SAME_M and turned_rad < math.sin(_IN_LINE_RAD * 2)
