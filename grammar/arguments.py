"""Verbs and what was said with them: which program is meant, and which argument fills which place of its entry."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from enum import Enum

from voxml.schema import Argument, ProgramEntry
from voxml.terms import Form, Name, Quantity, Term, Unit
from voxml.vocabulary import Lexicon, Reading

from . import phrases
from .machine import Refused

_UNIT_TYPES = {Unit.METRE: "length", Unit.DEGREE: "angle", Unit.SECOND: "duration", Unit.COUNT: "count"}
_TYPE_UNITS = {name: unit for unit, name in _UNIT_TYPES.items()}
_QUANTITIES = frozenset(_TYPE_UNITS)
_THINGS = frozenset({"physobj", "location", "human", "artifact", "any"})
_FORWARD = Term("forward")
_VAGUE = (Term("little"), Term("max"))
_NO_PLACES = frozenset({"for", "with", "without", "of"})  # relations that say nothing of where
_ON_THE_WAY = frozenset({"via", "through"})
BARE_DEGREES_MIN = 5  # nobody means degrees by "turn left two"


class Kind(Enum):
    """What an argument is by its shape, before a verb makes something of it."""

    AXIS = "axis"
    SIDE = "side"
    HEADING = "heading"
    QUANTITY = "quantity"
    NUMBER = "number"
    VAGUE = "vague"
    PATH = "path"  # a path relation with its place
    PLACE = "place"  # a place word: there, here
    LOCATION = "location"  # a locative relation with its place
    FACING = "facing"
    OF = "of"
    WAY = "way"
    PHRASE = "phrase"
    MANNER = "manner"
    REPEAT = "repeat"
    EVENT = "event"
    MEASURE = "measure"  # an amount with what it measures: a radius of two metres


_SAID = {
    Kind.AXIS: "forward or back",
    Kind.SIDE: "left or right",
    Kind.HEADING: "a compass heading",
    Kind.QUANTITY: "an amount",
    Kind.NUMBER: "a number",
    Kind.VAGUE: "an amount",
    Kind.PATH: "a way to go",
    Kind.PLACE: "here or there",
    Kind.LOCATION: "a place",
    Kind.FACING: "what to face",
    Kind.OF: "of what",
    Kind.WAY: "which way",
    Kind.PHRASE: "a thing or place",
    Kind.MEASURE: "a measure",
    Kind.EVENT: "something to do",
}


@dataclass(frozen=True, slots=True)
class Arg:
    """One argument as it was said: a form, or the readings of an event noun ("a picture")."""

    kind: Kind
    form: Form
    readings: tuple[Reading, ...] = ()


Args = tuple[Arg, ...]


class ArgumentFitter:
    """Makes a program's form of a verb and its arguments, by the types of the lexicon."""

    def __init__(self, lexicon: Lexicon) -> None:
        self._lexicon = lexicon

    def program(self, readings: Iterable[Reading], args: Args) -> Form:
        """The first reading that the arguments fit.

        Raises:
            Refused: they fit none; the reason is that of the first reading.
        """
        reason = ""
        if not args:  # said alone, a verb is rather one that takes nothing
            readings = sorted(readings, key=lambda reading: bool(_slots(reading.entry)))
        for reading in readings:
            try:
                return self._fit(reading, args)
            except Refused as refusal:
                reason = reason or str(refusal)
        legs = self._legs(readings, args)
        if legs is not None:
            return legs
        raise Refused(reason or "something else to do")

    def _legs(self, readings: Iterable[Reading], args: Args) -> Form | None:
        """Several paths are gone one after the other: "out of this room into the next one"."""
        paths = [index for index, arg in enumerate(args) if arg.kind is Kind.PATH]
        if len(paths) < 2:
            return None
        legs = (args[: paths[1]], args[paths[1] :])
        if _is_on_the_way(args[paths[1]]) and not _is_on_the_way(args[paths[0]]):
            legs = (legs[1], legs[0])
        first, rest = (self.program(readings, leg) for leg in legs)
        return Term("seq", (first, *(rest.args if isinstance(rest, Term) and rest.pred == "seq" else (rest,))))

    def implied(self, args: Args, preds: tuple[str, ...]) -> Form | None:
        """The program that arguments without a verb say all of: a side with an angle, a way with a distance."""
        if len(args) < 2 or any(arg.kind is Kind.NUMBER and not _may_be_degrees(arg.form) for arg in args):
            return None
        try:
            return self.program([Reading(self._lexicon.programs[pred]) for pred in preds], args)
        except Refused:
            return None

    def _fit(self, reading: Reading, args: Args) -> Form:
        entry = reading.entry
        bound: dict[str, Form] = {}
        wrappers: list[Term] = []
        repeats: list[Form] = []
        said = [_given(reading.gives), *args] if reading.gives is not None else list(args)
        for arg in said:
            if arg.kind is Kind.MANNER:
                assert isinstance(arg.form, Term)
                wrappers.append(arg.form)
            elif arg.kind is Kind.REPEAT:
                repeats.append(arg.form)
            else:
                self._bind(reading, bound, arg)
        _take_modifiers(entry, bound)
        missing = next((slot for slot in _slots(entry) if _needed(slot) and slot.variable not in bound), None)
        if missing is not None:
            raise Refused(_wanted(missing))
        form: Form = Term(
            entry.lex.pred, tuple(bound[slot.variable] for slot in _slots(entry) if slot.variable in bound)
        )
        for wrapper in wrappers:
            form = Term(wrapper.pred, (form,))
        for times in repeats:
            form = Term("repeat", (times, form))
        return form

    def _bind(self, reading: Reading, bound: dict[str, Form], arg: Arg) -> None:
        entry = reading.entry
        if reading.bare is False and arg.kind in (Kind.PHRASE, Kind.WAY):
            raise Refused(" or ".join(_slots(entry)[0].markers))
        for slot in _slots(entry):
            value = self._value(slot if reading.bare is None else replace(slot, bare=reading.bare), arg)
            if value is None:
                continue
            if slot.variable not in bound:
                bound[slot.variable] = value
                return
            if bound[slot.variable] == value:
                return  # "turn left ninety degrees to the left"
            if bound[slot.variable] == _FORWARD and arg.kind is Kind.HEADING:  # "forward, north"
                bound[slot.variable] = value
                return
            if arg.kind in (Kind.VAGUE, Kind.QUANTITY) and isinstance(value, Quantity) != isinstance(
                bound[slot.variable], Quantity
            ):  # "a little to the left, ten degrees"
                bound[slot.variable] = value if isinstance(value, Quantity) else bound[slot.variable]
                return
        raise Refused(f"'{entry.lex.pred.replace('_', ' ')}' without {_SAID[arg.kind]}")

    def _value(self, slot: Argument, arg: Arg) -> Form | None:
        """What the argument is in this place, or None where it does not fit."""
        types = slot.types
        match arg.kind, arg.form:
            case Kind.QUANTITY, form:
                return _said_in_full(form) if _unit_type(form) in types else None
            case Kind.NUMBER, Quantity(value=value):
                unit = next((_TYPE_UNITS[kind] for kind in types if kind in _QUANTITIES), None)
                too_few = unit is Unit.DEGREE and not _may_be_degrees(arg.form)
                return None if unit is None or too_few else Quantity(value, unit)
            case Kind.VAGUE, form:
                return form if _QUANTITIES & set(types) - {"count"} else None
            case Kind.SIDE, form:
                return form if {"side", "rotation"} & set(types) else None
            case Kind.AXIS | Kind.HEADING | Kind.WAY as kind, form:
                return form if kind.value in types else None
            case Kind.PATH | Kind.LOCATION | Kind.FACING | Kind.OF | Kind.MEASURE, Term() as form:
                return self._relation(slot, arg.kind, form)
            case Kind.PLACE, form:
                return self._place(slot, form)
            case Kind.PHRASE, form:
                return form if slot.bare and self._is_of_type(form, types) else None
        return None

    def _relation(self, slot: Argument, kind: Kind, form: Term) -> Form | None:
        """A landmark without the relation that marks it; a place with its relation, of those that the place names."""
        if slot.markers and "place" in slot.types:
            return form if form.pred in slot.markers else None
        if form.pred in slot.markers and len(form.args) == 1 and self._marked(slot, form.args[0]):
            return form.args[0]
        if form.pred in _NO_PLACES:
            return None
        wanted = {Kind.PATH: {"path"}, Kind.LOCATION: {"place", "path"}}.get(kind, set())
        return form if wanted & set(slot.types) else None

    def _marked(self, slot: Argument, form: Form) -> bool:
        if isinstance(form, Term) and not form.args and form.pred in slot.types:
            return True
        if isinstance(form, Quantity):
            return _UNIT_TYPES[form.unit] in slot.types
        return self._is_of_type(form, slot.types)

    def _place(self, slot: Argument, form: Form) -> Form | None:
        if not slot.bare:
            return None
        if "path" in slot.types:
            return Term("to", (form,))
        return form if {"place", "location"} & set(slot.types) else None

    def _is_of_type(self, form: Form, types: tuple[str, ...]) -> bool:
        """Whether a phrase may stand where one of these types is wanted; what has no noun of its own fits all."""
        if "name" in types and isinstance(form, Name):
            return True
        wanted = _THINGS & set(types)
        if not wanted:
            return False
        if "any" in wanted:
            return True
        entry = self._lexicon.objects.get(head_noun(form))
        return entry is None or bool(wanted & set(entry.lex.types))


