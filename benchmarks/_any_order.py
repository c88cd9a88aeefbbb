"""Conversations in which anything happens in any order, and what must hold of every step of them.

A walk is drawn from a `random.Random`: hypothesis' own in the tests, so that it can shrink one that fails, and a seeded
one in `benchmarks.any_order`.
"""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from random import Random
from typing import Any, TypeVar

from dialogue import DialogueManager, Question, Session
from dialogue.codec import from_data, to_data
from dialogue.events import (
    Dispatch,
    Event,
    Gesture,
    GestureKind,
    Naming,
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
from dialogue.table import QUESTIONS
from grammar import parse
from grammar.acts import DialogueAct, Function, NotUnderstood
from grammar.forms import parse_form
from grammar.sampling import Sampler
from grounding import World
from kirby.worlds import find_world
from robot.geometry import Point, Segment
from robot.messages import Control, FeedbackCode, Fiducial, Fiducials, Map, Odom, feedback
from voxml.vocabulary import load_lexicon

Value = TypeVar("Value")
Reading = tuple[DialogueAct, ...] | NotUnderstood

STOPS = (
    "stop",
    "stop!",
    "halt",
    "please stop now",
    "kirby, stop",
    "stop and turn left",
    "turn left, stop!",
    "no no stop",
)
UNSURE = 0.3
"""How sure the recogniser is of what was hardly heard."""

FORMS = (
    "stop", "go(forward)", "turn(45deg)", "go(to(there))", "go(to(the(block)))", "go(to(that(one)))", "turn(this(way))",
    "seq(go(to(there)),go(to(that(block))))", "patrol", "keep_going", "go_back", "continue", "cancel", "cancel(all)",
    "come_here", "dance", "it", "left", "1", "the(first(one))", "the(red(one))", "there", "north", "queue", "99m",
    "the(block,near(the(table)),left_of(the(block)))", "go(to(it))", "find(the(piano))", '"rosie"', "stop_patrol",
    "until(see(a(block)),go(forward))", "when(reach(the(red(block))),turn(left))", "find(the(fiducial,number(3)))",
    "seq(go(forward),wait(5s),turn(left))", "if(exists(a(block)),turn(left),turn(right))", "visit(all(block))",
    "again", "again(left)", "more(10)", "more(little)", "other(way)", "repeat(2)", "repeat(2,again)", "45deg", "2m",
    "the(other(one))", "to(the(block))", "not(that(one))", "turn(right)", "go(to(back_there))", "back_there", "both",
    "go(through(the(wall)))", "seq(go(forward),stop,go_back)", "neither", "any", "turn(other(way))", "go(forward,0m)",
    "where(you)", "see(what)", "what(that)", "count(block,on(left))", "is(it,red)", "is(you,near(the(table)))", "why",
    "doing", "going(where)", "color(the(block))", "distance(there)", "exists(anything)", "is(this,a(cone))", "todo",
    "understood", "frame(left)", 'learn("loop",seq(go(forward),perform("loop")))', 'perform("loop")', 'learn("loop")',
    'forget("loop")', "name(that(one),the(home))", "name(this(spot),the(home))", 'name(this(one),"rosie")',
    "go(to(the(home)))", "open(the(box))", "count(the(block))", "show(the(block))", "show(your(view))", "yes", "no",
)  # fmt: skip
_NOISE = (
    "blorp",
    "",
    "the the the",
    "go to to",
    "))((",
    "turn banana degrees",
    "stp",
    "trun lfet",
    "é\u0000",
    "9" * 40,
)
_SENSES = ("1", "2", "3", "4", "5")


# ------------------------------------------------------------------ what is said
@cache
def vocabulary(samples: int, seed: int) -> Mapping[str, Reading]:
    """Texts with what they are read as: sentences sampled from the grammar, some of them damaged, and noise; and every

    form as every kind of act, repaired or not, which no sentence need say.
    """
    rng = Random(seed)
    sampler = Sampler(load_lexicon(), rng.choice)
    sampled = [sampler.sample().text for _ in range(samples)]
    damaged = ["".join(_shuffled(rng, text.split())) for text in rng.sample(sampled, samples // 4)]
    texts = {text: parse(text) for text in (*STOPS, *_NOISE, *sampled, *damaged)}
    return {
        **texts,
        **{f"{f.value} {mark}{form}": _act(f, form, mark) for f in Function for form in FORMS for mark in ("", "~")},
    }


def _shuffled(rng: Random, words: list[str]) -> list[str]:
    return [f"{word} " for word in rng.sample(words, len(words))]


def _act(function: Function, form: str, mark: str) -> tuple[DialogueAct]:
    return (DialogueAct(function, parse_form(form), (0, len(form)), form if mark else None),)


# ------------------------------------------------------------------ what happens
@dataclass
class Walk:
    """One conversation, and the time that passes in it."""

    rng: Random
    said: Mapping[str, Reading]
    texts: Sequence[str]
    time_s: float = 0.0

    def event(self, session: Session) -> Event:
        """Anything that may happen next; now and then the clock jumps."""
        self.time_s = self.rng.uniform(0, 1000) if self.rng.random() < 0.01 else self.time_s + self.rng.uniform(0, 5)
        kinds = (self._utterance, self._pointing, self._gesture, self._feedback, self._senses, self._naming, self._tick)
        (kind,) = self.rng.choices(kinds, (40, 12, 10, 20, 10, 1, 7))
        return kind(session)

    def _utterance(self, session: Session) -> Event:
        text = self.rng.choice(STOPS) if self.rng.random() < 0.05 else self.rng.choice(self.texts)
        return Utterance(text, self.time_s, UNSURE if self.rng.random() < 0.1 else 1.0)

    def _place(self) -> Point:
        return Point(self.rng.uniform(-5, 5), self.rng.uniform(-5, 5))

    def _height(self, z_m: float) -> tuple[float, float, float]:
        place = self._place()
        return place.x_m, place.y_m, z_m

    def _pointing(self, session: Session) -> Event:
        targets = (
            PointedPlace(self._place()),
            PointedObject(self.rng.choice((*_SENSES, "nothing"))),
            PointedRay(self._place(), self.rng.uniform(-4, 4)),
            PointedRay(self._place(), self.rng.uniform(-4, 4), self.rng.uniform(-1.5, 1.5), 1.2),
        )
        return Pointing(self.rng.choice(targets), self.time_s, self.rng.random(), self.rng.random())

    def _gesture(self, session: Session) -> Event:
        kind = self.rng.choice((*GestureKind, "loop", "L shape"))
        return Gesture(kind, self.time_s, at_view=self.rng.random() < 0.2)

    def _feedback(self, session: Session) -> Event:
        """Of what was sent, or of anything, or of nothing that was ever sent."""
        sent = [task.id for task in session.tasks] or ["k1"]
        name = self.rng.choice((self.rng.choice(sent), self.rng.choice(sent), f"k{self.rng.randrange(200)}", None))
        code = self.rng.choice(tuple(FeedbackCode))
        return RobotFeedback(feedback(code, at=self._place(), detail="go forward 1", id=name), self.time_s)

    def _senses(self, session: Session) -> Event:
        at, yaw_rad = self._place(), self.rng.uniform(-math.pi, math.pi)
        odom = Odom(1, 1, (at.x_m, at.y_m, 0.0), (0.0, 0.0, yaw_rad), 0.0, 0.0, self.time_s)
        seen = self.rng.sample(_SENSES, self.rng.randrange(len(_SENSES)))
        markers = Fiducials(tuple(Fiducial(name, self._height(0.1), (0.0, 0.0, yaw_rad)) for name in seen))
        walls = Map(1, 10.0, 10.0, Point(0.0, 0.0), (Segment(self._place(), self._place()),))
        parts = {"odom": odom, "fiducials": markers, "map": walls}
        chosen = {name: part for name, part in parts.items() if self.rng.random() < 0.5}
        return WorldUpdate(self.time_s, **chosen)  # type: ignore[arg-type]

    def _naming(self, session: Session) -> Event:
        return Naming(self.rng.choice((*_SENSES, "nothing")), "Rosie", self.time_s)

    def _tick(self, session: Session) -> Event:
        return Tick(self.time_s)


# ------------------------------------------------------------------ what must hold
@lru_cache(maxsize=100_000)
def _parsed(text: str) -> Reading:
    return parse(text)


def manager(said: Mapping[str, Reading], session: Session) -> DialogueManager:
    """A dialogue manager that reads the texts of the vocabulary as they stand there."""
    return DialogueManager(load_lexicon(), lambda text: said[text] if text in said else _parsed(text), session)


def beginning(rng: Random) -> Session:
    """A conversation about a world of which everything is known, or nothing yet."""
    scene = find_world("five_things")
    return Session(world=rng.choice((World.explored, World.unexplored))(scene))


def converse(rng: Random, said: Mapping[str, Reading], steps: int) -> Counter[str]:
    """A conversation of so many steps, and the same once more from its log; how often it was in which state.

    Raises:
        AssertionError: something does not hold.
    """
    session = beginning(rng)
    walk, run, log = Walk(rng, said, tuple(said)), manager(said, session), []
    states: Counter[str] = Counter()
    for _ in range(steps):
        before = run.session
        event = walk.event(before)
        outputs = run.handle(event)
        check_step(event, said, before, outputs, run.session)
        log.append((event, outputs))
        states[run.session.state.value] += 1
    check_replay(rng, said, session, log, run.session)
    return states


def check_step(
    event: Event, said: Mapping[str, Reading], before: Session, outputs: tuple[Output, ...], after: Session
) -> None:
    """What must hold whenever something has happened.

    Raises:
        AssertionError: it does not.
    """
    sent = [command for output in outputs if isinstance(output, Dispatch) for command in output.commands]
    assert (after.question is not None) == (after.state in QUESTIONS), "a question and the state must agree"
    if _is_stop(event):
        assert sent[:1] == [Control.STOP], "what stops must stop at once, before anything else"
        assert sent == [Control.STOP] or not _is_hardly_heard(event), "what was hardly heard beside it must wait"
        return
    if _stays_open(before.question, after.question):
        assert not sent, "nothing is sent while the question that guards it stays open"
    if _is_unsure(event, said):
        assert set(sent) <= {Control.STOP} or before.agenda is not None, "nothing moves by guess"
    if isinstance(event, RobotFeedback | WorldUpdate | Tick | Naming):
        asking = before.question is not None and after.question is not None
        assert not asking or not sent or set(sent) == {Control.QUEUE}, "nothing begins by itself while Kirby asks"
        assert set(sent) <= {Control.QUEUE} or before.agenda is not None, "nothing moves that nobody asked for"
    if isinstance(event, Pointing) and before.question is None:
        assert not sent or before.agenda is not None, "a hand alone answers, and orders nothing"


def _stays_open(before: Question | None, after: Question | None) -> bool:
    """Whether a question is still to be answered, though it may have been asked once more."""
    return before is not None and after is not None and replace(after, asked=before.asked) == before


def _is_stop(event: Event) -> bool:
    match event:
        case Utterance(text):
            return text in STOPS or text.removeprefix("instruct ").removeprefix("~") == "stop"
        case Gesture(GestureKind.OPEN_PALM):
            return True
        case _:
            return False


def _is_hardly_heard(event: Event) -> bool:
    return isinstance(event, Utterance) and event.confidence == UNSURE


def _is_unsure(event: Event, said: Mapping[str, Reading]) -> bool:
    """Whether nothing of what was said is sure; an utterance that stops is another matter."""
    if not isinstance(event, Utterance):
        return False
    reading = said[event.text]
    if isinstance(reading, NotUnderstood):
        return True
    stopping = any("stop" in str(act.form) for act in reading)
    return not stopping and (_is_hardly_heard(event) or all(act.repaired is not None for act in reading))


def check_replay(
    rng: Random,
    said: Mapping[str, Reading],
    begun: Session,
    log: Sequence[tuple[Event, tuple[Output, ...]]],
    ended: Session,
) -> None:
    """The log, written down and read back, gives the same outputs; and so does a conversation that was put away.

    Raises:
        AssertionError: something else comes of it.
    """
    replayed = manager(said, _through_json(begun, Session))
    put_away = rng.randrange(max(len(log), 1))
    for index, (event, outputs) in enumerate(log):
        if index == put_away:
            replayed = manager(said, _through_json(replayed.session, Session))
        assert replayed.handle(_through_json(event, Event)) == outputs, "the same events must give the same outputs"
    assert replayed.session == ended


def _through_json(value: Value, kind: Any) -> Value:
    read: Value = from_data(json.loads(json.dumps(to_data(value, kind))), kind)
    return read
