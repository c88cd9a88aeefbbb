"""The language model: trained offline and the same every time, read without running anything, never obeyed unasked."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from typer.testing import CliRunner

from grammar import NotUnderstood, parse
from grammar.guessing import NONE
from kirby import Agent, Dispatch, GestureKind, LanguageModel, Output, Say, load_lexicon, understand
from kirby.proposer import ModelError, StoredModel, trained_here
from kirby.train_model import Trained, train
from robot.messages import encode_command

ORDER = "scrondle two meters forward"
ASKED = "Did you mean: go two meters forward?"


LEXICON = load_lexicon()
WORDS = sorted(LEXICON.vocabulary())
PROGRAMS = sorted(LEXICON.programs)


def go(words: tuple[str, ...]) -> str:
    return "go"


def sent(outputs: tuple[Output, ...]) -> list[str]:
    return [encode_command(each) for output in outputs if isinstance(output, Dispatch) for each in output.commands]


def said(outputs: tuple[Output, ...]) -> list[str]:
    return [output.text for output in outputs if isinstance(output, Say)]


# ------------------------------------------------------------------ in a talk
@pytest.mark.parametrize(
    ("answer", "commands"), [("yes", ["go forward 2"]), ("no", []), ("turn left", ["turn left 90"])]
)
def test_a_guess_is_asked_about_and_done_only_if_it_was_meant(answer: str, commands: list[str]) -> None:
    agent = Agent(proposer=go)
    outputs = agent.hear(ORDER, 0.0)
    assert (sent(outputs), said(outputs), agent.state) == ([], [ASKED], "awaiting confirmation")
    assert sent(agent.hear(answer, 1.0)) == commands


def test_thumbs_answer_too() -> None:
    for thumb, commands in ((GestureKind.THUMBS_UP, ["go forward 2"]), (GestureKind.THUMBS_DOWN, [])):
        agent = Agent(proposer=go)
        agent.hear(ORDER, 0.0)
        assert sent(agent.gesture(thumb, 1.0)) == commands


def test_what_may_be_meant_to_stop_is_not_asked_about() -> None:
    assert sent(Agent(proposer=lambda words: "stop").hear("grunch it now", 0.0)) == ["stop"]


def test_without_a_model_it_is_not_understood() -> None:
    assert understand(ORDER)["status"] == "not_understood"
    record = understand(ORDER, proposer=go)
    assert (record["status"], record["commands"], record["reason"]) == ("ambiguous", None, ASKED)


@given(
    st.lists(st.sampled_from([*WORDS, "scrondle", "flomber", "2"]), min_size=1, max_size=7), st.sampled_from(PROGRAMS)
)
def test_nothing_that_was_guessed_moves_the_robot_before_it_is_confirmed(words: list[str], pred: str) -> None:
    text = " ".join(words)
    if isinstance(parse(text), NotUnderstood):
        outputs = Agent(proposer=lambda words: pred).hear(text, 0.0)
        assert set(sent(outputs)) <= {"stop"}


# ------------------------------------------------------------------ trained
@pytest.fixture(scope="module")
def trained() -> Trained:
    return train(LEXICON, lambda line: None, samples=200, epochs=2)


def test_a_verb_that_was_never_heard_is_guessed_from_what_goes_with_it(trained: Trained) -> None:
    likeliest = trained.model.likeliest
    assert likeliest(("scrondle", "<metre>", "forward"))[0] == "go"
    assert likeliest(("scrondle", "left", "<degree>"))[0] == "turn"
    assert likeliest(("the", "weather", "is", "nice", "today"))[0] == NONE


def test_it_is_seldom_sure_where_nothing_was_asked_for(trained: Trained) -> None:
    scores = trained.scores["corpora"]
    assert scores.false_share < 0.05
    assert scores.precision > 0.6


def test_training_again_gives_the_same_model(trained: Trained) -> None:
    again = train(LEXICON, lambda line: None, samples=200, epochs=2)
    assert again.model.classes == trained.model.classes
    assert again.model.pipe.model.to_bytes() == trained.model.pipe.model.to_bytes()
    assert again.scores == trained.scores


def test_a_model_read_back_answers_as_before(trained: Trained, tmp_path: Path) -> None:
    trained.model.save(tmp_path)
    loaded = LanguageModel.load(tmp_path)
    words = ("scrondle", "<metre>", "forward")
    assert loaded.classes == trained.model.classes
    assert loaded.likeliest(words) == trained.model.likeliest(words)
    assert StoredModel(tmp_path)(words) == trained.model(words)


@pytest.mark.parametrize("file", ["model.json", "weights"])
@pytest.mark.parametrize("content", [b"", b"{}", b"\x80\x04K\x01.", b"[" * 5000, bytes(range(256))])
def test_a_broken_model_is_refused_in_words(trained: Trained, tmp_path: Path, file: str, content: bytes) -> None:
    trained.model.save(tmp_path)
    (tmp_path / file).write_bytes(content)
    with pytest.raises(ModelError, match="kirby train language"):
        LanguageModel.load(tmp_path)


def test_a_model_of_another_version_is_refused(trained: Trained, tmp_path: Path) -> None:
    trained.model.save(tmp_path)
    data = json.loads((tmp_path / "model.json").read_text())
    (tmp_path / "model.json").write_text(json.dumps(data | {"version": 99}))
    with pytest.raises(ModelError, match="version 99"):
        LanguageModel.load(tmp_path)


# ------------------------------------------------------------------ where it is, and where not
def test_it_is_used_where_it_was_trained_to_the_state_folder(
    trained: Trained, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("KIRBY_STATE", str(tmp_path))
    assert trained_here() is None
    trained.model.save(tmp_path / "language")
    assert trained_here() is not None
    monkeypatch.setattr("kirby.proposer.find_spec", lambda name: None)
    assert trained_here() is None
    with pytest.raises(ModelError, match=r"pip install 'kirby-dialogue\[language\]'"):
        LanguageModel.load(tmp_path / "language")


def test_the_command_says_what_can_be_trained() -> None:
    from kirby.cli import app

    assert CliRunner().invoke(app, ["train", "--help"]).exit_code == 0
    done = subprocess.run([sys.executable, "-m", "kirby", "train", "dogs"], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (2, "kirby: 'dogs' is nothing to train: kirby train language\n")


def test_spacy_is_imported_only_where_a_model_is_asked() -> None:
    code = "import kirby, sys; kirby.Agent().hear('scrondle it'); kirby.LanguageModel; sys.exit('spacy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
