"""Pictures of the shared world for the documentation, from a real run: ``script/screenshots [FOLDER]``.

A robot drives in the paper's corridor; Chromium looks at it, points and talks. What it saw is docs/pictures/view-*.png.
"""

from __future__ import annotations

import math
import shutil
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from playwright.sync_api import Page, sync_playwright

from kirby.agent import Agent
from kirby.conversation import Conversation
from kirby.link import RobotLink
from kirby.view import View, serve, showing
from kirby.view_options import ViewOptions
from kirby.worlds import find_world, world_file
from robot.geometry import Point
from robot.process import RobotOptions, RobotProcess
from robot.redis_server import RedisServer
from voxworld.cameras import View as View3d

FOLDER = Path(__file__).parent / "pictures"
WORLD = "figure3"
SIZE = {"width": 1280, "height": 800}
PATIENCE_S = 120.0
FLAGS = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--headless=new", "--no-sandbox")


def main(folder: Path) -> None:
    """Take every picture."""
    with ExitStack() as stack:
        view = stack.enter_context(_kirby())
        page = stack.enter_context(_browser(view.world.url))
        _wait(lambda: view.world.people and view.world.people[0].shown is not None)
        page.get_by_role("button", name="Kirby's view").click()
        page.get_by_text("Kirby's camera").wait_for()
        _say(page, "go to the first fiducial on the right")
        _take(page, folder / "view-robot.png", after=lambda: _x_m(view) > 0.2)
        page.get_by_role("button", name="bird's eye").click()
        _take(page, folder / "view-driving.png", after=lambda: _stands(view) and _x_m(view) > 0.9)
        _wait(lambda: _state(page) == "at rest")
        time.sleep(2.0)
        page.mouse.click(*_seen(page, view, Point(0.9, 0.35)))
        _say(page, "go there")
        _take(page, folder / "view-pointing.png", after=lambda: _state(page) == "driving" and _x_m(view) < 1.7)


# ------------------------------------------------------------------ who takes part
@contextmanager
def _kirby() -> Iterator[View]:
    """Redis, robot, conversation and view, as ``kirby view`` has them."""
    with ExitStack() as stack:
        state = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        url = stack.enter_context(RedisServer(state)).url
        link = stack.enter_context(closing(RobotLink(url)))
        conversation = Conversation(Agent(find_world(WORLD)), link.send, lambda line: None)
        link.start(conversation.deliver)
        robot = stack.enter_context(closing(RobotProcess(RobotOptions(url, world_file(WORLD)[0], state))))
        robot.start()
        view = stack.enter_context(showing(ViewOptions(port=0), conversation, link, lambda who, text: None))
        stopping = threading.Event()
        stack.callback(stopping.set)
        threading.Thread(target=serve, args=(conversation, stopping), daemon=True).start()
        _wait(lambda: conversation.agent.pose is not None)
        yield view


@contextmanager
def _browser(url: str) -> Iterator[Page]:
    executable = shutil.which("chromium") or shutil.which("chromium-browser")
    if executable is None:
        sys.exit("screenshots: no Chromium here: apt-get install chromium")
    with sync_playwright() as playwright, playwright.chromium.launch(executable_path=executable, args=FLAGS) as browser:
        page = browser.new_page(viewport=SIZE)  # type: ignore[arg-type]
        page.goto(url)
        page.wait_for_selector("form input", timeout=PATIENCE_S * 1000)
        page.locator(".mantine-Notification-closeButton").first.click()  # "no GPU here"
        yield page


# ------------------------------------------------------------------ what they do
def _take(page: Page, path: Path, after: Callable[[], Any]) -> None:
    _wait(after)
    page.screenshot(path=path)
    print(path)


def _say(page: Page, text: str) -> None:
    box = page.locator("form input").first
    box.fill(text)
    box.press("Enter")


def _state(page: Page) -> str:
    return page.locator("#kirby-state").inner_text()


def _stands(view: View) -> bool:
    """Whether the camera has come to rest."""
    person = view.world.people[0]
    return person.viewpoint.view is View3d.BIRDS_EYE and person.shown == person.goal


def _x_m(view: View) -> float:
    pose = view.pose
    return math.nan if pose is None else pose.x_m


def _seen(page: Page, view: View, place: Point) -> tuple[float, float]:
    """The pixel at which a place on the floor is seen: a pinhole at the camera that the browser reports."""
    box, camera = page.locator("canvas").first.bounding_box(), view.world.people[0].client.camera
    assert box is not None
    ahead = camera.look_at - camera.position
    ahead = ahead / np.linalg.norm(ahead)
    right = np.cross(ahead, (0.0, 0.0, 1.0))
    right = right / np.linalg.norm(right)
    offset = np.array((place.x_m, place.y_m, 0.0)) - camera.position
    scale = box["height"] / 2 / math.tan(camera.fov / 2) / float(offset @ ahead)
    x_px, y_px = scale * float(offset @ right), -scale * float(offset @ np.cross(right, ahead))
    return box["x"] + box["width"] / 2 + x_px, box["y"] + box["height"] / 2 + y_px


def _wait(holds: Callable[[], Any]) -> None:
    end_s = time.monotonic() + PATIENCE_S
    while not holds():
        if time.monotonic() > end_s:
            sys.exit("screenshots: what the picture was to show did not happen")
        time.sleep(0.05)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else FOLDER)
