"""The dialogue manager's states and transitions: one table, as data, and the machine that all sessions share.

The robot's activity moves the conversation between the states that follow it; a question lies over them, and when it is
settled the conversation is where the robot is.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from functools import cache

from transitions import Machine


class Activity(Enum):
    """What the robot is at, by its feedback."""

    RESTING = "resting"
    MOVING = "moving"
    PATROLLING = "patrolling"
    PAUSED = "paused"
    STRAYED = "strayed"  # it asks: keep going OR go back
    LEFT_OVER = "left over"  # paused on what it was doing before it started anew


class State(Enum):
    """Where the conversation is; the first six follow the robot, the others are questions of Kirby's own."""

    IDLE = "idle"
    EXECUTING = "executing"
    PATROLLING = "patrolling"
    PAUSED = "paused"
    AWAITING_CHOICE = "awaiting choice"
    AWAITING_RECOVERY = "awaiting recovery"
    AWAITING_REFERENT = "awaiting referent"
    AWAITING_PLACE = "awaiting place"
    AWAITING_SIDE = "awaiting side"
    AWAITING_CONFIRMATION = "awaiting confirmation"


class Trigger(Enum):
    """What moves the conversation from state to state."""

    ROBOT_RESTS = "robot rests"
    ROBOT_MOVES = "robot moves"
    ROBOT_PATROLS = "robot patrols"
    ROBOT_PAUSES = "robot pauses"
    ROBOT_STRAYS = "robot strays"
    ROBOT_RESTARTS = "robot restarts"
    ASK_REFERENT = "ask referent"
    ASK_PLACE = "ask place"
    ASK_SIDE = "ask side"
    ASK_CONFIRMATION = "ask confirmation"
    SETTLE = "settle"


RESTING_STATE = {
    Activity.RESTING: State.IDLE,
    Activity.MOVING: State.EXECUTING,
    Activity.PATROLLING: State.PATROLLING,
    Activity.PAUSED: State.PAUSED,
    Activity.STRAYED: State.AWAITING_CHOICE,
    Activity.LEFT_OVER: State.AWAITING_RECOVERY,
}
ROBOT_TRIGGER = {
    Activity.RESTING: Trigger.ROBOT_RESTS,
    Activity.MOVING: Trigger.ROBOT_MOVES,
    Activity.PATROLLING: Trigger.ROBOT_PATROLS,
    Activity.PAUSED: Trigger.ROBOT_PAUSES,
    Activity.STRAYED: Trigger.ROBOT_STRAYS,
    Activity.LEFT_OVER: Trigger.ROBOT_RESTARTS,
}
QUESTIONS = (State.AWAITING_REFERENT, State.AWAITING_PLACE, State.AWAITING_SIDE, State.AWAITING_CONFIRMATION)
FOLLOWING = tuple(state for state in State if state not in QUESTIONS)
"""The states that follow the robot."""


@dataclass(frozen=True, slots=True)
class Row:
    """From any of ``sources`` to ``target`` on ``trigger``; ``target`` None stays; ``when`` is the robot's activity."""

    trigger: Trigger
    sources: tuple[State, ...]
    target: State | None
    when: Activity | None = None


TABLE: tuple[Row, ...] = (
    Row(Trigger.ROBOT_RESTS, FOLLOWING, State.IDLE),
    Row(Trigger.ROBOT_MOVES, FOLLOWING, State.EXECUTING),
    Row(Trigger.ROBOT_PATROLS, FOLLOWING, State.PATROLLING),
    Row(Trigger.ROBOT_PAUSES, FOLLOWING, State.PAUSED),
    # What the robot asks overrides what Kirby asks; its other news waits until the question is settled.
    Row(Trigger.ROBOT_STRAYS, tuple(State), State.AWAITING_CHOICE),
    Row(Trigger.ROBOT_RESTARTS, tuple(State), State.AWAITING_RECOVERY),
    Row(Trigger.ROBOT_RESTS, QUESTIONS, None),
    Row(Trigger.ROBOT_MOVES, QUESTIONS, None),
    Row(Trigger.ROBOT_PATROLS, QUESTIONS, None),
    Row(Trigger.ROBOT_PAUSES, QUESTIONS, None),
    Row(Trigger.ASK_REFERENT, tuple(State), State.AWAITING_REFERENT),
    Row(Trigger.ASK_PLACE, tuple(State), State.AWAITING_PLACE),
    Row(Trigger.ASK_SIDE, tuple(State), State.AWAITING_SIDE),
    Row(Trigger.ASK_CONFIRMATION, tuple(State), State.AWAITING_CONFIRMATION),
    *(Row(Trigger.SETTLE, QUESTIONS, state, activity) for activity, state in RESTING_STATE.items()),
)


class _Cursor:
    """The model of one session while a transition is made; conditions are its attributes, which the machine names."""

    def __init__(self, state: State, activity: Activity) -> None:
        self.state = state.name
        for each in Activity:
            setattr(self, _condition(each), each is activity)


def _condition(activity: Activity) -> str:
    return f"robot_is_{activity.name.lower()}"


@cache
def machine() -> Machine:
    """The one machine, without models of its own: each transition brings its session's (see `advance`)."""
    rows = [
        {
            "trigger": row.trigger.name,
            "source": [source.name for source in row.sources],
            "dest": None if row.target is None else row.target.name,
            "conditions": None if row.when is None else _condition(row.when),
        }
        for row in TABLE
    ]
    states = [state.name for state in State]
    return Machine(model=None, states=states, initial=None, transitions=rows, auto_transitions=False)


def advance(state: State, trigger: Trigger, activity: Activity) -> State:
    """The state after ``trigger``, by the table.

    Raises:
        transitions.MachineError: the table has no such row (a mistake in the program, not in the conversation).
    """
    cursor = _Cursor(state, activity)
    machine().events[trigger.name].trigger(cursor)
    return State[cursor.state]
