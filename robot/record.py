"""What the robot writes down so that it can take up its work again after it was killed."""

from __future__ import annotations

import json
from dataclasses import dataclass

from .geometry import Pose
from .messages import Malformed, decode_object
from .queue import QueueState, state_from_json, state_to_json


@dataclass(frozen=True, slots=True)
class Record:
    """The queue, where the robot stood, and how far it had turned since the queue's last ``Begin``."""

    queue: QueueState
    pose: Pose
    turned_rad: float


def record_to_json(record: Record) -> str:
    """JSON that :func:`record_from_json` reads back."""
    pose = record.pose
    data = {"queue": state_to_json(record.queue), "pose": [pose.x_m, pose.y_m, pose.yaw_rad]}
    return json.dumps({**data, "turned": record.turned_rad})


def record_from_json(text: str | bytes) -> Record:
    """Raises Malformed on anything that :func:`record_to_json` does not write."""
    data = decode_object(text)
    try:
        x_m, y_m, yaw_rad = (_moderate(value) for value in data["pose"])
        return Record(state_from_json(data["queue"]), Pose(x_m, y_m, yaw_rad), _moderate(data["turned"]))
    except (KeyError, TypeError, ValueError) as error:
        raise Malformed(f"the robot's record is not readable: {error}") from None


def _moderate(value: float) -> float:
    if not abs(value) < 1e6:
        raise ValueError("a number out of all proportion")
    return float(value)
