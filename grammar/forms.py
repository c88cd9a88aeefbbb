"""Logical forms: predicate-argument terms in the notation of VoxML programs.

``go(to(the(first(fiducial,on(right)))))``, ``turn(left,45deg)``, ``go(forward,1.524m)``. A form is a `Term` (a
predicate with arguments; a bare name is a term without any), a `Quantity` (a number with its unit) or a `Name` (a
quoted text that is not vocabulary). `str` prints the canonical text and `parse_form` reads it back to the same value.
The whole notation, predicate by predicate, is in ``docs/forms.md``.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


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
    """A predicate and its arguments; ``pred`` matches ``[a-z][a-z0-9_]*``."""

    pred: str
    args: tuple[Form, ...] = ()

    def __str__(self) -> str:
        return f"{self.pred}({','.join(map(str, self.args))})" if self.args else self.pred


Form = Term | Quantity | Name
