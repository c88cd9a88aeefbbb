"""World -> scene, what changed between two scenes, and the scene for other engines."""

from __future__ import annotations

import json
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dialogue.events import Highlight, PointedObject, PointedPlace, PointedRay, Pointing
from grounding import World
from robot.geometry import Point, Pose, Segment
from voxml.scene import read_scene
from voxworld.appearance import COLOURS, POINTED, Shape
from voxworld.nodes import Arrow, Avatar, Change, Disc, Drop, Line, Node, Put, Scene, Thing, Wall, diff, patched
from voxworld.scene import scene_of, to_json
from voxworld.shared import Shared

HEADS = {"block": "rectangular_prism", "wastebasket": "cylindroid"}
HALL = """
name: hall
seed: 1
robot: {x: 0, y: 0, yaw_deg: 0}
walls:
  - [-1, 1, 5, 1]
  - [-1, -1, 5, -1]
objects:
  - {id: b, type: block, attributes: [red], x: 2.1, y: 0, yaw_deg: 180, size: [0.2, 0.3, 0.4],
     fiducial: {id: 1, height: 0.2, face: front}}
  - {id: w, type: wastebasket, names: [Binny], x: 3, y: 0.5, yaw_deg: -90, size: [0.2, 0.2, 0.3],
     fiducial: {id: 2, height: 0.15, face: front}}
"""


def hall() -> Shared:
    return Shared().with_world(World.explored(read_scene(HALL))).with_pose(Pose(0.0, 0.0, 0.0))


def seen(shared: Shared) -> dict[str, Node]:
    return scene_of(shared, HEADS).by_id


def test_a_thing_stands_behind_its_marker_with_its_shape_and_colour() -> None:
    block = seen(hall())["thing-1"]
    assert isinstance(block, Thing)
    assert (block.shape, block.colour, block.label) == (Shape.RECTANGULAR_PRISM, COLOURS["red"], "red block (1)")
    # The marker is on the front, at map (2.0, 0); the block's middle is 0.1 m behind it, half its height up.
    assert (block.centre.x_m, block.centre.y_m, block.centre.z_m) == pytest.approx((0.0, 0.2, 2.1))
    assert block.size_m == (0.3, 0.4, 0.2)


def test_names_and_shapes_come_from_the_world_and_the_lexicon() -> None:
    basket = seen(hall())["thing-2"]
    assert isinstance(basket, Thing)
    assert (basket.shape, basket.label) == (Shape.CYLINDROID, "Binny (2)")


def test_the_sides_of_a_thing_are_not_walls_as_well() -> None:
    explored = World.explored(read_scene(HALL))
    side = Segment(Point(1.98, -0.16), Point(2.01, 0.15))  # the block's front, as the laser has it
    past = Segment(Point(1.98, -0.16), Point(2.01, 0.75))  # a wall that begins there
    for segment, shown in ((side, 0), (past, 1)):
        world = World(entities=explored.entities, walls=(segment,))
        nodes = scene_of(Shared().with_world(world), HEADS).nodes
        assert sum(isinstance(node, Wall) for node in nodes) == shown


def test_the_robot_looks_where_it_drives() -> None:
    robot = seen(hall().with_pose(Pose(1.0, 0.5, math.pi / 2)))["robot"]
    assert isinstance(robot, Avatar)
    assert (robot.position.x_m, robot.position.z_m) == (-0.5, 1.0)
    assert robot.rotation_rad == pytest.approx(-math.pi / 2)


def test_nothing_of_the_robot_is_shown_before_it_was_heard_of() -> None:
    assert "robot" not in seen(Shared())


def test_the_referent_is_highlighted() -> None:
    things = seen(hall().with_meant(Highlight(("2",), (Point(1.0, 0.0),))))
    assert [node.highlighted for node in things.values() if isinstance(node, Thing)] == [False, True]
    assert isinstance(things["meant-0"], Disc)


def test_a_pointed_place_is_a_purple_circle_with_the_name_of_who_pointed() -> None:
    disc = seen(hall().with_pointing(Pointing(PointedPlace(Point(1.0, -0.5)), 0.0, speaker="Ann")))["pointed-Ann"]
    assert isinstance(disc, Disc)
    assert (disc.centre.x_m, disc.centre.z_m, disc.colour, disc.label) == (0.5, 1.0, POINTED, "Ann")


def test_each_person_has_one_mark() -> None:
    shared = hall()
    for who, target in (("Ann", PointedPlace(Point(1, 0))), ("Bob", PointedObject("1")), ("Ann", PointedObject("2"))):
        shared = shared.with_pointing(Pointing(target, 0.0, speaker=who))
    marks = [name for name in seen(shared) if name.startswith("pointed-")]
    assert sorted(marks) == ["pointed-Ann", "pointed-Bob"]
    assert "pointed-Bob" not in seen(shared.without("Bob"))


