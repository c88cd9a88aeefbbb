"""Kirby: steer a mobile robot with English and gesture. Hosts import from here and from nowhere else.

    from kirby import Agent

Names are imported when they are first used, so that the command line starts without what it does not need.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from dialogue.events import (
        CameraMove,
        Dispatch,
        Event,
        Gesture,
        GestureKind,
        Highlight,
        MoveCamera,
        Naming,
        Output,
        PointedObject,
        PointedPlace,
        PointedRay,
        Pointing,
        RobotFeedback,
        Say,
        Tick,
        Tone,
        Utterance,
        WorldUpdate,
    )
    from grammar import Proposer
    from grounding import Entities, Entity, StandsFor, World
    from robot.geometry import Point, Pose, Segment
    from robot.messages import (
        Command,
        Feedback,
        FeedbackCode,
        Fiducial,
        Fiducials,
        Map,
        Odom,
        decode_command,
        encode_command,
        feedback,
    )
    from voxml.errors import KirbyError
    from voxml.scene import Scene, load_scene
    from voxml.vocabulary import Lexicon, load_lexicon

    from .agent import Agent, RobotPort, understand
    from .proposer import LanguageModel

__all__ = [
    "Agent",
    "CameraMove",
    "Command",
    "Dispatch",
    "Entities",
    "Entity",
    "Event",
    "Feedback",
    "FeedbackCode",
    "Fiducial",
    "Fiducials",
    "Gesture",
    "GestureKind",
    "Highlight",
    "KirbyError",
    "LanguageModel",
    "Lexicon",
    "Map",
    "MoveCamera",
    "Naming",
    "Odom",
    "Output",
    "Point",
    "PointedObject",
    "PointedPlace",
    "PointedRay",
    "Pointing",
    "Pose",
    "Proposer",
    "RobotFeedback",
    "RobotPort",
    "Say",
    "Scene",
    "Segment",
    "StandsFor",
    "Tick",
    "Tone",
    "Utterance",
    "World",
    "WorldUpdate",
    "decode_command",
    "encode_command",
    "feedback",
    "load_lexicon",
    "load_scene",
    "understand",
]

_HOMES = (
    "kirby.agent",
    "kirby.proposer",
    "dialogue.events",
    "grammar",
    "grounding",
    "robot.geometry",
    "robot.messages",
    "voxml.errors",
    "voxml.scene",
    "voxml.vocabulary",
)


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"module 'kirby' has no attribute '{name}'")
    for home in _HOMES:
        module = import_module(home)
        if hasattr(module, name):
            globals()[name] = getattr(module, name)
            return globals()[name]
    raise AttributeError(f"module 'kirby' has no attribute '{name}'")
