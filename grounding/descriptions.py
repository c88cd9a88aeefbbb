"""Noun phrases taken apart: determiner, ordinal or superlative, noun with its adjectives, chain of modifiers."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from grammar.forms import Form, Name, Quantity, Term

from .ordering import ORDERINGS

DEFINITE = frozenset({"the", "your", "my", "our", "his", "her", "its", "their"})
INDEFINITE = frozenset({"a", "some", "any", "another", "either"})
PLURAL = frozenset({"all", "both", "every", "each", "most", "what", "which"})
DEMONSTRATIVE = frozenset({"this", "that", "these", "those"})
DETERMINERS = DEFINITE | INDEFINITE | PLURAL | DEMONSTRATIVE
EXCLUDING = frozenset({"another"})
"""Determiners of something else than was spoken of."""

POINTED = "pointed"
_MANY = "plural"


@dataclass(frozen=True, slots=True)
class Description:
    """``form`` is the whole noun phrase. ``pointings`` are what fusion put there: ``pointed(...)``."""

    form: Form
    determiner: str
    noun: str
    adjectives: tuple[str, ...] = ()
    ordering: str | None = None
    modifiers: tuple[Term, ...] = ()
    pointings: tuple[Term, ...] = ()
    plural: bool = False
    count: int | None = None


def describe(form: Form) -> Description | None:
    """The parts of a noun phrase; None for a form that is none (a place, a heading, a name)."""
    if not isinstance(form, Term) or form.pred not in DETERMINERS:
        return None
    parts = _peeled(form)
    core, adjectives = parts.core, []
    while len(core.args) == 1 and isinstance(inner := core.args[0], Term):
        adjectives.append(core.pred)
        core = inner
    chain = [part for part in core.args if isinstance(part, Term)] + parts.chain
    return Description(
        form,
        form.pred,
        core.pred,
        tuple(adjective for adjective in adjectives if adjective != _MANY),
        parts.ordering,
        tuple(part for part in chain if part.pred != POINTED and not _pointing_in(part)),
        tuple(filter(None, map(_pointing_in, chain))),
        _MANY in adjectives or parts.count is not None,
        parts.count,
    )


@dataclass
class _Peeled:
    """What is under the determiner, the ordering and the number, whichever of these two comes first."""

    core: Term
    chain: list[Term]
    ordering: str | None = None
    count: int | None = None


def _peeled(phrase: Term) -> _Peeled:
    """The noun with its adjectives, and what is said around it; a bare demonstrative is of some one."""
    if not phrase.args or phrase.args[0] == Term(POINTED) or _pointing_in(phrase.args[0]) is not None:
        return _Peeled(Term("one"), _terms(phrase.args))
    found = _Peeled(phrase, [])
    while True:
        match found.core:
            case Term("count", (Quantity(value=number), Term() as inner, *rest)):
                found.count = int(number)
            case Term(pred, (Term() as inner, *rest)) if found.core is phrase:
                pass
            case Term(pred, (Term() as inner, *rest)) if pred in ORDERINGS:
                found.ordering = found.ordering or pred
            case _:
                return found
        found.core, found.chain = inner, _terms(tuple(rest)) + found.chain


def _terms(parts: tuple[Form, ...]) -> list[Term]:
    return [part for part in parts if isinstance(part, Term)]


def _pointing_in(part: Form) -> Term | None:
    """``pointed(...)`` itself, or in ``there(pointed(...))``."""
    if not isinstance(part, Term):
        return None
    if part.pred == POINTED:
        return part
    first = part.args[0] if part.pred in ("there", "here") and part.args else None
    return first if isinstance(first, Term) and first.pred == POINTED else None


def attachments(modifiers: tuple[Term, ...]) -> Iterator[tuple[Term, ...]]:
    """Every way of hanging a flat chain of modifiers onto the head and onto each other's noun phrases.

    ``(on(right), by(the(door)))`` hangs both on the head; where a modifier's last argument is a noun phrase, what
    follows may belong to that instead: ``(right_of(the(table,by(the(door)))),)``. The flat reading comes first.
    """
    if not modifiers:
        yield ()
        return
    first, rest = modifiers[0], modifiers[1:]
    for taken in range(len(rest) + 1):
        inner, outer = rest[:taken], rest[taken:]
        for nested in _nested(first, inner):
            for others in attachments(outer):
                yield (nested, *others)


def _nested(modifier: Term, inner: tuple[Term, ...]) -> Iterator[Term]:
    landmark = modifier.args[-1] if modifier.args else None
    if not inner:
        yield modifier
    elif modifier.pred != "not" and isinstance(landmark, Term) and landmark.args and describe(landmark) is not None:
        for chain in attachments(inner):
            yield replace(modifier, args=(*modifier.args[:-1], with_modifiers(landmark, chain)))


def with_modifiers(phrase: Term, modifiers: tuple[Term, ...]) -> Term:
    """A noun phrase with more modifiers at the end of its chain, where the notation wants them."""
    core = phrase.args[0]
    if isinstance(core, Term) and core.pred in ORDERINGS and core.args:
        core = replace(core, args=(*core.args, *modifiers))
        return replace(phrase, args=(core, *phrase.args[1:]))
    return replace(phrase, args=(*phrase.args, *modifiers))


def number_of(modifier: Term) -> str | None:
    """The id in ``number(3)``, as it stands on a fiducial."""
    if modifier.pred != "number" or len(modifier.args) != 1:
        return None
    match modifier.args[0]:
        case Quantity(value=value):
            return str(int(value)) if value == int(value) else None
        case Name(text=text):
            return text
        case _:
            return None
