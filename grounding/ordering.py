"""Ordinals and superlatives: which of the things that fit is the second from the left, the nearest, the other one."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from grammar.forms import Term

from .entities import NO_ROWS, Entity, Rows
from .outcomes import Reason, Unresolved
from .relations import REGIONS, distances_m, gap_m, local_m, meeting_key_m
from .world import World

ORDINALS = {
    name: rank
    for rank, name in enumerate(
        ("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth"), start=1
    )
}
_HERE_M = 0.6  # a thing this near is where the robot is, so it is not the next one

Keys = NDArray[np.float64]  # shape (rows,)


def _away_m(world: World, rows: Rows) -> Keys:
    return distances_m((world.robot.x_m, world.robot.y_m), world.entities.xy_m[rows])


def _from_left(world: World, rows: Rows) -> Keys:
    """Smaller is further left, as the robot sees it: by bearing, not by distance from its heading line."""
    local = local_m(world.robot, world.entities.xy_m[rows])
    return -np.arctan2(local[:, 1], local[:, 0])


def _met(world: World, rows: Rows) -> Keys:
    return meeting_key_m(world.robot, world.entities.xy_m[rows])


def _size(axis: int) -> Callable[[World, Rows], Keys]:
    return lambda world, rows: world.entities.size_m[rows, axis]


def _volume(world: World, rows: Rows) -> Keys:
    volume: Keys = np.prod(world.entities.size_m[rows], axis=1)
    return volume


def _opposite(key: Callable[[World, Rows], Keys]) -> Callable[[World, Rows], Keys]:
    return lambda world, rows: -key(world, rows)


EXTREMES: Mapping[str, Callable[[World, Rows], Keys]] = {
    "nearest": _away_m,
    "farthest": _opposite(_away_m),
    "leftmost": _from_left,
    "rightmost": _opposite(_from_left),
    "largest": _opposite(_volume),
    "smallest": _volume,
    "tallest": _opposite(_size(2)),
    "shortest": _size(2),
    "widest": _opposite(_size(1)),
    "narrowest": _size(1),
    "longest": _opposite(_size(0)),
}
"""Superlatives, each by a key of which the smallest is meant."""

_COUNTED_FROM: Mapping[str, Callable[[World, Rows], Keys]] = {
    "left": _from_left,
    "right": _opposite(_from_left),
    "end": _opposite(_met),
    "back": _opposite(_met),
}
_BY_DISTANCE = frozenset({"nearest", "farthest"})
_CHOICES = frozenset({"last", "next", "previous", "middle", "only", "other", "same"})
ORDERINGS = frozenset(ORDINALS) | frozenset(EXTREMES) | _CHOICES


def counted_from(modifier: Term) -> str | None:
    """Where counting begins in ``from(left)`` or ``from(the(end))``; None for any other modifier."""
    if modifier.pred != "from" or len(modifier.args) != 1:
        return None
    origin = modifier.args[0]
    while isinstance(origin, Term) and len(origin.args) == 1:
        origin = origin.args[0]
    return origin.pred if isinstance(origin, Term) and origin.pred in _COUNTED_FROM else None


def measured_from(ordering: str | None, modifier: Term) -> Term | None:
    """The landmark in "nearest to the door", "farthest from the wall"; None for the robot, and for other modifiers."""
    if ordering not in _BY_DISTANCE or modifier.pred not in ("to", "from") or len(modifier.args) != 1:
        return None
    (landmark,) = modifier.args
    return landmark if isinstance(landmark, Term) and landmark.pred not in REGIONS else None


@dataclass(frozen=True, slots=True)
class Choice:
    """What is picked of things that fit.

    ``origin`` is where counting begins (None: along the robot's way); ``landmarks`` are what "nearest" and "farthest"
    are measured from (none: the robot); ``count`` is how many are wanted (None: one).
    """

    ordering: str
    origin: str | None = None
    landmarks: tuple[Entity, ...] = ()
    count: int | None = None

    def key(self, world: World, rows: Rows) -> Keys:
        """The smallest are picked first."""
        if self.landmarks:
            gaps_m = np.array([gap_m(each, world.entities.xy_m[rows]) for each in self.landmarks])
            if self.ordering == "farthest":
                return np.asarray(-gaps_m.min(axis=0))
            return np.asarray(np.where(gaps_m > 0, gaps_m, np.inf).min(axis=0))  # nothing is nearest to itself
        counted = _COUNTED_FROM[self.origin] if self.origin else _met
        return EXTREMES.get(self.ordering, counted)(world, rows)


def pick(form: Term, choice: Choice, rows: Rows, world: World) -> Rows | Unresolved:
    """Those of ``rows`` that the ordering picks: as many as are wanted, or more where they are equally so, or none.

    ``form`` is the whole noun phrase.
    """
    ordering, origin = choice.ordering, choice.origin
    if choice.count is not None and ordering in _FROM_AN_END:
        return _several(form, choice, rows, world)
    if not len(rows):
        return rows if ordering not in ORDINALS else Unresolved(Reason.TOO_FEW, form, 0)
    if ordering in EXTREMES:
        key = choice.key(world, rows)
        return np.extract(key <= key.min() + 1e-6, rows)
    key = choice.key(world, rows)
    rank = ORDINALS.get(ordering)
    if rank is None:
        return _chosen(ordering, origin, key, rows, world)
    if rank > len(rows):
        return Unresolved(Reason.TOO_FEW, form, len(rows))
    return rows[np.argpartition(key, rank - 1)[[rank - 1]]]


_FROM_AN_END = frozenset(EXTREMES) | {"first", "last", "next"}


def _several(form: Term, choice: Choice, rows: Rows, world: World) -> Rows | Unresolved:
    """ "The first two", "the three nearest", "the last two": from an end of an order."""
    assert choice.count is not None
    if choice.count > len(rows):
        return Unresolved(Reason.TOO_FEW, form, len(rows))
    order = rows[np.argsort(choice.key(world, rows), kind="stable")]
    return order[-choice.count :] if choice.ordering == "last" else order[: choice.count]


def _chosen(ordering: str, origin: str | None, key: Keys, rows: Rows, world: World) -> Rows:
    ahead_m = local_m(world.robot, world.entities.xy_m[rows])[:, 0]
    match ordering:
        case "last" if origin is None and (ahead_m >= 0).any():
            # The last one ahead: what lies behind was passed already, unless there is nothing else.
            return rows[[np.argmax(np.where(ahead_m >= 0, key, -1.0))]]
        case "last":
            return rows[[np.argmax(key)]]
        case "next":
            coming = np.extract((ahead_m >= 0) & (_away_m(world, rows) > _HERE_M), rows)
            return coming[[np.argmin(_met(world, coming))]] if len(coming) else NO_ROWS
        case "previous":
            passed = np.extract((ahead_m < 0) & (_away_m(world, rows) > _HERE_M), rows)
            return passed[[np.argmin(_away_m(world, passed))]] if len(passed) else NO_ROWS
        case "middle":
            in_row = rows[np.argsort(_along_row(world, rows), kind="stable")]
            return in_row[(len(in_row) - 1) // 2 : len(in_row) // 2 + 1]
        case "other":
            return np.extract(rows != _focus_row(world), rows)
        case "same":
            return np.extract(rows == _focus_row(world), rows)
        case _:
            return rows


def _along_row(world: World, rows: Rows) -> Keys:
    """Places in a row of things, which may lie along the robot's way or across it."""
    local = local_m(world.robot, world.entities.xy_m[rows])
    along: Keys = local[:, int(np.ptp(local[:, 1]) > np.ptp(local[:, 0]))]
    return along


def _focus_row(world: World) -> int:
    return world.entities.index.get(world.focus[0], -1) if world.focus else -1
