"""Where Kirby and other things are, which way, and how far."""

from __future__ import annotations

from dialogue.wording import direction, metres, phrase, place_words
from grammar.forms import Term
from grounding import Entity, Grounded, resolve
from grounding.places import wall_ahead_m
from grounding.relations import COMPASS_RAD
from robot.geometry import Point, Pose, wrap_angle

from .asked import Asked, Report, capital

NEAR_M = 1.0  # a thing this near is worth a mention with a place


def where(asked: Asked) -> Report:
    """Where something is from here; where Kirby itself is."""
    (target,) = asked.args
    if target == Term("you"):
        return _here(asked)
    meant = resolve(target, asked.world, asked.lexicon)
    if isinstance(meant, Grounded) and isinstance(meant.one, Point):
        return Report(capital(_away("that", meant.one, asked.world.robot)))
    things = asked.things(target)
    return Report(capital(away(asked, things)), things)


def away(asked: Asked, things: tuple[Entity, ...]) -> str:
    """How far and which way each of these is."""
    robot = asked.world.robot
    return "; ".join(_away(name, thing.point, robot) for name, thing in zip(asked.names(things), things, strict=True))


def _away(name: str, place: Point, robot: Pose) -> str:
    return f"{name} is {metres(robot.point.distance_to(place))} away, {direction(robot, place)}"


def _here(asked: Asked) -> Report:
    robot = asked.world.robot
    near = min(asked.world.entities.items, key=lambda e: robot.point.distance_to(e.point), default=None)
    by: tuple[Entity, ...] = ()
    if near is not None and robot.point.distance_to(near.point) <= NEAR_M:
        by = (near,)
    beside = f", by {asked.names(by)[0]}" if by else ""
    inside = f" in {name}" if (name := _room_around(asked)) else ""
    return Report(f"I am at {place_words(robot.point)}{inside}{beside}, facing {_compass(robot.yaw_rad)}", by)


def _room_around(asked: Asked) -> str:
    """What kind of room Kirby is in; that it is just a room says nothing."""
    plan = asked.world.floor_plan
    room = None if plan is None else plan.room_at(asked.world.robot.point)
    return "" if room is None or room.place.type == "room" else phrase(Term("the", (Term(room.place.type),)))


def heading(asked: Asked) -> Report:
    """Which way Kirby faces."""
    return Report(f"I am facing {_compass(asked.world.robot.yaw_rad)}")


def _compass(yaw_rad: float) -> str:
    return min(COMPASS_RAD, key=lambda name: abs(wrap_angle(COMPASS_RAD[name] - yaw_rad)))


def distance(asked: Asked) -> Report:
    """How far something is."""
    (target,) = asked.args
    robot = asked.world.robot
    if target == Term("the", (Term("wall"),)):
        ahead_m = wall_ahead_m(robot, asked.world.walls)
        return Report("I see no wall ahead" if ahead_m is None else f"The wall ahead is {metres(ahead_m)} away")
    things = asked.things(target)
    names = asked.names(things)
    told = [f"{n} is {metres(robot.point.distance_to(t.point))} away" for n, t in zip(names, things, strict=True)]
    return Report(capital("; ".join(told)), things)
