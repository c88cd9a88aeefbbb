"""One step of the conversation in the making: the session as it becomes, and the outputs so far."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import reduce
from typing import Any

from grammar.acts import DialogueAct, NotUnderstood
from grammar.forms import Form
from grounding import Entity
from robot.geometry import Point
from robot.messages import Command, Control, ideal_end
from voxml.vocabulary import Lexicon

from .events import CameraMove, Dispatch, Highlight, MoveCamera, Output, Say, Tone
from .session import Question, Session, Task
from .table import ROBOT_TRIGGER, Activity, Trigger, advance
from .wording import which_one

Parser = Callable[[str], tuple[DialogueAct, ...] | NotUnderstood]


class Turn:
    """A working copy of the session; it ends with the handling of its event.

    ``sent`` are the controls that went out in this step: the robot obeys them before what is sent next, though it has
    not said so yet.
    """

    def __init__(self, session: Session, lexicon: Lexicon, parse: Parser) -> None:
        self.session = session
        self.lexicon = lexicon
        self.parse = parse
        self.outputs: list[Output] = []
        self.sent: set[Command] = set()

    def update(self, **changes: Any) -> None:
        """Set fields of the session."""
        self.session = replace(self.session, **changes)

    def say(self, text: str, tone: Tone = Tone.REPLY) -> None:
        """Kirby says it; what it refuses is the reason that it will give."""
        self.outputs.append(Say(text, tone))
        if tone is Tone.REFUSAL:
            self.update(reason=text)

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

    def ask_whether(self, acts: tuple[DialogueAct, ...], understood: str) -> None:
        """Ask whether this was meant, before anything is done about acts that were not surely understood."""
        sure = tuple(replace(act, repaired=None) for act in acts)
        self.ask(Trigger.ASK_CONFIRMATION, Question(f"Did you mean: {understood}?", sure))

    def ask_which(self, acts: tuple[DialogueAct, ...], hole: Form, candidates: tuple[Entity, ...]) -> None:
        """Show the things that may be meant, and ask which of them goes into the place of ``hole``."""
        ids = tuple(entity.id for entity in candidates)
        text = which_one(candidates, self.session.world.with_robot(self.session.start))
        self.highlight(ids, ())
        self.ask(Trigger.ASK_REFERENT, Question(text, acts, hole, ids))

    def settle(self) -> None:
        """The question of Kirby's own, if there is one, is over."""
        if self.session.question is not None:
            self.update(question=None)
            self.trigger(Trigger.SETTLE)

    def dispatch(self, commands: tuple[Command, ...]) -> tuple[str, ...]:
        """Send commands; they are tasks, by these ids, until the robot says that they ended."""
        first = self.session.sent + 1
        tasks = tuple(Task(f"{self.session.name}{first + offset}", command) for offset, command in enumerate(commands))
        ids = tuple(task.id for task in tasks)
        self.outputs.append(Dispatch(commands, ids))
        ideal = reduce(ideal_end, commands, self.session.start)
        moving = any(task.moves for task in tasks)
        self.sent.update(command for command in commands if isinstance(command, Control))
        self.update(tasks=self.session.tasks + tasks, sent=self.session.sent + len(commands))
        if moving:
            self.update(holds_camera=False, reason="")
            self.update(ideal=None if Control.GO_BACK in commands else ideal)
        answered = self.session.activity in (Activity.STRAYED, Activity.LEFT_OVER)
        if moving or (answered and {Control.KEEP_GOING, Control.CONTINUE} & set(commands)):
            self.robot_is(Activity.MOVING)
        return ids

    def move_camera(self, move: CameraMove) -> None:
        """Change the view; what nudges from now on nudges the camera, until the robot is told to move."""
        self.outputs.append(MoveCamera(move))
        self.update(holds_camera=True)

    def highlight(self, entities: tuple[str, ...], places: tuple[Point, ...]) -> None:
        """Show what was understood to be meant."""
        if entities or places:
            self.outputs.append(Highlight(entities, places))
