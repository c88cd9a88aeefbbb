"""What the navigator can be asked to do, and what it answers at every step."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum

from robot.geometry import Point


@dataclass(frozen=True, slots=True)
class Reach:
    """Drive to a place (map frame) around obstacles, then take the yaw if one is given.

    ``reverse``: a place behind may be backed up to, when the straight way there is free.
    """

    place: Point
    yaw_rad: float | None = None
    reverse: bool = False


@dataclass(frozen=True, slots=True)
class Rotate:
    """Turn in place by an angle, counter-clockwise positive; beyond a full turn it is really turned.

    ``final_yaw_rad``: the heading (map frame) to end on, so that the errors of several turns do not add up. It refines
    ``angle_rad`` by less than half a turn and never changes its sense of direction.
    """

    angle_rad: float
    final_yaw_rad: float | None = None


Goal = Reach | Rotate


class State(Enum):
    """How a goal stands."""

    ACTIVE = "active"
    ARRIVED = "arrived"
    FAILED = "failed"


class Phase(Enum):
    """What is being done for the goal; the two of a :class:`Rotate` are the bridge's feedback codes."""

    FOLLOW = "follow"
    ALIGN = "align"
    RECOVER = "recover"
    ESTIMATE_ROTATION = "estimate rotation"
    VERIFY_ROTATION = "verify rotation"


class Reason(Enum):
    """Why a goal failed."""

    CUT_OFF = "there is no way there"
    OCCUPIED = "the place is inside an obstacle"
    STUCK = "the way is blocked"


@dataclass(frozen=True, slots=True)
class Drive:
    """One step's answer: the velocities to command now, and how the goal stands.

    ``path`` runs from the robot to the goal, map frame. ``moved_to`` is the free place that stands in for a goal inside
    an obstacle. Velocities are zero unless the state is ACTIVE.
    """

    linear_mps: float
    angular_radps: float
    state: State
    phase: Phase
    path: tuple[Point, ...] = ()
    reason: Reason | None = None
    moved_to: Point | None = None


def sense(angle_rad: float) -> float:
    """1.0 counter-clockwise, -1.0 clockwise."""
    return math.copysign(1.0, angle_rad)
