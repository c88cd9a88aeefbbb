"""World files: what they say is what is loaded, and what is wrong with them is said in one line."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from voxml.scene import Face, Scene, SceneError, find_scene, load_scene, read_scene

WORLDS = Path(__file__).parents[2] / "corpora" / "worlds"

HALL = """
name: hall
seed: 7
robot: {x: 0.5, y: -0.25, yaw_deg: 90}
walls:
  - [0, 1, 4, 1]
  - {line: [4, 1, 4, -1], height: 0.3, thickness: 0.1}
objects:
  - id: red_block
    type: block
    attributes: [red]
    names: [rosie]
    x: 2
    y: 0
    yaw_deg: 180
    size: [0.2, 0.3, 0.4]
    fiducial: {id: 1, height: 0.2, face: left}
  - {id: bin, type: wastebasket, x: 3, y: 0.5, size: [0.3, 0.3, 0.4]}
"""


def changed(**changes: object) -> str:
    data = yaml.safe_load(HALL)
    for path, value in changes.items():
        target = data
        *steps, last = path.split("__")
        for step in steps:
            target = target[int(step)] if step.isdigit() else target[step]
        if value is None:
            del target[last]
        else:
            target[int(last) if last.isdigit() else last] = value
    return yaml.safe_dump(data)


def test_everything_in_the_file_is_in_the_scene() -> None:
    hall = read_scene(HALL)
    assert (hall.name, hall.seed, hall.start.x_m, hall.start.y_m) == ("hall", 7, 0.5, -0.25)
    assert hall.start.yaw_rad == pytest.approx(math.pi / 2)
    assert [(w.x1_m, w.y2_m, w.height_m, w.thickness_m) for w in hall.walls] == [(0, 1, 0.6, 0.05), (4, -1, 0.3, 0.1)]
    block = hall.objects[0]
    assert (block.type, block.attributes, block.names, block.size_m) == ("block", ("red",), ("rosie",), (0.2, 0.3, 0.4))
    assert block.fiducial is not None
    assert block.fiducial.face is Face.LEFT
    assert hall.find("bin") is hall.objects[1]
    assert hall.with_fiducial(1) is block
    assert hall.find("nothing") is None
    assert hall.with_fiducial(2) is None


def test_a_marker_sits_on_the_side_it_was_put_on_and_looks_away_from_it() -> None:
    marker = read_scene(HALL).objects[0].marker
    assert marker is not None
    assert (marker.x_m, marker.y_m, marker.z_m) == pytest.approx((2.0, -0.15, 0.2))
    assert marker.yaw_rad == pytest.approx(-math.pi / 2)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"seed": None}, "the file: 'seed' is missing"),
        ({"colour": "red"}, "the file: 'colour' is not a field"),
        ({"objects__0__colour": "red"}, "objects[0]: 'colour' is not a field"),
        ({"robot__x": "here"}, "robot.x: 'here' is not a number"),
        ({"robot__x": float("nan")}, "robot.x: 'nan' is not a number"),
        ({"robot__y": 1e9}, "robot.y: 1e+09 is out of range"),
        ({"robot__y": 10**400}, "is not a number"),
        ({"robot__x": True}, "robot.x: 'True' is not a number"),
        ({"robot__yaw_deg": 400}, "robot.yaw_deg: 400 is out of range"),
        ({"walls__0": [1, 2, 3]}, "walls[0].line: must be 4 numbers: [x1, y1, x2, y2]"),
        ({"walls__0": [1, 2, 1, 2]}, "walls[0]: both ends are the same"),
        ({"walls": {}}, "walls: must be a list"),
        ({"objects__1__size": [0.3, 0, 0.4]}, "objects[1].size: 0 is not a length"),
        ({"objects__1__id": "red_block"}, "objects: id 'red_block' is used twice"),
        ({"objects__1__fiducial": {"id": 1, "height": 0.2, "face": "left"}}, "fiducial id '1' is used twice"),
        ({"objects__0__fiducial__id": 1000}, "must be a whole number from 0 to 999"),
        ({"objects__0__fiducial__face": "top"}, "objects[0].fiducial.face: 'top' is not a side"),
        ({"objects__0__fiducial__height": 0.38}, "a marker of 0.1 m does not fit its side of 0.2 x 0.4 m"),
        ({"objects__0__attributes": ["red", ""]}, "objects[0].attributes[1]: '' must be text"),
        ({"objects__0": 5}, "objects[0]: must be a mapping"),
    ],
)
def test_a_broken_file_is_refused_in_one_line_with_file_and_field(changes: dict[str, object], words: str) -> None:
    with pytest.raises(SceneError) as caught:
        read_scene(changed(**changes), "hall.yaml")
    assert str(caught.value).startswith("hall.yaml: ")
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_key_given_twice_is_refused() -> None:
    with pytest.raises(SceneError, match="'seed' is given twice"):
        read_scene(HALL + "seed: 8\n")


@given(st.one_of(st.text(max_size=60), st.text("[]{}:-!&*|>'\"#,0123456789 \n", max_size=60)))
def test_any_text_is_a_scene_or_a_scene_error(text: str) -> None:
    try:
        outcome: Scene | str = read_scene(text)
    except SceneError as error:
        outcome = str(error)
    assert isinstance(outcome, Scene) or "\n" not in outcome


def test_worlds_are_found_by_name_and_by_path(tmp_path: Path) -> None:
    (tmp_path / "hall.yaml").write_text(HALL)
    assert find_scene("hall", tmp_path) == find_scene(str(tmp_path / "hall.yaml"), tmp_path)
    with pytest.raises(SceneError, match="no world 'hal': use one of hall"):
        find_scene("hal", tmp_path)
    with pytest.raises(SceneError, match="cannot be read"):
        load_scene(tmp_path / "none.yaml")


@pytest.mark.parametrize("path", sorted(WORLDS.glob("*.yaml")), ids=lambda path: path.stem)
def test_every_world_of_the_project_loads_and_is_called_like_its_file(path: Path) -> None:
    assert load_scene(path).name == path.stem
