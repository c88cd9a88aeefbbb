"""Helpers of the tests that look at the world: an application that writes down, patience, and where things are seen."""

from __future__ import annotations

import math
import queue
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from dialogue.events import Gesture, Pointing, Utterance
from voxworld.people import Person
from voxworld.view import VoxWorld

PATIENCE_S = 60.0
STILL_S = 1.0


class RecordingHost:
    """An application that writes down what people did."""

    def __init__(self) -> None:
        self.said: queue.Queue[Utterance | Pointing | Gesture] = queue.Queue()
        self.asked: queue.Queue[tuple[str, ...]] = queue.Queue()

    def deliver(self, event: Utterance | Pointing | Gesture) -> None:
        self.said.put(event)

    def stop(self, who: str) -> str:
        self.asked.put(("stop", who))
        return ""

    def cancel(self, errand: str, who: str) -> None:
        self.asked.put(("cancel", errand, who))

    def rename(self, entity: str, name: str, who: str) -> None:
        self.asked.put(("rename", entity, name, who))

    def clock(self) -> float:
        return 1.0


def until(holds: Callable[[], Any], patience_s: float = PATIENCE_S) -> Any:
    """The first truthy value; fails the test when none comes."""
    end_s = time.monotonic() + patience_s
    while time.monotonic() < end_s:
        value = holds()
        if value:
            return value
        time.sleep(0.02)
    pytest.fail(f"nothing came of it within {patience_s:g} s")


def settled(world: VoxWorld, number: int = 0) -> Person:
    """The person, once their browser says that its camera is where it was sent."""

    def there() -> Person | None:
        people = world.people
        person = people[number] if len(people) > number else None
        if person is None or person.goal is None or person.shown != person.goal:
            return None
        off_m = math.dist(person.client.camera.position, person.goal.position_m)
        return person if off_m < 0.05 else None

    person: Person = until(there)
    return person


def still(world: VoxWorld) -> Person:
    """The only person, once their picture has stood still for a while: what is found draws it back."""
    seen: list[tuple[float, object]] = []

    def stands() -> Person | None:
        person = settled(world)
        now_s = time.monotonic()
        if not seen or seen[0][1] != person.goal:
            seen[:] = [(now_s, person.goal)]
        return person if now_s - seen[0][0] > STILL_S else None

    person: Person = until(stands)
    return person


def on_screen(page: Any, person: Person, place: tuple[float, float, float]) -> tuple[float, float]:
    """Where a place (map frame, z up) is seen, in pixels: a pinhole at the camera that the browser reports."""
    box, camera = page.locator("canvas").first.bounding_box(), person.client.camera
    ahead = camera.look_at - camera.position
    ahead = ahead / np.linalg.norm(ahead)
    right = np.cross(ahead, (0.0, 0.0, 1.0))
    right = right / np.linalg.norm(right)
    offset = np.array(place) - camera.position
    scale = box["height"] / 2 / math.tan(camera.fov / 2) / float(offset @ ahead)
    down = -float(offset @ np.cross(right, ahead))
    x_px, y_px = scale * float(offset @ right), scale * down
    return box["x"] + box["width"] / 2 + x_px, box["y"] + box["height"] / 2 + y_px


def heading_rad(person: Person) -> float:
    """The way the browser's camera looks over the floor."""
    way = person.client.camera.look_at - person.client.camera.position
    return math.atan2(way[1], way[0])


def next_said(host: RecordingHost, kind: type) -> Any:
    event = host.said.get(timeout=60)
    assert isinstance(event, kind), event
    return event
