"""The situated corpora speak of everything that the lexicon and the dialogue know: nothing spatial is left untried."""

from __future__ import annotations

import pytest

from corpora.cases import Case, DialogueCase, load_corpus
from corpora.runner import default_corpora
from dialogue.reports import QUESTIONS
from grammar import parse
from grammar.acts import DialogueAct
from grammar.forms import Form, Term
from grounding import Frame, frames_in
from grounding.ordering import ORDERINGS
from voxml.vocabulary import load_lexicon

LEXICON = load_lexicon()


def preds(form: Form) -> set[str]:
    return {form.pred}.union(*map(preds, form.args)) if isinstance(form, Term) else set()


@pytest.fixture(scope="module")
def cases() -> tuple[Case | DialogueCase, ...]:
    every = (case for path in default_corpora() for case in load_corpus(path, path.name))
    return tuple(case for case in every if case.setting.world is not None)


@pytest.fixture(scope="module")
def acts(cases: tuple[Case | DialogueCase, ...]) -> tuple[DialogueAct, ...]:
    """What is said in them."""
    said = [case.text for case in cases if isinstance(case, Case)]
    for case in cases:
        if isinstance(case, DialogueCase):
            said += [turn.event[1] for turn in case.turns if turn.event[0] == "say"]
    read = (parse(text, LEXICON) for text in said)
    return tuple(act for acts in read if isinstance(acts, tuple) for act in acts)


@pytest.fixture(scope="module")
def used(acts: tuple[DialogueAct, ...]) -> set[str]:
    return set().union(*(preds(act.form) for act in acts))


def test_there_are_many(cases: tuple[Case | DialogueCase, ...]) -> None:
    assert sum(isinstance(case, Case) for case in cases) >= 400
    assert sum(isinstance(case, DialogueCase) for case in cases) >= 60


def test_every_relation_has_a_case(used: set[str]) -> None:
    assert set(LEXICON.relations) - used == set()


def test_every_determiner_has_a_case(used: set[str]) -> None:
    asked_only = {"whose"}  # it makes a question of its own: "whose left?" asks for the frame
    assert set(LEXICON.functions) - used == asked_only
    assert "frame" in used


def test_every_ordinal_and_superlative_has_a_case(used: set[str]) -> None:
    assert ORDERINGS - used == set()


def test_every_frame_has_a_case(acts: tuple[DialogueAct, ...]) -> None:
    assert {frame for act in acts for _, frame in frames_in(act.form, LEXICON)} == set(Frame)


def test_every_kind_of_question_has_a_case(used: set[str]) -> None:
    assert set(QUESTIONS) - used == set()
