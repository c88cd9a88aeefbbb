"""What words and pointing mean in the world that the robot has found. Never sees strings of English."""

from .approach import STAND_OFF_M, approach
from .entities import FIDUCIAL, Entities, Entity, StandsFor
from .outcomes import Ambiguous, Grounded, Heading, Reason, Resolution, Unresolved
from .resolve import resolve
from .world import World

__all__ = [
    "FIDUCIAL",
    "STAND_OFF_M",
    "Ambiguous",
    "Entities",
    "Entity",
    "Grounded",
    "Heading",
    "Reason",
    "Resolution",
    "StandsFor",
    "Unresolved",
    "World",
    "approach",
    "resolve",
]
