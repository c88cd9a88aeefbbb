"""What to do when nothing moves, in Nav2's order: clear, spin, back up, wait; then all over once more, then give up."""

from __future__ import annotations

import math
from enum import Enum

from robot.geometry import Pose, wrap_angle

from .follower import Twist

ROUNDS = 2
SPIN_RADPS = 0.8
SPIN_RAD = math.pi / 2.0
BACK_UP_MPS = 0.08
BACK_UP_M = 0.15
WAIT_S = 3.0
LONGEST_S = 5.0  # of any one behaviour, should something hold the robot
FORGIVEN_M = 1.0  # having come this far since the last trouble, the count starts anew


class Behaviour(Enum):
    """Each ends with planning anew from the map as it is then; clearing is nothing but that."""

    CLEAR = "clear"
    SPIN = "spin"
    BACK_UP = "back up"
    WAIT = "wait"


ORDER = tuple(Behaviour)


class Recovery:
    """Runs the behaviours one at a time; :meth:`start` says when there is none left."""

    def __init__(self) -> None:
        self._tried = 0
        self._behaviour: Behaviour | None = None
        self._begun: tuple[Pose, float] | None = None

    @property
    def is_active(self) -> bool:
        return self._behaviour is not None

    def start(self, pose: Pose, now_s: float) -> bool:
        """Begin the next behaviour; False when all have been tried."""
        if self._begun is not None and self._begun[0].point.distance_to(pose.point) > FORGIVEN_M:
            self._tried = 0
        if self._tried >= ROUNDS * len(ORDER):
            return False
        self._behaviour = ORDER[self._tried % len(ORDER)]
        self._begun = (pose, now_s)
        self._tried += 1
        return True

    def step(self, pose: Pose, now_s: float) -> Twist:
        """The velocities to command now; the behaviour ends by itself."""
        assert self._begun is not None
        begun, begun_s = self._begun
        elapsed_s = now_s - begun_s
        twist = Twist(0.0, 0.0)
        if self._behaviour is Behaviour.SPIN and abs(wrap_angle(pose.yaw_rad - begun.yaw_rad)) < SPIN_RAD:
            twist = Twist(0.0, SPIN_RADPS)
        elif self._behaviour is Behaviour.BACK_UP and pose.point.distance_to(begun.point) < BACK_UP_M:
            twist = Twist(-BACK_UP_MPS, 0.0)
        waiting = self._behaviour is Behaviour.WAIT and elapsed_s < WAIT_S
        if elapsed_s > LONGEST_S or not (waiting or twist != Twist(0.0, 0.0)):
            self._behaviour = None
            return Twist(0.0, 0.0)
        return twist
