"""The robot's queue and flow control: a pure state machine, no clock and no I/O (the paper, section 3.1; RSB).

``handle(state, event, here) -> (state, effects)``. What the state means for the wheels, the camera and the wire is
said in the effects, which the control loop carries out; the state is frozen and survives as JSON.
"""

from .flow import QUEUE_MAX, STRAYED_M, handle
from .state import (
    IDLE,
    Arrived,
    Begin,
    Effect,
    Estimated,
    Event,
    Failed,
    Forget,
    Garbled,
    Goal,
    Halt,
    Here,
    Mode,
    Orphaned,
    Photograph,
    PictureFailed,
    PictureTaken,
    QueueState,
    Received,
    Reset,
    Resumed,
    Started,
    Tell,
)
from .stored import state_from_json, state_to_json

__all__ = [
    "IDLE",
    "QUEUE_MAX",
    "STRAYED_M",
    "Arrived",
    "Begin",
    "Effect",
    "Estimated",
    "Event",
    "Failed",
    "Forget",
    "Garbled",
    "Goal",
    "Halt",
    "Here",
    "Mode",
    "Orphaned",
    "Photograph",
    "PictureFailed",
    "PictureTaken",
    "QueueState",
    "Received",
    "Reset",
    "Resumed",
    "Started",
    "Tell",
    "handle",
    "state_from_json",
    "state_to_json",
]
