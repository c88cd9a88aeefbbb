"""The state table is complete, and its chart in the documentation is current."""

from __future__ import annotations

from itertools import product
from pathlib import Path

import pytest

from dialogue.chart import chart
from dialogue.table import QUESTIONS, RESTING_STATE, ROBOT_TRIGGER, Activity, State, Trigger, advance

DOCUMENT = Path(__file__).parents[2] / "docs" / "dialogue.md"
ASKING = (Trigger.ASK_REFERENT, Trigger.ASK_PLACE, Trigger.ASK_SIDE, Trigger.ASK_CONFIRMATION)


@pytest.mark.parametrize(("state", "activity"), list(product(State, Activity)))
def test_the_robots_news_has_a_row_in_every_state(state: State, activity: Activity) -> None:
    after = advance(state, ROBOT_TRIGGER[activity], activity)
    overrides = activity in (Activity.STRAYED, Activity.LEFT_OVER)
    assert after is (state if state in QUESTIONS and not overrides else RESTING_STATE[activity])


@pytest.mark.parametrize(("state", "trigger"), list(product(State, ASKING)))
def test_anything_can_be_asked_in_every_state(state: State, trigger: Trigger) -> None:
    assert advance(state, trigger, Activity.RESTING) in QUESTIONS


@pytest.mark.parametrize(("state", "activity"), list(product(QUESTIONS, Activity)))
def test_a_settled_question_leads_to_where_the_robot_is(state: State, activity: Activity) -> None:
    assert advance(state, Trigger.SETTLE, activity) is RESTING_STATE[activity]


def test_the_chart_in_the_documentation_is_current() -> None:
    assert chart() in DOCUMENT.read_text(encoding="utf-8"), "run: python docs/draw_state_chart.py"
