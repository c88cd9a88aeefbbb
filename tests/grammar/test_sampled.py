"""Sentences sampled from the grammar come back, and damaged ones do no harm."""

from __future__ import annotations

import random

from benchmarks import robustness, sampling
from grammar import parse
from grammar.explain import Explainer
from grammar.reader import Reader
from grammar.sampling import Sampler
from kirby import understand
from voxml.terms import parse_form
from voxml.vocabulary import load_lexicon


def test_sampled_sentences_read_back_to_the_form_they_were_sampled_from_or_are_ambiguous() -> None:
    figures = sampling.run(2_000, seed=3)
    assert figures["lost_sentences"] == []
    assert figures["heard_as_slip"] < 0.01 * figures["sentences"]
    assert figures["same"] > 0.9 * figures["sentences"]


def test_what_shifting_rules_out_is_read_where_nothing_else_is() -> None:
    for text, form in (
        ("the second or both of them", "or(the(second(one)),both)"),
        ("go to the first door four times", "repeat(4,go(to(the(first(door)))))"),
    ):
        acts = parse(text)
        assert isinstance(acts, tuple)
        assert [str(act.form) for act in acts] == [form]


def test_what_looks_like_a_slip_of_the_tongue_is_read_as_it_stands_where_it_makes_no_sense_otherwise() -> None:
    for text, form in (("i am sorry", "stop"), ("uh huh", "yes")):
        acts = parse(text)
        assert isinstance(acts, tuple)
        assert [str(act.form) for act in acts] == [form]


def test_sampled_forms_print_and_read_back() -> None:
    sampler = Sampler(load_lexicon(), random.Random(4).choice)
    for _ in range(500):
        form = sampler.sample().form
        assert str(parse_form(str(form))) == str(form)


def test_the_same_seed_samples_the_same_sentences() -> None:
    lexicon = load_lexicon()
    one, other = (Sampler(lexicon, random.Random(9).choice) for _ in range(2))
    assert [one.sample() for _ in range(20)] == [other.sample() for _ in range(20)]


def test_damaged_sentences_raise_nothing_and_move_nothing_unless_understood() -> None:
    figures = robustness.run(1_500, seed=2)
    assert (figures["raised"], figures["moved_though_not_understood"]) == (0, 0)


def test_an_explanation_names_the_words_that_were_read_and_the_rules() -> None:
    lexicon = load_lexicon()
    explained = Explainer(Reader(lexicon), lexicon).explain("uh turn left, no, right and take a picture")
    assert [token.text for token in explained.tokens] == ["turn", "right", "and", "take", "a", "picture"]
    leaves = [[(leaf.label, leaf.words) for leaf in tree.leaves()] for tree in explained.trees]
    assert leaves[0] == [("VERB", "turn"), ("SIDE", "right")]
    assert leaves[1][-1] == ("EVENT", "picture")


def test_to_lead_short_of_somebody_is_refused_in_words() -> None:
    record = understand("lead short of me")
    assert (record["commands"] or [], bool(record["reason"])) == ([], True)
