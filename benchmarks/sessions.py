"""Ten thousand live conversations in one process: memory of each, events a second, time to put one away and back."""

from __future__ import annotations

import gc
import time
import tracemalloc
from collections.abc import Callable

from dialogue.events import Event, PointedPlace, Pointing, RobotFeedback, Tick, Utterance
from kirby.agent import Agent
from kirby.worlds import find_world
from robot.geometry import Point
from robot.messages import FeedbackCode, feedback
from voxml.vocabulary import load_lexicon

SESSIONS = 10_000
_STORED = 500


def run() -> dict[str, object]:
    """Figures of one process."""
    lexicon, scene = load_lexicon(), find_world("figure3")
    Agent(scene, lexicon).hear("go forward", 0.0)  # what all share is loaded
    each_bytes = _bytes_each(lambda: Agent(scene, lexicon, clock=lambda: 0.0))
    agents = [Agent(scene, lexicon, clock=lambda: 0.0) for _ in range(SESSIONS)]
    begin = time.perf_counter()
    for event in _events():
        for agent in agents:
            agent.handle(event)
    events_s = SESSIONS * len(_events()) / (time.perf_counter() - begin)
    begin = time.perf_counter()
    texts = [agent.to_json() for agent in agents[:_STORED]]
    restored = [Agent.from_json(text, lexicon) for text in texts]
    stored_ms = 1000.0 * (time.perf_counter() - begin) / _STORED
    assert [agent.session for agent in restored] == [agent.session for agent in agents[:_STORED]]
    return {
        "sessions": SESSIONS,
        "kilobytes_each": each_bytes / 1000.0,
        "events_a_second": events_s,
        "json_and_back_ms": stored_ms,
        "json_kilobytes": len(texts[-1]) / 1000.0,
    }


def _bytes_each(make: Callable[[], Agent]) -> float:
    """Memory of one conversation after a short talk, beside what all share."""
    gc.collect()
    tracemalloc.start()
    agents = [make() for _ in range(_STORED)]
    for agent in agents:
        for event in _events():
            agent.handle(event)
    gc.collect()
    size = tracemalloc.get_traced_memory()[0] / len(agents)
    tracemalloc.stop()
    return size


def _events() -> tuple[Event, ...]:
    """A short talk: most of what reaches a session is not words."""
    return (
        Utterance("turn left", 0.0),
        RobotFeedback(feedback(FeedbackCode.ESTIMATE_ROTATION, id="k1"), 1.0),
        RobotFeedback(feedback(FeedbackCode.SUCCESS_VERIFY_ROTATION, id="k1"), 2.0),
        Pointing(PointedPlace(Point(1.0, 0.5)), 3.0),
        Utterance("go there", 4.0),
        Tick(5.0),
        RobotFeedback(feedback(FeedbackCode.SUCCESS_GO_TO, at=Point(1.0, 0.5), id="k2"), 6.0),
    )
