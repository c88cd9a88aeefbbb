"""What people and robot share: the world model, and what was pointed at, meant and driven in it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from dialogue.events import Highlight, PointedObject, PointedPlace, PointedRay, Pointing
from grounding import Entity, World
from robot.geometry import Point, Pose

from .explored import Explored
from .identity import Walls

STEP_M = 0.05  # between two points of the trail
TRAIL_MAX = 4_000
LOOK_EVERY_M = 0.25  # between two looks around for explored ground


@dataclass(frozen=True, slots=True)
class Pointed:
    """What somebody pointed at last; ``who`` is shown beside it."""

    who: str
    target: PointedPlace | PointedObject | PointedRay


@dataclass(frozen=True, slots=True)
class Shared:
    """Everything that a scene is made from, in map coordinates; every change makes a new value.

    ``robot`` is None before its first sign of life.
    """

    robot: Pose | None = None
    entities: tuple[Entity, ...] = ()
    walls: Walls = field(default_factory=Walls)
    explored: Explored = field(default_factory=Explored)
    looked_from: Point | None = None
    trail: tuple[Point, ...] = ()
    path: tuple[Point, ...] = ()
    meant: Highlight = field(default_factory=Highlight)
    pointed: tuple[Pointed, ...] = ()

    def with_pose(self, pose: Pose) -> Shared:
        """The robot is here now; its trail grows, and so does the ground it has seen."""
        shared = replace(self, robot=pose)
        if not self.trail or self.trail[-1].distance_to(pose.point) >= STEP_M:
            shared = replace(shared, trail=(*self.trail, pose.point)[-TRAIL_MAX:])
        return shared._looked_around(again=False)

    def with_world(self, world: World) -> Shared:
        """The world model as the dialogue holds it: walls, and things with what was taught of them."""
        shared = self if self.entities == world.entities.items else replace(self, entities=world.entities.items)
        if self.walls.segments == world.walls:
            return shared
        return replace(shared, walls=self.walls.with_segments(world.walls))._looked_around(again=True)

    def with_path(self, path: tuple[Point, ...]) -> Shared:
        """The way that the robot means to drive; empty when it means to drive nowhere."""
        return replace(self, path=path)

    def with_meant(self, meant: Highlight) -> Shared:
        """The referents of the moment."""
        return replace(self, meant=meant)

    def with_pointing(self, pointing: Pointing) -> Shared:
        """Somebody pointed: one mark for each person, the newest."""
        who = pointing.speaker or ""
        others = tuple(mark for mark in self.pointed if mark.who != who)
        return replace(self, pointed=(*others, Pointed(who, pointing.target)))

    def without(self, who: str) -> Shared:
        """Somebody left, and so does the mark."""
        return replace(self, pointed=tuple(mark for mark in self.pointed if mark.who != who))

    def _looked_around(self, *, again: bool) -> Shared:
        """Sweep the laser from where the robot is; nothing is swept before there are walls to stop it."""
        if self.robot is None or not self.walls.segments:
            return self
        eye = self.robot.point
        if not again and self.looked_from is not None and self.looked_from.distance_to(eye) < LOOK_EVERY_M:
            return self
        return replace(self, explored=self.explored.seen_from(eye, self.walls.segments), looked_from=eye)
