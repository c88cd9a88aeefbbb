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

PATIENCE_S = 20.0


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


def on_screen(person: Person, place: tuple[float, float, float]) -> tuple[float, float]:
    """Where a place (map frame, z up) is seen, in pixels: a pinhole at the camera that the browser reports."""
    camera = person.client.camera
    ahead = camera.look_at - camera.position
    ahead = ahead / np.linalg.norm(ahead)
    right = np.cross(ahead, (0.0, 0.0, 1.0))
    right = right / np.linalg.norm(right)
    offset = np.array(place) - camera.position
    scale = camera.image_height / 2 / math.tan(camera.fov / 2) / float(offset @ ahead)
    down = -float(offset @ np.cross(right, ahead))
    return camera.image_width / 2 + scale * float(offset @ right), camera.image_height / 2 + scale * down


def heading_rad(person: Person) -> float:
    """The way the browser's camera looks over the floor."""
    way = person.client.camera.look_at - person.client.camera.position
    return math.atan2(way[1], way[0])


def next_said(host: RecordingHost, kind: type) -> Any:
    event = host.said.get(timeout=20)
    assert isinstance(event, kind), event
    return event
