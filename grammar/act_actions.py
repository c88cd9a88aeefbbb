"""What the rules for acts and for commands of several parts mean, by the rule's name in the ``.lark`` file."""

from __future__ import annotations

from voxml.terms import Form, Quantity, Term

from .acts import Function
from .machine import Refused
from .phrases import ONE, pred_of
from .tables import Action

Act = tuple[Function, Form]
_AGAIN = Term("again")
_STOP = Term("stop")
_WITH_MORE = (Term("go"), Term("turn"), Term("come_here"))
_GOING_ON = (Term("go"), Term("keep_going"), Term("continue"))


def _of(kind: Function) -> Action:
    return lambda form: (kind, form)


def _says(kind: Function, pred: str) -> Action:
    return lambda form: (kind, Term(pred))


def _quality(quality: Form) -> Act:
    """ "(which one?) red"."""
    return Function.FRAGMENT, Term("the", (Term(pred_of(quality), (ONE,)),))


def _quality_of(determiner: Form, quality: Form) -> Act:
    if pred_of(determiner) == "no":
        raise Refused("a noun")
    return _quality(quality)


def _again_often(that: Form, times: Form | Quantity, *mark: Form) -> Act:
    return Function.FRAGMENT, Term("repeat", (times, _AGAIN))


def _forbidden(no: Form, what: Form) -> Act:
    """ "do not turn left"; what may not move at all stops."""
    return Function.INSTRUCT, _STOP if what in _GOING_ON else Term("not", (what,))


def _conditional(marker: Form, condition: Form, core: Form, *otherwise: Form) -> Form:
    """ "if C, A, otherwise B", "when C, A", "unless C, A"."""
    if pred_of(marker) == "unless":
        return Term("if", (Term("not", (condition,)), core, *otherwise))
    return Term(pred_of(marker), (condition, core, *otherwise))


def _until(condition: Form, core: Form) -> Form:
    """ "go forward until you see a door"; to turn until one faces something is to face it."""
    match condition, core:
        case Term("is", (Term("you"), Term("facing", (place,)))) | Term("face", (place,)), Term("turn", ()):
            return Term("face", (place,))
    return Term("until", (condition, core))


def _whole(form: Form) -> Form:
    """What is to be done, if it is all that was said of it: "when you come back" does not end behind "come"."""
    if form in _WITH_MORE:
        raise Refused("something else to do")
    return form


def _sequence(first: Form, second: Form) -> Form:
    return Term("seq", (first, second))


ACT_ACTIONS: dict[str, Action] = {
    "act_instruct": _of(Function.INSTRUCT),
    "act_question": _of(Function.QUESTION),
    "act_inform": _of(Function.INFORM),
    "act_confirm": _says(Function.CONFIRM, "yes"),
    "act_deny": _says(Function.DENY, "no"),
    "act_halt": _says(Function.INSTRUCT, "stop"),
    "act_greet": _of(Function.GREET),
    "act_thank": _of(Function.THANK),
    "act_thank_for": lambda thanks, what: (Function.THANK, thanks),
    "act_bye": _of(Function.BYE),
    "act_acknowledge": _of(Function.ACKNOWLEDGE),
    "act_praise": lambda praise, event: (Function.ACKNOWLEDGE, Term("ok")),
    "act_answer": _of(Function.ANSWER),
    "act_forbid": _forbidden,
    "act_return": _of(Function.FRAGMENT),
    "act_again": _says(Function.FRAGMENT, "again"),
    "act_again_often": _again_often,
    "act_suggest": lambda about, what: (Function.FRAGMENT, what),
    "act_quality": _quality,
    "act_quality_of": _quality_of,
    "act_number": lambda mark, number: (Function.FRAGMENT, number),
    "act_until": lambda marker, condition: (Function.FRAGMENT, Term("until", (condition,))),
    "act_not_but": lambda mark, wrong, right: (Function.CORRECT, right),
}

COMMAND_ACTIONS: dict[str, Action] = {
    "conditional": _conditional,
    "conditional_marked": lambda marker, condition, mark, core: _conditional(marker, condition, core),
    "conditional_after": lambda core, marker, condition: _conditional(marker, condition, core),
    "alternative": lambda marker, condition, core, mark, other: _conditional(marker, condition, core, other),
    "alternative_marked": lambda marker, condition, mark, core, otherwise, other: _conditional(
        marker, condition, core, other
    ),
    "until": lambda core, marker, condition: _until(condition, core),
    "until_first": lambda marker, condition, core: _until(condition, core),
    "until_first_marked": lambda marker, condition, mark, core: _until(condition, core),
    "before_first": lambda before, later, core: _sequence(core, _whole(later)),
    "before_first_marked": lambda before, later, mark, core: _sequence(core, later),
    "before_last": lambda core, before, later: core if core == _STOP else _sequence(core, later),
    "after_first": lambda after, first, core: _sequence(_whole(first), core),
    "after_first_marked": lambda after, first, mark, core: _sequence(first, core),
    "after_last": lambda core, after, first: _sequence(first, core),
    "naming": lambda call, what, name: Term("name", (what, name)),
    "naming_as": lambda call, what, mark, name: Term("name", (what, name)),
    "stopping": lambda *said: _STOP,
}
