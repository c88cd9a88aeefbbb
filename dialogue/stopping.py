"""Stop words: what stops the robot at once, and what only says where an instruction ends."""

from __future__ import annotations

from dataclasses import replace

from grammar.acts import DialogueAct, Function
from grammar.forms import Form, Term
from voxml.vocabulary import Lexicon

STOP = Term("stop")


def stops(form: Form) -> bool:
    """Whether an instruction begins with stopping."""
    match form:
        case Term(pred="stop", args=()):
            return True
        case Term(pred="seq", args=(first, *_)):
            return stops(first)
        case _:
            return False


def stop_first(
    acts: tuple[DialogueAct, ...], text: str, lexicon: Lexicon, moving: bool = False
) -> tuple[DialogueAct, ...]:
    """The acts of an utterance with a stop in front of all others, if it is one that acts at once.

    What was told before it is not done any more ("turn left ... stop!"). Only a stop that a word joins to an
    instruction before it ("go forward and then stop") waits for its turn: it says where that one ends. So does one
    between two instructions, unless the robot is ``moving``.
    """
    steps = [index for index, act in enumerate(acts) if act.function is Function.INSTRUCT]
    between = () if moving else steps[1:-1]
    stops_at_once = (i for i in steps if i not in between and _is_at_once(acts, i, text, lexicon))
    at = next(stops_at_once, None)
    if at is None:
        return acts
    stop = acts[at]
    rest = [act for act in acts[:at] if act.function is not Function.INSTRUCT]
    if isinstance(stop.form, Term) and stop.form.pred == "seq":
        rest.append(replace(stop, form=Term("seq", stop.form.args[1:])))
    return (replace(stop, form=STOP, repaired=None), *rest, *acts[at + 1 :])


def _is_at_once(acts: tuple[DialogueAct, ...], index: int, text: str, lexicon: Lexicon) -> bool:
    act = acts[index]
    if not stops(act.form):
        return False
    if index == 0 or acts[index - 1].function is not Function.INSTRUCT or act.repaired is not None:
        return True
    return not _joins(text[acts[index - 1].span[1] : act.span[0]], lexicon)


def _joins(between: str, lexicon: Lexicon) -> bool:
    """Whether what stands between two clauses makes the second the continuation of the first; "and now" does not."""
    words = set(between.lower().replace(",", " ").split())
    joining = lexicon.closed.table("AND").keys() | lexicon.closed.table("THEN").keys()
    return bool(words & joining) and not words & lexicon.closed.table("skip").keys()
