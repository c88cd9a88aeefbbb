"""The place that a relation to a landmark names as a goal: "behind the table", "past the door", "between the boxes"."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from robot.geometry import Point, Pose, Segment

from .entities import Entity
from .floor_plan import Room
from .map_places import OPENINGS, WALL, ends_of
from .relations import COMPASS_RAD
from .world import World

CLEAR_M = 0.5
"""From the side of a thing to the middle of the robot beside it."""

BEFORE = frozenset({"path.goal", "path.direction", "path.via", "RCC8.DC", "RCC8.EC"})
"""Relations whose place, for a thing that one can stand before, is where one stands before it."""

_INTO = frozenset({"path.in", "path.goal", "RCC8.NTPP"})
_OVER = frozenset({"path.across", "path.through", "path.along", "path.past", "path.down", "path.up"})
_BEYOND_M = 0.8  # behind a doorway
_OPPOSITE_M = 1.5  # across a hallway's width
_OPEN_M = 5.0  # where the map shows no wall ahead
_SHORT_OF_WALL_M = 0.4

_Place = Callable[[Point, Entity], Point]


def goal_place(value: str, world: World, landmarks: tuple[Entity, ...]) -> Point | None:
    """Where a relation of this value (see its entry) leads, seen from the robot; None if it names no one place."""
    robot = world.robot.point
    room = world.room_of(landmarks[0]) if len(landmarks) == 1 else None
    if room is not None:
        return _room_place(value, world, room)
    if value == "path.along" and len(landmarks) == 1 and landmarks[0].type == WALL:
        return _along(landmarks[0], world)
    if value == "projective.between" and len(landmarks) == 2:
        first, second = (landmark.point for landmark in landmarks)
        return Point((first.x_m + second.x_m) / 2, (first.y_m + second.y_m) / 2)
    place = _PLACES.get(value)
    return None if place is None or len(landmarks) != 1 else place(robot, landmarks[0])


def _room_place(value: str, world: World, room: Room) -> Point | None:
    """In a room, across it, or out of it by the nearest doorway."""
    robot, plan = world.robot.point, world.floor_plan
    assert plan is not None
    if value in _INTO:
        return room.place.point
    if value in _OVER:
        return max(room.sides, key=robot.distance_to)
    ways = plan.doorways_of(room)
    if value != "path.out" or not ways:
        return None
    nearest = min(ways, key=lambda way: robot.distance_to(way.point))
    return _through(room.place.point, nearest)


def _through(robot: Point, thing: Entity) -> Point:
    """On its other side, straight through."""
    beyond_rad = thing.pose.yaw_rad + (math.pi if thing.pose.to_local(robot).x_m >= 0 else 0.0)
    return thing.point.moved(_BEYOND_M, beyond_rad)


def _along(wall: Entity, world: World) -> Point:
    """Beside a wall, before the end of it that lies more ahead; doorways do not end it."""
    ahead = max(ends_of(wall, world.walls, world.robot), key=lambda end: world.robot.to_local(end).x_m)
    before = ahead.moved(CLEAR_M, ahead.bearing_to(wall.point))
    return before.moved(CLEAR_M, wall.pose.yaw_rad)


def _reach_m(landmark: Entity) -> float:
    return max(landmark.size_m[:2]) / 2 + CLEAR_M


def _own(angle_rad: float) -> _Place:
    """On a side of the thing's own."""
    return lambda robot, thing: thing.point.moved(_reach_m(thing), thing.pose.yaw_rad + angle_rad)


def _seen(angle_rad: float) -> _Place:
    """On a side as seen from the robot; 0 lies beyond the thing."""
    return lambda robot, thing: thing.point.moved(_reach_m(thing), robot.bearing_to(thing.point) + angle_rad)


def _on_map(angle_rad: float) -> _Place:
    return lambda robot, thing: thing.point.moved(_reach_m(thing), angle_rad)


_PLACES: Mapping[str, _Place] = {
    "projective.front": _own(0.0),
    "projective.back": _own(math.pi),
    "projective.left": _seen(math.pi / 2),
    "projective.right": _seen(-math.pi / 2),
    "projective.near": _seen(math.pi),
    "projective.across": lambda robot, thing: thing.point.moved(_OPPOSITE_M, thing.pose.yaw_rad),
    "projective.away": lambda robot, thing: robot.moved(1.0, thing.point.bearing_to(robot)),
    "path.past": _seen(0.0),
    "path.around": _seen(0.0),
    "path.through": _through,
    "path.across": _seen(0.0),
    "path.in": lambda robot, thing: _through(robot, thing) if thing.type in OPENINGS else thing.point,
    "RCC8.NTPP": lambda robot, thing: thing.point,
    **{f"cardinal.{name}": _on_map(yaw_rad) for name, yaw_rad in COMPASS_RAD.items()},
}


def free_way_m(heading: Pose, walls: tuple[Segment, ...]) -> float:
    """How far the robot can drive straight on until the first wall that the map shows, with room left to turn."""
    ahead_m = wall_ahead_m(heading, walls)
    return max((_OPEN_M + _SHORT_OF_WALL_M if ahead_m is None else ahead_m) - _SHORT_OF_WALL_M, 0.0)


def wall_ahead_m(heading: Pose, walls: tuple[Segment, ...]) -> float | None:
    """How far straight ahead the first wall is; None where the map shows none."""
    return min((away_m for wall in walls if (away_m := _crossing_m(heading, wall)) is not None), default=None)


def _crossing_m(heading: Pose, wall: Segment) -> float | None:
    """How far ahead the heading line meets a wall; None where it does not."""
    a, b = heading.to_local(wall.start), heading.to_local(wall.end)
    if a.y_m * b.y_m > 0 or a.y_m == b.y_m:
        return None
    x_m = a.x_m + (b.x_m - a.x_m) * a.y_m / (a.y_m - b.y_m)
    return x_m if x_m > 0 else None
