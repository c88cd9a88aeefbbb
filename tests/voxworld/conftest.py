"""A world without a robot behind it, and a browser to look at it with."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from onlooker import PATIENCE_S, RecordingHost

from grounding import World
from robot.geometry import Pose
from voxml.scene import read_scene
from voxworld.front import Address
from voxworld.view import VoxWorld

HEADS = {"block": "rectangular_prism", "wastebasket": "cylindroid"}
HALL = """
name: hall
seed: 1
robot: {x: 0, y: 0, yaw_deg: 0}
walls:
  - [-1, 1, 5, 1]
  - [-1, -1, 5, -1]
  - [5, -1, 5, 1]
objects:
  - {id: b, type: block, attributes: [red], x: 2.1, y: -0.6, yaw_deg: 180, size: [0.2, 0.3, 0.4],
     fiducial: {id: 1, height: 0.2, face: front}}
  - {id: w, type: wastebasket, x: 3, y: 0.6, yaw_deg: 180, size: [0.2, 0.2, 0.3],
     fiducial: {id: 2, height: 0.15, face: front}}
"""
# No GPU where tests run, and nothing asked of other machines.
CHROMIUM_FLAGS = (
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--headless=new",
    "--no-sandbox",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
)


@pytest.fixture
def host() -> RecordingHost:
    return RecordingHost()


@pytest.fixture
def voxworld(host: RecordingHost) -> Iterator[VoxWorld]:
    world = VoxWorld(host, HEADS, Address(port=0))
    world.start()
    world.show_world(World.explored(read_scene(HALL)))
    world.show_pose(Pose(0.0, 0.0, 0.0))
    yield world
    world.close()


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    executable = shutil.which("chromium") or shutil.which("chromium-browser")
    if executable is None:
        pytest.skip("no Chromium here: apt-get install chromium")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=executable, args=list(CHROMIUM_FLAGS))
        yield browser
        browser.close()


@pytest.fixture
def visit(browser: Any) -> Iterator[Callable[[str], Any]]:
    """Opens an address in a browser of its own kind, as another person would, and waits for the world to be there."""
    contexts: list[Any] = []

    def open_page(url: str) -> Any:
        context = browser.new_context(viewport={"width": 1280, "height": 800})
        contexts.append(context)
        page = context.new_page()
        page.asked = []  # what the page asked of anybody
        page.on("request", lambda request: page.asked.append(request.url))
        page.goto(url)
        page.wait_for_selector("form input", timeout=PATIENCE_S * 1000)
        page.locator("canvas").first.wait_for()
        page.locator(".mantine-Notification-closeButton").first.click()  # "no GPU here"
        return page

    yield open_page
    for context in contexts:
        context.close()
