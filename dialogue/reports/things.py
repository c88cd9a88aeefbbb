"""What there is: what is in view, on a side, near a thing; how many, whether, which."""

from __future__ import annotations

from dialogue.wording import listed, phrase, plural, unresolved
from grammar.forms import Form, Term
from grounding import Reason, Unresolved, resolve
from grounding.view import in_view

from .asked import THING, Asked, Needs, Report, bare, capital, uncapital

_ANYONE = frozenset({"someone", "anyone"})
_ANYTHING = frozenset({"anything", "something", "what"}) | _ANYONE


def see(asked: Asked) -> Report:
    """What is in view, or in some place."""
    what, *places = asked.args
    if what == Term("what") and not places:
        return _all_in_view(asked)
    noun = what.args[0] if isinstance(what, Term) and what.args else THING
    things = asked.fitting(noun, tuple(places))
    if not things:
        kind = "nothing" if noun == THING else f"no {_plural(noun)}"
        return Report(f"I know of {kind} {' '.join(map(phrase, places))}".rstrip())
    return Report(f"{capital(listed(asked.names(things), 'and'))}", things)


def _all_in_view(asked: Asked) -> Report:
    things = in_view(asked.world)
    if things:
        return Report(f"I see {listed(asked.names(things), 'and')}", things)
    known = asked.world.entities.items
    if not known:
        return Report("I see nothing that I know")
    return Report(f"Nothing from here, but I know of {listed(asked.names(known), 'and')}", known)


def count(asked: Asked) -> Report:
    """How many there are."""
    noun, places = bare(asked.args[0], asked.args[1:])
    things = asked.fitting(noun, places)
    where = " ".join(map(phrase, places))
    number = f"{len(things)} {phrase(noun)}" if len(things) == 1 else f"{len(things) or 'no'} {_plural(noun)}"
    return Report(f"I know of {number} {where}".rstrip(), things)


def _plural(noun: Form) -> str:
    return plural(phrase(bare(noun, ())[0]))


def list_(asked: Asked) -> Report:
    """Everything of a kind."""
    things = asked.fitting(asked.args[0], ())
    return Report(capital(listed(asked.names(things), "and")) if things else "None that I have seen", things)


def exists(asked: Asked) -> Report:
    """Whether there is such a thing, and which."""
    what, *places = asked.args
    if isinstance(what, Term) and what.pred in _ANYTHING:
        noun = Term("person") if what.pred in _ANYONE else THING
        what = Term("a", (noun, *what.args, *places))
    outcome = resolve(what, asked.world, asked.lexicon)
    if isinstance(outcome, Unresolved):
        if outcome.reason is Reason.NEEDS_POINTING:
            raise Needs(outcome)
        return Report(f"No, {uncapital(unresolved(outcome))}".rstrip(".").replace(" an object", " anything"))
    things = asked.things(what)
    return Report(f"Yes: {listed(asked.names(things), 'and')}", things)


def which(asked: Asked) -> Report:
    """Which of them it is."""
    things = asked.things(Term("the", asked.args))
    return Report(capital(listed(asked.names(things), "or")), things)
