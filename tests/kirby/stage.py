"""Kirby and a pybullet robot over a real Redis, in one process so that the truth about the body can be read."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import redis

from dialogue.events import (
    Gesture,
    GestureKind,
    Output,
    PointedObject,
    PointedPlace,
    Pointing,
    RobotFeedback,
    Utterance,
)
from kirby.agent import Agent
from kirby.conversation import Conversation, Happening, Line, Speaker
from kirby.link import RobotLink, connect
from kirby.worlds import find_world
from robot.bridge import Bridge
from robot.control import Robot
from robot.geometry import Point, Pose, wrap_angle
from robot.messages import Keys
from robot.pacing import LOOK_S
from robot.pybullet_body import PybulletBody
from robot.redis_server import RedisServer
from robot.sightings import Markers
from voxml.scene import Scene

KEYS = Keys()
PATIENCE_S = 120.0
SIMULATED_LIMIT_S = 240.0


@dataclass
class Stage:
    """Said lines go through the whole of Kirby; the robot moves in between."""

    scene: Scene
    body: PybulletBody
    robot: Robot
    conversation: Conversation
    client: redis.Redis
    lines: list[Line] = field(default_factory=list)
    told: int = 0  # feedback of the robot that the conversation has heard

    def say(self, text: str) -> list[str]:
        """Say it, let the robot do what comes of it, and return what Kirby said meanwhile."""
        before = len(self.lines)
        self.begin(text)
        self.settle()
        return [line.text for line in self.lines[before:] if line.speaker is Speaker.KIRBY]

    def begin(self, text: str) -> None:
        """Say it; the robot does not move yet."""
        self.conversation.handle(Utterance(text, self.conversation.clock()))

    def point(self, at: Point | int) -> None:
        """Point at a place, or at the thing that a fiducial stands for."""
        target = PointedPlace(at) if isinstance(at, Point) else PointedObject(str(at))
        self.conversation.handle(Pointing(target, self.conversation.clock()))

    def gesture(self, kind: GestureKind | str, at_view: bool = False) -> None:
        self.conversation.handle(Gesture(kind, self.conversation.clock(), at_view=at_view))
        self.settle()

    def drive(self, until: Callable[[], bool]) -> None:
        """Let the robot go on until something is so, and hear what it has said so far."""
        end_s = self.body.time_s + SIMULATED_LIMIT_S
        while not until():
            assert self.body.time_s < end_s, "it did not come to that"
            self.robot.tick()
        self.robot.attend()
        self.catch_up()

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
        self.catch_up()

    def catch_up(self) -> None:
        """Until the conversation knows all that the robot has published."""
        give_up_s = time.monotonic() + PATIENCE_S
        said = self.client.xlen(KEYS.feedback_stream)
        while self.told < said or self.conversation.pending or not self._is_located():
            assert time.monotonic() < give_up_s, "what the robot publishes does not arrive"
            self.conversation.step(0.02)

    def count(self, happening: Happening, outputs: tuple[Output, ...]) -> None:
        """Watches the conversation."""
        self.told += isinstance(happening, RobotFeedback)

    def _is_located(self) -> bool:
        pose = self.conversation.agent.pose
        return pose is not None and pose.point.distance_to(self.robot.pose.point) < 0.002

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
        closing(connect(server.url)) as client,
    ):
        robot = Robot(body, bridge, boot=bridge.open(), markers=Markers(body.camera, scene.marker_size_m))
        lines: list[Line] = []
        conversation = Conversation(Agent(world=scene), link.send, lines.append)
        made = Stage(scene, body, robot, conversation, client, lines, client.xlen(KEYS.feedback_stream))
        conversation.watch(made.count)
        link.start(conversation.deliver)
        robot.settle(LOOK_S)
        robot.attend()
        made.settle()
        yield made
