"""Everything that a conversation remembers, as one frozen value."""

from __future__ import annotations

from dataclasses import dataclass

from grammar.acts import DialogueAct
from grammar.forms import Form, Term
from grounding import World
from robot.geometry import Point, Pose, wrap_angle
from robot.messages import CancelCommand, Command, Control

from .events import Pointing
from .plans import Deferred
from .table import Activity, State

# A robot this near to where its last movement ideally ended is reckoned from that ideal, as the robot itself does.
_IDEAL_WITHIN_M = 0.15
_IDEAL_WITHIN_RAD = 0.175


@dataclass(frozen=True, slots=True)
class Task:
    """A command that was sent and has not ended yet."""

    id: str
    command: Command

    @property
    def moves(self) -> bool:
        """Whether it takes its turn in the robot's queue, rather than acting at once."""
        return not isinstance(self.command, Control | CancelCommand) or self.command in (
            Control.GO_BACK,
            Control.TAKE_PICTURE,
        )


@dataclass(frozen=True, slots=True)
class Agenda:
    """What is left to be done when something has happened. ``since_s`` is when waiting for time to pass began."""

    deferred: Deferred
    since_s: float | None = None


@dataclass(frozen=True, slots=True)
class Question:
    """What Kirby asked, and what it does once it knows.

    ``acts`` wait for the answer, which takes the place of ``hole`` in their forms; ``candidates`` are ids of things.
    ``commands`` are to be sent before, to get out of the way what keeps the robot from doing it.
    """

    text: str
    acts: tuple[DialogueAct, ...] = ()
    hole: Form | None = None
    candidates: tuple[str, ...] = ()
    commands: tuple[Command, ...] = ()
    asked: int = 1


@dataclass(frozen=True, slots=True)
class Past:
    """An instruction that was carried out: its forms with all that was left open filled in, and where it began.

    ``ids`` pair with the commands, as they were sent.
    """

    forms: tuple[Form, ...]
    commands: tuple[Command, ...]
    start: Pose
    ids: tuple[str, ...] = ()

    @property
    def form(self) -> Form:
        """All of it as one form."""
        return self.forms[0] if len(self.forms) == 1 else Term("seq", self.forms)


@dataclass(frozen=True, slots=True)
class Routine:
    """Something to do that was given a name; a learned gesture of that name does it too."""

    name: str
    form: Form


@dataclass(frozen=True, slots=True)
class Waiting:
    """A question that nobody has answered since ``since_s``, and how often Kirby has come back to it."""

    text: str
    since_s: float
    reminded: int = 0


HISTORY_MAX = 8
_UNKNOWN = World()


@dataclass(frozen=True, slots=True)
class Session:
    """One conversation. ``ideal`` is where the robot's last movement ends, or ended, if nothing goes wrong.

    ``pointings`` are those not yet used, the newest last. ``place`` is the place last spoken of. ``name`` begins the
    id of every command: where several conversations reach one robot, each has its own. ``history`` is what was carried
    out, the latest last; ``reason`` is why something last went otherwise, in words; ``heard`` is what was understood of
    what was said last, questions aside. ``holds_camera``: the view was
    moved since the robot was last told to move.
    """

    state: State = State.IDLE
    activity: Activity = Activity.RESTING
    world: World = _UNKNOWN
    located: bool = False
    tasks: tuple[Task, ...] = ()
    sent: int = 0
    name: str = "k"
    ideal: Pose | None = None
    question: Question | None = None
    agenda: Agenda | None = None
    pointings: tuple[Pointing, ...] = ()
    place: Point | None = None
    history: tuple[Past, ...] = ()
    routines: tuple[Routine, ...] = ()
    reason: str = ""
    heard: tuple[Form, ...] = ()
    waiting: Waiting | None = None
    holds_camera: bool = False

    @property
    def last(self) -> Past | None:
        """The instruction that was carried out last."""
        return self.history[-1] if self.history else None

    def routine(self, name: str) -> Routine | None:
        """The routine of that name, with or without its article: the gesture "L shape" does "the L shape"."""
        wanted = _bare(name)
        return next((routine for routine in self.routines if _bare(routine.name) == wanted), None)

    @property
    def pending(self) -> tuple[Task, ...]:
        """The movements still to be done: not ended, nor dropped, by id or with all others, by what was sent since.

        What a plain ``cancel`` drops is known when the robot says so.
        """
        left: tuple[Task, ...] = ()
        for task in self.tasks:
            match task.command:
                case Control.CANCEL_ALL:
                    left = ()
                case CancelCommand(of):
                    left = tuple(other for other in left if other.id != of)
                case Control.GO_BACK:
                    left = (task,)
                case _ if task.moves:
                    left = (*left, task)
        return left

    @property
    def moving(self) -> bool:
        """Whether there are movements to be done."""
        return bool(self.pending)

    @property
    def start(self) -> Pose:
        """Where the next movement will begin."""
        here, ideal = self.world.robot, self.ideal
        if ideal is None or self.activity in (Activity.STRAYED, Activity.LEFT_OVER):
            return here
        if self.moving:
            return ideal
        astray = here.point.distance_to(ideal.point) > _IDEAL_WITHIN_M
        return here if astray or abs(wrap_angle(here.yaw_rad - ideal.yaw_rad)) > _IDEAL_WITHIN_RAD else ideal


def _bare(name: str) -> str:
    return name.lower().removeprefix("the ")
