"""Flow control: the commands that act at once, whatever waits (RSB, "Commands").

Each returns None, or why it is out of place; then it has changed nothing.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from robot.messages import Control, FeedbackCode, encode_command

from .state import Halt, Mode
from .step import Step


def _stop(step: Step, id: str | None) -> str | None:
    step.effects.append(Halt())
    if step.state.mode is Mode.MOVING:
        step.pause()
    answers = {Mode.PAUSED: FeedbackCode.PAUSED, Mode.AWAITING: FeedbackCode.HELP}
    step.tell(answers.get(step.state.mode, FeedbackCode.READY), id=id)
    return None


def _continue(step: Step, id: str | None) -> str | None:
    if step.state.mode is Mode.AWAITING:
        return "user input is required: keep going OR go back"
    if step.state.mode is not Mode.PAUSED:
        return "robot is not paused"
    step.tell(FeedbackCode.RESTARTING, id=id)
    current = step.state.current
    if current is None:
        step.go_next()
    else:
        step.state = replace(step.state, mode=Mode.MOVING)
        step.pursue(current)
    return None


def _cancel(step: Step, id: str | None) -> str | None:
    if step.state.mode is Mode.READY:
        return "there is nothing to cancel"
    # While awaiting an answer the movement that strayed has ended already: all that is left is to go on.
    if step.state.goals and step.state.mode is not Mode.AWAITING:
        first, *rest = step.state.goals
        step.drop(first)
        step.state = replace(step.state, current=None, pending=tuple(rest))
    step.tell(FeedbackCode.CANCELLED_GOAL, id=id)
    step.go_on_from_here()
    return None


def cancel_command(step: Step, of: str, id: str | None) -> str | None:
    """As ``cancel``, for the movement that was sent under the id ``of``, whether it is being done or waits."""
    goal = next((goal for goal in step.state.goals if goal.id == of), None)
    if goal is None:
        return f"nothing with the id {of} is being done or waits"
    if step.state.current is not None and goal is step.state.current.goal:
        return _cancel(step, id)
    step.drop_pending(goal)
    step.tell(FeedbackCode.CANCELLED_GOAL, id=id)
    return None


def _cancel_all(step: Step, id: str | None) -> str | None:
    step.drop_all()
    step.tell(FeedbackCode.CANCELLED_ALL, id=id)
    step.tell(FeedbackCode.READY)
    return None


def _keep_going(step: Step, id: str | None) -> str | None:
    if step.state.mode is Mode.PAUSED:
        return "robot is paused: continue, cancel OR go back"
    if step.state.mode is not Mode.AWAITING:
        return "robot is not waiting for an answer"
    step.tell(FeedbackCode.RESTARTING, id=id)
    step.go_on_from_here()
    return None


def _stop_patrol(step: Step, id: str | None) -> str | None:
    current = step.state.current
    if current is None or not current.patrols:
        return "robot is not patrolling"
    step.drop(current.goal, FeedbackCode.STOP_PATROL)
    step.tell(FeedbackCode.STOP_PATROL, id=id)
    step.go_on_from_here()
    return None


def _queue(step: Step, id: str | None) -> str | None:
    waiting = ", ".join(encode_command(goal.command) for goal in step.state.goals)
    step.tell(FeedbackCode.QUEUE, id=id, detail=waiting or "nothing")
    return None


CONTROLS: dict[Control, Callable[[Step, str | None], str | None]] = {
    Control.STOP: _stop,
    Control.CONTINUE: _continue,
    Control.CANCEL: _cancel,
    Control.CANCEL_ALL: _cancel_all,
    Control.KEEP_GOING: _keep_going,
    Control.STOP_PATROL: _stop_patrol,
    Control.QUEUE: _queue,
}