def head_noun(form: Form) -> str:
    """The noun at the heart of a phrase: ``the(first(red(block),on(left)))`` -> ``block``."""
    while isinstance(form, Term) and form.args:
        form = form.args[0]
    return form.pred if isinstance(form, Term) else ""


def _is_on_the_way(arg: Arg) -> bool:
    """Whether a path is gone before the goal that is named: "to the kitchen via the hallway"."""
    return isinstance(arg.form, Term) and arg.form.pred in _ON_THE_WAY


def _take_modifiers(entry: ProgramEntry, bound: dict[str, Form]) -> None:
    """A verb's own preposition outranks its noun's: "search the kitchen for a cup", "put the box on the table"."""
    for slot in _slots(entry):
        if slot.bare or slot.variable in bound:
            continue
        for variable, form in bound.items():
            parted = phrases.parted(form, frozenset(slot.markers))
            if parted is not None:
                modifier = parted[1]
                is_place = not slot.markers
                bound[variable], bound[slot.variable] = parted[0], modifier if is_place else modifier.args[0]
                break


def _given(form: Form) -> Arg:
    if form in _VAGUE:
        return Arg(Kind.VAGUE, form)
    return Arg(Kind.AXIS if isinstance(form, Term) and not form.args else Kind.PATH, form)


def _slots(entry: ProgramEntry) -> tuple[Argument, ...]:
    return tuple(slot for slot in entry.args if "agent" not in slot.types)


def _needed(slot: Argument) -> bool:
    return not slot.optional and slot.default is None


def _wanted(slot: Argument) -> str:
    return " or ".join(kind if kind not in _THINGS else "a thing or place" for kind in slot.types[:1])


def _unit_type(form: Form) -> str:
    while isinstance(form, Term) and form.args:  # more(2m)
        form = form.args[0]
    return _UNIT_TYPES[form.unit] if isinstance(form, Quantity) else ""


def _said_in_full(form: Form) -> Form:
    """ "another two feet" with its verb is two feet."""
    return form.args[0] if isinstance(form, Term) and isinstance(form.args[0], Quantity) else form


def _may_be_degrees(form: Form) -> bool:
    """Whether a number without its unit can be an angle: "turn left ninety", but not the "one" of "the left one"."""
    return isinstance(form, Quantity) and form.value >= BARE_DEGREES_MIN
