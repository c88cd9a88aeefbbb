"""What is written in the lexicon hangs together: words, bodies, affordances, markers, more general nouns."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

import pytest

from voxml.schema import Entry, ObjectEntry, ProgramEntry, RelationEntry
from voxml.terms import Form, Term, parse_term
from voxml.vocabulary import Lexicon, load_lexicon

PRIMITIVES = frozenset(
    ["translate", "rotate", "orient", "reach", "patrol", "perceive", "wait", "picture", "control", "dialogue", "unable"]
)
PARTS = frozenset({"hand", "arm", "legs", "wings"})
CONTROLS = frozenset(["stop", "continue", "cancel", "cancel_all", "go_back", "keep_going", "stop_patrol", "queue"])
OPERATORS = frozenset({"repeat", "seq"})
UNAMBIGUOUS = (
    "NOUN",
    "NOUNS",
    "ADJECTIVE",
    "ORDINAL",
    "MANNER",
    "LOC",
    "PATH",
    "DETERMINER",
    "DEMONSTRATIVE",
    "INTERROGATIVE",
)


@pytest.fixture(scope="module")
def lexicon() -> Lexicon:
    return load_lexicon()


def ids(entry: Entry) -> str:
    return entry.lex.pred


def programs() -> list[ProgramEntry]:
    return list(load_lexicon().programs.values())


def objects() -> list[ObjectEntry]:
    return list(load_lexicon().objects.values())


def relations() -> list[RelationEntry]:
    return list(load_lexicon().relations.values())


def subterms(form: Form) -> Iterator[Term]:
    if isinstance(form, Term):
        yield form
        for arg in form.args:
            yield from subterms(arg)


def phrases(entry: Entry) -> list[str]:
    own = [entry.lex.pred.replace("_", " ")] if entry.lex.spoken else []
    return own + [synonym.text for synonym in entry.lex.synonyms if synonym.kind is None]


@pytest.mark.parametrize(
    ("kind", "least"), [("programs", 75), ("objects", 75), ("relations", 38), ("attributes", 35), ("functions", 22)]
)
def test_there_are_enough_entries_of_each_type(lexicon: Lexicon, kind: str, least: int) -> None:
    assert len(getattr(lexicon, kind)) >= least


@pytest.mark.parametrize("category", UNAMBIGUOUS)
def test_a_word_names_one_entry_in_its_category(lexicon: Lexicon, category: str) -> None:
    meanings = defaultdict(set)
    for phrase in lexicon.words():
        for sense in lexicon.lookup(phrase):
            if sense.category == category:
                meanings[phrase].add(str(sense.value))
    assert {phrase: found for phrase, found in meanings.items() if len(found) > 1} == {}


def test_a_verb_of_two_programs_is_settled_by_its_arguments(lexicon: Lexicon) -> None:
    """Unless it is the predicate of one of them, which then comes first."""
    signatures: dict[str, dict[str, object]] = defaultdict(dict)
    for entry in lexicon.programs.values():
        said = tuple((arg.types, arg.markers) for arg in entry.args[1:])
        for synonym in entry.lex.synonyms:
            signatures[f"{synonym.kind} {synonym.text}"][entry.lex.pred] = (said, synonym.gives)
    clashes = {
        word: sorted(found)
        for word, found in signatures.items()
        if len(set(map(str, found.values()))) < len(found) and word.removeprefix("None ") not in lexicon.programs
    }
    assert clashes == {}


@pytest.mark.parametrize("entry", programs(), ids=ids)
def test_a_body_comes_down_to_primitives(lexicon: Lexicon, entry: ProgramEntry) -> None:
    def descend(pred: str, above: tuple[str, ...]) -> None:
        assert pred not in above, f"{' -> '.join((*above, pred))} goes round in a circle"
        assert pred in lexicon.programs, f"{pred} is neither a primitive nor a program"
        for step in lexicon.programs[pred].body:
            events = step.event.args if step.event.pred in OPERATORS else (step.event,)
            for event in events:
                if isinstance(event, Term) and event.pred not in PRIMITIVES:
                    descend(event.pred, (*above, pred))

    descend(entry.lex.pred, ())


@pytest.mark.parametrize("entry", programs(), ids=ids)
def test_a_body_speaks_of_its_arguments_only(lexicon: Lexicon, entry: ProgramEntry) -> None:
    variables = {arg.variable for arg in entry.args}
    for step in entry.body:
        for term in (step.event, *(guard.condition for guard in step.guards)):
            single = {part.pred for part in subterms(term) if not part.args and len(part.pred) == 1}
            assert single <= variables, f"{single - variables} is not among the arguments"


@pytest.mark.parametrize("entry", programs(), ids=ids)
def test_primitives_of_a_closed_set_are_given_one_of_it(entry: ProgramEntry) -> None:
    for step in entry.body:
        for term in subterms(step.event):
            if term.pred == "control":
                assert str(term.args[0]) in CONTROLS
            if term.pred == "unable":
                assert str(term.args[1]) in PARTS


@pytest.mark.parametrize("entry", programs(), ids=ids)
def test_markers_are_known(lexicon: Lexicon, entry: ProgramEntry) -> None:
    for arg in entry.args:
        closed = {word.text for name in ("MEASURE", "FACING") for word in lexicon.closed.words_of(name)}
        assert set(arg.markers) <= lexicon.relations.keys() | closed
        assert arg.bare or arg.markers or "place" in arg.types  # a place says its relation by itself


@pytest.mark.parametrize("entry", objects(), ids=ids)
def test_an_affordance_is_a_program_over_paths_that_exist(lexicon: Lexicon, entry: ObjectEntry) -> None:
    assert entry.affordances
    for affordance in entry.affordances:
        assert affordance.event.pred in lexicon.programs
        for arg in affordance.event.args[1:]:
            assert isinstance(arg, Term)
            assert arg.pred.startswith("[") or arg.pred in lexicon.relations


@pytest.mark.parametrize("entry", objects(), ids=ids)
def test_an_object_has_a_body_and_stands_upright(entry: ObjectEntry) -> None:
    assert entry.head.index == 1
    assert entry.concavity is not None
    assert entry.scale is not None
    assert entry.movable is not None
    assert {"UP", "TOP"} <= {condition.name for condition in entry.intrinsic}


def test_every_noun_has_a_plural(lexicon: Lexicon) -> None:
    plurals = defaultdict(set)
    for phrase in lexicon.words():
        for sense in lexicon.lookup(phrase):
            if sense.category == "NOUNS":
                plurals[str(sense.value)].add(phrase)
    for entry in lexicon.objects.values():
        assert len(plurals[f"plural({entry.lex.pred})"]) == len(set(phrases(entry))), entry.lex.pred


def test_more_general_nouns_are_nouns_and_lead_upwards(lexicon: Lexicon) -> None:
    for entry in lexicon.objects.values():
        seen, open_ = set(), list(entry.attributes)
        while open_:
            general = open_.pop()
            assert general in lexicon.objects, f"{general}, which every {entry.lex.pred} is said to be, is no noun"
            assert general != entry.lex.pred
            if general not in seen:
                seen.add(general)
                open_ += lexicon.objects[general].attributes


@pytest.mark.parametrize("entry", relations(), ids=ids)
def test_a_relation_says_what_must_hold_and_what_it_goes_with(lexicon: Lexicon, entry: RelationEntry) -> None:
    assert entry.constraint
    assert len(entry.args) >= 2
    for text in entry.correspondences:
        term = parse_term(text)
        assert term.pred == "converse" or term.pred in lexicon.relations


@pytest.mark.parametrize(
    ("place", "path", "allowed"),
    [
        ("doorway", "through", True),
        ("wall", "through", False),
        ("window", "through", False),
        ("room", "into", True),
        ("room", "out_of", True),
        ("hallway", "down", True),
        ("hallway", "along", True),
        ("table", "under", True),
        ("table", "through", False),
        ("ramp", "up", True),
        ("stairs", "up", False),
        ("rug", "over", True),
        ("wastebasket", "into", False),
        ("elevator", "into", True),
    ],
)
def test_affordances_say_where_one_can_go(lexicon: Lexicon, place: str, path: str, allowed: bool) -> None:
    wanted = parse_term(f"go(x,{path}([1]))")
    assert (wanted in [affordance.event for affordance in lexicon.objects[place].affordances]) is allowed


@pytest.mark.parametrize(
    ("word", "pred"),
    [
        ("trash can", "wastebasket"),
        ("corridor", "hallway"),
        ("sofa", "couch"),
        ("television", "tv"),
        ("people", "plural(person)"),
        ("bookshelves", "plural(shelf)"),
        ("marker", "fiducial"),
    ],
)
def test_people_use_other_words_for_the_same_thing(lexicon: Lexicon, word: str, pred: str) -> None:
    assert pred in [str(sense.value) for sense in lexicon.lookup(word)]
