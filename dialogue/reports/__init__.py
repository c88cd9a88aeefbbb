"""Answers to questions, from the world model and from what was said and done: short, true, in metres."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from dialogue.session import Session
from dialogue.wording import phrase, unresolved
from grammar.forms import Form, Term
from grounding import Reason, Unresolved
from voxml.vocabulary import Lexicon

from .asked import Asked, Needs, Report
from .frames import frame
from .kirby import WHO, can, doing, done, going, todo, understood, why
from .places import distance, heading, where
from .properties import colour, is_, shape, size, what
from .things import count, exists, list_, see, which

__all__ = ["QUESTIONS", "Report", "report"]


def report(question: Form, session: Session, lexicon: Lexicon) -> Report | Unresolved:
    """The answer. ``Unresolved`` where it takes a pointing to know what is asked about."""
    head, args = (question.pred, question.args) if isinstance(question, Term) else ("", ())
    answer = _ANSWERS.get(head)
    if answer is None:
        return Report(f"I can't answer that: {phrase(question)}.")
    try:
        return answer(Asked(args, session, lexicon))
    except Needs as needs:
        if needs.outcome.reason is Reason.NEEDS_POINTING:
            return needs.outcome
        return Report(unresolved(needs.outcome).rstrip("."))


_ANSWERS: Mapping[str, Callable[[Asked], Report]] = {
    "where": where,
    "heading": heading,
    "distance": distance,
    "measure": distance,
    "see": see,
    "count": count,
    "list": list_,
    "exists": exists,
    "which": which,
    "what": what,
    "describe": what,
    "color": colour,
    "size": size,
    "shape": shape,
    "is": is_,
    "who": lambda asked: Report(WHO),
    "introduce": lambda asked: Report(WHO),
    "can": can,
    "doing": doing,
    "report": doing,
    "frame": frame,
    "going": going,
    "done": done,
    "todo": todo,
    "understood": understood,
    "why": why,
}

QUESTIONS = frozenset(_ANSWERS)
"""Every kind of question that has an answer, by the head of its form."""
