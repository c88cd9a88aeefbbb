"""What holds the words of an order and is none: forbidden, asked about, told of, called off. Any order, any words."""

from __future__ import annotations

import pytest

from grammar import DialogueAct, Function, NotUnderstood, Term, parse

ORDERS = (
    *("go forward", "turn left", "go there", "move back two feet", "go to the door", "go through the doorway"),
    *("turn around", "face north", "take a picture", "patrol", "come here", "go forward and turn left"),
)
FORBIDDING = (
    *("don't", "do not", "please don't", "no don't", "no do not", "no please don't", "wait don't", "stop don't"),
    *("no no no don't", "no you don't need to", "you don't have to", "i don't want you to", "never", "you must not"),
)
ASKING = (
    *("are you able to", "do you want to", "do you have to", "can you still", "how do i make it", "why would you"),
    *("what if you", "did you", "should i", "would you rather", "what does it mean to"),
)
TELLING = (
    *("it would be bad to", "he told me to", "you never", "i might", "they want me to", "nobody said to", "i will"),
    *(
        "i want to",
        "she asked him to",
        "the sign says",
        "i saw it",
        "you always",
        "when you",
        "before you",
        "after you",
    ),
    *(
        "instead of letting you",
        "as you",
        "because you",
        "someone should",
        "the other robot should",
        "remember when you",
    ),
)


def _acts(text: str) -> tuple[DialogueAct, ...]:
    reading = parse(text)
    return () if isinstance(reading, NotUnderstood) else reading


def _is_harmless(act: DialogueAct) -> bool:
    orders = act.function in (Function.INSTRUCT, Function.CORRECT)
    return not orders or act.form == Term("stop") or (isinstance(act.form, Term) and act.form.pred == "not")


@pytest.mark.parametrize("head", FORBIDDING)
def test_what_is_forbidden_is_not_ordered(head: str) -> None:
    said = [f"{head} {order}" for order in (*ORDERS, "turn left or go forward")]
    assert [text for text in said if not all(map(_is_harmless, _acts(text)))] == []


@pytest.mark.parametrize("head", [*ASKING, *TELLING])
def test_what_is_asked_or_told_is_not_ordered(head: str) -> None:
    said = [f"{head} {order}" for order in ORDERS]
    assert [text for text in said if not all(map(_is_harmless, _acts(text)))] == []


@pytest.mark.parametrize("end", ["never mind", "scratch that", "cancel", "no cancel that", "cancel everything"])
def test_what_is_called_off_in_one_breath_is_not_ordered(end: str) -> None:
    for order in ORDERS:
        forms = [act.form for act in _acts(f"{order} {end}")]
        assert forms
        assert all(isinstance(form, Term) and form.pred in ("cancel", "cancel_all", "stop") for form in forms), order
