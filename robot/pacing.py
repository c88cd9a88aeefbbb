"""Running a robot in wall-clock time: at once its pace, a multiple of it, or as fast as the machine goes."""

from __future__ import annotations

import threading
import time

from .control import PERIOD_S, Robot
from .errors import RobotError

SPEED_MAX = 1_000.0
LOOK_S = 2.0  # the robot stands and looks for so long before it says READY: "the first one" needs something seen
SETTLE_S = 1.0  # and comes to rest before it tells that it is done
IDLE_S = 0.25
BEHIND_MAX_S = 0.5


def parse_speed(text: str) -> float | None:
    """Simulated seconds a second; None for ``max``.

    Raises:
        RobotError: neither.
    """
    if text == "max":
        return None
    try:
        speed = float(text)
    except ValueError:
        speed = 0.0
    if not 0.0 < speed <= SPEED_MAX:
        raise RobotError(f"speed '{text}' must be 'max' or a number above 0 and up to {SPEED_MAX:g}, such as 1 or 10")
    return speed


def run(robot: Robot, speed: float | None, stopping: threading.Event) -> None:
    """Run until ``stopping`` is set; at ``speed`` simulated seconds a second, or as fast as possible if None."""
    robot.settle(LOOK_S)
    if speed is None:
        _run_freely(robot, stopping)
    else:
        _run_paced(robot, PERIOD_S / speed, stopping)


def _run_paced(robot: Robot, period_s: float, stopping: threading.Event) -> None:
    due_s = time.monotonic()
    while not stopping.is_set():
        robot.tick()
        due_s += period_s
        if time.monotonic() - due_s > BEHIND_MAX_S:
            due_s = time.monotonic()  # the machine is too slow for this pace: no hurrying afterwards
        while (left_s := due_s - time.monotonic()) > 0.0:
            if robot.port.wait(left_s):
                robot.attend()  # between periods: a stop has the wheels at zero without waiting for the next


def _run_freely(robot: Robot, stopping: threading.Event) -> None:
    """Simulated time passes only while there is something to do, so that nothing depends on when a command comes.

    What is done is told after the robot has come to rest: who answers at once finds it at rest, always in the same
    place.
    """
    while not stopping.is_set():
        robot.attend()
        if not robot.busy:
            robot.port.wait(IDLE_S)
            continue
        while robot.busy and not stopping.is_set():
            robot.tick()
            if robot.held:
                robot.port.wait(PERIOD_S)
        robot.settle(SETTLE_S)
