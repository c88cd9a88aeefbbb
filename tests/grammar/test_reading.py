"""What text means: the notation of docs/forms.md, repairs, and what must never be an order."""

from __future__ import annotations

import pytest

from grammar import DialogueAct, Function, NotUnderstood, parse


def forms(text: str) -> list[str]:
    acts = parse(text)
    assert isinstance(acts, tuple), f"{text}: {acts}"
    return [str(act.form) for act in acts]


@pytest.mark.parametrize(
    ("text", "form"),
    [
        ("go forward", "go(forward)"),
        ("go forward five feet", "go(forward,1.524m)"),
        ("three and a half meters forward", "go(forward,3.5m)"),
        ("turn left forty five degrees", "turn(left,45deg)"),
        ("move ten degrees to your left", "turn(left,10deg)"),
        ("would you mind turning around", "turn_around"),
        ("go north two meters", "go(north,2m)"),
        ("turn to your three o'clock", "face(clock(3))"),
        ("go to the first fiducial on the right", "go(to(the(first(fiducial,on(right)))))"),
        ("go to the box on the right of the table by the door", "go(to(the(box,right_of(the(table)),by(the(door)))))"),
        ("slowly go forward", "slowly(go(forward))"),
        ("go forward until you see a block", "until(see(a(block)),go(forward))"),
        ("turn left twice", "repeat(2,turn(left))"),
    ],
)
def test_instructions_have_the_forms_of_the_documentation(text: str, form: str) -> None:
    acts = parse(text)
    assert isinstance(acts, tuple)
    assert [(act.function, str(act.form)) for act in acts] == [(Function.INSTRUCT, form)]


def test_clauses_come_in_the_order_in_which_they_are_to_be_done() -> None:
    assert forms("go forward two feet, then turn right and take a picture") == [
        "go(forward,0.6096m)",
        "turn(right)",
        "take_picture",
    ]
    assert forms("take a picture but before that turn left") == ["turn(left)", "take_picture"]


def test_spans_point_at_the_words_of_each_act() -> None:
    text = "uh turn left and then go forward"
    acts = parse(text)
    assert isinstance(acts, tuple)
    assert [text[slice(*act.span)] for act in acts] == ["turn left", "go forward"]


@pytest.mark.parametrize(
    ("text", "form"),
    [
        ("turn left, I mean right", "turn(right)"),
        ("go forward two, no, three meters", "go(forward,3m)"),
        ("turn turn uh left", "turn(left)"),
        ("go for- forward two feet", "go(forward,0.6096m)"),
    ],
)
def test_self_repair_leaves_what_was_meant(text: str, form: str) -> None:
    assert forms(text) == [form]


@pytest.mark.parametrize(
    ("text", "function"),
    [
        ("where are you", Function.QUESTION),
        ("the door is open", Function.INFORM),
        ("ninety degrees", Function.FRAGMENT),
        ("no, the other one", Function.CORRECT),
        ("thank you", Function.THANK),
        ("yes", Function.CONFIRM),
    ],
)
def test_what_is_no_order_is_an_act_of_its_own(text: str, function: Function) -> None:
    acts = parse(text)
    assert isinstance(acts, tuple)
    assert acts[0].function is function


def test_what_is_not_understood_says_where_and_what_was_expected() -> None:
    failure = parse("go to the blorp")
    assert isinstance(failure, NotUnderstood)
    assert "go to the blorp"[slice(*failure.span)] == "blorp"
    assert "a thing or place" in failure.expected


def test_the_nearest_thing_that_is_understood_is_offered() -> None:
    failure = parse("turnip left ninety degrees")
    assert isinstance(failure, NotUnderstood)
    assert failure.nearest == "turn left ninety degrees"


@pytest.mark.parametrize("text", ["turn lfet", "trun left", "turn leff"])
def test_a_misspelt_word_is_repaired_and_the_act_says_so(text: str) -> None:
    acts = parse(text)
    assert isinstance(acts, tuple)
    assert [(str(act.form), act.repaired) for act in acts] == [("turn(left)", "turn left")]


@pytest.mark.parametrize("text", ["stop", "stp", "stop blorp", "oh god stop", "no stop stop you", "stahp"])
def test_whatever_may_mean_stop_stops_at_once(text: str) -> None:
    acts = parse(text)
    assert isinstance(acts, tuple)
    assert str(acts[0].form) == "stop"
    assert acts[0].repaired is None


@pytest.mark.parametrize("text", ["why didn't you stop", "i did not tell you to stop here", "stop the music"])
def test_a_stop_word_that_is_denied_or_asked_about_is_no_order(text: str) -> None:
    acts = parse(text)
    assert isinstance(acts, NotUnderstood) or acts[0].function is not Function.INSTRUCT


def test_a_line_of_a_hundred_thousand_characters_is_refused() -> None:
    assert isinstance(parse("turn left and " * 7_143), NotUnderstood)


def test_forty_clauses_are_forty_acts() -> None:
    acts = parse(" and then ".join(["turn left ninety degrees"] * 40))
    assert isinstance(acts, tuple)
    assert len(acts) == 40
    assert all(isinstance(act, DialogueAct) for act in acts)
