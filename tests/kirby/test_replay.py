"""Logs of conversations, and going through them again."""

from __future__ import annotations

from pathlib import Path

import pytest

from dialogue.events import Gesture, GestureKind, PointedPlace, Pointing, RobotFeedback, Tick, Utterance
from kirby.agent import Agent
from kirby.conversation import Conversation
from kirby.errors import KirbyError
from kirby.replay import logged, replay
from robot.geometry import Point
from robot.messages import FeedbackCode, feedback

EVENTS = (
    Utterance("where are you", 0.0),
    Utterance("go there", 1.0),
    Pointing(PointedPlace(Point(1.0, 0.5)), 2.0, spread_m=0.1),
    RobotFeedback(feedback(FeedbackCode.SUCCESS_GO_TO, at=Point(1.0, 0.5), id="k1"), 3.0),
    Utterance("turn 45 degrees", 4.0),
    Tick(30.0),
    Tick(60.0),
    Gesture(GestureKind.OPEN_PALM, 61.0),
)


def talk(path: Path) -> None:
    conversation = Conversation(Agent(), lambda dispatch: None, lambda line: None, lambda: 0.0)
    with logged(conversation, path):
        for event in EVENTS:
            conversation.handle(event)


def test_a_logged_talk_comes_out_the_same(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    talk(tmp_path / "log")
    assert replay(tmp_path / "log")
    assert capsys.readouterr().out == "8 events: the outputs came out the same\n"


def test_what_differs_is_shown(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    talk(tmp_path / "log")
    text = (tmp_path / "log").read_text()
    (tmp_path / "log").write_text(text.replace("I am at (0, 0)", "I am at (1, 0)"))
    assert not replay(tmp_path / "log")
    assert capsys.readouterr().out.startswith("line 2: something else came of")


@pytest.mark.parametrize("text", ["", "nonsense", '{"session":{}}\n{"event":3}\n', '{"session":{"state":"flying"}}\n'])
def test_what_is_no_log_is_refused(tmp_path: Path, text: str) -> None:
    (tmp_path / "log").write_text(text)
    with pytest.raises(KirbyError):
        replay(tmp_path / "log")
