"""Rooms, openings, corners and walls by the map alone."""

from __future__ import annotations

import math
from importlib.resources import files

import pytest

from grammar.forms import parse_form
from grounding import Ambiguous, Entity, Grounded, Reason, Unresolved, World, resolve
from grounding.floor_plan import HALLWAY, ROOM, floor_plan
from grounding.places import goal_place
from robot.geometry import ORIGIN, Point, Pose, Segment
from voxml.scene import find_scene
from voxml.vocabulary import load_lexicon

WORLDS = files("corpora") / "worlds"
APARTMENT = World.explored(find_scene("apartment", WORLDS))


def wall(x1_m: float, y1_m: float, x2_m: float, y2_m: float) -> Segment:
    return Segment(Point(x1_m, y1_m), Point(x2_m, y2_m))


def meant(text: str, world: World = APARTMENT) -> Entity | Point:
    outcome = resolve(parse_form(text), world, load_lexicon())
    assert isinstance(outcome, Grounded), outcome
    assert isinstance(outcome.one, Entity | Point)
    return outcome.one


def place(text: str, world: World = APARTMENT) -> tuple[float, float]:
    found = meant(text, world)
    point = found.point if isinstance(found, Entity) else found
    return round(point.x_m, 2), round(point.y_m, 2)


# ------------------------------------------------------------------ the plan
def test_the_apartment_has_its_rooms_its_hallway_and_its_seven_doorways() -> None:
    plan = floor_plan(APARTMENT.walls)
    assert plan is not None
    kinds = [room.place.type for room in plan.rooms]
    assert (kinds.count(ROOM), kinds.count(HALLWAY)) == (7, 1)  # the store room that has no door is one of them
    middles = sorted((round(d.point.x_m, 2), round(d.point.y_m, 2)) for d in plan.doorways)
    assert middles == [(0.65, -0.8), (1.45, 0.8), (4.0, 2.45), (4.65, -0.8), (5.45, 0.8), (7.75, 0.8), (8.05, -0.8)]


def test_every_doorway_joins_two_different_rooms() -> None:
    plan = floor_plan(APARTMENT.walls)
    assert plan is not None
    for doorway in plan.doorways:
        before, behind = plan.joined(doorway)
        assert before is not None
        assert behind is not None
        assert before != behind


def test_slits_of_a_mapped_corner_do_not_open_a_room_and_furniture_makes_none() -> None:
    rough = (
        wall(0.0, 0.0, 4.9, 0.03),
        wall(5.0, 0.1, 5.02, 3.95),
        wall(4.9, 4.0, 2.5, 4.0),
        wall(1.6, 4.02, 0.1, 4.0),
        wall(0.0, 3.9, 0.0, 0.1),
        wall(1.0, 1.0, 1.5, 1.0),  # two crates, 0.9 m apart
        wall(2.4, 1.0, 2.9, 1.0),
    )
    plan = floor_plan(rough)
    assert plan is not None
    assert len(plan.rooms) == 1
    assert [(round(d.point.x_m, 1), round(d.point.y_m, 1)) for d in plan.doorways] == [(2.0, 4.0)]


def test_open_walls_make_no_room() -> None:
    assert World(walls=(wall(0, 0, 3, 0), wall(0, 2, 3, 2))).floor_plan is not None
    open_world = World(ORIGIN, walls=(wall(0, 1, 3, 1), wall(0, -1, 3, -1)))
    outcome = resolve(parse_form("the(room)"), open_world, load_lexicon())
    assert isinstance(outcome, Unresolved)
    assert outcome.reason is Reason.NOTHING_FITS


