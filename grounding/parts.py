"""Parts of a thing or room as places: "the far end of the hallway", "this side of the table", "the middle of it"."""

from __future__ import annotations

import math

from grammar.forms import Term
from robot.geometry import Point, wrap_angle

from .descriptions import Description
from .entities import Entity
from .floor_plan import Room
from .places import goal_place
from .relations import COMPASS_RAD
from .world import World

_END = "end"
_CENTER = frozenset({"center", "middle"})
PARTS = frozenset({"side", "edge", "front", "back", _END}) | _CENTER
_FAR = frozenset({"far", "farthest", "other", "opposite"})
_NEAR = frozenset({"near", "nearest"})
_TURNED_RAD = {"front": 0.0, "left": math.pi / 2, "leftmost": math.pi / 2, "back": math.pi, "right": -math.pi / 2}
_TURNED_RAD["rightmost"] = _TURNED_RAD["right"]
"""Sides of a room in the robot's view."""

_SIDES = {
    "front": "projective.front",
    "back": "projective.back",
    "left": "projective.left",
    "leftmost": "projective.left",
    "right": "projective.right",
    "rightmost": "projective.right",
    **{name: f"cardinal.{name}" for name in COMPASS_RAD},
}
"""Sides of a thing, by the relations that have the same place."""


def whole_of(description: Description) -> Term | None:
    """The noun phrase of what a part belongs to: ``the(table)`` in ``the(left(side),of(the(table)))``, ``it`` in
    ``its(left(side))``.
    """
    if description.noun in PARTS and description.determiner == "its":
        return Term("it")
    wholes = (m.args[0] for m in description.modifiers if m.pred == "of" and len(m.args) == 1)
    whole = next(wholes, None) if description.noun in PARTS or description.ordering == "middle" else None
    return whole if isinstance(whole, Term) else None


def part_place(description: Description, whole: Entity, world: World) -> Point | None:
    """Where a part is: within a room, or beside a thing where the robot can stand. None for a part it has not.

    Left, right, near and far are seen from the robot; front and back of a thing are its own.
    """
    said = frozenset(filter(None, (*description.adjectives, description.ordering, description.noun)))
    if description.determiner == "this" and not said & _FAR:
        said |= {"near"}
    room = world.room_of(whole)
    if said & _CENTER:
        return whole.point if room is None else room.place.point
    return _beside(said, whole, world) if room is None else _within(said, room, world)


def _beside(said: frozenset[str], thing: Entity, world: World) -> Point | None:
    side = next((_SIDES[part] for part in said if part in _SIDES), None)
    if side is None:
        side = "projective.near" if said & _NEAR else "path.past" if said & (_FAR | {_END}) else None
    return None if side is None else goal_place(side, world, (thing,))


def _within(said: frozenset[str], room: Room, world: World) -> Point | None:
    """The side or end of a room: the nearer, the farther, or the one on that side."""
    robot, places = world.robot, room.ends if _END in said else room.sides
    if said & _NEAR:
        return min(places, key=robot.point.distance_to)
    turns = [robot.yaw_rad + _TURNED_RAD[part] for part in said if part in _TURNED_RAD]
    turns += [COMPASS_RAD[part] for part in said if part in COMPASS_RAD]
    if turns:
        return min(places, key=lambda place: abs(wrap_angle(room.middle.bearing_to(place) - turns[0])))
    return max(places, key=robot.point.distance_to) if said & (_FAR | {_END}) else None
