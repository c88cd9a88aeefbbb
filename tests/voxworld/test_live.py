"""The whole of Kirby behind the page: a robot that drives, a Redis that dies, and Chromium to see it with."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

import pytest
import redis
from onlooker import heading_rad, on_screen, settled, still, until

from kirby.agent import Agent
from kirby.conversation import Conversation
from kirby.link import RobotLink
from kirby.view import View, serve, showing
from kirby.view_options import ViewOptions
from kirby.worlds import find_world
from robot.geometry import Point, Pose
from robot.messages import Keys, decode_fiducials, decode_odom
from robot.redis_server import RedisServer
from voxworld.cameras import TURN_RAD

pytestmark = pytest.mark.physics

Visit = Callable[[str], Any]
KIRBY = (sys.executable, "-P", "-m", "kirby")
KEYS = Keys()
START_S, DRIVE_S, RECOVERY_S = 60.0, 120.0, 60.0  # patience for a busy machine: how long it takes is in docs/view.md


@contextmanager
def command(*arguments: str) -> Iterator[tuple[subprocess.Popen[str], list[str]]]:
    """A Kirby command while it runs, and the lines it prints on standard error."""
    process = subprocess.Popen(
        (*KIRBY, *arguments), stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True, env=os.environ
    )
    lines: list[str] = []
    reader = threading.Thread(target=lambda: lines.extend(process.stderr or ()), daemon=True)
    reader.start()
    try:
        yield process, lines
    finally:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(20)
        finally:
            process.kill()


@pytest.fixture
def bus(tmp_path: Path) -> Iterator[RedisServer]:
    folder = tmp_path / "bus"
    folder.mkdir()
    with RedisServer(folder) as server:
        yield server


@pytest.fixture
def client(bus: RedisServer) -> Iterator[Any]:
    with redis.Redis.from_url(bus.url) as client:
        yield client


@contextmanager
def robot(bus: RedisServer, client: Any, folder: Path) -> Iterator[subprocess.Popen[str]]:
    """A robot in the paper's corridor, three times as fast as life."""
    state = str(folder / "robot")
    with command("robot", "--redis", bus.url, "--world", "figure3", "--state", state, "--speed", "3") as (process, _):
        until(lambda: client.exists(KEYS.status), START_S)
        yield process


@contextmanager
def viewed(bus: RedisServer) -> Iterator[View]:
    """A conversation with that robot, and the view beside it."""
    stopping = threading.Event()
    with closing(RobotLink(bus.url)) as link:
        conversation = Conversation(Agent(find_world("figure3")), link.send, lambda line: None)
        link.start(conversation.deliver)
        worker = threading.Thread(target=serve, args=(conversation, stopping), daemon=True)
        with showing(ViewOptions(port=0), conversation, link, lambda who, text: None) as view:
            worker.start()
            yield view
            stopping.set()
            worker.join(5)


def pose(client: Any) -> Pose:
    return decode_odom(client.get(KEYS.odom)).pose


def marker(client: Any, number: int) -> Pose:
    found = decode_fiducials(client.get(KEYS.fiducials)).fiducials
    return next(fiducial.pose for fiducial in found if fiducial.id == str(number))


def state(page: Any) -> str:
    text: str = page.locator("#kirby-state").inner_text()
    return text


def conversation_of(page: Any) -> str:
    text: str = page.locator("#kirby-conversation").inner_text()
    return text


def say(page: Any, text: str) -> None:
    box = page.locator("form input").first
    box.fill(text)
    box.press("Enter")


def drive(page: Any, text: str, arrived: str = "successfully navigated") -> None:
    """Say it, and wait until Kirby says that one more place was reached, and rests."""
    before = conversation_of(page).count(arrived)
    say(page, text)
    until(lambda: conversation_of(page).count(arrived) > before, DRIVE_S)
    until(lambda: state(page) == "at rest", DRIVE_S)


def point(page: Any, view: View, place: tuple[float, float, float]) -> None:
    """Click where a place is seen, once the picture stands still."""
    before = view.world.pointed
    page.mouse.click(*on_screen(page, still(view.world), place))
    until(lambda: view.world.pointed != before)


def test_gestures_and_words_move_the_camera(bus: RedisServer, client: Any, tmp_path: Path, visit: Visit) -> None:
    """Through the whole dialogue, by the camera that the browser reports; the robot stays where it is."""
    with robot(bus, client, tmp_path), viewed(bus) as view:
        page = visit(view.world.url)
        stood = pose(client)
        above = settled(view.world).client.camera.position[2]

        def height() -> float:
            z: float = settled(view.world).client.camera.position[2]
            return z

        def heading() -> float:
            return heading_rad(settled(view.world))

        page.get_by_text("Gestures").click()
        for gesture, holds in (
            ("servo left", lambda: abs(heading() - TURN_RAD) < 0.03),
            ("servo right", lambda: abs(heading()) < 0.03),
            ("servo back", lambda: height() > above * 1.1),
            ("push right", lambda: height() < 0.3),
            ("push left", lambda: height() > 3.0),
        ):
            page.get_by_role("button", name=gesture).click()
            until(holds)
        for words, holds in (
            ("show me your view", lambda: height() < 0.3),
            ("show me the bird's eye view", lambda: height() > 3.0),
            ("rotate the camera left", lambda: abs(heading() - TURN_RAD) < 0.03),
            ("switch views", lambda: height() < 0.3),
        ):
            say(page, words)
            until(holds)
        assert pose(client).point.distance_to(stood.point) < 0.01


