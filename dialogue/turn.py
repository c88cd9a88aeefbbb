"""One step of the conversation in the making: the session as it becomes, and the outputs so far."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from grammar.acts import DialogueAct, NotUnderstood
from robot.geometry import Point
from robot.messages import Command, Control, ideal_end
from voxml.vocabulary import Lexicon

from .events import Dispatch, Highlight, Output, Say, Tone
from .session import Question, Session, Task
from .table import ROBOT_TRIGGER, Activity, Trigger, advance

Parser = Callable[[str], tuple[DialogueAct, ...] | NotUnderstood]


class Turn:
    """A working copy of the session; it ends with the handling of its event.

    ``cleared`` is true once everything was canceled in this step, so that nothing stands in the way any more.
    """

    def __init__(self, session: Session, lexicon: Lexicon, parse: Parser) -> None:
        self.session = session
        self.lexicon = lexicon
        self.parse = parse
        self.outputs: list[Output] = []
        self.cleared = False

    def update(self, **changes: Any) -> None:
        """Set fields of the session."""
        self.session = replace(self.session, **changes)

    def say(self, text: str, tone: Tone = Tone.REPLY) -> None:
        self.outputs.append(Say(text, tone))

    def trigger(self, trigger: Trigger) -> None:
        """Move through the state table."""
        self.update(state=advance(self.session.state, trigger, self.session.activity))

    def robot_is(self, activity: Activity) -> None:
        """News of what the robot is at."""
        self.update(activity=activity)
        if activity in (Activity.STRAYED, Activity.LEFT_OVER):
            self.update(question=None)
        self.trigger(ROBOT_TRIGGER[activity])

    def ask(self, trigger: Trigger, question: Question) -> None:
        """Put a question in the place of any other."""
        self.update(question=question)
        self.trigger(trigger)
        self.say(question.text, Tone.QUESTION)

    def settle(self) -> None:
        """The question of Kirby's own, if there is one, is over."""
        if self.session.question is not None:
            self.update(question=None)
            self.trigger(Trigger.SETTLE)

    def dispatch(self, commands: tuple[Command, ...]) -> None:
        """Send commands; they are tasks until the robot says that they ended."""
        first = self.session.sent + 1
        tasks = tuple(Task(f"{self.session.name}{first + offset}", command) for offset, command in enumerate(commands))
        self.outputs.append(Dispatch(commands, tuple(task.id for task in tasks)))
        ideal = self.session.start
        for command in commands:
            ideal = ideal_end(ideal, command)
        moving = any(task.moves for task in tasks)
        self.cleared = self.cleared or Control.CANCEL_ALL in commands
        self.update(tasks=self.session.tasks + tasks, sent=self.session.sent + len(commands))
        if moving:
            self.update(ideal=None if Control.GO_BACK in commands else ideal)
        answered = self.session.activity in (Activity.STRAYED, Activity.LEFT_OVER)
        if moving or (answered and {Control.KEEP_GOING, Control.CONTINUE} & set(commands)):
            self.robot_is(Activity.MOVING)

    def highlight(self, entities: tuple[str, ...], places: tuple[Point, ...]) -> None:
        """Show what was understood to be meant."""
        if entities or places:
            self.outputs.append(Highlight(entities, places))
