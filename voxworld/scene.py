"""World -> scene: what people see of what the robot has found, in the paper's virtual-world coordinates. Pure."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import asdict
from functools import lru_cache
from typing import Any

from dialogue.events import PointedObject, PointedPlace, PointedRay
from grounding import FIDUCIAL, Entity
from robot.geometry import Point, Segment
from voxml.scene import WALL_HEIGHT_M, WALL_THICKNESS_M

from .appearance import PATH, POINTED, REFERENT, TRAIL, colour_of, shape_of
from .coordinates import to_cuboid, to_virtual, to_virtual_rotation
from .explored import Explored
from .identity import Walls
from .nodes import Arrow, Avatar, Disc, Floor, Line, Node, Scene, Thing, Wall
from .shared import Pointed, Shared

# A bare marker is drawn as a post of this size, large enough to be seen and clicked from above.
FIDUCIAL_SIZE_M = (0.14, 0.14, 0.22)
POINTED_RADIUS_M = 0.15
MEANT_RADIUS_M = 0.20
RAY_M = 1.5
SIDE_MARGIN_M = 0.10
LINE_HEIGHT_M = 0.012
TRAIL_CHUNK = 64  # points a line: only the newest line grows

Heads = Mapping[str, str]  # type of thing -> its VoxML head


def scene_of(shared: Shared, heads: Heads) -> Scene:
    """Everything there is to see. ``heads`` tells the shape of each type of thing, from its lexicon entry."""
    nodes: list[Node] = [_floor(shared.explored), *_walls(shared.walls, shared.entities)]
    nodes += (_thing(entity, heads, entity.id in shared.meant.entities) for entity in shared.entities)
    nodes += _trail(shared.trail)
    if len(shared.path) > 1:
        nodes.append(_line("path", shared.path, PATH, LINE_HEIGHT_M * 2))
    nodes += (
        Disc(f"meant-{i}", to_virtual(place), MEANT_RADIUS_M, REFERENT) for i, place in enumerate(shared.meant.places)
    )
    nodes += filter(None, (_mark(mark, shared) for mark in shared.pointed))
    if shared.robot is not None:
        nodes.append(Avatar("robot", to_virtual(shared.robot.point), to_virtual_rotation(shared.robot.yaw_rad)))
    return Scene(tuple(nodes))


def label_of(entity: Entity) -> str:
    """What stands above a thing: its name or its description, with the number on its marker."""
    number = "" if entity.fiducial_id is None else f" {entity.fiducial_id}"
    if entity.names:
        return f"{entity.names[0]} ({entity.fiducial_id})" if number else entity.names[0]
    kind = entity.type.replace("_", " ")
    if entity.type == FIDUCIAL:
        return f"fiducial{number}"
    description = " ".join((*entity.attributes, kind))
    return f"{description} ({entity.fiducial_id})" if number else description


def to_json(scene: Scene) -> str:
    """The scene for other engines: metres and radians, left-handed with Y up (Unity's axes), colours 0 to 255."""
    nodes: list[dict[str, Any]] = [{"kind": type(node).__name__.lower(), **asdict(node)} for node in scene.nodes]
    for node in nodes:
        if "shape" in node:
            node["shape"] = node["shape"].value
    return json.dumps({"axes": "left-handed, x right, y up, z ahead", "nodes": nodes})


# ------------------------------------------------------------------ the parts
@lru_cache(maxsize=4)
def _floor(explored: Explored) -> Floor:
    rectangles = explored.rectangles_m()
    # X = -y turns each rectangle over: what was its low side is its high side.
    return Floor("floor", tuple((-y2, x1, -y1, x2) for x1, y1, x2, y2 in rectangles))


@lru_cache(maxsize=4)
def _walls(walls: Walls, entities: tuple[Entity, ...]) -> tuple[Wall, ...]:
    """The walls, but for the sides of things: the laser sees those too, and they would hide the thing itself."""
    named = zip(walls.ids, walls.segments, strict=True)
    return tuple(
        _wall(name, segment)
        for name, segment in named
        if segment.length_m > 0 and not any(_is_side(segment, entity) for entity in entities)
    )


def _is_side(segment: Segment, thing: Entity) -> bool:
    """Whether the segment lies within the thing's footprint, as well as laser and camera know it."""
    length_m, width_m, _ = thing.size_m
    reach_m = math.hypot(length_m, width_m) + SIDE_MARGIN_M
    if (
        segment.length_m > reach_m + SIDE_MARGIN_M
        or abs(segment.start.x_m - thing.pose.x_m) > reach_m
        or abs(segment.start.y_m - thing.pose.y_m) > reach_m
    ):
        return False
    for end in (segment.start, segment.end):
        place = thing.pose.to_local(end)
        behind_m = -length_m if thing.fiducial_id is not None else -length_m / 2
        if not behind_m - SIDE_MARGIN_M <= place.x_m <= behind_m + length_m + SIDE_MARGIN_M:
            return False
        if abs(place.y_m) > width_m / 2 + SIDE_MARGIN_M:
            return False
    return True


@lru_cache(maxsize=8192)
def _wall(id: str, segment: Segment) -> Wall:
    cuboid = to_cuboid(segment)
    centre = to_virtual(segment.midpoint, WALL_HEIGHT_M / 2)
    # Longer by its thickness, so that walls that meet in a corner leave no notch.
    size_m = (cuboid.length_m + WALL_THICKNESS_M, WALL_HEIGHT_M, WALL_THICKNESS_M)
    return Wall(id, centre, cuboid.rotation_rad, size_m)


def _thing(entity: Entity, heads: Heads, highlighted: bool) -> Thing:
    """The entity's pose is where its front is; the thing stands behind it, on the floor."""
    length_m, width_m, height_m = FIDUCIAL_SIZE_M if entity.type == FIDUCIAL else entity.size_m
    middle = entity.pose.ahead(-length_m / 2) if entity.fiducial_id is not None else entity.pose
    return Thing(
        id=f"thing-{entity.id}",
        entity=entity.id,
        shape=shape_of(heads.get(entity.type)),
        centre=to_virtual(middle.point, height_m / 2),
        rotation_rad=to_virtual_rotation(entity.pose.yaw_rad),
        size_m=(width_m, height_m, length_m),
        colour=colour_of(entity.attributes),
        label=label_of(entity),
        highlighted=highlighted,
    )


def _trail(trail: tuple[Point, ...]) -> list[Line]:
    """Lines that share their end points, so that driving on changes the last one alone."""
    starts = range(0, len(trail) - 1, TRAIL_CHUNK)
    return [_line(f"trail-{i}", trail[at : at + TRAIL_CHUNK + 1], TRAIL, LINE_HEIGHT_M) for i, at in enumerate(starts)]


def _line(id: str, points: tuple[Point, ...], colour: tuple[int, int, int], height_m: float) -> Line:
    return Line(id, tuple(to_virtual(point, height_m) for point in points), colour)


def _mark(mark: Pointed, shared: Shared) -> Disc | Arrow | None:
    """The paper's purple circle, or an arrow where a direction was pointed out."""
    name = f"pointed-{mark.who}"
    match mark.target:
        case PointedPlace(place):
            return Disc(name, to_virtual(place), POINTED_RADIUS_M, POINTED, mark.who)
        case PointedObject(entity_id):
            thing = next((entity for entity in shared.entities if entity.id == entity_id), None)
            if thing is None:
                return None
            radius_m = max(POINTED_RADIUS_M, 0.75 * max(thing.size_m[0], thing.size_m[1]))
            return Disc(name, to_virtual(thing.point), radius_m, POINTED, mark.who)
        case PointedRay(origin, direction_rad):
            end = origin.moved(RAY_M, direction_rad)
            return Arrow(name, to_virtual(origin), to_virtual(end), POINTED)
