"""The values of the queue: its state, the events that go in and the effects that come out. Map frame throughout."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from robot.geometry import Point, Pose
from robot.messages import Command, Control, Envelope, Feedback, Patrol, Turn
from robot.navigation.goals import Goal as Target


# ------------------------------------------------------------------ state
class Mode(Enum):
    """What the robot is at. Its wheels may turn in MOVING alone."""

    READY = "ready"
    MOVING = "moving"
    PAUSED = "paused"
    AWAITING = "awaiting"  # strayed: an answer to HELP is wanted


@dataclass(frozen=True, slots=True)
class Goal:
    """A command that takes time, as it was received: a movement, ``go back`` or ``take picture``.

    ``entry`` is its place in the durable list. ``start`` is the ideal end of the goal before and ``end`` its own.
    """

    entry: int
    command: Command
    id: str | None
    start: Pose
    end: Pose

    @property
    def moves(self) -> bool:
        return self.command is not Control.TAKE_PICTURE


@dataclass(frozen=True, slots=True)
class Current:
    """The goal being done. ``remaining_rad`` is what is left of a turn, counter-clockwise positive.

    A patrol is at ``vertex`` of ``loop`` (both from 0), with ``reached`` vertices of this loop visited.
    """

    goal: Goal
    remaining_rad: float = 0.0
    loop: int = 0
    vertex: int = 0
    reached: int = 0

    @property
    def patrols(self) -> bool:
        return isinstance(self.goal.command, Patrol)

    @property
    def turns(self) -> bool:
        return isinstance(self.goal.command, Turn)


@dataclass(frozen=True, slots=True)
class QueueState:
    """Everything the queue remembers.

    ``began`` is where the current or last movement began; ``anchor`` the ideal end of the last one that succeeded.
    ``pictures`` are those asked for out of turn. Entries up to ``admitted`` were sent before a restart was announced,
    so the pause that it brought does not refuse them.
    """

    mode: Mode = Mode.READY
    current: Current | None = None
    pending: tuple[Goal, ...] = ()
    pictures: tuple[Goal, ...] = ()
    began: Pose | None = None
    anchor: Pose | None = None
    admitted: int = 0

    @property
    def goals(self) -> tuple[Goal, ...]:
        """What is being done and what is pending, in order."""
        return self.pending if self.current is None else (self.current.goal, *self.pending)

    @property
    def patrolling(self) -> bool:
        return self.mode is Mode.MOVING and self.current is not None and self.current.patrols


IDLE = QueueState()


@dataclass(frozen=True, slots=True)
class Here:
    """Where the robot believes it is, and how far it has turned since ``Begin``, counter-clockwise positive."""

    pose: Pose
    turned_rad: float = 0.0


# ------------------------------------------------------------------ events
@dataclass(frozen=True, slots=True)
class Started:
    """The robot is up with nothing left from before."""


@dataclass(frozen=True, slots=True)
class Resumed:
    """The robot is up again with this state from before; ``unhandled`` says that the durable list holds more than it.

    Entries up to ``admitted`` were sent before anybody could know.
    """

    admitted: int
    unhandled: bool


@dataclass(frozen=True, slots=True)
class Received:
    """A command, by its place in the durable list."""

    entry: int
    envelope: Envelope


@dataclass(frozen=True, slots=True)
class Garbled:
    """An entry that is no command, and why; ``id`` if it had a readable one."""

    entry: int
    reason: str
    id: str | None = None


@dataclass(frozen=True, slots=True)
class Orphaned:
    """An entry taken before a restart of which nothing is known any more, so that it will not be done."""

    entry: int
    id: str | None = None


@dataclass(frozen=True, slots=True)
class Estimated:
    """A turn is complete by odometry and is now being verified."""


@dataclass(frozen=True, slots=True)
class Arrived:
    """The target of the last ``Begin`` is reached; ``moved_to`` is the place that stood in for one without room."""

    moved_to: Point | None = None


@dataclass(frozen=True, slots=True)
class Failed:
    """The target of the last ``Begin`` cannot be reached."""


@dataclass(frozen=True, slots=True)
class PictureTaken:
    """The picture of that entry is in the file of that path."""

    entry: int
    path: str


@dataclass(frozen=True, slots=True)
class PictureFailed:
    """The picture of that entry could not be saved."""

    entry: int


@dataclass(frozen=True, slots=True)
class Reset:
    """Bridge_Reset: everything on the wire is gone."""


Event = (
    Reset
    | Started
    | Resumed
    | Received
    | Garbled
    | Orphaned
    | Estimated
    | Arrived
    | Failed
    | PictureTaken
    | PictureFailed
)


# ------------------------------------------------------------------ effects
@dataclass(frozen=True, slots=True)
class Tell:
    """Publish this feedback."""

    feedback: Feedback


@dataclass(frozen=True, slots=True)
class Begin:
    """Pursue this target now, instead of any other."""

    target: Target


@dataclass(frozen=True, slots=True)
class Halt:
    """Wheels to zero at once, and pursue nothing."""


@dataclass(frozen=True, slots=True)
class Photograph:
    """Take a picture from now on and save it for this entry."""

    entry: int


@dataclass(frozen=True, slots=True)
class Forget:
    """The entry has ended: it may leave the durable list."""

    entry: int


Effect = Tell | Begin | Halt | Photograph | Forget
