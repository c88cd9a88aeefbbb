"""The robot's record as a careless hand may leave it: readable or not, never a crash."""

import contextlib
import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot.geometry import ORIGIN
from robot.messages import GoForward, Malformed, Patrol
from robot.queue import QueueState
from robot.queue.state import Current, Goal, Mode
from robot.record import Record, record_from_json, record_to_json

GOALS = tuple(Goal(n, command, "id", ORIGIN, ORIGIN) for n, command in enumerate((Patrol(), GoForward(2.0))))
STATE = QueueState(Mode.MOVING, Current(GOALS[0]), GOALS[1:], (), ORIGIN, ORIGIN, 7)
GOOD = record_to_json(Record(STATE, ORIGIN, 0.5))

JUNK = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5) | st.just(10**400),
    lambda inner: st.lists(inner, max_size=5) | st.dictionaries(st.text(max_size=5), inner, max_size=3),
    max_leaves=6,
)


def read(text):
    with contextlib.suppress(Malformed):
        assert isinstance(record_from_json(text), Record)


@given(name=st.sampled_from(["mode", "current", "pending", "pictures", "began", "anchor", "admitted"]), junk=JUNK)
def test_any_value_in_the_queues_state(name, junk):
    record = json.loads(GOOD)
    state = json.loads(record["queue"])
    for spoilt in (junk, [junk, *(state[name] if isinstance(state[name], list) else [])][:5]):
        read(json.dumps({**record, "queue": json.dumps({**state, name: spoilt})}))


@given(name=st.sampled_from(["queue", "pose", "turned"]), junk=JUNK)
def test_any_value_in_the_record(name, junk):
    read(json.dumps({**json.loads(GOOD), name: junk}))


@pytest.mark.parametrize("text", ["1" * 5000, "[" * 100_000, '{"pose": ' + "1" * 5000 + "}", "\ud800", "", "{}"])
def test_any_text(text):
    with pytest.raises(Malformed):
        record_from_json(text)


def test_places_out_of_all_proportion_are_refused():
    with pytest.raises(Malformed, match="proportion"):
        record_from_json(GOOD.replace("[0.0, 0.0, 0.0]", "[1e300, 0.0, 0.0]"))
