"""What people say before they have said it: mended as a listener would."""

from __future__ import annotations

import pytest

from grammar import DialogueAct, Function, parse


def forms(text: str) -> list[str]:
    acts = parse(text)
    assert isinstance(acts, tuple), (text, acts)
    return [str(act.form) for act in acts]


@pytest.mark.parametrize(
    ("text", "form"),
    [
        ("uh turn um left", "turn(left)"),
        ("turn turn left", "turn(left)"),
        ("go to the go to the door", "go(to(the(door)))"),
        ("mo- move forward two meters", "go(forward,2m)"),
        ("move ff four feet forward", "go(forward,1.2192m)"),
        ("go forward ten deg ten feet", "go(forward,3.048m)"),
        ("turn thirty grees to the left", "turn(left,30deg)"),
        ("turn left, i mean right", "turn(right)"),
        ("turn left, no, right", "turn(right)"),
        ("turn left forty, no, fifty degrees", "turn(left,50deg)"),
        ("go forward two, no, three meters", "go(forward,3m)"),
        ("turn left sorry go forward", "go(forward)"),
        ("can you move can you turn to your right thirty degrees", "turn(right,30deg)"),
        ("go to the red block no the blue one", "go(to(the(blue(one))))"),
        ("forty five degrees uh turn right", "turn(right,45deg)"),
    ],
)
def test_the_mended_words_are_what_is_meant(text: str, form: str) -> None:
    assert forms(text) == [form]


def test_digits_said_one_by_one_are_no_repeat() -> None:
    assert forms("go to 2 2") == ["go(to(point(2m,2m)))"]


@pytest.mark.parametrize("text", ["no no", "no no no", "sorry", "excuse me"])
def test_what_may_mean_stop_is_not_taken_for_a_slip(text: str) -> None:
    assert forms(text) == ["stop"]


@pytest.mark.parametrize(
    ("text", "form"),
    [("no, the other one", "the(other(one))"), ("i mean left", "left"), ("no, turn right", "turn(right)")],
)
def test_what_begins_by_taking_back_is_a_correction(text: str, form: str) -> None:
    acts = parse(text)
    assert isinstance(acts, tuple)
    assert [(act.function, str(act.form)) for act in acts] == [(Function.CORRECT, form)]


def test_an_order_to_stop_is_no_correction() -> None:
    assert parse("no, stop") == (DialogueAct(Function.INSTRUCT, acts_form("stop"), (4, 8)),)


def acts_form(text: str) -> object:
    from grammar import parse_form

    return parse_form(text)


@pytest.mark.parametrize("text", ["!!h\ufffdno\ufffd! tbvq", ".no go", "! no, turn left", ", i mean go forward"])
def test_a_repair_of_nothing_raises_nothing(text: str) -> None:
    parse(text)
