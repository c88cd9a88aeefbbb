"""The queue's state as JSON and back, for the durable record that survives the robot's process."""

from __future__ import annotations

import json
from typing import Any

from robot.geometry import Pose
from robot.messages import (
    CancelCommand,
    Command,
    Control,
    Malformed,
    Patrol,
    decode_command,
    decode_object,
    encode_command,
)

from .state import Current, Goal, Mode, QueueState

NUMBER_MAX = 1e6  # metres or radians: far beyond any place or turn


def state_to_json(state: QueueState) -> str:
    """JSON that :func:`state_from_json` reads back to an equal state (command values to six decimals)."""
    current = state.current
    return json.dumps(
        {
            "mode": state.mode.value,
            "current": None
            if current is None
            else [_goal(current.goal), current.remaining_rad, current.loop, current.vertex, current.reached],
            "pending": [_goal(goal) for goal in state.pending],
            "pictures": [_goal(goal) for goal in state.pictures],
            "began": _pose(state.began),
            "anchor": _pose(state.anchor),
            "admitted": state.admitted,
        }
    )


def state_from_json(text: str | bytes) -> QueueState:
    """Raises Malformed on anything that :func:`state_to_json` does not write."""
    data = decode_object(text)
    try:
        state = QueueState(
            Mode(data["mode"]),
            None if data["current"] is None else _read_current(*data["current"]),
            tuple(_read_goal(*row) for row in data["pending"]),
            tuple(_read_goal(*row) for row in data["pictures"]),
            _read_pose(data["began"]),
            _read_pose(data["anchor"]),
            _whole(data["admitted"]),
        )
    except (KeyError, TypeError, ValueError) as error:
        raise Malformed(f"stored queue is not readable: {error}") from None
    if (state.mode is Mode.MOVING) != (state.current is not None) and state.mode is not Mode.PAUSED:
        raise Malformed("stored queue is not readable: its mode does not fit what it does")
    return state


def _goal(goal: Goal) -> list[Any]:
    return [goal.entry, encode_command(goal.command), goal.id, _pose(goal.start), _pose(goal.end)]


def _pose(pose: Pose | None) -> list[float] | None:
    return None if pose is None else [pose.x_m, pose.y_m, pose.yaw_rad]


def _read_current(goal: list[Any], remaining_rad: Any, loop: Any, vertex: Any, reached: Any) -> Current:
    current = Current(_read_goal(*goal), _number(remaining_rad), _whole(loop), _whole(vertex), _whole(reached))
    command = current.goal.command
    if isinstance(command, Patrol) and current.vertex >= command.sides:
        raise ValueError("a vertex beyond its polygon")
    return current


def _read_goal(entry: Any, command: Any, id: Any, start: Any, end: Any) -> Goal:
    started, ended = _read_pose(start), _read_pose(end)
    if started is None or ended is None or not isinstance(command, str) or not isinstance(id, str | None):
        raise ValueError("a goal must have a command, an id or null, and two poses")
    return Goal(_whole(entry), _read_command(command), id, started, ended)


def _read_command(text: str) -> Command:
    command = decode_command(text)
    at_once = isinstance(command, Control) and command not in (Control.GO_BACK, Control.TAKE_PICTURE)
    if at_once or isinstance(command, CancelCommand):
        raise ValueError(f"'{text}' is no goal")
    return command


def _read_pose(row: Any) -> Pose | None:
    if row is None:
        return None
    x_m, y_m, yaw_rad = row
    return Pose(_number(x_m), _number(y_m), _number(yaw_rad))


def _number(value: Any) -> float:
    if not abs(value) < NUMBER_MAX:
        raise ValueError("a number out of all proportion")
    return float(value)


def _whole(value: Any) -> int:
    if not isinstance(value, int) or value < 0:
        raise ValueError(f"{value!r} is not a whole number")
    return value
