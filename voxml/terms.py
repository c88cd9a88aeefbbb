"""Terms: the one notation of logical forms, program bodies and affordance formulas.

``go(to(the(first(fiducial,on(right)))))``, ``rotate(x,y,90deg)``, ``put(x,in([1]))``. A form is a `Term` (a predicate
with arguments; a bare name is a term without any), a `Quantity` (a number with its unit) or a `Name` (a quoted text
that is not vocabulary). `str` prints the canonical text and `parse_form` reads it back to the same value. The notation,
predicate by predicate, is in ``docs/forms.md``.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import Enum

FORM_MAX_CHARS = 100_000
DEPTH_MAX = 100


class Unit(Enum):
    """Units after conversion: every length is metres and every angle degrees by the time a form is built."""

    METRE = "m"
    DEGREE = "deg"
    SECOND = "s"
    COUNT = ""


@dataclass(frozen=True, slots=True)
class Quantity:
    """A number with a unit; prints as ``1.524m``, ``45deg`` or ``3``."""

    value: float
    unit: Unit = Unit.COUNT

    def __str__(self) -> str:
        text = f"{self.value:.6f}".rstrip("0").rstrip(".")
        return f"{'0' if text == '-0' else text}{self.unit.value}"


@dataclass(frozen=True, slots=True)
class Name:
    """A quoted text: a taught name or a routine's name; prints as ``"the loop"``."""

    text: str

    def __str__(self) -> str:
        escaped = self.text.replace("\\", "\\\\").replace('"', '\\"')
        return f'"{escaped}"'


@dataclass(frozen=True, slots=True)
class Term:
    """A predicate and its arguments; ``pred`` matches ``[A-Za-z][A-Za-z0-9_]*`` (lower case in forms).

    In affordance formulas ``[1]``, a component or habitat by its number, is a predicate too.
    """

    pred: str
    args: tuple[Form, ...] = ()

    def __str__(self) -> str:
        return f"{self.pred}({','.join(map(str, self.args))})" if self.args else self.pred


Form = Term | Quantity | Name


class FormError(ValueError):
    """A text that is not of the notation; ``str()`` says where and what would be right."""


_TOKEN = re.compile(
    r"\s*(?:(?P<number>-?[0-9]+(?:\.[0-9]+)?)(?P<unit>m|deg|s)?(?![A-Za-z0-9_.])"
    r"|(?P<pred>[A-Za-z][A-Za-z0-9_]*)"
    r'|"(?P<name>(?:[^"\\]|\\["\\])*)"'
    r"|(?P<index>\[[0-9]{1,6}\])"
    r"|(?P<mark>[(),]))"
)


_PRED = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,200}")


class _Reader:
    def __init__(self, text: str) -> None:
        if len(text) > FORM_MAX_CHARS:
            raise FormError(f"form of {len(text)} characters is too long: at most {FORM_MAX_CHARS}")
        self.text = text
        self.at = 0

    def next_token(self) -> re.Match[str]:
        token = _TOKEN.match(self.text, self.at)
        if token is None:
            raise FormError(f"character {self.at + 1} of '{self.text[:80]}' is not of a form such as go(forward,1m)")
        self.at = token.end()
        return token

    def skip_mark(self, mark: str) -> bool:
        token = _TOKEN.match(self.text, self.at)
        if token is None or token["mark"] != mark:
            return False
        self.at = token.end()
        return True

    def form(self, depth: int = 0) -> Form:
        if depth > DEPTH_MAX:
            raise FormError(f"form is nested more than {DEPTH_MAX} deep")
        token = self.next_token()
        if token["number"] is not None:
            return Quantity(float(token["number"]), Unit(token["unit"] or ""))
        if token["name"] is not None:
            return Name(re.sub(r"\\(.)", r"\1", token["name"]))
        if token["index"] is not None:
            return Term(token["index"])
        if token["pred"] is None:
            raise FormError(f"character {self.at} of '{self.text[:80]}': expected a predicate, a number or a name")
        return Term(token["pred"], self.arguments(depth) if self.skip_mark("(") else ())

    def arguments(self, depth: int) -> tuple[Form, ...]:
        args = [self.form(depth + 1)]
        while self.skip_mark(","):
            args.append(self.form(depth + 1))
        if not self.skip_mark(")"):
            raise FormError(f"character {self.at + 1} of '{self.text[:80]}': expected ',' or ')'")
        return tuple(args)


def parse_form(text: str) -> Form:
    """Read a form; ``parse_form(str(form)) == form`` for every form whose numbers have at most six decimals.

    Raises:
        FormError: the text is not of the notation.
    """
    if _PRED.fullmatch(text):
        return Term(text)
    reader = _Reader(text)
    form = reader.form()
    if reader.text[reader.at :].strip():
        raise FormError(f"character {reader.at + 1} of '{text[:80]}': nothing expected after the form")
    return form


def parse_term(text: str) -> Term:
    """As `parse_form`, for a text that must be a predicate with or without arguments."""
    form = parse_form(text)
    if not isinstance(form, Term):
        raise FormError(f"'{text[:80]}' is not a predicate with arguments")
    return form
