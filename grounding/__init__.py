"""What words and pointing mean in the world that the robot has found. Never sees strings of English."""

from .approach import STAND_OFF_M, approach
from .entities import FIDUCIAL, Entities, Entity, StandsFor
from .frames import Frame, frame_of, frames_in
from .outcomes import Ambiguous, Grounded, Heading, Reason, Resolution, Unresolved
from .resolve import resolve
from .world import World

__all__ = [
    "FIDUCIAL",
    "STAND_OFF_M",
    "Ambiguous",
    "Entities",
    "Entity",
    "Frame",
    "Grounded",
    "Heading",
    "Reason",
    "Resolution",
    "StandsFor",
    "Unresolved",
    "World",
    "approach",
    "frame_of",
    "frames_in",
    "resolve",
]
