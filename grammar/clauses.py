"""The clauses of an utterance put together: what repeats, completes, teaches, calls off or corrects what."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from voxml.terms import Form, Term

from .acts import Function
from .ellipsis import Completer

_SOCIAL = frozenset({Function.ACKNOWLEDGE, Function.GREET, Function.THANK, Function.BYE, Function.CONFIRM})
_STOP = Term("stop")
_GO = Term("go")
_AGAIN = Term("again")


@dataclass(frozen=True, slots=True)
class Clause:
    """One act and the tokens it was read from, ``[start, end)``; ``before`` where it was said to come first."""

    function: Function
    form: Form
    start: int
    end: int
    before: bool = False


Clauses = tuple[Clause, ...]


@dataclass(frozen=True, slots=True)
class Composer:
    """Composes clauses, with the words of one lexicon. ``is_control``: a form tells the robot's queue what to do."""

    completer: Completer
    is_control: Callable[[Form], bool]

    def composed(self, clauses: Clauses, corrects: bool) -> Clauses:
        """The acts in the order in which they are to be done; ``corrects``: the utterance takes something back."""
        clauses = _taught(self._completed(_repeated(_without_setting_out(clauses))))
        clauses = self._called_off(_ordered(clauses))
        return self._corrected(_without_pleasantries(clauses), corrects)

    def _completed(self, clauses: Clauses) -> Clauses:
        """Fragments behind an instruction are instructions of the same kind, where they fit it."""
        made: list[Clause] = []
        for clause in clauses:
            form = None
            if made and made[-1].function is Function.INSTRUCT and clause.function is Function.FRAGMENT:
                form = self.completer.completed(made[-1].form, clause.form)
            made.append(clause if form is None else replace(clause, function=Function.INSTRUCT, form=form))
        return tuple(made)

    def _called_off(self, clauses: Clauses) -> Clauses:
        """ "turn left, never mind": what is called off before it was sent is not sent."""
        last = max((at for at, clause in enumerate(clauses) if _is_cancel(clause.form)), default=0)
        if not last:
            return clauses
        return tuple(clause for at, clause in enumerate(clauses) if at >= last or self.is_control(clause.form))

    def _corrected(self, clauses: Clauses, corrects: bool) -> Clauses:
        """ "no, turn left" and "I mean left" correct; "no, stop" stops."""
        if len(clauses) > 1 and clauses[0].function is Function.DENY:
            corrects, clauses = clauses[1].function is not Function.QUESTION, clauses[1:]
        first, *others = clauses
        takes_back = first.function in (Function.INSTRUCT, Function.FRAGMENT) and not self.is_control(first.form)
        return (replace(first, function=Function.CORRECT), *others) if corrects and takes_back else clauses


def _without_setting_out(clauses: Clauses) -> Clauses:
    """ "go stand by the door": to go is part of what is then to be done."""
    if len(clauses) == 1:
        return clauses
    return tuple(
        clause
        for clause, following in zip(clauses, (*clauses[1:], None), strict=True)
        if clause.form != _GO or following is None or following.start > clause.end
    )


def _repeated(clauses: Clauses) -> Clauses:
    """ "A and B, twice", "twice, A and B", "A and B, and do that twice": said apart, how often counts for all of it."""
    at = next((index for index, clause in enumerate(clauses) if _is_times(clause)), None)
    if at is None or len(clauses) == 1:
        return clauses
    done = clauses[:at] if at else clauses[1:]
    rest = clauses[at + 1 :] if at else ()
    if any(clause.function is not Function.INSTRUCT for clause in done):
        return clauses
    often = clauses[at].form
    assert isinstance(often, Term)
    once = done[0].form if len(done) == 1 else Term("seq", tuple(clause.form for clause in done))
    whole = Term("repeat", (often.args[0], once))
    first, last = min(clauses[at].start, done[0].start), max(clauses[at].end, done[-1].end)
    return (Clause(Function.INSTRUCT, whole, first, last), *rest)


def _is_times(clause: Clause) -> bool:
    match clause.function, clause.form:
        case Function.FRAGMENT, Term("repeat", (_,)):
            return True
        case Function.FRAGMENT, Term("repeat", (_, again)):
            return again == _AGAIN
    return False


def _taught(clauses: Clauses) -> Clauses:
    """ "learn the loop: go forward, turn right" is one act: what follows is taught, not done."""
    first, *rest = clauses
    if not rest or not isinstance(first.form, Term) or first.form.pred != "learn" or len(first.form.args) != 1:
        return clauses
    steps = Term("seq", tuple(clause.form for clause in rest)) if len(rest) > 1 else rest[0].form
    return (replace(first, form=Term("learn", (*first.form.args, steps)), end=rest[-1].end),)


def _ordered(clauses: Clauses) -> Clauses:
    """What was said to come first, first; the same "stop" or pleasantry only once."""
    ordered: list[Clause] = []
    for clause in clauses:
        if ordered and ordered[-1].form == clause.form and (clause.form == _STOP or clause.function in _SOCIAL):
            continue
        ordered.insert(max(len(ordered) - 1, 0) if clause.before else len(ordered), clause)
    return tuple(ordered)


def _is_cancel(form: Form) -> bool:
    return isinstance(form, Term) and form.pred in ("cancel", "cancel_all")


def _without_pleasantries(clauses: Clauses) -> Clauses:
    """Pleasantries only where nothing else was said; of those "okay" only where it is all."""
    for dull in (_SOCIAL, frozenset({Function.ACKNOWLEDGE})):
        told = tuple(clause for clause in clauses if clause.function not in dull)
        if told:
            return told
    return clauses
