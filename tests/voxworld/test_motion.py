"""Things glide to where they are, the short way, and arrive."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from voxworld.coordinates import VirtualPoint
from voxworld.motion import Placement, eased, placement_of
from voxworld.nodes import Avatar, Wall
from voxworld.people import fit_name
from voxworld.talk import Condition, Remark, Side, condition_html, conversation_html

metres = st.floats(-20, 20)
vectors = st.tuples(metres, metres, metres)
placements = st.builds(Placement, vectors, st.floats(-math.pi, math.pi), vectors)


@given(placements, placements, st.floats(0.001, 0.5))
def test_every_frame_comes_nearer_and_never_passes(shown: Placement, goal: Placement, duration_s: float) -> None:
    after = eased(shown, goal, duration_s)
    assert math.dist(after.position_m, goal.position_m) <= math.dist(shown.position_m, goal.position_m) + 1e-9
    turned = abs(math.remainder(after.yaw_rad - goal.yaw_rad, math.tau))
    assert turned <= abs(math.remainder(shown.yaw_rad - goal.yaw_rad, math.tau)) + 1e-9


@given(placements, placements)
def test_it_arrives_within_two_seconds(shown: Placement, goal: Placement) -> None:
    for _ in range(50):
        shown = eased(shown, goal, 0.04)
    assert shown == goal


def test_a_wall_that_is_named_from_its_other_end_does_not_spin() -> None:
    shown = Placement((0, 0, 0), 1.55, half_turn=math.pi)
    after = eased(shown, Placement((0, 0, 0), -1.55, half_turn=math.pi), 0.05)
    assert abs(after.yaw_rad - shown.yaw_rad) < 0.05


def test_the_stage_is_the_map() -> None:
    robot = placement_of(Avatar("robot", VirtualPoint(-0.5, 0.0, 2.0), -math.pi / 2))
    assert robot.position_m == (2.0, 0.5, 0.0)
    assert robot.yaw_rad == pytest.approx(math.pi / 2)


def test_a_wall_to_the_right_lies_across_the_stage() -> None:
    wall = placement_of(Wall("w", VirtualPoint(1.0, 0.3, 2.0), 0.0, (3.0, 0.6, 0.05)))
    assert wall.position_m == (2.0, -1.0, 0.3)
    assert wall.size_m == (0.05, 3.0, 0.6)  # its length lies along y, its own left


@given(st.text(max_size=60), st.sets(st.text(max_size=20), max_size=4))
def test_names_are_of_one_line_and_nobody_elses(text: str, taken: set[str]) -> None:
    name = fit_name(text, taken)
    assert name
    assert name not in taken
    assert name == " ".join(name.split())


def test_what_people_say_is_text_and_not_markup() -> None:
    html = conversation_html((Remark(Side.PERSON, "<i>Ann</i>", "<script>alert(1)</script>"),))
    assert "<script>" not in html
    assert "<i>" not in html
    assert "<b>x" not in condition_html(Condition(state="<b>x", notice="<b>x", place="<b>x"))
