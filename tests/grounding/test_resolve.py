"""What descriptions mean, from the robot's view."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grammar.forms import parse_form
from grounding import (
    Ambiguous,
    Entities,
    Entity,
    Frame,
    Grounded,
    Heading,
    Reason,
    Resolution,
    Unresolved,
    World,
    frames_in,
    resolve,
)
from robot.geometry import ORIGIN, Point, Pose
from voxml.vocabulary import load_lexicon


def thing(id: str, kind: str, x_m: float, y_m: float, *attributes: str, yaw_deg: float = 180.0) -> Entity:
    return Entity(id, kind, Pose(x_m, y_m, math.radians(yaw_deg)), attributes, fiducial_id=id)


CORRIDOR = World(
    ORIGIN,
    Entities(
        (
            thing("1", "block", 2.0, -0.5, "red"),
            thing("2", "block", 2.5, 0.6, "blue"),
            thing("3", "wastebasket", 3.0, -0.7, "gray"),
            thing("4", "box", 3.5, 0.8, "yellow"),
            thing("5", "box", 4.0, -0.9, "green"),
        )
    ),
)


def meant(text: str, world: World = CORRIDOR) -> Resolution:
    return resolve(parse_form(text), world, load_lexicon())


def ids(outcome: Resolution) -> list[str]:
    found = outcome.referents if isinstance(outcome, Grounded) else outcome.candidates  # type: ignore[union-attr]
    return [entity.id for entity in found if isinstance(entity, Entity)]


@pytest.mark.parametrize(
    ("form", "id"),
    [
        ("the(first(fiducial,on(right)))", "1"),
        ("the(second(fiducial,on(right)))", "3"),
        ("the(third(fiducial,on(right)))", "5"),
        ("the(last(fiducial,on(right)))", "5"),
        ("the(first(fiducial,on(left)))", "2"),
        ("the(second(one,on(left)))", "4"),
        ("the(last(one,on(left)))", "4"),
        ("the(red(block))", "1"),
        ("the(wastebasket)", "3"),
        ("the(nearest(box))", "4"),
        ("the(farthest(fiducial))", "5"),
        ("the(fiducial,number(4))", "4"),
        ("a(block)", "1"),
        ("the(block,on(left))", "2"),
        ("the(box,near(the(blue(block))))", "4"),
        ("the(one,between(the(red(block)),the(green(box))))", "3"),
        ('entity("5")', "5"),
        ("the(leftmost(block))", "2"),
        ("the(rightmost(box))", "5"),
        ("the(second(fiducial,from(left)))", "4"),
        ("the(first(fiducial,from(right)))", "1"),
        ("the(first(block,from(the(end))))", "2"),
        ("the(next(fiducial))", "1"),
        ("the(left(block))", "2"),
        ("the(yellow(one))", "4"),
    ],
)
def test_a_description_that_fits_one_thing_means_it(form: str, id: str) -> None:
    assert ids(meant(form)) == [id]


def test_several_that_fit_are_candidates_in_the_order_in_which_the_robot_would_meet_them() -> None:
    outcome = meant("the(block)", CORRIDOR.with_robot(Pose(5.0, 0.0, math.pi)))
    assert isinstance(outcome, Ambiguous)
    assert ids(outcome) == ["2", "1"]


@pytest.mark.parametrize(
    ("form", "reason"),
    [
        ("the(purple(block))", Reason.NOTHING_FITS),
        ("the(chair)", Reason.NOTHING_FITS),
        ("the(third(block))", Reason.TOO_FEW),
        ("both(fiducial)", Reason.NOTHING_FITS),
        ("there", Reason.NEEDS_POINTING),
        ("this(way)", Reason.NEEDS_POINTING),
        ("it", Reason.NO_ANTECEDENT),
        ("the(block,near(the(chair)))", Reason.NOTHING_FITS),
        ("the(block,above(the(box)))", Reason.NOT_A_PLACE),
    ],
)
def test_what_means_nothing_says_why(form: str, reason: Reason) -> None:
    outcome = meant(form)
    assert isinstance(outcome, Unresolved)
    assert outcome.reason is reason


def test_sides_and_order_turn_with_the_robot() -> None:
    back = CORRIDOR.with_robot(Pose(5.0, 0.0, math.pi))
    assert ids(meant("the(first(fiducial,on(right)))", back)) == ["4"]
    assert ids(meant("the(first(fiducial,on(left)))", back)) == ["5"]


def test_what_lies_behind_comes_after_what_lies_ahead() -> None:
    midway = CORRIDOR.with_robot(Pose(2.4, 0.0, 0.0))
    assert ids(meant("the(first(fiducial,on(right)))", midway)) == ["3"]
    assert ids(meant("the(third(fiducial,on(right)))", midway)) == ["1"]
    assert ids(meant("the(last(fiducial,on(right)))", midway)) == ["5"]


@pytest.mark.parametrize(("name", "yaw_deg"), [("east", 0), ("north", 90), ("southwest", 225), ("southeast", 315)])
def test_headings_are_the_maps(name: str, yaw_deg: float) -> None:
    outcome = meant(name)
    assert isinstance(outcome, Grounded)
    assert isinstance(outcome.one, Heading)
    assert math.isclose(outcome.one.yaw_rad, math.radians(yaw_deg))


def test_plurals_mean_every_one_nearest_first() -> None:
    assert ids(meant("all(block)")) == ["1", "2"]
    assert ids(meant("both(box)")) == ["4", "5"]


def test_pronouns_lean_on_what_was_spoken_of() -> None:
    spoken = CORRIDOR.speaking_of(("1",))
    assert ids(meant("it", spoken)) == ["1"]
    assert ids(meant("the(other(block))", spoken)) == ["2"]
    assert ids(meant("another(block)", spoken)) == ["2"]
    assert ids(meant("the(other(one))", spoken)) == ["2"]
    assert ids(meant("the(one,on(left))", spoken)) == ["2"]


def test_sizes_are_compared_and_equals_are_asked_about() -> None:
    sizes = {"a": (0.2, 0.2, 0.9), "b": (0.5, 0.5, 0.5), "c": (0.5, 0.5, 0.5)}
    world = World(ORIGIN, Entities(tuple(Entity(n, "box", Pose(2.0, 1.0, 0.0), size_m=s) for n, s in sizes.items())))
    assert ids(meant("the(tallest(box))", world)) == ["a"]
    assert ids(meant("the(smallest(box))", world)) == ["a"]
    outcome = meant("the(largest(box))", world)
    assert isinstance(outcome, Ambiguous)
    assert ids(outcome) == ["b", "c"]


def test_the_middle_one_is_counted_across_the_view() -> None:
    row = World(ORIGIN, Entities(tuple(thing(n, "box", 2.0, y) for n, y in (("a", 1.0), ("b", -1.0), ("c", 0.1)))))
    assert ids(meant("the(middle(box))", row)) == ["c"]


def test_the_robots_own_sides_are_landmarks() -> None:
    beside = World(
        ORIGIN, Entities((thing("l", "box", 0.0, 1.0), thing("f", "box", 1.0, 0.0), thing("b", "box", -1, 0)))
    )
    assert ids(meant("the(box,left_of(you))", beside)) == ["l"]
    assert ids(meant("the(box,in_front_of(you))", beside)) == ["f"]
    assert ids(meant("the(box,behind(you))", beside)) == ["b"]


# ------------------------------------------------------------------ attachment
def test_an_attachment_that_denotes_nothing_is_dropped() -> None:
    """The box by the table: one box is near it, and the door is near that table alone."""
    world = World(
        ORIGIN,
        Entities(
            (
                thing("a", "box", 2.0, 1.0),
                thing("b", "box", 6.0, 1.0),
                thing("t", "table", 2.0, 2.0),
                thing("u", "table", 6.0, 2.0),
                thing("d", "door", 6.0, 3.4),
            )
        ),
    )
    # The box is 2.4 m from the door, so only "the table by the door" denotes.
    assert ids(meant("the(box,near(the(table)),by(the(door)))", world)) == ["b"]


# ------------------------------------------------------------------ pointing
def test_a_place_that_is_pointed_at_is_meant_by_there() -> None:
    assert meant("there(pointed(point(1m,2m)))") == Grounded((Point(1.0, 2.0),))


def test_the_nearest_plausible_thing_is_meant_and_the_noun_helps() -> None:
    assert ids(meant("that(one,pointed(point(2.05m,-0.45m)))")) == ["1"]
    assert ids(meant("that(wastebasket,pointed(point(2.5m,-0.6m)))")) == ["3"]


def test_two_that_are_as_likely_are_asked_about() -> None:
    outcome = meant("that(one,pointed(point(2.5m,-0.6m)))")
    assert isinstance(outcome, Ambiguous)
    assert ids(outcome) == ["1", "3"]


def test_word_and_hand_may_disagree() -> None:
    outcome = meant('that(wastebasket,pointed("2"))')
    assert isinstance(outcome, Unresolved)
    assert outcome.reason is Reason.POINTED_ELSEWHERE


def test_a_ray_means_what_lies_along_it_and_a_way_its_direction() -> None:
    bearing_deg = math.degrees(ORIGIN.point.bearing_to(Point(3.5, 0.8)))
    assert ids(meant(f"that(box,pointed(ray(0m,0m,{bearing_deg:.3f}deg),3deg))")) == ["4"]
    assert meant("this(way,pointed(ray(0m,0m,90deg)))") == Grounded((Heading(math.pi / 2),))


def test_with_its_elevation_a_ray_tells_what_stands_near_from_what_stands_far() -> None:
    row = World(ORIGIN, Entities((thing("near", "box", 1.5, 0.0), thing("far", "box", 4.0, 0.1))))
    flat = meant("that(box,pointed(ray(0m,0m,0deg),5deg))", row)
    assert isinstance(flat, Ambiguous)
    assert ids(meant("that(box,pointed(ray(0m,0m,0deg,-40deg,1.4m),5deg))", row)) == ["near"]
    assert ids(meant("that(box,pointed(ray(0m,0m,0deg,-18deg,1.4m),5deg))", row)) == ["far"]


def test_a_ray_that_comes_down_shows_a_place() -> None:
    outcome = meant("there(pointed(ray(1m,0m,90deg,-45deg,1.5m)))")
    assert isinstance(outcome, Grounded)
    assert isinstance(outcome.one, Point)
    assert outcome.one.distance_to(Point(1.0, 1.5)) < 1e-9


def test_pointing_twice_tells_more_than_pointing_once() -> None:
    pair = World(ORIGIN, Entities((thing("a", "box", 3.0, 0.0), thing("b", "box", 3.0, 0.8))))
    once = "pointed(ray(0m,0m,5deg),5deg)"
    assert isinstance(meant(f"that(box,{once})", pair), Ambiguous)
    assert ids(meant(f"that(box,{once},{once},{once})", pair)) == ["a"]


# ------------------------------------------------------------------ properties
places = st.tuples(st.floats(-9, 9), st.floats(-9, 9))


@given(st.lists(places, min_size=1, max_size=12, unique=True), places, st.floats(-3, 3))
def test_ordinals_count_every_thing_once(where: list[tuple[float, float]], at: tuple[float, float], yaw: float) -> None:
    things = Entities(tuple(thing(str(n), "block", x, y) for n, (x, y) in enumerate(where)))
    world = World(Pose(*at, yaw), things)
    names = ("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth")
    counted = [meant(f"the({name}(block))", world) for name in names[: len(where)]]
    met = [i for outcome in counted for i in ids(outcome)]
    assert len(set(met)) == len(met) == min(len(where), len(names))


@given(st.lists(places, min_size=1, max_size=12), places, st.floats(-3, 3))
def test_nothing_is_on_both_sides(where: list[tuple[float, float]], at: tuple[float, float], yaw: float) -> None:
    world = World(Pose(*at, yaw), Entities(tuple(thing(str(n), "block", x, y) for n, (x, y) in enumerate(where))))
    sides = [meant(f"all(block,on({side}))", world) for side in ("left", "right")]
    left, right = (set(ids(side)) if isinstance(side, Grounded) else set() for side in sides)
    assert not left & right


# ------------------------------------------------------------------ negation, numbers, grades
@pytest.mark.parametrize(
    ("form", "found"),
    [
        ("the(block,not(red))", ["2"]),
        ("the(block,not(on(left)))", ["1"]),
        ("the(block,not(near(the(wastebasket))))", []),
        ("the(block,not(near(the(yellow(box)))))", ["1"]),
        ("all(block,not(the(red(block))))", ["2"]),
        ("all(fiducial,not(the(red(block))),not(the(wastebasket)))", ["2", "4", "5"]),
        ("the(first(count(2,plural(fiducial))))", ["1", "2"]),
        ("the(last(count(2,plural(fiducial),on(right))))", ["3", "5"]),
        ("the(count(2,nearest(plural(fiducial))))", ["1", "2"]),
        ("the(leftmost(count(2,plural(fiducial))))", ["2", "4"]),
        ("the(count(2,plural(fiducial),on(left)))", ["2", "4"]),
        ("the(second(fiducial,from(right)))", ["3"]),
        ("most(fiducial)", ["1", "2", "3"]),
        ("a(one,of(the(plural(box))))", ["4"]),
        ("and(the(red(block)),the(yellow(box)))", ["1", "4"]),
        ("the(box,past(the(wastebasket)))", ["5"]),
        ("the(nearest(box,to(the(wastebasket))))", ["5"]),
        ("the(farthest(fiducial,from(the(green(box)))))", ["2"]),
        ("the(nearest(fiducial,to(the(blue(block)))))", ["4"]),
        ("the(farthest(block,from(you)))", ["2"]),
        ("the(nearest(block,on(left),to(the(box))))", ["2"]),
        ("the(wastebasket,past(the(red(block))))", ["3"]),
    ],
)
def test_denied_counted_and_joined(form: str, found: list[str]) -> None:
    outcome = meant(form)
    assert (ids(outcome) if isinstance(outcome, Grounded) else []) == found


def test_near_is_the_one_that_is_by_far_the_nearest_and_asked_where_it_is_not_clear() -> None:
    def boxes(*at_m: float) -> World:
        things = (thing(str(n), "box", 3.0, y_m) for n, y_m in enumerate(at_m))
        return World(ORIGIN, Entities((thing("t", "table", 3.0, 0.0), *things)))

    assert ids(meant("the(box,near(the(table)))", boxes(0.4, 1.4))) == ["0"]
    assert isinstance(meant("the(box,near(the(table)))", boxes(0.9, 1.4)), Ambiguous)
    assert len(ids(meant("the(plural(box),near(the(table)))", boxes(0.4, 1.4)))) == 2


@pytest.mark.parametrize(
    ("form", "frames"),
    [
        ("the(block,on(left))", [Frame.ROBOT]),
        ("the(block,left_of(the(table)))", [Frame.VIEWER]),
        ("the(block,left_of(you))", [Frame.ROBOT]),
        ("the(block,in_front_of(the(desk,north_of(the(door)))))", [Frame.OWN, Frame.MAP]),
        ("the(block,near(the(table)))", []),
    ],
)
def test_every_description_tells_its_frames(form: str, frames: list[Frame]) -> None:
    assert [frame for _, frame in frames_in(parse_form(form), load_lexicon())] == frames
