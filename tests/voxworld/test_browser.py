"""What people see and do, in Chromium, with a world that no robot stands behind."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from typing import Any

import pytest
from onlooker import RecordingHost, heading_rad, next_said, on_screen, settled, until

from dialogue.events import (
    CameraMove,
    Gesture,
    GestureKind,
    PointedObject,
    PointedPlace,
    PointedRay,
    Pointing,
    Tone,
    Utterance,
)
from robot.geometry import Point, Pose
from voxworld.cameras import TURN_RAD
from voxworld.talk import Condition, Errand, Remark, Side
from voxworld.view import VoxWorld

Visit = Callable[[str], Any]


def test_pointing_at_floor_and_things(voxworld: VoxWorld, host: RecordingHost, visit: Visit) -> None:
    page = visit(voxworld.url)
    person = settled(voxworld)
    for place in (Point(1.0, 0.3), Point(3.8, -0.5)):
        page.mouse.click(*on_screen(page, person, (place.x_m, place.y_m, 0.0)))
        target = next_said(host, Pointing).target
        assert isinstance(target, PointedPlace)
        assert target.place.distance_to(place) < 0.03
    page.mouse.click(*on_screen(page, person, (2.1, -0.6, 0.2)))
    pointing = next_said(host, Pointing)
    assert (pointing.target, pointing.speaker) == (PointedObject("1"), "Guest")


def test_a_drag_with_shift_is_a_direction(voxworld: VoxWorld, host: RecordingHost, visit: Visit) -> None:
    page = visit(voxworld.url)
    person = settled(voxworld)
    page.keyboard.down("Shift")
    page.mouse.move(*on_screen(page, person, (1.0, 0.0, 0.0)))
    page.mouse.down()
    page.mouse.move(*on_screen(page, person, (1.3, 0.3, 0.0)), steps=5)
    page.mouse.move(*on_screen(page, person, (1.6, 0.6, 0.0)), steps=5)
    page.mouse.up()
    page.keyboard.up("Shift")
    ray = next_said(host, Pointing).target
    assert isinstance(ray, PointedRay)
    assert ray.direction_rad == pytest.approx(math.radians(45), abs=0.1)
    assert ray.origin.distance_to(Point(1.0, 0.0)) < 0.1


def test_a_long_press_asks_before_anything_is_said(voxworld: VoxWorld, host: RecordingHost, visit: Visit) -> None:
    page = visit(voxworld.url)
    person = settled(voxworld)
    page.mouse.move(*on_screen(page, person, (1.5, 0.2, 0.0)))
    page.mouse.down()
    page.get_by_text("Go there?").wait_for(timeout=60_000)
    page.mouse.up()
    assert host.said.empty()
    page.get_by_role("button", name="Yes, go there").click()
    assert next_said(host, Pointing).target.place.distance_to(Point(1.5, 0.2)) < 0.03
    assert next_said(host, Utterance).text == "go there"


def test_the_text_box_and_its_history(voxworld: VoxWorld, host: RecordingHost, visit: Visit) -> None:
    page = visit(voxworld.url)
    box = page.locator("form input").first
    for text in ("turn left", "go forward two meters"):
        box.fill(text)
        box.press("Enter")
        said = next_said(host, Utterance)
        assert (said.text, said.speaker) == (text, "Guest")
        until(lambda: box.input_value() == "")
    box.press("ArrowUp")
    box.press("ArrowUp")
    assert box.input_value() == "turn left"
    box.press("ArrowDown")
    assert box.input_value() == "go forward two meters"


def test_stop_acts_while_everything_else_waits(voxworld: VoxWorld, host: RecordingHost, visit: Visit) -> None:
    page = visit(voxworld.url)
    release = threading.Event()
    host.deliver = lambda event: release.wait(30)  # type: ignore[assignment,method-assign,misc,return-value]
    box = page.locator("form input").first
    box.fill("go forward")
    box.press("Enter")
    page.locator("#kirby-stop").click()
    assert host.asked.get(timeout=60) == ("stop", "Guest")
    page.locator("canvas").first.focus()
    page.keyboard.press("Escape")
    assert host.asked.get(timeout=60) == ("stop", "Guest")
    release.set()


def test_views_and_turns_of_the_camera(voxworld: VoxWorld, visit: Visit) -> None:
    voxworld.show_pose(Pose(1.0, 0.2, 0.5))
    page = visit(voxworld.url)
    person = settled(voxworld)
    above = person.client.camera.position[2]
    assert above > 3.0
    assert heading_rad(person) == pytest.approx(0.0, abs=0.01)

    page.get_by_role("button", name="turn left").click()
    until(lambda: abs(heading_rad(settled(voxworld)) - TURN_RAD) < 0.02)
    page.get_by_role("button", name="back", exact=True).click()
    until(lambda: settled(voxworld).client.camera.position[2] > above * 1.1)

    page.get_by_role("button", name="Kirby's view").click()
    until(lambda: settled(voxworld).client.camera.position[2] < 0.3)
    assert heading_rad(person) == pytest.approx(0.5, abs=0.03)
    assert math.dist(person.client.camera.position[:2], (1.0, 0.2)) < 0.15
    page.get_by_role("button", name="turn right").click()
    until(lambda: abs(heading_rad(settled(voxworld)) - (0.5 - TURN_RAD)) < 0.03)
    voxworld.show_pose(Pose(2.0, 0.0, 0.0))  # the robot drives on, and the camera with it
    until(lambda: math.dist(settled(voxworld).client.camera.position[:2], (2.0, 0.0)) < 0.15)

    for move, holds in (
        (CameraMove.SWITCH_LEFT, lambda: settled(voxworld).client.camera.position[2] > 3.0),
        (CameraMove.SWITCH_RIGHT, lambda: settled(voxworld).client.camera.position[2] < 0.3),
        (CameraMove.BACK, lambda: settled(voxworld).client.camera.position[0] < 1.8),
        (CameraMove.ROTATE_LEFT, lambda: abs(heading_rad(settled(voxworld)) - TURN_RAD) < 0.03),
    ):
        voxworld.move_camera(move, "Guest")
        until(holds)


def test_gesture_buttons_names_and_errands(voxworld: VoxWorld, host: RecordingHost, visit: Visit) -> None:
    page = visit(voxworld.url)
    page.get_by_text("Gestures").click()
    page.get_by_role("button", name="thumbs up").click()
    assert next_said(host, Gesture) == Gesture(GestureKind.THUMBS_UP, 1.0, "Guest", at_view=True)
    page.get_by_text("Things found").click()
    name = page.locator("form input").nth(1)
    name.fill("Rosie")
    name.press("Enter")
    assert host.asked.get(timeout=60) == ("rename", "1", "Rosie", "Guest")
    voxworld.show_errands((Errand("7", "go forward 2"), Errand("8", "turn left 90")))
    page.get_by_role("button", name="turn left 90").click()
    assert host.asked.get(timeout=60) == ("cancel", "8", "Guest")


def test_several_people_each_with_their_own_camera(voxworld: VoxWorld, host: RecordingHost, visit: Visit) -> None:
    ann, bob = visit(voxworld.url), visit(voxworld.url)
    settled(voxworld, 1)
    assert [person.name for person in voxworld.people] == ["Guest", "Guest 2"]
    ann.get_by_text("You", exact=True).click()
    ann.get_by_label("Name").fill("Ann") if ann.get_by_label("Name").count() else ann.locator("input").last.fill("Ann")
    until(lambda: voxworld.people[0].name == "Ann")
    ann.get_by_role("button", name="Kirby's view").click()
    until(lambda: settled(voxworld, 0).client.camera.position[2] < 0.3)
    assert settled(voxworld, 1).client.camera.position[2] > 3.0
    voxworld.show_remark(Remark(Side.PERSON, "Ann", "go there <b>now</b>"))
    voxworld.show_remark(Remark(Side.KIRBY, "Kirby", "Where?", Tone.QUESTION))
    for page in (ann, bob):
        log = page.locator("#kirby-conversation")
        log.get_by_text("Where?").wait_for()
        assert "go there <b>now</b>" in log.inner_text()
    voxworld.move_camera(CameraMove.BIRDS_EYE, None)  # nobody knows who asked: everybody's camera moves
    until(lambda: settled(voxworld, 0).client.camera.position[2] > 3.0)


def test_a_page_that_is_loaded_again_is_right_again(voxworld: VoxWorld, host: RecordingHost, visit: Visit) -> None:
    page = visit(voxworld.url)
    settled(voxworld)
    voxworld.show_condition(Condition("driving", False, True, "", "the robot shows no sign of life"))
    page.locator("#kirby-lost").wait_for()
    page.reload()
    page.locator("#kirby-lost").wait_for()
    assert page.locator("#kirby-robot").get_attribute("data-state") == "gone"
    until(lambda: len(voxworld.people) == 1)
    person = settled(voxworld)
    page.locator("canvas").first.wait_for()
    page.mouse.click(*on_screen(page, person, (1.0, 0.0, 0.0)))
    assert next_said(host, Pointing).target.place.distance_to(Point(1.0, 0.0)) < 0.03


def test_nothing_is_asked_of_another_machine(voxworld: VoxWorld, visit: Visit) -> None:
    page = visit(voxworld.url)
    settled(voxworld)
    asked = [url for url in page.asked if not url.startswith(("data:", "blob:", voxworld.url))]
    assert asked == []
