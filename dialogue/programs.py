"""Programs of the lexicon, unfolded: a grounded form -> the events of its VoxML body, with the arguments filled in."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from grammar.forms import Form, Name, Quantity, Term, Unit
from grounding.relations import COMPASS_RAD
from voxml.schema import Argument, ProgramEntry

AGENT = "agent"
_UNITS = {"length": Unit.METRE, "angle": Unit.DEGREE, "duration": Unit.SECOND, "count": Unit.COUNT}
_AXES = frozenset({"forward", "back"})
_SIDES = frozenset({"left", "right"})
_VAGUE = frozenset({"little", "max"})
_PATHS = frozenset({"to", "toward", "away_from", "through", "past", "around", "along", "across", "into", "out_of"})
_NO_PHRASES = _AXES | _SIDES | _PATHS | frozenset(COMPASS_RAD)


def _is_unit(unit: Unit) -> Callable[[Form], bool]:
    def fits(form: Form) -> bool:
        if isinstance(form, Term) and form.pred == "more" and form.args:
            return fits(form.args[0])
        return form.unit is unit if isinstance(form, Quantity) else _is_bare(form, _VAGUE)

    return fits


def is_amount(form: Form) -> bool:
    """A quantity, a vague one ("a little"), or what is to be added to one ("two more feet")."""
    if isinstance(form, Term):
        return is_amount(form.args[0]) if form.pred == "more" and form.args else _is_bare(form, _VAGUE)
    return isinstance(form, Quantity)


def _is_bare(form: Form, preds: frozenset[str]) -> bool:
    return isinstance(form, Term) and not form.args and form.pred in preds


def is_way(form: Form) -> bool:
    """ "This way", "that way"."""
    return isinstance(form, Term) and bool(form.args) and form.args[0] == Term("way")


def _is_path(form: Form) -> bool:
    return isinstance(form, Term) and (form.pred in _PATHS or form.pred in ("there", "here"))


def _is_phrase(form: Form) -> bool:
    """A noun phrase, a pronoun, a place or a name: whatever was not claimed by a narrower type."""
    if isinstance(form, Name):
        return True
    return isinstance(form, Term) and not is_amount(form) and form.pred not in _NO_PHRASES


_FITS: Mapping[str, Callable[[Form], bool]] = {
    **{name: _is_unit(unit) for name, unit in _UNITS.items()},
    "axis": lambda form: _is_bare(form, _AXES),
    "side": lambda form: _is_bare(form, _SIDES),
    "rotation": lambda form: _is_bare(form, _SIDES),
    "heading": lambda form: _is_bare(form, frozenset(COMPASS_RAD)),
    "way": is_way,
    "path": _is_path,
    "name": lambda form: isinstance(form, Name),
}


def bind(entry: ProgramEntry, args: tuple[Form, ...], endless: bool = False) -> dict[str, Form] | None:
    """The arguments of a form, by the variables of its program; defaults where nothing was said.

    An argument goes to the first variable that is still free and whose type it fits. None when one fits nowhere.
    ``endless`` takes for the default of an amount not this much but as much as there is.
    """
    bound: dict[str, Form] = {}
    for value in args:
        slot = next((arg for arg in entry.args if arg.variable not in bound and _fits(arg, value)), None)
        if slot is None:
            return None
        bound[slot.variable] = value
    for arg in entry.args:
        if arg.default is not None:
            bound.setdefault(arg.variable, _most(arg) if endless else arg.default)
    return bound


def _most(argument: Argument) -> Form:
    assert argument.default is not None
    if "length" in argument.types:
        return Term("max")
    return Quantity(360.0, Unit.DEGREE) if "angle" in argument.types else argument.default


def _fits(argument: Argument, value: Form) -> bool:
    return any(_FITS.get(kind, _is_phrase)(value) for kind in argument.types if kind != AGENT)


def substitute(event: Term, bound: Mapping[str, Form], variables: frozenset[str]) -> Term:
    """The event with its variables filled in. A variable without a value is left out, as in the notation."""
    args: list[Form] = []
    for arg in event.args:
        if isinstance(arg, Term) and not arg.args and arg.pred in variables:
            if arg.pred in bound:
                args.append(bound[arg.pred])
        else:
            args.append(substitute(arg, bound, variables) if isinstance(arg, Term) else arg)
    return replace(event, args=tuple(args))
