"""Entries: read strictly, with errors that help; printed back as they were."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from voxml import formulas
from voxml.reader import FILE_MAX_BYTES, parse_entry, read_entry
from voxml.schema import ObjectEntry, ProgramEntry, VoxmlError
from voxml.terms import FormError, Name, Quantity, Term, Unit, parse_form
from voxml.vocabulary import ENTRY_FOLDERS, LEXICON_FOLDER
from voxml.writer import write_entry

TURN = (LEXICON_FOLDER / "programs" / "turn.xml").read_text(encoding="utf-8")


def test_a_program_has_typed_arguments_and_a_body() -> None:
    entry = parse_entry(TURN, "turn.xml")
    assert isinstance(entry, ProgramEntry)
    assert entry.args[0].types == ("agent",)
    assert entry.args[2].default == Quantity(90, Unit.DEGREE)
    assert entry.body[-1].event.pred == "rotate"


@pytest.mark.parametrize("folder", ENTRY_FOLDERS)
def test_every_entry_prints_back_as_it_stands_in_its_file(folder: str) -> None:
    for path in sorted((LEXICON_FOLDER / folder).glob("*.xml")):
        assert write_entry(read_entry(path)) == path.read_text(encoding="utf-8"), path.name


def test_affordances_are_terms() -> None:
    entry = read_entry(LEXICON_FOLDER / "objects" / "doorway.xml")
    assert isinstance(entry, ObjectEntry)
    assert any(affordance.event.args[-1] == parse_form("through([1])") for affordance in entry.affordances)


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (("<Pred>turn</Pred>", "<Pred></Pred>"), "<Pred>|empty"),
        (("<Pred>turn</Pred>", "<Pred>Turn!</Pred>"), "lower-case"),
        (("<Lex>", "<Lexicon>"), "well-formed"),
        (('Type="Program"', 'Type="Programme"'), "use one of"),
        (('Value="x:agent"', 'Value="x"'), "variable:type"),
        (('Value="x:agent"', 'Value="x:robot"'), "use one of"),
        (('Default="90deg"', 'Default="("'), "Default"),
        (("rotate(x,y,z)", "rotate(x,y"), "Subevent"),
    ],
)
def test_what_is_wrong_is_named_with_file_and_remedy(change: tuple[str, str], told: str) -> None:
    assert change[0] in TURN
    with pytest.raises(VoxmlError, match=told) as raised:
        parse_entry(TURN.replace(*change), "turn.xml")
    assert "turn.xml" in str(raised.value)


@pytest.mark.parametrize("text", ['<!DOCTYPE VoxML [<!ENTITY a "b">]><VoxML/>', "<VoxML>", "<Other/>", ""])
def test_declarations_and_broken_files_are_refused(text: str) -> None:
    with pytest.raises(VoxmlError):
        parse_entry(text, "x.xml")


def test_a_file_that_is_too_long_is_not_read(tmp_path: Path) -> None:
    path = tmp_path / "long.xml"
    path.write_text(" " * (FILE_MAX_BYTES + 1), encoding="utf-8")
    with pytest.raises(VoxmlError, match="too long"):
        read_entry(path)


@pytest.mark.parametrize(
    "text",
    ["H[2]->[put(x, in([1]))]contain([1], x)", "H->[go(x, through([1]))]", "H[2],on(y, [1])->[roll(x, [1])]"],
)
def test_affordance_formulas_print_back(text: str) -> None:
    assert formulas.format_affordance(formulas.parse_affordance(text)) == text


@pytest.mark.parametrize(
    ("name", "value"), [("UP[2]", "align(Y,E_y)"), ("TOP[2]", "top(+Y)"), ("CONSTR[2]", "X = Y = Z")]
)
def test_habitats_print_back(name: str, value: str) -> None:
    assert formulas.format_habitat(formulas.parse_habitat(name, value)) == (name, value)


@pytest.mark.parametrize("text", ["e1:rotate(x,y,z)", "e2:if(not(known(y))):while(perceive(x,y)):patrol(x,s,r,i)"])
def test_bodies_print_back(text: str) -> None:
    assert formulas.format_subevent(formulas.parse_subevent(text)) == text


PREDS = st.from_regex(r"[a-z][a-z0-9_]{0,8}", fullmatch=True)
LEAVES = (
    PREDS.map(Term)
    | st.builds(Quantity, st.integers(-(10**9), 10**9).map(lambda value: value / 1000), st.sampled_from(Unit))
    | st.builds(Name, st.text(max_size=12))
)
FORMS = st.recursive(LEAVES, lambda inner: st.builds(Term, PREDS, st.lists(inner, min_size=1, max_size=4).map(tuple)))


@given(FORMS)
def test_forms_are_read_back_to_the_same_value(form: object) -> None:
    assert parse_form(str(form)) == form


@given(st.text(max_size=40))
def test_any_text_is_a_form_or_a_form_error(text: str) -> None:
    try:
        form = parse_form(text)
    except FormError:
        return
    assert parse_form(str(form)) == form
