"""What a thing is: its kind, color, size and shape, and whether it is so."""

from __future__ import annotations

from dialogue.conditions import holds
from dialogue.plans import Stops
from dialogue.wording import listed, metres, phrase
from grammar.forms import Form, Term
from grounding import Entity
from grounding.descriptions import DETERMINERS

from .asked import THING, Asked, Report, capital
from .places import away

_COLOURS = frozenset(
    {"red", "green", "blue", "yellow", "orange", "purple", "pink", "brown", "black", "white", "gray", "beige", "cyan"}
    | {"magenta", "maroon"}
)


def what(asked: Asked) -> Report:
    """What a thing is."""
    things = asked.things(asked.args[0])
    return Report("; ".join(_described(thing, asked) for thing in things).replace("; That", "; that"), things)


def _described(thing: Entity, asked: Asked) -> str:
    marked = f" with fiducial {thing.fiducial_id}" if thing.fiducial_id and thing.type != "fiducial" else ""
    if thing.type == "fiducial":
        return f"That is fiducial {thing.id}; I don't know what it stands for"
    return f"That is {asked.names((thing,))[0]}{marked}"


def colour(asked: Asked) -> Report:
    """Which colors it has."""
    things = asked.things(asked.args[0])
    told = []
    for name, thing in zip(_kinds(things), things, strict=True):
        colours = [attribute for attribute in thing.attributes if attribute in _COLOURS]
        told.append(f"{name} is {listed(colours, 'and')}" if colours else f"I don't know what color {name} is")
    return Report(capital("; ".join(told)), things)


def _kinds(things: tuple[Entity, ...]) -> tuple[str, ...]:
    """The things by their nouns alone: what is asked about is left out of the name."""
    return tuple(f"the {thing.type.replace('_', ' ')}" for thing in things)


def size(asked: Asked) -> Report:
    """How large it is."""
    things = asked.things(asked.args[0])
    told = []
    for name, thing in zip(asked.names(things), things, strict=True):
        depth, width, height = (metres(value) for value in thing.size_m)
        told.append(f"{name} is {width} wide, {depth} deep and {height} high")
    return Report(capital("; ".join(told)), things)


def shape(asked: Asked) -> Report:
    """Which shape its kind has."""
    things = asked.things(asked.args[0])
    entries = [asked.lexicon.objects.get(thing.type) for thing in things]
    shapes = ["unknown" if entry is None else entry.head.name.replace("_", " ") for entry in entries]
    told = [f"the shape of {name} is {shape}" for name, shape in zip(asked.names(things), shapes, strict=True)]
    return Report(capital("; ".join(told)), things)


def is_(asked: Asked) -> Report:
    """Whether it is so; where it is not, what is so instead."""
    subject, said = asked.args
    if subject == Term("you"):
        return _am(asked, said)
    things = asked.things(subject)
    able = asked.fitting(*_fitted(said))
    so = tuple(thing for thing in things if thing in able)
    if len(so) == len(things):
        return Report("Yes", things)
    if so:
        return Report(f"{capital(listed(asked.names(so), 'and'))}: yes; the others: no", things)
    if isinstance(said, Term) and said.pred in asked.lexicon.attributes and said.pred not in _COLOURS:
        return Report(f"I can't tell whether it is {phrase(said)}", things)
    return Report(f"No, {_as_it_is(asked, said, things)}", things)


def _as_it_is(asked: Asked, said: Form, things: tuple[Entity, ...]) -> str:
    """What is so instead of what was asked."""
    if isinstance(said, Term) and said.pred in asked.lexicon.relations:
        return away(asked, things)
    return f"{'that is' if len(things) == 1 else 'those are'} {listed(asked.names(things), 'and')}"


def _fitted(said: Form) -> tuple[Form, tuple[Form, ...]]:
    """What is said of a thing, as a noun with its modifiers: ``red``, ``on(left)``, ``a(door)``."""
    if isinstance(said, Term) and said.pred in DETERMINERS:
        return said.args[0], said.args[1:]
    if isinstance(said, Term) and not said.args:
        return Term(said.pred, (THING,)), ()
    return THING, (said,)


def _am(asked: Asked, said: Form) -> Report:
    try:
        condition = Term(said.pred, (Term("you"), *said.args)) if isinstance(said, Term) else Term("is")
        return Report("Yes" if holds(condition, asked.world, asked.lexicon) else "No")
    except Stops:
        return Report("I can't tell")
