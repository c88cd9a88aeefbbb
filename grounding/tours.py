"""A good order in which to visit several things."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from robot.geometry import Point

from .entities import Entity

_PASSES_MAX = 50


def tour(start: Point, things: Sequence[Entity]) -> tuple[Entity, ...]:
    """The things in a short order from ``start``: always on to the nearest, then 2-opt (Croes 1958)."""
    left, order, here = list(things), [], start
    while left:
        nearest = min(left, key=lambda thing: here.distance_to(thing.point))
        left.remove(nearest)
        order.append(nearest)
        here = nearest.point
    for _ in range(_PASSES_MAX):
        better = _improved(start, order)
        if better is None:
            break
        order = better
    return tuple(order)


def _improved(start: Point, order: list[Entity]) -> list[Entity] | None:
    length_m = _length_m(start, order)
    for first in range(len(order) - 1):
        for last in range(first + 1, len(order)):
            turned = order[:first] + order[first : last + 1][::-1] + order[last + 1 :]
            if _length_m(start, turned) < length_m - 1e-9:
                return turned
    return None


def _length_m(start: Point, order: Sequence[Entity]) -> float:
    places = [start, *(thing.point for thing in order)]
    return sum(a.distance_to(b) for a, b in pairwise(places))
