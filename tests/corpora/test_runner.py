"""Corpora are matched exactly, and what differs is told so that one can see it."""

from __future__ import annotations

from pathlib import Path

import pytest

from corpora.cases import CorpusError
from corpora.reporting import report_text
from corpora.runner import FOLDER, Report, default_corpora, run


def run_text(folder: Path, text: str, known: str = "") -> Report:
    path = folder / "some.yaml"
    path.write_text(text, encoding="utf-8")
    if known:
        (folder / "known_failures.yaml").write_text(known, encoding="utf-8")
    return run([path])


def test_the_corpora_of_commands_reference_and_dialogue_pass() -> None:
    report = run(path for path in default_corpora() if path.parent == FOLDER)
    assert report.ok, report_text(report)
    cases = sum("dialogues" not in result.source for result in report.results)
    assert cases >= 150
    assert len(report.results) - cases >= 12


def test_a_changed_expectation_fails_with_expected_and_got(tmp_path: Path) -> None:
    original = (FOLDER / "commands.yaml").read_text(encoding="utf-8")
    report = run_text(tmp_path, original.replace("commands: [turn left 45]", "commands: [turn left 46]"))
    assert not report.ok
    text = report_text(report)
    assert "expected: turn left 46" in text
    assert "got:      turn left 45" in text


@pytest.mark.parametrize(
    "case",
    [
        "{say: go forward, commands: [go forward 1, turn left 90]}",
        "{say: go forward then turn left, commands: [go forward 1]}",
        "{say: go forward}",
        "{say: go forward, act: question, commands: [go forward 1]}",
        "{say: go forward, form: go(back), commands: [go forward 1]}",
        "{say: go forward, status: ambiguous, commands: [go forward 1]}",
        "{say: go forward, commands: [go forward 1], reply: Okay.}",
    ],
)
def test_anything_more_less_or_other_is_a_failure(tmp_path: Path, case: str) -> None:
    assert not run_text(tmp_path, f"cases: [{case}]").ok


def test_a_dialogue_stops_at_the_first_turn_that_differs(tmp_path: Path) -> None:
    turns = "[{say: go forward, commands: [go forward 1]}, {say: turn left}, {say: turn right}]"
    report = run_text(tmp_path, f"dialogues: [{{name: a, turns: {turns}}}]")
    assert [d.step for d in report.results[0].differences] == ["turn 2: commands"]


def known(step: str, case: str = "go forward") -> str:
    return f"known_failures: [{{file: some.yaml, case: {case}, step: {step}, reason: not yet}}]"


def test_a_known_failure_is_no_failure(tmp_path: Path) -> None:
    report = run_text(tmp_path, "cases: [{say: go forward, commands: [go back]}]", known("commands"))
    assert report.ok
    assert "1" in report_text(report)


@pytest.mark.parametrize(
    ("case", "failure"),
    [
        ("{say: go forward, commands: [go forward 1]}", known("commands")),
        ("{say: go forward, commands: [go back]}", known("form")),
        ("{say: turn left, commands: [turn left 90]}", known("commands")),
    ],
    ids=["it passes", "it fails elsewhere", "there is no such case"],
)
def test_a_known_failure_that_is_none_is_an_error(tmp_path: Path, case: str, failure: str) -> None:
    assert not run_text(tmp_path, f"cases: [{case}]", failure).ok


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("cases: [{say: go, comands: []}]", "'comands' is not a field"),
        ("cases: [{commands: []}]", "'say' is missing"),
        ("cases: [{say: yes}]", "put it in quotes"),
        ("cases: [{say: go, status: fine}]", "status 'fine' is unknown"),
        ("cases: [{say: go, at: [1, 2]}]", "must be 3 numbers"),
        ("cases: [{say: go, world: atlantis}]", "no world 'atlantis'"),
        ("cases: {say: go}", "'cases' must be a list"),
        ("dialogues: [{name: a, turns: []}]", "at least one turn"),
        ("dialogues: [{name: a, turns: [{say: go, point: [1, 2]}]}]", "exactly one of"),
        ("dialogues: [{name: a, turns: [{feedback: FINE}]}]", "'FINE' is unknown"),
        ("dialogues: [{name: a, world: figure3, turns: [{see: [99]}]}]", "fiducials of the world"),
        ("cases: [", "is not YAML"),
        ("- 1", "must be a mapping"),
    ],
)
def test_a_broken_corpus_is_refused_in_one_line(tmp_path: Path, text: str, says: str) -> None:
    with pytest.raises(CorpusError) as failure:
        run_text(tmp_path, text)
    assert says in str(failure.value)
    assert "\n" not in str(failure.value)


def test_a_corpus_that_is_not_there_is_refused() -> None:
    with pytest.raises(CorpusError, match="cannot be read"):
        run([Path("nowhere.yaml")])


def test_known_failures_are_not_a_corpus() -> None:
    assert all(path.name != "known_failures.yaml" for path in default_corpora())
