"""Rooms furnished at random: the things of Kirby's own worlds, by their kinds, sizes and numbers, none in another."""

from __future__ import annotations

import math
import random
from functools import cache
from importlib.resources import files

from grounding import Entities, Entity
from robot.geometry import Point, Pose
from voxml.scene import SceneObject, find_scene

WIDTH_M, DEPTH_M = 8.0, 6.0
THINGS_MIN, THINGS_MAX = 5, 30
_WORLDS = ("apartment", "corridor", "figure3", "hall", "lab", "maze")
_ROOM_TO_STAND_M = 0.3
_TRIES = 200


def furnished(chance: random.Random) -> Entities:
    """5 to 30 things of one world, shuffled and set down square to the walls, where no two overlap.

    They are drawn as the world has them, each at most once before all were: a world with three desks gives up to three.
    """
    stock: list[SceneObject] = []
    count, world = chance.randint(THINGS_MIN, THINGS_MAX), chance.choice(_WORLDS)
    things: list[Entity] = []
    for number in range(count):
        stock = stock or chance.sample(_things_of(world), len(_things_of(world)))
        placed = _placed(str(number), stock.pop(), things, chance)
        things += [placed] if placed else []
    return Entities(tuple(things))


@cache
def _things_of(world: str) -> tuple[SceneObject, ...]:
    return find_scene(world, files("corpora") / "worlds").objects


def _placed(id: str, thing: SceneObject, others: list[Entity], chance: random.Random) -> Entity | None:
    """None where the room is too full for it."""
    for _ in range(_TRIES):
        yaw_rad = chance.randrange(4) * math.pi / 2
        pose = Pose(chance.uniform(0.5, WIDTH_M - 0.5), chance.uniform(0.5, DEPTH_M - 0.5), yaw_rad)
        candidate = Entity(id, thing.type, pose, thing.attributes, size_m=thing.size_m)
        if not any(_overlap(candidate, other) for other in others):
            return candidate
    return None


def footprint_m(thing: Entity) -> tuple[float, float]:
    """Along the room's width and depth."""
    length_m, width_m, _ = thing.size_m
    return (length_m, width_m) if abs(math.cos(thing.pose.yaw_rad)) > 0.5 else (width_m, length_m)


def _overlap(a: Entity, b: Entity) -> bool:
    (a_width, a_depth), (b_width, b_depth) = footprint_m(a), footprint_m(b)
    apart_x, apart_y = abs(a.pose.x_m - b.pose.x_m), abs(a.pose.y_m - b.pose.y_m)
    return apart_x < (a_width + b_width) / 2 and apart_y < (a_depth + b_depth) / 2


def standing_place(things: Entities, chance: random.Random) -> Point:
    """Somewhere on the free floor."""
    while True:
        place = Point(chance.uniform(0.0, WIDTH_M), chance.uniform(0.0, DEPTH_M))
        if all(_clear(place, thing) for thing in things.items):
            return place


def _clear(place: Point, thing: Entity) -> bool:
    width_m, depth_m = footprint_m(thing)
    aside_x, aside_y = abs(place.x_m - thing.pose.x_m), abs(place.y_m - thing.pose.y_m)
    return aside_x > width_m / 2 + _ROOM_TO_STAND_M or aside_y > depth_m / 2 + _ROOM_TO_STAND_M
