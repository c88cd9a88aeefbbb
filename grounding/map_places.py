"""Places that nobody marked: doorways, corners and walls, as the map shows them from where the robot is."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import permutations

from robot.geometry import Point, Pose, Segment, wrap_angle

from .approach import sees, wall_ends_m
from .entities import Entity
from .floor_plan import DOORWAY, FloorPlan, Room, floor_plan
from .regions import sampled
from .relations import COMPASS_RAD

CORNER, WALL = "corner", "wall"
OPENINGS = frozenset({DOORWAY, "opening", "door", "entrance", "exit"})
"""What an opening may be called."""

Walls = tuple[Segment, ...]

_WALL_MIN_M = 0.5
_LONG_M = 1.5
_MET_M = 0.3  # as far as mapped walls that meet, or are one, may be apart
_SAME_LINE_RAD = math.radians(10.0)
_INTO_ROOM_M = 0.45  # from a corner's walls to where the robot can stand in it
_WALL_HEIGHT_M = 0.6
_ACROSS = math.sin(math.radians(45.0))


def map_place(id: str, walls: Walls, robot: Pose) -> Entity | None:
    """The place of this id."""
    plan = floor_plan(walls)
    if plan is None:
        return None
    rooms = tuple(room.place for room in plan.rooms)
    places = (*rooms, *plan.doorways, *corners(walls, robot), *walls_in_sight(walls, robot))
    return next((place for place in places if place.id == id), None)


def doorways(walls: Walls, robot: Pose) -> tuple[Entity, ...]:
    """Those of the room in which the robot is, or all where it is in none that is known.

    Each is named by the wall in which it is, or where that has several, by where it lies from the middle of the room.
    """
    plan = floor_plan(walls)
    if plan is None:
        return ()
    here = plan.room_at(robot.point)
    ways = plan.doorways if here is None else plan.doorways_of(here)
    middle = robot.point if here is None else here.middle
    by_wall = [_compass(_outwards_rad(way.pose, middle)) for way in ways]
    by_place = [_compass(middle.bearing_to(way.point)) for way in ways]
    names = (wall if by_wall.count(wall) == 1 else place for wall, place in zip(by_wall, by_place, strict=True))
    return tuple(replace(way, attributes=(name,)) for way, name in zip(ways, names, strict=True))


def _outwards_rad(doorway: Pose, middle: Point) -> float:
    """The way through it, out of the room."""
    return doorway.yaw_rad if doorway.to_local(middle).x_m < 0 else doorway.yaw_rad + math.pi


def corners(walls: Walls, robot: Pose) -> tuple[Entity, ...]:
    """Places in the corners of the room, or of all walls where the robot is in none."""
    plan = floor_plan(walls)
    if plan is None:
        return ()
    here, found = plan.room_at(robot.point), list[Entity]()
    for place in _corners(tuple(wall for wall in walls if wall.length_m >= _WALL_MIN_M)):
        known = any(place.distance_to(other.point) <= _INTO_ROOM_M for other in found)
        if not known and (here is None or plan.room_at(place) == here):
            pose = Pose(place.x_m, place.y_m, 0.0)
            found.append(Entity(f"{CORNER} {len(found) + 1}", CORNER, pose, size_m=(0.0, 0.0, 0.0)))
    middle = robot.point if here is None else here.middle
    return tuple(replace(each, attributes=(_quarter(middle, each.point),)) for each in found)


def _quarter(middle: Point, place: Point) -> str:
    return f"{'north' if place.y_m > middle.y_m else 'south'}{'east' if place.x_m > middle.x_m else 'west'}"


def _corners(walls: Walls) -> Iterator[Point]:
    """Beside every end of a wall that meets another which stands across."""
    for wall, other in permutations(walls, 2):
        if abs(math.sin(wall.direction_rad - other.direction_rad)) < _ACROSS:
            continue
        for end, far in ((wall.start, wall.end), (wall.end, wall.start)):
            met = nearest_on(other, end)
            if end.distance_to(met) > _MET_M:
                continue
            along = met.moved(_INTO_ROOM_M, end.bearing_to(far))
            for away in (other.start, other.end):
                if met.distance_to(away) > _INTO_ROOM_M:
                    yield along.moved(_INTO_ROOM_M, met.bearing_to(away))


def walls_in_sight(walls: Walls, robot: Pose) -> tuple[Entity, ...]:
    """Those of the room, each as what of it is nearest to the robot, and by where it stands: "the north wall".

    Pieces of one line, as a wall with a doorway has, are one wall.
    """
    plan, ends_m, found = floor_plan(walls), wall_ends_m(walls), list[Entity]()
    here = None if plan is None else plan.room_at(robot.point)
    parts = {n: part for n, wall in enumerate(walls, start=1) if (part := _part_in(wall, plan, here)) is not None}
    feet = {number: nearest_on(part, robot.point) for number, part in parts.items()}
    for number in sorted(feet, key=lambda n: robot.point.distance_to(feet[n])):
        wall, face = walls[number - 1], _facing(parts[number], feet[number], robot.point)
        if sees(robot.point, feet[number], ends_m) and not any(_in_line(face, other.pose) for other in found):
            size_m = (0.0, wall.length_m, _WALL_HEIGHT_M)
            found.append(Entity(f"{WALL} {number}", WALL, face, (_compass(face.yaw_rad + math.pi),), size_m=size_m))
    return tuple(found)


def _part_in(wall: Segment, plan: FloorPlan | None, here: Room | None) -> Segment | None:
    """The stretch of a wall that bounds a room, or all of it where there is none; None for less than a wall."""
    places = sampled(wall)
    within = places if plan is None or here is None else places[plan.inside(here, places)]
    if not len(within):
        return None
    (start_x, start_y), (end_x, end_y) = within[0].tolist(), within[-1].tolist()
    part = Segment(Point(start_x, start_y), Point(end_x, end_y))
    return part if part.length_m >= _WALL_MIN_M else None


def _facing(wall: Segment, foot: Point, robot: Point) -> Pose:
    """Straight out from the wall, on the robot's side."""
    left = Pose(foot.x_m, foot.y_m, wall.direction_rad + math.pi / 2)
    return left if left.to_local(robot).x_m >= 0 else left.turned(math.pi)


