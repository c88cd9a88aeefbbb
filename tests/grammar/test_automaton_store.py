"""Compiled grammars kept in files: the same automaton comes back, and whatever is wrong with a file harms nothing."""

from __future__ import annotations

from pathlib import Path

import pytest

from grammar import automaton_store
from grammar.automaton import Automaton

GRAMMAR = "start: greeting NAME -> greeted\ngreeting: HELLO | GOOD MORNING -> both\n"


@pytest.fixture
def kept(tmp_path: Path) -> Path:
    """The file of the grammar, just compiled."""
    automaton_store.automaton(GRAMMAR, tmp_path)
    return next(tmp_path.iterdir())


def _read_without_lark(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Automaton:
    monkeypatch.setattr(automaton_store, "compiled", lambda grammar: pytest.fail("compiled again"))
    return automaton_store.automaton(GRAMMAR, folder)


def test_what_was_kept_is_what_was_compiled(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    made = automaton_store.automaton(GRAMMAR, tmp_path)
    assert _read_without_lark(tmp_path, monkeypatch) == made
    assert {rule.name for rule in made.rules} >= {"greeted", "both"}


def test_another_grammar_is_another_file(kept: Path) -> None:
    automaton_store.automaton(GRAMMAR + "// a remark\n", kept.parent)
    assert len(list(kept.parent.iterdir())) == 2


@pytest.mark.parametrize("damage", ["", "[]", "not json", "[1,2\n0"])
def test_a_damaged_file_is_made_anew(kept: Path, damage: str, monkeypatch: pytest.MonkeyPatch) -> None:
    kept.write_text(damage, encoding="utf-8")
    made = automaton_store.automaton(GRAMMAR, kept.parent)
    assert _read_without_lark(kept.parent, monkeypatch) == made


def test_an_altered_file_is_not_trusted(kept: Path) -> None:
    kept.write_text(kept.read_text(encoding="utf-8").replace("HELLO", "HULLO"), encoding="utf-8")
    assert "HULLO" not in automaton_store.automaton(GRAMMAR, kept.parent).shifts[0]
    assert "HULLO" not in kept.read_text(encoding="utf-8")


def test_a_folder_that_cannot_be_written_does_no_harm(tmp_path: Path) -> None:
    in_the_way = tmp_path / "file"
    in_the_way.write_text("", encoding="utf-8")
    assert automaton_store.automaton(GRAMMAR, in_the_way / "folder").rules


def test_only_so_many_are_kept(tmp_path: Path) -> None:
    for number in range(automaton_store.FILES_MAX + 3):
        automaton_store.automaton(f"{GRAMMAR}// {number}\n", tmp_path)
    assert len(list(tmp_path.iterdir())) == automaton_store.FILES_MAX
