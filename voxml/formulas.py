"""Habitat conditions, affordance formulas and program bodies: texts of VoxML read into types and printed back."""

from __future__ import annotations

import re

from .schema import Affordance, AxisConstraint, AxisDirection, Guard, HabitatCondition, Head, Subevent
from .terms import Form, FormError, Term, parse_term

_HEAD = re.compile(r"([a-z][a-z0-9_]*)(?:\[([0-9]+)\])?")
_HABITAT_NAME = re.compile(r"([A-Z][A-Z_]*)(?:\[([0-9]+)\])?")
_AXIS_CHAIN = re.compile(r"[XYZ](?:\s*(?:=|>=|<=|>|<)\s*[XYZ])+")
_SIGNED = re.compile(r"([a-z][a-z0-9_]*)\(([+-][XYZ])\)")
_HABITAT = re.compile(r"H(?:\[([0-9]+)\])?(,.*)?")
_SUBEVENT = re.compile(r"(e[0-9]+)\s*[:,]\s*(.+)")
_GUARD = re.compile(r"(while|if)\(")


def parse_head(text: str) -> Head:
    """``cylindroid[1]``; raises FormError on anything else."""
    match = _HEAD.fullmatch(text.strip())
    if match is None:
        raise FormError(f"'{text}' is not a shape or kind with an optional index, such as cylindroid[1]")
    return Head(match[1], None if match[2] is None else int(match[2]))


def format_head(head: Head) -> str:
    """As it is written: ``cylindroid[1]``."""
    return head.name if head.index is None else f"{head.name}[{head.index}]"


def parse_habitat(name: str, value: str) -> HabitatCondition:
    """``UP[2]`` with ``align(Y,E_y)``, ``TOP[2]`` with ``top(+Y)``, ``CONSTR[2]`` with ``X = Y = Z``."""
    match = _HABITAT_NAME.fullmatch(name.strip())
    if match is None:
        raise FormError(f"habitat name '{name}' is not capitals with an optional index, such as UP[2]")
    index = None if match[2] is None else int(match[2])
    return HabitatCondition(match[1], index, _habitat_value(value.strip()))


def _habitat_value(text: str) -> Term | AxisConstraint | AxisDirection:
    if _AXIS_CHAIN.fullmatch(text):
        parts = re.findall(r"[XYZ]|[<>=]+", text)
        return AxisConstraint(tuple(parts[::2]), tuple(parts[1::2]))
    signed = _SIGNED.fullmatch(text)
    return AxisDirection(signed[1], signed[2]) if signed else parse_term(text)


def format_habitat(condition: HabitatCondition) -> tuple[str, str]:
    """Name and value as they stand in the XML."""
    name = condition.name if condition.index is None else f"{condition.name}[{condition.index}]"
    match condition.value:
        case AxisConstraint(axes, comparisons):
            rest = "".join(f" {sign} {axis}" for sign, axis in zip(comparisons, axes[1:], strict=True))
            return name, axes[0] + rest
        case AxisDirection(predicate, direction):
            return name, f"{predicate}({direction})"
        case term:
            return name, str(term)


def parse_affordance(text: str) -> Affordance:
    """``H[2]->[put(x, in([1]))]contain([1], x)``: habitat, conditions, event, result."""
    header, arrow, rest = text.strip().partition("->[")
    match = _HABITAT.fullmatch(header)
    end = _closing_bracket(rest)
    if match is None or not arrow or end is None:
        raise FormError(f"'{text}' is not H[i](,condition)->[EVENT]RESULT")
    result = rest[end + 1 :].strip()
    return Affordance(
        int(match[1] or 0),
        _conditions(match[2] or ""),
        parse_term(rest[:end]),
        parse_term(result) if result else None,
        match[1] is not None,
    )


def _closing_bracket(text: str) -> int | None:
    depth = 1
    for at, character in enumerate(text):
        depth += {"[": 1, "]": -1}.get(character, 0)
        if depth == 0:
            return at
    return None


def _conditions(text: str) -> tuple[Form, ...]:
    if not text.strip():
        return ()
    return parse_term(f"all({text.strip().removeprefix(',')})").args


def format_affordance(affordance: Affordance) -> str:
    """As it is written: ``H[2]->[go(x, to([1]))]at(x, [1])``."""
    habitat = f"H[{affordance.habitat}]" if affordance.indexed else "H"
    conditions = "".join(f",{spaced(condition)}" for condition in affordance.conditions)
    result = "" if affordance.result is None else spaced(affordance.result)
    return f"{habitat}{conditions}->[{spaced(affordance.event)}]{result}"


def spaced(form: Form) -> str:
    """The form with a space after each comma, as affordance formulas are published."""
    if not isinstance(form, Term) or not form.args:
        return str(form)
    return f"{form.pred}({', '.join(map(spaced, form.args))})"


def parse_subevent(text: str) -> Subevent:
    """``e1:if(known(y)):reach(x,near(y))``."""
    match = _SUBEVENT.fullmatch(text.strip())
    if match is None:
        raise FormError(f"'{text}' is not a numbered subevent such as e1:rotate(x,y,z)")
    label, rest = match.groups()
    guards = []
    while (opening := _GUARD.match(rest)) is not None and (end := _closing(rest, opening.end())) is not None:
        guards.append(Guard(opening[1], parse_term(rest[opening.end() : end])))
        rest = rest[end + 2 :]
    return Subevent(label, tuple(guards), parse_term(rest))


def _closing(text: str, start: int) -> int | None:
    """Where the bracket opened before ``start`` closes, if a colon follows it."""
    depth = 1
    for at in range(start, len(text)):
        depth += {"(": 1, ")": -1}.get(text[at], 0)
        if depth == 0:
            return at if text[at + 1 : at + 2] == ":" else None
    return None


def format_subevent(subevent: Subevent) -> str:
    """As it is written: ``e1:if(bound(p)):reach(x,p)``."""
    guards = "".join(f"{guard.operator}({guard.condition}):" for guard in subevent.guards)
    return f"{subevent.label}:{guards}{subevent.event}"
