"""What goes into the dialogue manager and what comes out of it.

``dialogue`` is one pure step: an event in, outputs out. Time comes in with each event; the core never reads a clock.
Places are in the map frame.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from robot.geometry import Point
from robot.messages import Command, Feedback, Fiducials, Map, Odom


# ------------------------------------------------------------------ in
@dataclass(frozen=True, slots=True)
class Utterance:
    """Something the person said or typed; ``confidence`` in [0, 1] is the recogniser's (1 for typed text)."""

    text: str
    time_s: float
    confidence: float = 1.0
    speaker: str | None = None


@dataclass(frozen=True, slots=True)
class PointedPlace:
    """A place on the floor that was pointed at."""

    place: Point


@dataclass(frozen=True, slots=True)
class PointedObject:
    """A thing that was pointed at, by the world model's id (a fiducial's id for what a fiducial stands for)."""

    id: str


@dataclass(frozen=True, slots=True)
class PointedRay:
    """A pointing ray, from ``origin`` in ``direction_rad``.

    With an elevation (up from the horizontal) it begins at the eye or hand, ``height_m`` above the floor; without one
    only its bearing over the floor is known.
    """

    origin: Point
    direction_rad: float
    elevation_rad: float | None = None
    height_m: float = 0.0


@dataclass(frozen=True, slots=True)
class Pointing:
    """A deictic gesture; ``spread_rad`` and ``spread_m`` are one standard deviation of where it may have meant."""

    target: PointedPlace | PointedObject | PointedRay
    time_s: float
    spread_m: float = 0.0
    spread_rad: float = 0.0
    speaker: str | None = None


class GestureKind(Enum):
    """The paper's default gesture set (section 3.3.2), and the open palm that stops."""

    THUMBS_UP = "thumbs up"
    THUMBS_DOWN = "thumbs down"
    CLAW = "claw"
    PUSH_LEFT = "push left"
    PUSH_RIGHT = "push right"
    BECKON = "beckon"
    SERVO_LEFT = "servo left"
    SERVO_RIGHT = "servo right"
    SERVO_BACK = "servo back"
    OPEN_PALM = "open palm"


@dataclass(frozen=True, slots=True)
class Gesture:
    """A gesture that was recognised: one of the default set, or a learned one by its name.

    ``at_view`` says that it was made at the shared view rather than at the robot: a servo then turns the camera.
    """

    kind: GestureKind | str
    time_s: float
    speaker: str | None = None
    at_view: bool = False


@dataclass(frozen=True, slots=True)
class Naming:
    """Somebody wrote a name beside a thing; ``id`` is the world model's."""

    id: str
    name: str
    time_s: float
    speaker: str | None = None


@dataclass(frozen=True, slots=True)
class RobotFeedback:
    """Feedback from the robot, in the order in which it was published."""

    feedback: Feedback
    time_s: float


@dataclass(frozen=True, slots=True)
class WorldUpdate:
    """News from the robot's senses; ``None`` means unchanged."""

    time_s: float
    odom: Odom | None = None
    map: Map | None = None
    fiducials: Fiducials | None = None


@dataclass(frozen=True, slots=True)
class Tick:
    """Time passing, for reminders."""

    time_s: float


Event = Utterance | Pointing | Gesture | Naming | RobotFeedback | WorldUpdate | Tick


# ------------------------------------------------------------------ out
@dataclass(frozen=True, slots=True)
class Dispatch:
    """Send these commands to the robot, in this order. ``ids`` pair with them, so that their feedback can be told."""

    commands: tuple[Command, ...]
    ids: tuple[str, ...]


class Tone(Enum):
    """What a reply is: an answer, news of the robot, a question that waits for an answer, or a refusal."""

    REPLY = "reply"
    NEWS = "news"
    QUESTION = "question"
    REFUSAL = "refusal"


@dataclass(frozen=True, slots=True)
class Say:
    """Kirby says this."""

    text: str
    tone: Tone = Tone.REPLY


@dataclass(frozen=True, slots=True)
class Highlight:
    """Show what is meant: entities by id, and places."""

    entities: tuple[str, ...] = ()
    places: tuple[Point, ...] = ()


class CameraMove(Enum):
    """Views of the shared world, and turns of the camera."""

    BIRDS_EYE = "bird's eye"
    ROBOT_VIEW = "robot's view"
    SWITCH_LEFT = "switch left"
    SWITCH_RIGHT = "switch right"
    ROTATE_LEFT = "rotate left"
    ROTATE_RIGHT = "rotate right"
    BACK = "back"


@dataclass(frozen=True, slots=True)
class MoveCamera:
    """Change what the person sees of the shared world."""

    move: CameraMove


Output = Dispatch | Say | Highlight | MoveCamera
