"""Answers to questions, from the world model and from what was said and done: short, true, in metres."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from grammar.forms import Form, Term
from grounding import Ambiguous, Entity, Grounded, Reason, Unresolved, World, resolve
from grounding.descriptions import DETERMINERS
from grounding.places import wall_ahead_m
from grounding.relations import COMPASS_RAD
from grounding.view import in_view
from robot.geometry import Point, Pose, wrap_angle
from robot.messages import GoTo, ideal_end
from voxml.vocabulary import Lexicon

from .conditions import holds
from .plans import Stops
from .session import Session
from .table import Activity
from .wording import command_words, direction, listed, metres, name_entities, phrase, place_words, plural, unresolved

ABLE = (
    "I can go forward and back, turn, go to things and places and find them, face them, patrol, take pictures, and "
    "tell you what I have seen. Say 'stop' at any time."
)
WHO = "I am Kirby, a mobile robot that you can talk to."

_COLOURS = frozenset(
    {"red", "green", "blue", "yellow", "orange", "purple", "pink", "brown", "black", "white", "gray", "beige", "cyan"}
    | {"magenta", "maroon"}
)
_ANYONE = frozenset({"someone", "anyone"})
_ANYTHING = frozenset({"anything", "something", "what"}) | _ANYONE
_NUMBERS = DETERMINERS | {"plural", "count"}
_THING = Term("object")
_NEAR_M = 1.0  # a thing this near is worth a mention when Kirby says where it is


@dataclass(frozen=True, slots=True)
class Report:
    """What to say, and the things it is about, nearest first."""

    text: str
    entities: tuple[Entity, ...] = ()


class _Needs(Exception):  # noqa: N818 - a result that ends an answer early, never seen outside this file
    def __init__(self, outcome: Unresolved) -> None:
        self.outcome = outcome


@dataclass(frozen=True, slots=True)
class _Asked:
    """A question with what it is answered from."""

    args: tuple[Form, ...]
    session: Session
    lexicon: Lexicon

    @property
    def world(self) -> World:
        return self.session.world

    def things(self, form: Form) -> tuple[Entity, ...]:
        """Everything that a description may mean: a question about several is answered for each.

        Raises:
            _Needs: nothing is meant.
        """
        match resolve(form, self.world, self.lexicon):
            case Grounded(referents):
                return tuple(each for each in referents if isinstance(each, Entity))
            case Ambiguous(_, candidates):
                return candidates
            case Unresolved() as failure:
                raise _Needs(failure)

    def names(self, things: tuple[Entity, ...]) -> tuple[str, ...]:
        return name_entities(things, self.world)


def report(question: Form, session: Session, lexicon: Lexicon) -> Report | Unresolved:
    """The answer. ``Unresolved`` where it takes a pointing to know what is asked about."""
    head, args = (question.pred, question.args) if isinstance(question, Term) else ("", ())
    answer = _ANSWERS.get(head)
    if answer is None:
        return Report(f"I can't answer that: {phrase(question)}.")
    try:
        return answer(_Asked(args, session, lexicon))
    except _Needs as needs:
        if needs.outcome.reason is Reason.NEEDS_POINTING:
            return needs.outcome
        return Report(unresolved(needs.outcome).rstrip("."))


# ------------------------------------------------------------------ where
def _where(asked: _Asked) -> Report:
    (target,) = asked.args
    if target == Term("you"):
        return _here(asked)
    meant = resolve(target, asked.world, asked.lexicon)
    if isinstance(meant, Grounded) and isinstance(meant.one, Point):
        return Report(_capital(_away("that", meant.one, asked.world.robot)))
    things = asked.things(target)
    told = [
        _away(name, thing.point, asked.world.robot) for name, thing in zip(asked.names(things), things, strict=True)
    ]
    return Report(_capital("; ".join(told)), things)


def _away(name: str, place: Point, robot: Pose) -> str:
    return f"{name} is {metres(robot.point.distance_to(place))} away, {direction(robot, place)}"


def _here(asked: _Asked) -> Report:
    robot = asked.world.robot
    near = min(asked.world.entities.items, key=lambda e: robot.point.distance_to(e.point), default=None)
    by: tuple[Entity, ...] = ()
    if near is not None and robot.point.distance_to(near.point) <= _NEAR_M:
        by = (near,)
    beside = f", by {asked.names(by)[0]}" if by else ""
    return Report(f"I am at {place_words(robot.point)}{beside}, facing {_compass(robot.yaw_rad)}", by)


def _heading(asked: _Asked) -> Report:
    return Report(f"I am facing {_compass(asked.world.robot.yaw_rad)}")


def _compass(yaw_rad: float) -> str:
    return min(COMPASS_RAD, key=lambda name: abs(wrap_angle(COMPASS_RAD[name] - yaw_rad)))


def _distance(asked: _Asked) -> Report:
    (target,) = asked.args
    robot = asked.world.robot
    if target == Term("the", (Term("wall"),)):
        ahead_m = wall_ahead_m(robot, asked.world.walls)
        return Report("I see no wall ahead" if ahead_m is None else f"The wall ahead is {metres(ahead_m)} away")
    things = asked.things(target)
    names = asked.names(things)
    told = [f"{n} is {metres(robot.point.distance_to(t.point))} away" for n, t in zip(names, things, strict=True)]
    return Report(_capital("; ".join(told)), things)


# ------------------------------------------------------------------ what there is
def _see(asked: _Asked) -> Report:
    what, *places = asked.args
    if what == Term("what") and not places:
        return _all_in_view(asked)
    noun = what.args[0] if isinstance(what, Term) and what.args else _THING
    things = _fitting(asked, noun, tuple(places))
    if not things:
        kind = "nothing" if noun == _THING else f"no {_plural(noun)}"
        return Report(f"I know of {kind} {' '.join(map(phrase, places))}".rstrip())
    return Report(f"{_capital(listed(asked.names(things), 'and'))}", things)


def _all_in_view(asked: _Asked) -> Report:
    things = in_view(asked.world)
    if things:
        return Report(f"I see {listed(asked.names(things), 'and')}", things)
    known = asked.world.entities.items
    if not known:
        return Report("I see nothing that I know")
    return Report(f"Nothing from here, but I know of {listed(asked.names(known), 'and')}", known)


def _count(asked: _Asked) -> Report:
    noun, places = _bare(asked.args[0], asked.args[1:])
    things = _fitting(asked, noun, places)
    where = " ".join(map(phrase, places))
    number = f"{len(things)} {phrase(noun)}" if len(things) == 1 else f"{len(things) or 'no'} {_plural(noun)}"
    return Report(f"I know of {number} {where}".rstrip(), things)


def _plural(noun: Form) -> str:
    return plural(phrase(_bare(noun, ())[0]))


def _bare(noun: Form, places: tuple[Form, ...]) -> tuple[Form, tuple[Form, ...]]:
    """A noun phrase without its determiner and number, and its modifiers."""
    while isinstance(noun, Term) and noun.pred in _NUMBERS and noun.args:
        first, *rest = noun.args[1:] if noun.pred == "count" else noun.args
        noun, places = first, (*rest, *places)
    return noun, places


def _fitting(asked: _Asked, noun: Form, places: tuple[Form, ...]) -> tuple[Entity, ...]:
    """The things of a kind; none if there is none of it."""
    noun, places = _bare(noun, places)
    every = Term("all", (noun, *places))
    outcome = resolve(every, asked.world, asked.lexicon)
    if isinstance(outcome, Unresolved) and (outcome.reason is not Reason.NOTHING_FITS or outcome.form != every):
        raise _Needs(outcome)
    found = outcome.referents if isinstance(outcome, Grounded) else ()
    return tuple(each for each in found if isinstance(each, Entity))


def _list(asked: _Asked) -> Report:
    things = _fitting(asked, asked.args[0], ())
    return Report(_capital(listed(asked.names(things), "and")) if things else "None that I have seen", things)


def _exists(asked: _Asked) -> Report:
    what, *places = asked.args
    if isinstance(what, Term) and what.pred in _ANYTHING:
        noun = Term("person") if what.pred in _ANYONE else _THING
        what = Term("a", (noun, *what.args, *places))
    outcome = resolve(what, asked.world, asked.lexicon)
    if isinstance(outcome, Unresolved):
        if outcome.reason is Reason.NEEDS_POINTING:
            raise _Needs(outcome)
        return Report(f"No, {_uncapital(unresolved(outcome))}".rstrip(".").replace(" an object", " anything"))
    things = asked.things(what)
    return Report(f"Yes: {listed(asked.names(things), 'and')}", things)


def _which(asked: _Asked) -> Report:
    things = asked.things(Term("the", asked.args))
    return Report(_capital(listed(asked.names(things), "or")), things)


# ------------------------------------------------------------------ what a thing is
def _what(asked: _Asked) -> Report:
    things = asked.things(asked.args[0])
    return Report("; ".join(_described(thing, asked) for thing in things).replace("; That", "; that"), things)


def _described(thing: Entity, asked: _Asked) -> str:
    marked = f" with fiducial {thing.fiducial_id}" if thing.fiducial_id and thing.type != "fiducial" else ""
    if thing.type == "fiducial":
        return f"That is fiducial {thing.id}; I don't know what it stands for"
    return f"That is {asked.names((thing,))[0]}{marked}"


def _colour(asked: _Asked) -> Report:
    things = asked.things(asked.args[0])
    told = []
    for name, thing in zip(_kinds(things), things, strict=True):
        colours = [attribute for attribute in thing.attributes if attribute in _COLOURS]
        told.append(f"{name} is {listed(colours, 'and')}" if colours else f"I don't know what color {name} is")
    return Report(_capital("; ".join(told)), things)


def _kinds(things: tuple[Entity, ...]) -> tuple[str, ...]:
    """The things by their nouns alone: what is asked about is left out of the name."""
    return tuple(f"the {thing.type.replace('_', ' ')}" for thing in things)


def _size(asked: _Asked) -> Report:
    things = asked.things(asked.args[0])
    told = []
    for name, thing in zip(asked.names(things), things, strict=True):
        depth, width, height = (metres(value) for value in thing.size_m)
        told.append(f"{name} is {width} wide, {depth} deep and {height} high")
    return Report(_capital("; ".join(told)), things)


def _shape(asked: _Asked) -> Report:
    things = asked.things(asked.args[0])
    entries = [asked.lexicon.objects.get(thing.type) for thing in things]
    shapes = ["unknown" if entry is None else entry.head.name.replace("_", " ") for entry in entries]
    told = [f"the shape of {name} is {shape}" for name, shape in zip(asked.names(things), shapes, strict=True)]
    return Report(_capital("; ".join(told)), things)


def _is(asked: _Asked) -> Report:
    subject, said = asked.args
    if subject == Term("you"):
        return _am(asked, said)
    things = asked.things(subject)
    able = _fitting(asked, *_fitted(said))
    so = tuple(thing for thing in things if thing in able)
    if len(so) == len(things):
        return Report("Yes", things)
    if so:
        return Report(f"{_capital(listed(asked.names(so), 'and'))}: yes; the others: no", things)
    if isinstance(said, Term) and said.pred in asked.lexicon.attributes and said.pred not in _COLOURS:
        return Report(f"I can't tell whether it is {phrase(said)}", things)
    return Report(f"No, {_as_it_is(asked, said, things)}", things)


def _as_it_is(asked: _Asked, said: Form, things: tuple[Entity, ...]) -> str:
    """What is so instead of what was asked."""
    if isinstance(said, Term) and said.pred in asked.lexicon.relations:
        return _uncapital(_where(_Asked((asked.args[0],), asked.session, asked.lexicon)).text)
    return f"{'that is' if len(things) == 1 else 'those are'} {listed(asked.names(things), 'and')}"


def _fitted(said: Form) -> tuple[Form, tuple[Form, ...]]:
    """What is said of a thing, as a noun with its modifiers: ``red``, ``on(left)``, ``a(door)``."""
    if isinstance(said, Term) and said.pred in DETERMINERS:
        return said.args[0], said.args[1:]
    if isinstance(said, Term) and not said.args:
        return Term(said.pred, (_THING,)), ()
    return _THING, (said,)


def _am(asked: _Asked, said: Form) -> Report:
    try:
        condition = Term(said.pred, (Term("you"), *said.args)) if isinstance(said, Term) else Term("is")
        return Report("Yes" if holds(condition, asked.world, asked.lexicon) else "No")
    except Stops:
        return Report("I can't tell")


# ------------------------------------------------------------------ Kirby itself
def _doing(asked: _Asked) -> Report:
    session = asked.session
    tasks = [f"'{command_words(task.command)}'" for task in session.tasks if task.moves]
    match session.activity:
        case Activity.PAUSED | Activity.LEFT_OVER:
            return Report(f"I am paused on {tasks[0]}" if tasks else "I am paused")
        case Activity.STRAYED:
            return Report("I am off my way, and ask whether to keep going or to go back")
        case Activity.PATROLLING:
            return Report("I am patrolling")
    if not tasks:
        return Report("Nothing: I am waiting for commands")
    return Report(f"I am doing {', then '.join(tasks)}")


def _going(asked: _Asked) -> Report:
    session = asked.session
    if not session.moving:
        return Report("Nowhere: I am not on my way")
    end, first = session.world.robot, True
    for task in session.tasks:
        if task.moves and (isinstance(task.command, GoTo) or first):
            end, first = ideal_end(end, task.command), False
    near = tuple(e for e in session.world.entities.items if e.point.distance_to(end.point) <= _NEAR_M)
    near = tuple(sorted(near, key=lambda e: e.point.distance_to(end.point)))[:1]
    return Report(f"To {place_words(end.point)}" + (f", by {asked.names(near)[0]}" if near else ""), near)


def _done(asked: _Asked) -> Report:
    past = asked.session.history
    if not past:
        return Report("Nothing yet")
    return Report(f"You told me to {' and '.join(command_words(c) for c in past[-1].commands)}")


def _why(asked: _Asked) -> Report:
    return Report(_capital(asked.session.reason.rstrip(".")) or "Because you told me to")


# ------------------------------------------------------------------ the table
_ANSWERS: Mapping[str, Callable[[_Asked], Report]] = {
    "where": _where,
    "heading": _heading,
    "distance": _distance,
    "measure": _distance,
    "see": _see,
    "count": _count,
    "list": _list,
    "exists": _exists,
    "which": _which,
    "what": _what,
    "describe": _what,
    "color": _colour,
    "size": _size,
    "shape": _shape,
    "is": _is,
    "who": lambda asked: Report(WHO.rstrip(".")),
    "introduce": lambda asked: Report(WHO.rstrip(".")),
    "can": lambda asked: Report(ABLE.rstrip(".")),
    "doing": _doing,
    "report": _doing,
    "going": _going,
    "done": _done,
    "why": _why,
}


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def _uncapital(text: str) -> str:
    return text if text.startswith("I ") else text[:1].lower() + text[1:]