def test_a_pointed_direction_is_an_arrow() -> None:
    arrow = seen(hall().with_pointing(Pointing(PointedRay(Point(1, 0), math.pi / 2), 0.0)))["pointed-"]
    assert isinstance(arrow, Arrow)
    assert (arrow.start.x_m, arrow.end.x_m) == pytest.approx((0.0, -1.5))


def test_driving_changes_the_robot_and_the_newest_piece_of_its_trail_alone() -> None:
    shared = hall()
    for step in range(100):
        shared = shared.with_pose(Pose(0.06 * step, 0.0, 0.0))
    before = scene_of(shared, HEADS)
    after = scene_of(shared.with_pose(Pose(6.0, 0.0, 0.0)), HEADS)
    changed = {update.after.id for update in diff(before, after) if isinstance(update, Change)}
    assert changed <= {"robot", "trail-1", "floor"}
    assert {"robot", "trail-1"} <= changed


def test_the_planned_path_is_a_line_from_here_to_there() -> None:
    path = seen(hall().with_path((Point(0, 0), Point(1, 0), Point(1, 1))))["path"]
    assert isinstance(path, Line)
    assert [(p.x_m, p.z_m) for p in path.points] == [(0, 0), (0, 1), (-1, 1)]


def test_a_wall_that_grows_stays_the_same_wall() -> None:
    world = World(walls=(Segment(Point(0, 1), Point(2, 1)), Segment(Point(0, -1), Point(2, -1))))
    grown = World(walls=(Segment(Point(-0.02, -1.01), Point(3.5, -1)), Segment(Point(2.6, 1.02), Point(0.01, 1))))
    before = Shared().with_world(world)
    after = before.with_world(grown)
    updates = diff(scene_of(before, {}), scene_of(after, {}))
    moved = [update for update in updates if isinstance(update, Change) and isinstance(update.after, Wall)]
    assert len(moved) == 2
    assert not any(isinstance(update, Drop) for update in updates)
    assert all(math.copysign(1, u.before.centre.x_m) == math.copysign(1, u.after.centre.x_m) for u in moved)  # type: ignore[union-attr]


def test_a_wall_that_is_gone_goes_and_a_new_one_gets_a_name_of_its_own() -> None:
    first = Shared().with_world(World(walls=(Segment(Point(0, 1), Point(2, 1)), Segment(Point(0, -1), Point(2, -1)))))
    second = first.with_world(World(walls=(Segment(Point(0, 1), Point(2, 1)), Segment(Point(5, -1), Point(5, 1)))))
    updates = diff(scene_of(first, {}), scene_of(second, {}))
    assert [type(update) for update in updates] == [Drop, Put]
    assert isinstance(updates[1], Put)
    assert updates[1].node.id == "wall-2"


def test_a_scene_is_json_for_other_engines() -> None:
    data = json.loads(to_json(scene_of(hall(), HEADS)))
    kinds = {node["kind"] for node in data["nodes"]}
    assert {"wall", "thing", "avatar", "floor"} <= kinds
    block = next(node for node in data["nodes"] if node["id"] == "thing-1")
    assert block["shape"] == "rectangular_prism"
    assert block["centre"]["z_m"] == pytest.approx(2.1)


# ------------------------------------------------------------------ properties
_metres = st.integers(-40, 40).map(lambda n: n / 10)
_points = st.builds(Point, _metres, _metres)
_walls = st.lists(st.builds(Segment, _points, _points), max_size=6).map(tuple)
_marks = st.lists(st.builds(Pointing, st.builds(PointedPlace, _points), st.just(0.0)), max_size=2)


@st.composite
def _shared(draw: st.DrawFn) -> Shared:
    shared = Shared().with_world(World(walls=draw(_walls))).with_world(World(walls=draw(_walls)))
    for place in draw(st.lists(_points, max_size=4)):
        shared = shared.with_pose(Pose(place.x_m, place.y_m, 0.0))
    for mark in draw(_marks):
        shared = shared.with_pointing(mark)
    return shared


@given(_shared(), _shared())
def test_a_difference_makes_one_scene_of_the_other_and_no_more(first: Shared, second: Shared) -> None:
    old, new = scene_of(first, {}), scene_of(second, {})
    updates = diff(old, new)
    assert patched(old, updates).by_id == new.by_id
    assert diff(new, patched(old, updates)) == ()
    same = {name for name, node in old.by_id.items() if new.by_id.get(name) == node}
    touched = {u.id if isinstance(u, Drop) else (u.node if isinstance(u, Put) else u.after).id for u in updates}
    assert not same & touched


@given(_walls, _walls)
def test_every_wall_has_one_id_and_every_id_one_wall(first: tuple[Segment, ...], second: tuple[Segment, ...]) -> None:
    walls = Shared().with_world(World(walls=first)).with_world(World(walls=second)).walls
    assert set(walls.segments) == set(second)
    assert len(set(walls.ids)) == len(walls.ids) == len(walls.segments)


def test_an_empty_scene_needs_nothing_to_become_itself() -> None:
    assert diff(Scene(), Scene()) == ()