# ------------------------------------------------------------------ words
@pytest.mark.parametrize(
    ("form", "at"),
    [
        ("the(first(doorway,on(left)))", (1.45, 0.8)),
        ("the(second(door,on(right)))", (4.65, -0.8)),
        ("the(nearest(opening))", (0.65, -0.8)),
        ("the(end,of(the(hallway)))", (8.4, 0.0)),
        ("the(near(end),of(the(hallway)))", (-0.4, 0.0)),
        ("the(other(end,of(the(hallway))))", (8.4, 0.0)),
        ("the(left(side),of(the(hallway)))", (4.0, 0.2)),
        ("the(northeast(corner))", (8.55, 0.35)),
        ("the(wall)", (9.0, 0.0)),
        ("the(wall,on(left))", (0.0, 0.8)),
        ("the(south(wall))", (0.0, -0.8)),
        ("the(wastebasket,in(the(hallway)))", (8.62, -0.05)),
    ],
)
def test_places_of_the_map_are_meant_by_words(form: str, at: tuple[float, float]) -> None:
    assert place(form) == at


def test_the_room_is_where_the_robot_is_and_the_next_lies_behind_the_first_doorway() -> None:
    kitchen = APARTMENT.with_robot(Pose(5.4, 2.2, math.pi))  # its doorway to the living room lies ahead
    here, there = meant("the(room)", kitchen), meant("the(next(room))", kitchen)
    assert isinstance(here, Entity)
    assert isinstance(there, Entity)
    assert 4.0 < here.point.x_m < 6.5
    assert there.point.x_m < 4.0
    assert there.point.y_m > 0.8


def test_things_are_in_the_room_that_holds_them() -> None:
    kitchen = APARTMENT.with_robot(Pose(5.4, 2.2, 0.0))
    outcome = resolve(parse_form("all(object,in(this(room)))"), kitchen, load_lexicon())
    assert isinstance(outcome, Grounded)
    assert {e.type for e in outcome.referents if isinstance(e, Entity)} == {"fridge", "stove", "chair"}


def test_several_doorways_are_asked_about_and_can_be_found_again_by_id() -> None:
    outcome = resolve(parse_form("the(doorway,on(left))"), APARTMENT, load_lexicon())
    assert isinstance(outcome, Ambiguous)
    assert len(outcome.candidates) == 3
    for candidate in outcome.candidates:
        found = APARTMENT.get(candidate.id)
        assert found is not None
        assert found.pose == candidate.pose


def test_through_a_doorway_leads_straight_to_its_other_side() -> None:
    doorway = meant("the(first(doorway,on(left)))")
    assert isinstance(doorway, Entity)
    beyond = goal_place("path.through", APARTMENT, (doorway,))
    assert beyond is not None
    assert (round(beyond.x_m, 2), round(beyond.y_m, 2)) == (1.45, 1.6)


def test_out_of_a_room_leads_through_its_nearest_doorway() -> None:
    bathroom = APARTMENT.with_robot(Pose(7.8, 2.5, 0.0))
    room = meant("the(room)", bathroom)
    assert isinstance(room, Entity)
    outside = goal_place("path.out", bathroom, (room,))
    assert outside is not None
    assert (round(outside.x_m, 2), round(outside.y_m, 2)) == (7.75, 0.0)


def test_what_was_marked_comes_before_what_the_map_shows() -> None:
    marked = APARTMENT.with_place(Entity("front door", "door", Pose(9.0, 0.0, math.pi)))
    assert place("the(door)", marked) == (9.0, 0.0)


# ------------------------------------------------------------------ sides of things
def test_sides_of_a_thing_are_places_beside_it() -> None:
    table = Entity("t", "table", Pose(3.0, 0.0, math.pi / 2), size_m=(1.0, 1.0, 0.7))
    world = World(ORIGIN).with_place(table)
    assert place("the(near(side),of(the(table)))", world) == (2.0, 0.0)
    assert place("the(far(side),of(the(table)))", world) == (4.0, 0.0)
    assert place("the(left(side),of(the(table)))", world) == (3.0, 1.0)
    assert place("the(front,of(the(table)))", world) == (3.0, 1.0)
    assert place("this(side,of(the(table)))", world) == (2.0, 0.0)
    assert place("the(other(side,of(the(table))))", world) == (4.0, 0.0)
