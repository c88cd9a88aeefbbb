"""The robot's feedback: what it changes in the conversation, and what Kirby says of it.

The robot's messages are the paper's; Kirby says them as they are.
"""

from __future__ import annotations

from functools import reduce

from robot.geometry import Pose
from robot.messages import Control, FeedbackCode, ideal_end
from robot.messages import Turn as TurnCommand

from .events import RobotFeedback, Tone
from .session import Session, Task
from .table import Activity
from .turn import Turn
from .wording import turned

Code = FeedbackCode

ENDINGS = frozenset(
    {
        Code.SUCCESS_FORWARD,
        Code.SUCCESS_GO_TO,
        Code.SUCCESS_VERIFY_ROTATION,
        Code.SUCCESS_GO_BACK,
        Code.FINISH_PATROL,
        Code.STOP_PATROL,
        Code.PICTURE,
        Code.UNREACHABLE,
        Code.STRAYED,
        Code.CANCELLED_GOAL,
        Code.INVALID,
    }
)
"""What ends a movement; a command that acts at once ends with whatever comes under its id."""

_ACTIVITY = {
    Code.READY: Activity.RESTING,
    Code.FORWARD: Activity.MOVING,
    Code.GO_TO: Activity.MOVING,
    Code.ESTIMATE_ROTATION: Activity.MOVING,
    Code.GO_BACK: Activity.MOVING,
    Code.RESTARTING: Activity.MOVING,
    Code.PATROL: Activity.PATROLLING,
    Code.PAUSED: Activity.PAUSED,
    Code.HELP: Activity.STRAYED,
}
_UNSAID = frozenset({Code.ESTIMATE_ROTATION, Code.SUCCESS_ESTIMATE_ROTATION, Code.VERIFY_ROTATION})
_FAILURES = frozenset({Code.INVALID, Code.UNREACHABLE, Code.STRAYED})

_BY_ORDER = frozenset({Code.PAUSED, Code.CANCELLED_GOAL, Code.CANCELLED_ALL, Code.STOP_PATROL})


def hear_robot(turn: Turn, event: RobotFeedback) -> None:
    """Update what the robot is at, and tell."""
    feedback = event.feedback
    task = next((task for task in turn.session.tasks if task.id == feedback.id), None)
    if task is not None and (feedback.code in ENDINGS or not task.moves):
        turn.update(tasks=tuple(other for other in turn.session.tasks if other != task))
    if feedback.code in _FAILURES or feedback.code in (Code.CANCELLED_GOAL, Code.CANCELLED_ALL):
        turn.update(ideal=_recomputed(turn.session))
    if feedback.code in _FAILURES:
        turn.update(reason=feedback.message)
    elif feedback.code in _BY_ORDER:
        turn.update(reason="")
    _tell(turn, event, task)
    _follow(turn, event)


def _recomputed(session: Session) -> Pose | None:
    """Where what is left ends: the robot works it out anew from where it is (RSB, ``cancel``)."""
    left = [task.command for task in session.pending]
    return reduce(ideal_end, left, session.world.robot) if left else None


def _tell(turn: Turn, event: RobotFeedback, task: Task | None) -> None:
    code, message = event.feedback.code, event.feedback.message
    dropped = code in (Code.CANCELLED_GOAL, Code.STOP_PATROL) and task is not None and task.moves
    # Help is asked for below; a goal that was dropped is told by the answer to the command that dropped it.
    if code in _UNSAID or code is Code.HELP or dropped:
        return
    if code is Code.QUEUE and turn.session.activity is Activity.LEFT_OVER:
        what = message.removeprefix("pending: ")
        turn.say(f"I am paused on '{what}': continue, cancel or go back?", Tone.QUESTION)
    elif code is Code.SUCCESS_VERIFY_ROTATION and task is not None and isinstance(task.command, TurnCommand):
        turn.say(turned(task.command), Tone.NEWS)
    else:
        turn.say(message, Tone.REFUSAL if code in _FAILURES else Tone.NEWS)


def _follow(turn: Turn, event: RobotFeedback) -> None:
    """Take over what the robot is at."""
    feedback = event.feedback
    activity = _ACTIVITY.get(feedback.code)
    if feedback.code is Code.PAUSED and feedback.id is None:
        _left_over(turn)
    elif feedback.code is Code.READY and turn.session.moving:
        return  # said before it read what was sent
    elif feedback.code in ENDINGS and _is_done(turn):
        turn.robot_is(Activity.RESTING)
    elif activity is not None and activity is not turn.session.activity:
        turn.robot_is(activity)
        if activity is Activity.STRAYED:
            turn.say(f"{feedback.message}. Shall I keep going?", Tone.QUESTION)


def _is_done(turn: Turn) -> bool:
    """Whether what ended was the last of what was sent."""
    moving = turn.session.activity in (Activity.MOVING, Activity.PATROLLING)
    return moving and not turn.session.moving


def _left_over(turn: Turn) -> None:
    """A pause that nobody asked for: the robot started anew, and had something to do before."""
    turn.robot_is(Activity.LEFT_OVER)
    turn.dispatch((Control.QUEUE,))