def test_seeing_pointing_talking_and_stopping(bus: RedisServer, client: Any, tmp_path: Path, visit: Visit) -> None:
    with robot(bus, client, tmp_path), viewed(bus) as view:
        page = visit(view.world.url)
        drive(page, "go to the first fiducial on the right")
        assert "successfully navigated" in conversation_of(page)
        assert pose(client).point.distance_to(marker(client, 1).point) < 0.6

        place = Point(0.6, 0.3)
        point(page, view, (place.x_m, place.y_m, 0.0))
        drive(page, "go there")
        assert pose(client).point.distance_to(place) < 0.2

        blue = marker(client, 2)
        point(page, view, (blue.x_m, blue.y_m, 0.1))
        drive(page, "go to that one")
        assert pose(client).point.distance_to(blue.point) < 0.6

        say(page, "patrol")
        until(lambda: state(page) == "patrolling", DRIVE_S)
        page.locator("#kirby-stop").click()
        until(lambda: state(page) == "paused")
        stopped = pose(client)
        assert "Guest pressed Stop" in conversation_of(page)
        page.get_by_text("Things found").click()
        name = page.locator("form input").nth(1)
        name.fill("Rosie")
        name.press("Enter")
        until(lambda: "I call it Rosie" in conversation_of(page))
        until(lambda: '"Rosie (' in view.world.scene_json())
        page.get_by_role("button", name="Kirby's view").click()
        page.get_by_text("Kirby's camera").wait_for()
        assert pose(client).point.distance_to(stopped.point) < 0.02


def test_a_lost_robot_and_a_page_loaded_again(bus: RedisServer, client: Any, tmp_path: Path, visit: Visit) -> None:
    with viewed_after_robot(bus, client, tmp_path) as (process, view):
        page = visit(view.world.url)
        say(page, "patrol")
        until(lambda: state(page) == "patrolling", DRIVE_S)
        page.reload()
        until(lambda: page.locator("#kirby-state").count() and state(page) == "patrolling", RECOVERY_S)
        assert "patrolling" in conversation_of(page)

        process.kill()
        page.locator("#kirby-lost").wait_for(timeout=RECOVERY_S * 1000)
        assert page.locator("#kirby-robot").get_attribute("data-state") == "gone"
        with robot(bus, client, tmp_path):
            page.locator("#kirby-lost").wait_for(state="detached", timeout=RECOVERY_S * 1000)
            until(lambda: "paused" in state(page), RECOVERY_S)
            say(page, "continue")
            until(lambda: state(page) in ("driving", "patrolling"), DRIVE_S)


def test_redis_killed_and_started_again(bus: RedisServer, client: Any, tmp_path: Path, visit: Visit) -> None:
    with robot(bus, client, tmp_path), viewed(bus) as view:
        page = visit(view.world.url)
        say(page, "go forward two meters")
        until(lambda: "looking for path" in conversation_of(page))
        bus.kill()
        until(lambda: "Redis does not answer" in conversation_of(page))
        page.locator("#kirby-lost").wait_for(state="detached", timeout=RECOVERY_S * 1000)
        until(lambda: state(page) == "at rest" and "successfully navigated" in conversation_of(page), DRIVE_S)
        assert pose(client).x_m > 1.8


def test_any_command_of_several_can_be_cancelled(bus: RedisServer, client: Any, tmp_path: Path, visit: Visit) -> None:
    with robot(bus, client, tmp_path), viewed(bus) as view:
        page = visit(view.world.url)
        say(page, "go forward two meters, then turn left, then go forward one meter")
        page.get_by_role("button", name="turn left 90 degrees").click()
        until(lambda: "cancelled 'turn left 90 degrees'" in conversation_of(page))
        until(lambda: conversation_of(page).count("successfully navigated") == 2, DRIVE_S)
        assert pose(client).point.distance_to(Point(3.0, 0.0)) < 0.2


def test_kirby_view_prints_one_address_and_ends_when_told(tmp_path: Path) -> None:
    with command("view", "--world", "figure3", "--port", "0", "--state", str(tmp_path)) as (process, lines):
        url = until(lambda: re.search(r"http://127\.0\.0\.1:\d+/", "".join(lines)), START_S)
        assert url
    assert process.returncode == 0


@contextmanager
def viewed_after_robot(bus: RedisServer, client: Any, folder: Path) -> Iterator[tuple[subprocess.Popen[str], View]]:
    with robot(bus, client, folder) as process, viewed(bus) as view:
        yield process, view
