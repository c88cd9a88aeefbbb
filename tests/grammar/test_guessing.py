"""What cannot be read is said again with a verb of the program that was guessed, and is asked about, never done."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grammar import DialogueAct, Function, NotUnderstood, Term, parse
from grammar.guessing import Guesser, Proposer
from grammar.reader import Reader
from voxml.vocabulary import load_lexicon

LEXICON = load_lexicon()
READER = Reader(LEXICON)
GUESSER = Guesser(LEXICON, READER)
WORDS = sorted(LEXICON.vocabulary())


def always(pred: str | None) -> Proposer:
    """A proposer that is sure of one program, whatever is said."""
    return lambda words: pred


def guessed(text: str, pred: str) -> tuple[str, str | None] | None:
    acts = parse(text, proposer=always(pred))
    return None if isinstance(acts, NotUnderstood) else (str(acts[0].form), acts[0].repaired)


@pytest.mark.parametrize(
    ("text", "pred", "form", "asked"),
    [
        ("scrondle a meter forwards", "go", "go(forward,1m)", "go a meter forwards"),
        ("scrondle yourself a meter forwards-ish", "go", "go(forward,1m)", "go a meter forwards"),
        ("could you flomber to the red block", "go", "go(to(the(red(block))))", "could you go to the red block"),
        ("flomber slowly to your left", "turn", "slowly(turn(left))", "turn slowly to your left"),
        ("grunch down the blue box", "find", "find(the(blue(box)))", "find the blue box"),
        ("grunch a photo of the door", "take_picture", "take_picture(the(door))", "make a photo of the door"),
    ],
)
def test_a_guess_is_the_persons_words_with_a_verb_that_is_known(text: str, pred: str, form: str, asked: str) -> None:
    assert guessed(text, pred) == (form, asked)


@pytest.mark.parametrize(
    ("text", "pred"),
    [
        ("never scrondle to the door", "go"),  # forbids
        ("scrondle to the door if you see a block", "go"),  # on a condition
        ("go to the flomber", "go"),  # where to is not known
        ("scrondle ten degrees to the kitchen", "go"),  # an amount may not be lost
        ("the grunch was a flomber of scrondles", "go"),  # too much is unknown
        ("flomber grunch", "dock"),  # everything is
        ("scrondle a meter forwards", "sing"),  # no such program
    ],
)
def test_nothing_is_guessed_where_more_than_the_verb_would_have_to_be(text: str, pred: str) -> None:
    assert guessed(text, pred) is None


def test_of_several_clauses_those_are_guessed_that_cannot_be_read() -> None:
    acts = parse("turn left and scrondle to the door, then take a picture", proposer=always("go"))
    assert isinstance(acts, tuple)
    assert [str(act.form) for act in acts] == ["turn(left)", "go(to(the(door)))", "take_picture"]
    assert {act.repaired for act in acts} == {"turn left, then go to the door, then take a picture"}


def test_a_clause_is_not_lost_with_its_verb() -> None:
    assert guessed("turn left and scrondle", "turn") is None
    assert guessed("scrondle to the box and the chair", "go") == (
        "go(to(and(the(box),the(chair))))",
        "go to the box and the chair",
    )


def test_what_may_be_meant_to_stop_stops() -> None:
    assert parse("grunch it now", proposer=always("stop")) == (DialogueAct(Function.INSTRUCT, Term("stop"), (0, 13)),)


def test_what_can_be_read_is_not_guessed_at() -> None:
    assert guessed("turn left", "go") == ("turn(left)", None)


def test_a_classifier_sees_amounts_by_their_dimension() -> None:
    assert GUESSER.words("uh scrondle three and a half feet, to the left") == (
        "scrondle", "<metre>", "to", "the", "left",
    )  # fmt: skip


@given(
    st.lists(st.one_of(st.sampled_from(WORDS), st.sampled_from(["scrondle", "flomber", "2", "ten"])), max_size=8),
    st.sampled_from(sorted(GUESSER.programs)),
)
def test_whatever_is_guessed_is_an_instruction_that_says_what_it_was_taken_for(words: list[str], pred: str) -> None:
    text = " ".join(words)
    acts = GUESSER.guess(text, always(pred))
    if acts is not None and acts[0].form != Term("stop"):
        (said,) = {act.repaired for act in acts}
        assert said is not None
        assert all(act.function is Function.INSTRUCT for act in acts)
        assert [replace(act, span=(0, len(text)), repaired=said) for act in READER.read(said)] == list(acts)