def _in_line(face: Pose, other: Pose) -> bool:
    turned_rad = abs(wrap_angle(face.yaw_rad - other.yaw_rad))
    return turned_rad <= _SAME_LINE_RAD and abs(other.to_local(face.point).x_m) <= _MET_M


def ends_of(wall: Entity, walls: Walls, robot: Pose) -> tuple[Point, ...]:
    """The ends of its pieces, within the room."""
    plan = floor_plan(walls)
    here = None if plan is None else plan.room_at(robot.point)
    parts = filter(None, (_part_in(each, plan, here) for each in walls))
    pieces = (part for part in parts if _in_line(_facing(part, part.midpoint, robot.point), wall.pose))
    return tuple(end for piece in pieces for end in (piece.start, piece.end))


def nearest_on(wall: Segment, place: Point) -> Point:
    """Of a wall, what is nearest to a place."""
    local = Pose(wall.start.x_m, wall.start.y_m, wall.direction_rad).to_local(place)
    return wall.start.moved(min(max(local.x_m, 0.0), wall.length_m), wall.direction_rad)


def long_walls(walls: Walls) -> tuple[Entity, ...]:
    """Every wall that is too long to be the side of a thing, whole."""
    return tuple(_whole(f"{WALL} {n}", wall) for n, wall in enumerate(walls, start=1) if wall.length_m >= _LONG_M)


def whole_wall(wall: Entity, walls: Walls) -> Entity:
    """The wall of which `walls_in_sight` gave what is nearest to the robot."""
    line = min(walls, key=lambda each: nearest_on(each, wall.point).distance_to(wall.point))
    return _whole(wall.id, line)


def _whole(id: str, wall: Segment) -> Entity:
    """Seen from above a line, across the way that it looks."""
    middle = wall.midpoint
    pose = Pose(middle.x_m, middle.y_m, wall.direction_rad + math.pi / 2)
    return Entity(id, WALL, pose, size_m=(0.0, wall.length_m, _WALL_HEIGHT_M))


def _compass(bearing_rad: float) -> str:
    return min(COMPASS_RAD, key=lambda name: abs(wrap_angle(COMPASS_RAD[name] - bearing_rad)))
