"""One step of the queue: an event in, the next state and its effects out (RSB, "Commands" and "Feedback codes")."""

from __future__ import annotations

from dataclasses import replace

from robot.messages import CancelCommand, Command, Control, Envelope, FeedbackCode, GoForward, GoTo, Turn, ideal_end

from .controls import CONTROLS, cancel_command
from .patrol import after_vertex
from .state import (
    IDLE,
    Arrived,
    Current,
    Effect,
    Estimated,
    Event,
    Failed,
    Garbled,
    Goal,
    Halt,
    Here,
    Mode,
    Orphaned,
    Photograph,
    PictureFailed,
    PictureTaken,
    QueueState,
    Received,
    Reset,
    Resumed,
    Started,
)
from .step import Step

QUEUE_MAX = 100
STRAYED_M = 0.5
MOVED = ", the nearest free place"

_SUCCESS: dict[type[Command], FeedbackCode] = {
    GoForward: FeedbackCode.SUCCESS_FORWARD,
    GoTo: FeedbackCode.SUCCESS_GO_TO,
    Turn: FeedbackCode.SUCCESS_VERIFY_ROTATION,
    Control: FeedbackCode.SUCCESS_GO_BACK,
}


def handle(state: QueueState, event: Event, here: Here) -> tuple[QueueState, tuple[Effect, ...]]:
    """The state after ``event``, and what is to be done about it in that order.

    Never raises: commands that are out of place are answered with INVALID and change nothing; news of a movement that
    is no longer being made says nothing.
    """
    step = Step(state, here)
    match event:
        case Received(entry, envelope):
            _received(step, entry, envelope)
        case Garbled() | Orphaned():
            _not_done(step, event)
        case Estimated():
            _estimated(step)
        case Arrived() | Failed():
            _finished(step, event)
        case PictureTaken(entry, path):
            _pictured(step, entry, FeedbackCode.PICTURE, path)
        case PictureFailed(entry):
            _pictured(step, entry, FeedbackCode.UNREACHABLE, "")
        case Reset():
            _reset(step)
        case Started():
            step.tell(FeedbackCode.READY)
        case Resumed(admitted, unhandled):
            _resumed(step, admitted, unhandled)
    return step.state, tuple(step.effects)


# ------------------------------------------------------------------ commands
def _received(step: Step, entry: int, envelope: Envelope) -> None:
    command = envelope.command
    if isinstance(command, CancelCommand):
        _act_at_once(step, entry, envelope, cancel_command(step, command.of, envelope.id))
    elif not isinstance(command, Control):
        _movement(step, entry, envelope)
    elif command is Control.TAKE_PICTURE:
        _take_picture(step, entry, envelope)
    elif command is Control.GO_BACK:
        _go_back(step, entry, envelope.id)
    else:
        _act_at_once(step, entry, envelope, CONTROLS[command](step, envelope.id))


def _act_at_once(step: Step, entry: int, envelope: Envelope, refusal: str | None) -> None:
    """What does not queue has been done, or refused, by now."""
    if refusal is not None:
        step.tell(FeedbackCode.INVALID, id=envelope.id, detail=refusal)
    step.forget(entry)


def _not_done(step: Step, event: Garbled | Orphaned) -> None:
    if isinstance(event, Garbled):
        step.tell(FeedbackCode.INVALID, id=event.id, detail=event.reason)
    else:
        step.tell(FeedbackCode.CANCELLED_GOAL, id=event.id)
    step.forget(event.entry)


def _movement(step: Step, entry: int, envelope: Envelope) -> None:
    refusal = _movement_refusal(step.state, entry)
    if refusal is not None:
        step.refuse(entry, envelope.id, refusal)
        return
    if step.state.mode is Mode.AWAITING:
        step.drop_all()
    _append(step, entry, envelope)


def _movement_refusal(state: QueueState, entry: int) -> str | None:
    if state.mode is Mode.PAUSED and entry > state.admitted:
        return "robot is paused"
    if state.patrolling:
        return "robot is patrolling"
    return None if state.mode is Mode.AWAITING else _full(state)


def _full(state: QueueState) -> str | None:
    full = len(state.pending) + len(state.pictures) >= QUEUE_MAX
    return f"queue is full: at most {QUEUE_MAX} commands wait" if full else None


def _append(step: Step, entry: int, envelope: Envelope) -> None:
    start = step.last_end()
    goal = Goal(entry, envelope.command, envelope.id, start, ideal_end(start, envelope.command))
    step.state = replace(step.state, pending=(*step.state.pending, goal))
    if step.state.mode is Mode.READY:
        step.go_next()


