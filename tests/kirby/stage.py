"""Kirby and a pybullet robot over a real Redis, in one process so that the truth about the body can be read."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from dialogue.events import PointedPlace, Pointing, Utterance
from kirby.agent import Agent
from kirby.conversation import Conversation, Line, Speaker
from kirby.link import RobotLink
from kirby.worlds import find_world
from robot.bridge import Bridge
from robot.control import Robot
from robot.geometry import Point, Pose, wrap_angle
from robot.pacing import LOOK_S
from robot.pybullet_body import PybulletBody
from robot.redis_server import RedisServer
from robot.sightings import Markers
from voxml.scene import Scene

PATIENCE_S = 120.0
SIMULATED_LIMIT_S = 240.0


@dataclass
class Stage:
    """Said lines go through the whole of Kirby; the robot moves in between."""

    scene: Scene
    body: PybulletBody
    robot: Robot
    conversation: Conversation
    lines: list[Line] = field(default_factory=list)

    def say(self, text: str) -> list[str]:
        """Say it, let the robot do what comes of it, and return what Kirby said meanwhile."""
        before = len(self.lines)
        self.conversation.handle(Utterance(text, self.conversation.clock()))
        self.settle()
        return [line.text for line in self.lines[before:] if line.speaker is Speaker.KIRBY]

    def point(self, place: Point) -> None:
        self.conversation.handle(Pointing(PointedPlace(place), self.conversation.clock()))

    def settle(self) -> None:
        """Until the robot is idle or Kirby asks something."""
        give_up_s = time.monotonic() + PATIENCE_S
        while self.conversation.agent.busy or self.robot.busy or self.conversation.pending:
            assert time.monotonic() < give_up_s, "Kirby and the robot did not settle"
            self.robot.attend()
            self.robot.run_until_idle(SIMULATED_LIMIT_S)
            self.conversation.step(0.02)
        self.robot.settle(1.0)
        self.robot.attend()

    def marker(self, fiducial: int) -> Pose:
        """Where a marker truly is and faces."""
        for thing in self.scene.objects:
            if thing.fiducial is not None and thing.fiducial.id == fiducial:
                marker = thing.marker
                assert marker is not None
                return Pose(marker.x_m, marker.y_m, marker.yaw_rad)
        raise AssertionError(f"no fiducial {fiducial} in {self.scene.name}")

    def off_by_rad(self, place: Point) -> float:
        """How far the robot truly looks past a place."""
        here = self.body.truth()
        return abs(wrap_angle(here.point.bearing_to(place) - here.yaw_rad))


@contextmanager
def stage(folder: Path, world: str, *, start: Pose | None = None, seed: int | None = None) -> Iterator[Stage]:
    """Everything set up, and the robot has looked around."""
    folder.mkdir(exist_ok=True)
    scene = find_world(world)
    with (
        RedisServer(folder) as server,
        closing(PybulletBody(scene, start=start, seed=seed)) as body,
        closing(Bridge(server.url)) as bridge,
        closing(RobotLink(server.url)) as link,
    ):
        robot = Robot(body, bridge, boot=bridge.open(), markers=Markers(body.camera, scene.marker_size_m))
        lines: list[Line] = []
        conversation = Conversation(Agent(world=scene), link.send, lines.append)
        link.start(conversation.deliver)
        robot.settle(LOOK_S)
        robot.attend()
        made = Stage(scene, body, robot, conversation, lines)
        while conversation.agent.pose is None or not conversation.agent.session.world.entities:
            robot.attend()
            conversation.step(0.05)
        made.settle()
        yield made
