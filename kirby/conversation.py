"""The one loop: events in, outputs carried out. Here, and only here, the circle of the dialogue closes."""

from __future__ import annotations

import queue
import time
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

import redis

from dialogue.events import Dispatch, Event, Highlight, MoveCamera, Output, RobotFeedback, Say, Tick, Tone
from robot.messages import FeedbackCode, feedback

from .agent import Agent
from .link import Found, Garbled, LinkEvent, Lost

TICK_S = 0.5

Happening = Event | LinkEvent
Watcher = Callable[[Happening, tuple[Output, ...]], None]


class Speaker(Enum):
    """Who a line of the transcript comes from."""

    PERSON = "You"
    KIRBY = "Kirby"
    SYSTEM = "--"


@dataclass(frozen=True, slots=True)
class Line:
    """One line of the transcript."""

    speaker: Speaker
    text: str
    tone: Tone = Tone.REPLY


class Conversation:
    """An agent, a robot on the other end of a link, and someone to show the transcript to.

    `deliver` may be called from any thread; `step` belongs to one.
    """

    def __init__(
        self,
        agent: Agent,
        send: Callable[[Dispatch], None],
        show: Callable[[Line], None],
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.agent = agent
        self.clock = clock
        self.lost: Lost | None = None
        self._send = send
        self._show = show
        self._watchers: tuple[Watcher, ...] = ()
        self._inbox: queue.SimpleQueue[Happening] = queue.SimpleQueue()

    def deliver(self, item: Happening) -> None:
        """Queue an event for the next step."""
        self._inbox.put(item)

    @property
    def pending(self) -> bool:
        """True while delivered events wait to be handled."""
        return not self._inbox.empty()

    def watch(self, watcher: Watcher) -> None:
        """Tell ``watcher`` of everything that happens, after it has: what came in, and what came of it."""
        self._watchers = (*self._watchers, watcher)

    def unwatch(self, watcher: Watcher) -> None:
        """Tell ``watcher`` no more."""
        self._watchers = tuple(other for other in self._watchers if other != watcher)

    def step(self, timeout_s: float = TICK_S) -> tuple[Happening, tuple[Output, ...]]:
        """Handle the next event, or a tick when none comes in time; returns it with what came of it."""
        try:
            item = self._inbox.get(timeout=timeout_s)
        except queue.Empty:
            item = Tick(self.clock())
        match item:
            case Lost() | Found() | Garbled():
                self._hear_link(item)
                self._tell(item, ())
                return item, ()
        return item, self.handle(item)

    def _hear_link(self, item: Lost | Found | Garbled) -> None:
        match item:
            case Lost(reason):
                self.lost = item
                self._show(Line(Speaker.SYSTEM, reason))
            case Found():
                self.lost = None
                self._show(Line(Speaker.SYSTEM, "the robot is back"))
            case Garbled(reason):
                self._show(Line(Speaker.SYSTEM, f"passed over what the robot sent: {reason}"))

    def handle(self, event: Event) -> tuple[Output, ...]:
        """One event through the agent, and its outputs out into the world."""
        outputs = self.agent.handle(event)
        for output in outputs:
            self._carry_out(output)
        self._tell(event, outputs)
        return outputs

    def _tell(self, happening: Happening, outputs: tuple[Output, ...]) -> None:
        for watcher in self._watchers:
            watcher(happening, outputs)

    def _carry_out(self, output: Output) -> None:
        match output:
            case Say(text, tone):
                self._show(Line(Speaker.KIRBY, text, tone))
            case Dispatch():
                try:
                    self._send(output)
                except redis.RedisError as error:
                    self._refuse(output, f"not sent, for Redis does not answer ({error}): say it again")
            case Highlight() | MoveCamera():
                pass  # a terminal has nothing to light up or turn

    def _refuse(self, dispatch: Dispatch, reason: str) -> None:
        """Tell the agent that its commands came to nothing, as the robot itself would."""
        for command_id in dispatch.ids:
            self.deliver(RobotFeedback(feedback(FeedbackCode.INVALID, detail=reason, id=command_id), self.clock()))
