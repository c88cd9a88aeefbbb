"""The handling of one event: the state as it becomes, the effects so far, and the ways in which the queue moves on."""

from __future__ import annotations

import math
from dataclasses import replace

from robot.geometry import Point, Pose, wrap_angle
from robot.messages import (
    Command,
    Control,
    FeedbackCode,
    GoForward,
    GoTo,
    Patrol,
    Side,
    Turn,
    feedback,
    ideal_end,
)
from robot.navigation.goals import Goal as Target
from robot.navigation.goals import Reach, Rotate

from .patrol import vertex
from .state import (
    Begin,
    Current,
    Effect,
    Forget,
    Goal,
    Halt,
    Here,
    Mode,
    Photograph,
    QueueState,
    Tell,
)

# A robot this near to where its last movement ideally ended has not been carried away since: the next one is reckoned
# from that ideal, so that errors do not add up over commands given one by one either.
ANCHOR_M = 0.15
ANCHOR_RAD = math.radians(10.0)

_BEGIN: dict[type[Command], FeedbackCode] = {
    GoForward: FeedbackCode.FORWARD,
    GoTo: FeedbackCode.GO_TO,
    Turn: FeedbackCode.ESTIMATE_ROTATION,
    Patrol: FeedbackCode.PATROL,
    Control: FeedbackCode.GO_BACK,
}


class Step:
    """A working copy of the state and the effects collected on the way."""

    def __init__(self, state: QueueState, here: Here) -> None:
        self.state = state
        self.here = here
        self.effects: list[Effect] = []

    def tell(self, code: FeedbackCode, *, id: str | None = None, at: Point | None = None, detail: str = "") -> None:
        self.effects.append(Tell(feedback(code, at=at, detail=detail, id=id)))

    def refuse(self, entry: int, id: str | None, reason: str) -> None:
        self.tell(FeedbackCode.INVALID, id=id, detail=reason)
        self.forget(entry)

    def forget(self, entry: int) -> None:
        self.effects.append(Forget(entry))

    def end(self, goal: Goal, code: FeedbackCode, *, at: Point | None = None, detail: str = "") -> None:
        """The goal's ending, told under its id; ``at`` is where, if not at its own place."""
        self.tell(code, id=goal.id, at=at or goal.end.point, detail=detail)
        self.forget(goal.entry)
        self.state = replace(self.state, current=None)

    def drop(self, goal: Goal, code: FeedbackCode = FeedbackCode.CANCELLED_GOAL) -> None:
        """End a goal on command: told under its id, and not at all without one, for the command's own answer tells."""
        if goal.id is not None:
            self.tell(code, id=goal.id)
        self.forget(goal.entry)

    def drop_all(self) -> None:
        """Halt, and drop everything that is being done or pending."""
        self.effects.append(Halt())
        for goal in self.state.goals:
            self.drop(goal)
        self.state = replace(self.state, mode=Mode.READY, current=None, pending=(), anchor=None)

    def pause(self) -> None:
        """Keep what was being done for later; a turn keeps what is left of it."""
        current = self.state.current
        if current is not None and current.turns:
            current = replace(current, remaining_rad=current.remaining_rad - self.here.turned_rad)
        self.state = replace(self.state, mode=Mode.PAUSED, current=current)

    def go_next(self) -> None:
        """Begin the first pending goal, or be ready."""
        if not self.state.pending:
            self.state = replace(self.state, mode=Mode.READY, current=None)
            self.tell(FeedbackCode.READY)
            return
        goal, *rest = self.state.pending
        current = Current(goal, _turn_rad(goal, self.here.pose))
        began = self.here.pose if goal.moves else self.state.began
        self.state = replace(self.state, mode=Mode.MOVING, current=current, pending=tuple(rest), began=began)
        if goal.moves:
            self.tell(_BEGIN[type(goal.command)], id=goal.id, at=goal.end.point)
        if current.patrols:
            self.tell(FeedbackCode.PLAN_LOOP, id=goal.id, detail="1")
        self.pursue(current)

    def go_on_from_here(self) -> None:
        """The rest of the queue, recomputed from where the robot really is."""
        self.effects.append(Halt())
        pending = _from(self.here.pose, self.state.pending)
        self.state = replace(self.state, current=None, pending=pending, anchor=None)
        self.go_next()

    def drop_pending(self, goal: Goal) -> None:
        """End one that waits; those after it are recomputed from the ideal end of the one before it."""
        at = self.state.pending.index(goal)
        before, after = self.state.pending[:at], self.state.pending[at + 1 :]
        self.drop(goal)
        self.state = replace(self.state, pending=(*before, *_from(goal.start, after)))

    def pursue(self, current: Current) -> None:
        """Set the robot to this goal, from the start or from where it was paused."""
        if current.goal.moves:
            self.effects.append(Begin(self._target(current)))
        else:
            self.effects.append(Photograph(current.goal.entry))

    def _target(self, current: Current) -> Target:
        goal = current.goal
        if current.turns:
            return Rotate(current.remaining_rad, goal.end.yaw_rad)
        if current.patrols:
            return Reach(vertex(current), None)
        # Whatever drives next turns on its own way: the heading is taken only where it will be seen or built upon.
        driven_on = bool(self.state.pending) and isinstance(self.state.pending[0].command, GoForward | GoTo)
        backwards = isinstance(goal.command, GoForward) and goal.command.distance_m < 0
        return Reach(goal.end.point, None if driven_on else goal.end.yaw_rad, backwards)

    def last_end(self) -> Pose:
        """Where the next movement starts: the ideal end of the one before, unless the robot is elsewhere by now."""
        goals = self.state.goals
        if goals:
            return goals[-1].end
        pose, anchor = self.here.pose, self.state.anchor
        if anchor is None or pose.point.distance_to(anchor.point) > ANCHOR_M:
            return pose
        return anchor if abs(wrap_angle(pose.yaw_rad - anchor.yaw_rad)) <= ANCHOR_RAD else pose


def _from(start: Pose, goals: tuple[Goal, ...]) -> tuple[Goal, ...]:
    """The same goals, each from the ideal end of the one before."""
    chained: list[Goal] = []
    for goal in goals:
        chained.append(replace(goal, start=start, end=ideal_end(start, goal.command)))
        start = chained[-1].end
    return tuple(chained)


def _turn_rad(goal: Goal, pose: Pose) -> float:
    """How far to turn from ``pose``: the angle asked for, and what the robot is off the heading to start from."""
    if not isinstance(goal.command, Turn):
        return 0.0
    angle_rad = math.radians(goal.command.angle_deg)
    signed_rad = angle_rad if goal.command.side is Side.LEFT else -angle_rad
    return signed_rad + wrap_angle(goal.start.yaw_rad - pose.yaw_rad)