def _take_picture(step: Step, entry: int, envelope: Envelope) -> None:
    """In its turn among movements; at once where no turn will come soon and nothing is disturbed."""
    refusal = _full(step.state)
    if refusal is not None:
        step.refuse(entry, envelope.id, refusal)
    elif _no_turn_soon(step.state, entry):
        goal = Goal(entry, envelope.command, envelope.id, step.here.pose, step.here.pose)
        step.state = replace(step.state, pictures=(*step.state.pictures, goal))
        step.effects.append(Photograph(entry))
    else:
        _append(step, entry, envelope)


def _no_turn_soon(state: QueueState, entry: int) -> bool:
    paused = state.mode is Mode.PAUSED and entry > state.admitted
    return paused or state.patrolling or state.mode is Mode.AWAITING


def _go_back(step: Step, entry: int, id: str | None) -> None:
    """Works in every mode; after STRAYED it returns to where the movement that strayed began."""
    began = step.state.began
    if began is None:
        step.refuse(entry, id, "there is no movement to go back from")
        return
    step.drop_all()
    step.state = replace(step.state, pending=(Goal(entry, Control.GO_BACK, id, step.here.pose, began),))
    step.go_next()


# ------------------------------------------------------------------ news
def _estimated(step: Step) -> None:
    current = step.state.current
    if step.state.mode is Mode.MOVING and current is not None and current.turns:
        step.tell(FeedbackCode.SUCCESS_ESTIMATE_ROTATION, id=current.goal.id)
        step.tell(FeedbackCode.VERIFY_ROTATION, id=current.goal.id)


def _finished(step: Step, event: Arrived | Failed) -> None:
    current = step.state.current
    if step.state.mode is not Mode.MOVING or current is None or not current.goal.moves:
        return
    if current.patrols:
        _patrol_on(step, current, isinstance(event, Arrived))
    elif isinstance(event, Arrived):
        word = "" if event.moved_to is None else MOVED
        step.end(current.goal, _SUCCESS[type(current.goal.command)], at=event.moved_to, detail=word)
        step.state = replace(step.state, anchor=current.goal.end)
        step.go_next()
    else:
        _failed(step, current.goal)


def _failed(step: Step, goal: Goal) -> None:
    began = step.state.began
    if began is None or began.point.distance_to(step.here.pose.point) < STRAYED_M:
        step.end(goal, FeedbackCode.UNREACHABLE)
        step.go_on_from_here()
        return
    step.effects.append(Halt())
    step.end(goal, FeedbackCode.STRAYED)
    step.tell(FeedbackCode.HELP, id=goal.id)
    step.state = replace(step.state, mode=Mode.AWAITING, anchor=None)


def _patrol_on(step: Step, current: Current, reached: bool) -> None:
    following, news = after_vertex(current, reached)
    for code, detail in news:
        step.tell(code, id=current.goal.id, detail=detail)
    if following is None:
        step.end(current.goal, FeedbackCode.FINISH_PATROL)
        step.go_on_from_here()
    else:
        step.state = replace(step.state, current=following)
        step.pursue(following)


def _pictured(step: Step, entry: int, code: FeedbackCode, path: str) -> None:
    current = step.state.current
    if current is not None and current.goal.entry == entry and not current.goal.moves:
        step.end(current.goal, code, detail=path)
        if step.state.mode is Mode.MOVING:
            step.go_next()
        return
    for goal in step.state.pictures:
        if goal.entry == entry:
            step.tell(code, id=goal.id, detail=path)
            step.forget(entry)
    step.state = replace(step.state, pictures=tuple(goal for goal in step.state.pictures if goal.entry != entry))


def _reset(step: Step) -> None:
    step.drop_all()
    for goal in step.state.pictures:
        step.drop(goal)
    step.state = IDLE
    step.tell(FeedbackCode.READY)


def _resumed(step: Step, admitted: int, unhandled: bool) -> None:
    step.state = replace(step.state, admitted=admitted)
    for goal in step.state.pictures:
        step.effects.append(Photograph(goal.entry))
    if step.state.mode is Mode.AWAITING:
        step.tell(FeedbackCode.HELP)
    elif unhandled or step.state.mode is not Mode.READY:
        step.pause()
        step.tell(FeedbackCode.PAUSED)
    else:
        step.tell(FeedbackCode.READY)
