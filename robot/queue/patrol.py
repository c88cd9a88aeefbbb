"""Where a patrol goes: concentric polygons about the place where it starts (the paper, section 3.1)."""

from __future__ import annotations

import math
from dataclasses import replace

from robot.geometry import Point
from robot.messages import PATROL_RADIUS_MAX_M, FeedbackCode, Patrol

from .state import Current


def vertex(current: Current) -> Point:
    """The place to visit now. Vertices go counter-clockwise, the first straight ahead of where the patrol starts."""
    patrol, centre = _patrol(current), current.goal.start
    direction_rad = centre.yaw_rad + math.tau * current.vertex / patrol.sides
    return centre.point.moved(_radius_m(current), direction_rad)


def after_vertex(current: Current, reached: bool) -> tuple[Current | None, tuple[tuple[FeedbackCode, str], ...]]:
    """The patrol after this vertex, with what there is to tell (code and detail); None when it is finished.

    It is finished when not one vertex of a loop could be reached, or when the next loop would leave the limits.
    """
    visited = current.reached + reached
    if current.vertex + 1 < _patrol(current).sides:
        return replace(current, vertex=current.vertex + 1, reached=visited), ()
    if visited == 0:
        return None, ()
    completed = (FeedbackCode.COMPLETED_LOOP, str(current.loop + 1))
    following = replace(current, loop=current.loop + 1, vertex=0, reached=0)
    if _radius_m(following) > PATROL_RADIUS_MAX_M:
        return None, (completed,)
    return following, (completed, (FeedbackCode.PLAN_LOOP, str(following.loop + 1)))


def _patrol(current: Current) -> Patrol:
    assert isinstance(current.goal.command, Patrol)
    return current.goal.command


def _radius_m(current: Current) -> float:
    return _patrol(current).radius_m + current.loop * _patrol(current).increment_m
