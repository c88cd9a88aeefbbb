"""Noun phrases taken apart: determiner, ordinal or superlative, noun with its adjectives, chain of modifiers."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from grammar.forms import Form, Name, Quantity, Term

DEFINITE = frozenset({"the"})
INDEFINITE = frozenset({"a", "some", "any", "another"})
PLURAL = frozenset({"all", "both", "every", "each"})
DEMONSTRATIVE = frozenset({"this", "that", "these", "those"})
DETERMINERS = DEFINITE | INDEFINITE | PLURAL | DEMONSTRATIVE
ORDINALS = {
    name: rank
    for rank, name in enumerate(
        ("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth"), start=1
    )
}
LAST = "last"
SUPERLATIVES = frozenset({"nearest", "closest", "farthest", "furthest", "next"})
ORDERINGS = frozenset(ORDINALS) | SUPERLATIVES | {LAST}
POINTED = "pointed"


@dataclass(frozen=True, slots=True)
class Description:
    """``form`` is the whole noun phrase. ``pointing`` is what fusion put there: ``pointed(...)``."""

    form: Form
    determiner: str
    noun: str
    adjectives: tuple[str, ...] = ()
    ordering: str | None = None
    modifiers: tuple[Term, ...] = ()
    pointing: Term | None = None


def describe(form: Form) -> Description | None:
    """The parts of a noun phrase; None for a form that is none (a place, a heading, a name)."""
    if not isinstance(form, Term) or form.pred not in DETERMINERS or not form.args:
        return None
    core: Form = form.args[0]
    rest = form.args[1:]
    inner: tuple[Form, ...] = ()
    ordering: str | None = None
    if isinstance(core, Term) and core.pred in ORDERINGS and core.args:
        ordering, inner = core.pred, core.args[1:]
        core = core.args[0]
    chain = [part for part in (*inner, *rest) if isinstance(part, Term)]
    adjectives = []
    while isinstance(core, Term) and len(core.args) == 1 and isinstance(core.args[0], Term):
        adjectives.append(core.pred)
        core = core.args[0]
    if not isinstance(core, Term):
        return None
    chain = [part for part in core.args if isinstance(part, Term)] + chain
    return Description(
        form,
        form.pred,
        core.pred,
        tuple(adjectives),
        ordering,
        tuple(part for part in chain if part.pred != POINTED),
        next((part for part in chain if part.pred == POINTED), None),
    )


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
    if not inner:
        yield modifier
    elif modifier.args and describe(modifier.args[-1]) is not None:
        landmark = modifier.args[-1]
        assert isinstance(landmark, Term)
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
