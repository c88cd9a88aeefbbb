"""Kirby for embedding: a dialogue engine that is told what is said, shown and sensed, and says what to do about it.

    agent = Agent(world=my_scene)
    for output in agent.hear("go to the first block on the right"):
        ...

Neither Redis nor pybullet is needed: the outputs are values, and a host's own robot is anything with ``send``.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from typing import Any, Protocol

from dialogue.codec import UnreadableError, from_data, to_data
from dialogue.events import (
    Dispatch,
    Event,
    Gesture,
    GestureKind,
    Output,
    PointedObject,
    PointedPlace,
    PointedRay,
    Pointing,
    RobotFeedback,
    Tick,
    Utterance,
    WorldUpdate,
)
from dialogue.manager import DialogueManager
from dialogue.session import Session, Task
from dialogue.table import Activity, State
from dialogue.understanding import understand as _understand
from grammar import DialogueAct, NotUnderstood, Proposer, parse
from grounding.world import World
from robot.geometry import Point, Pose
from robot.messages import Command, Feedback, Fiducials, Map, Odom
from voxml.scene import Scene
from voxml.vocabulary import Lexicon, load_lexicon


class RobotPort(Protocol):
    """What a host's robot must offer. What comes of its commands goes back through `Agent.feedback`."""

    def send(self, commands: tuple[Command, ...], ids: tuple[str, ...]) -> None:
        """Take commands, in this order. Each has an id, of as many; its feedback is to bear it.

        Called before `Agent.handle` returns, so it must not wait for the robot. ``STOP`` acts at once, whatever else
        waits. What it raises goes to the host, with the conversation as if it had been sent.
        """


def understand(
    text: str,
    world: Scene | World | None = None,
    lexicon: Lexicon | None = None,
    proposer: Proposer | None = None,
) -> dict[str, Any]:
    """What Kirby makes of one utterance by itself: see `dialogue.understanding.understand`.

    A scene stands for a world that is known in full.
    """
    words = lexicon or load_lexicon()
    model = World.explored(world) if isinstance(world, Scene) else world
    return _understand(text, model, words, lambda said: parse(said, words, proposer=proposer))


class Agent:
    """One conversation about one robot. Not for several threads at once: give each event to it in turn.

    ``world`` says what each fiducial stands for (a scene: nothing is seen yet), or gives the whole world model.
    ``clock``, in seconds, is read only where a call gives no ``time_s``; a conversation that is to outlive the process
    wants one that does, such as `time.time`. ``name`` begins every command's id: give each conversation
    its own where several reach one robot. ``proposer``, such as a `LanguageModel`, guesses what is meant where the
    grammar has no reading; a guess is asked about first. Every method that takes something in returns the outputs.
    """

    def __init__(
        self,
        world: Scene | World | None = None,
        lexicon: Lexicon | None = None,
        robot: RobotPort | None = None,
        clock: Callable[[], float] = time.monotonic,
        name: str = "k",
        proposer: Proposer | None = None,
    ) -> None:
        model = World.unexplored(world) if isinstance(world, Scene) else world or World()
        self._lexicon = lexicon or load_lexicon()
        self._proposer = proposer
        self._manager = self._manage(Session(world=model, name=name))
        self._robot = robot
        self._clock = clock

    def _manage(self, session: Session) -> DialogueManager:
        return DialogueManager(self._lexicon, self._parse, session)

    def _parse(self, text: str) -> tuple[DialogueAct, ...] | NotUnderstood:
        return parse(text, self._lexicon, proposer=self._proposer)

    # -------------------------------------------------------------- in
    def hear(self, text: str, time_s: float | None = None, confidence: float = 1.0) -> tuple[Output, ...]:
        """Someone said or typed something; ``confidence`` in [0, 1] is the recogniser's."""
        return self.handle(Utterance(text, self._time(time_s), confidence))

    def point(
        self,
        at: Point | str | PointedRay,
        time_s: float | None = None,
        spread_m: float = 0.0,
        spread_rad: float = 0.0,
    ) -> tuple[Output, ...]:
        """Someone points at a place, at a thing by its id, or along a ray (map frame)."""
        match at:
            case Point():
                target: PointedPlace | PointedObject | PointedRay = PointedPlace(at)
            case str():
                target = PointedObject(at)
            case PointedRay():
                target = at
        return self.handle(Pointing(target, self._time(time_s), spread_m, spread_rad))

    def gesture(self, kind: GestureKind | str, time_s: float | None = None) -> tuple[Output, ...]:
        """Someone makes a gesture of the default set, or a learned one by its name."""
        return self.handle(Gesture(kind, self._time(time_s)))

    def feedback(self, feedback: Feedback, time_s: float | None = None) -> tuple[Output, ...]:
        """The robot says something."""
        return self.handle(RobotFeedback(feedback, self._time(time_s)))

    def world(
        self,
        odom: Odom | None = None,
        map: Map | None = None,
        fiducials: Fiducials | None = None,
        time_s: float | None = None,
    ) -> tuple[Output, ...]:
        """The robot senses something; what is not given is unchanged."""
        return self.handle(WorldUpdate(self._time(time_s), odom, map, fiducials))

    def tick(self, time_s: float | None = None) -> tuple[Output, ...]:
        """Time passes."""
        return self.handle(Tick(self._time(time_s)))

    def handle(self, event: Event) -> tuple[Output, ...]:
        """Any event. Commands among the outputs have been sent to the robot, if there is one."""
        outputs = self._manager.handle(event)
        if self._robot is not None:
            for output in outputs:
                if isinstance(output, Dispatch):
                    self._robot.send(output.commands, output.ids)
        return outputs

    # -------------------------------------------------------------- state
    def to_json(self) -> str:
        """The whole conversation; `from_json` goes on where it was."""
        return json.dumps(to_data(self.session, Session), separators=(",", ":"))

    @classmethod
    def from_json(
        cls,
        text: str,
        lexicon: Lexicon | None = None,
        robot: RobotPort | None = None,
        clock: Callable[[], float] = time.monotonic,
        proposer: Proposer | None = None,
    ) -> Agent:
        """The agent that `to_json` wrote.

        Raises:
            UnreadableError: the text is not of a session.
        """
        try:
            data = json.loads(text)
        except (json.JSONDecodeError, RecursionError):
            raise UnreadableError("a session is JSON, and this is not") from None
        agent = cls(None, lexicon, robot, clock, proposer=proposer)
        agent._manager = agent._manage(from_data(data, Session))
        return agent

    @property
    def session(self) -> Session:
        """Everything that is remembered."""
        return self._manager.session

    @property
    def state(self) -> str:
        """Where the conversation is, in words: ``idle``, ``executing``, ``awaiting choice``, ..."""
        return self.session.state.value

    @property
    def asking(self) -> bool:
        """Whether an answer is waited for."""
        return self.session.state.value.startswith("awaiting")

    @property
    def busy(self) -> bool:
        """Whether the robot is still at what it was told, and will go on by itself."""
        waits = self.asking or self.session.activity is Activity.PAUSED
        acting = any(not task.moves for task in self.session.tasks)
        return acting or (not waits and (bool(self.session.tasks) or self.session.state is not State.IDLE))

    @property
    def pose(self) -> Pose | None:
        """Where the robot is; None before it has said so."""
        return self.session.world.robot if self.session.located else None

    @property
    def queue(self) -> tuple[Task, ...]:
        """The commands that were sent and have not ended, in order."""
        return self.session.tasks

    def _time(self, time_s: float | None) -> float:
        return self._clock() if time_s is None else time_s
