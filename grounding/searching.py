"""Where to look for what a noun names: among the things that were seen, or among the places that the map shows."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from robot.geometry import Pose, wrap_angle

from .descriptions import DEFINITE, EXCLUDING, Description
from .entities import Entities, Entity
from .floor_plan import ROOM, ROOMS, FloorPlan, Room
from .map_places import CORNER, OPENINGS, WALL, Walls, corners, doorways, walls_in_sight
from .relations import meeting_key_m
from .world import World

_BEYOND_M = 0.8  # behind a doorway, where a room begins that was not seen yet
_PLACES: Mapping[str, Callable[[Walls, Pose], tuple[Entity, ...]]] = {
    **dict.fromkeys(OPENINGS, doorways),
    CORNER: corners,
    WALL: walls_in_sight,
}


def searched(description: Description, world: World) -> tuple[Description, World]:
    """The world that holds what the noun may name, and what of the description is still to be looked at in it.

    What was seen or taught as of that kind comes before what the map shows.
    """
    noun = description.noun
    if (noun not in ROOMS and noun not in _PLACES) or noun in world.entities.rows_by_type:
        return description, world
    plan = world.floor_plan
    if plan is None:
        return description, world
    if noun in ROOMS:
        return _rooms(description, world, plan)
    found = _PLACES[noun](world.walls, world.robot)
    if noun == WALL and _is_bare(description):
        found = _ahead(found, world.robot)
    return description, _only(world, noun, found)


def _is_bare(description: Description) -> bool:
    """ "The room", "this wall": the one that the situation tells."""
    said_more = description.ordering or description.modifiers or description.adjectives or description.pointings
    return not said_more and not description.plural and description.determiner in DEFINITE | {"this"}


def _ahead(walls: tuple[Entity, ...], robot: Pose) -> tuple[Entity, ...]:
    """ "The wall" is the one that the robot faces."""
    return tuple(sorted(walls, key=lambda w: abs(wrap_angle(robot.point.bearing_to(w.point) - robot.yaw_rad))))[:1]


# ------------------------------------------------------------------ rooms
def _rooms(description: Description, world: World, plan: FloorPlan) -> tuple[Description, World]:
    """ "The room" is where the robot is; "the next" and "the other room" lie behind a doorway of it."""
    noun, here = description.noun, plan.room_at(world.robot.point)
    if here is not None and _is_bare(description) and noun in (ROOM, here.place.type):
        return description, _only(world, noun, (here.place,))
    if description.ordering in ("next", "nearest", "other") or description.determiner in EXCLUDING:
        beyond = _beyond(world, plan, here)
        chosen = beyond if description.ordering == "other" else beyond[:1]
        return replace(description, ordering=None, determiner="the"), _only(world, noun, chosen)
    return description, _only(world, noun, tuple(r.place for r in plan.rooms if r.place.type == noun))


def _beyond(world: World, plan: FloorPlan, here: Room | None) -> tuple[Entity, ...]:
    """What lies behind the doorways of a room, in the order in which the robot would meet these."""
    ways = plan.doorways if here is None else plan.doorways_of(here)
    order = np.argsort(meeting_key_m(world.robot, Entities(ways).xy_m), kind="stable")
    found: dict[str, Entity] = {}
    for doorway in (ways[n] for n in order):
        rooms = [room for room in plan.joined(doorway) if room is not None and room != here]
        place = rooms[0].place if rooms else _unseen(world, doorway)
        found.setdefault(place.id, place)
    return tuple(found.values())


def _unseen(world: World, doorway: Entity) -> Entity:
    """A room of which nothing but its doorway is known."""
    side = -1.0 if doorway.pose.to_local(world.robot.point).x_m >= 0 else 1.0
    return replace(doorway, type=ROOM, pose=doorway.pose.ahead(side * _BEYOND_M))


def _only(world: World, noun: str, places: tuple[Entity, ...]) -> World:
    """With nothing but these places, each as what it was called."""
    return replace(world, entities=Entities(tuple(replace(place, type=noun) for place in places)))
