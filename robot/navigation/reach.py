"""Reaching a place: plan, follow, replan as the map grows, recover when stuck, give up when hopeless."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from robot.body import Limits
from robot.geometry import Point, Pose, wrap_angle
from robot.mapping.grid import OccupancyGrid

from .costmap import Costmap, build_costmap
from .follower import Follower, Twist
from .goals import Drive, Phase, Reach, Reason, Rotate, State
from .planner import Plan, plan
from .recovery import Recovery
from .rotation import Rotation
from .shield import Surroundings

REPLAN_EVERY_S = 2.0
REPLAN_AT_LEAST_S = 0.4
BETTER_SHARE = 0.9  # a new way must cost less than this share of the old one to be taken while the old one is good
NO_WAY_CHECKS = 3  # plans without a way, half a second apart, before it counts as proven
NO_WAY_PERIOD_S = 0.5
LOOK_AHEAD_M = 3.0  # how far ahead the path is checked against the laser
AT_ROBOT_M = 0.3  # nearer than this the shield watches
STUCK_S = 3.0
STUCK_M = 0.05
STUCK_RAD = 0.3
PATIENCE_S = 90.0  # without a cheaper way or anything new on the map
NEWS_CELLS = 40
NEAR_ENOUGH_M = 0.1  # a goal so near that cannot be driven onto counts as moved
BEHIND_RAD = math.radians(120.0)


@dataclass(frozen=True, slots=True)
class View:
    """What one control step has to go by; ``now_s`` counts only the time spent on the goal."""

    pose: Pose
    surroundings: Surroundings
    grid: OccupancyGrid
    now_s: float
    period_s: float
    speed_mps: float


class Reaching:
    """One :class:`Reach` under way."""

    def __init__(self, goal: Reach, limits: Limits) -> None:
        self.goal = goal
        self._limits = limits
        self._follower: Follower | None = None
        self._backwards_allowed = goal.reverse
        self._moved_to: Point | None = None
        self._planned_s = -math.inf
        self._planned_cells = 0
        self._checked_scan_s = -math.inf
        self._no_way = 0
        self._reason: Reason | None = None
        self._recovery = Recovery()
        self._aligning: Rotation | None = None
        self._anchor: tuple[Pose, float] | None = None
        self._best_cost_m = math.inf
        self._known_cells = 0
        self._hope_s = 0.0

    def step(self, view: View) -> Drive:
        """The command for now, not yet checked for collisions."""
        if self._aligning is not None:
            return self._align(view)
        if self._follower is not None and self._follower.has_arrived(view.pose):
            return self._arrived(view)
        if self._recovery.is_active:
            return self._recover(view)
        if self._needs_plan(view):
            self._plan(view)
        if self._reason is not None:
            return Drive(0.0, 0.0, State.FAILED, Phase.FOLLOW, (), self._reason)
        if self._follower is None:
            return self._drive(Twist(0.0, 0.0), view)
        if self._is_stuck(view):
            return self._stuck(view)
        return self._drive(self._follower.step(view.pose, view.speed_mps, self._clearance(view)), view)

    # -------------------------------------------------------------- planning
    def _needs_plan(self, view: View) -> bool:
        waited_s = view.now_s - self._planned_s
        if self._follower is None:
            return waited_s >= NO_WAY_PERIOD_S
        if waited_s < REPLAN_AT_LEAST_S or self._checked_scan_s == view.surroundings.time_s:
            return False
        self._checked_scan_s = view.surroundings.time_s
        if self._is_blocked(view):
            return True
        news = abs(view.grid.known_cells - self._planned_cells) >= NEWS_CELLS
        return news and waited_s >= REPLAN_EVERY_S and not self._follower.backwards

    def _plan(self, view: View) -> None:
        self._planned_s, self._planned_cells = view.now_s, view.grid.known_cells
        if self._backwards_allowed and self._plan_backwards(view):
            return
        rest = self._follower.rest(view.pose) if self._follower is not None else ()
        costmap = build_costmap(view.grid, view.pose.point, (self.goal.place, *rest), self._limits.radius_m)
        found = plan(costmap, view.pose.point, self.goal.place)
        if isinstance(found, Reason):
            self._no_way += 1
            self._follower = None
            self._reason = found if self._no_way >= NO_WAY_CHECKS else None
            return
        self._no_way = 0
        self._keep_hope(found, view)
        if self._follower is None or self._follower.backwards or self._is_better(found, costmap, view):
            self._follower = Follower(found.path, self._limits)
            self._moved_to = found.moved_to

    def _is_better(self, found: Plan, costmap: Costmap, view: View) -> bool:
        """Whether the new plan is worth leaving a path that may still be good: it must not swing between two ways."""
        assert self._follower is not None
        if self._is_blocked(view) or found.moved_to != self._moved_to:
            return True
        rest = self._follower.rest(view.pose)
        rest_m = sum(costmap.line_cost(a, b) for a, b in pairwise(rest))
        return found.cost_m < BETTER_SHARE * rest_m

    def _plan_backwards(self, view: View) -> bool:
        """Back straight up if the goal lies behind and nothing known or seen is in between."""
        pose, goal = view.pose, self.goal.place
        off_rad = wrap_angle(pose.point.bearing_to(goal) - pose.yaw_rad)
        self._backwards_allowed = False
        if abs(off_rad) < BEHIND_RAD:
            return False
        costmap = build_costmap(view.grid, pose.point, (goal,), self._limits.radius_m)
        if not math.isfinite(costmap.line_cost(pose.point, goal)):
            return False
        self._follower = Follower((pose.point, goal), self._limits, backwards=True)
        return True

    def _is_blocked(self, view: View) -> bool:
        """Whether the laser sees something within the robot's radius of the path just ahead."""
        assert self._follower is not None
        points = view.surroundings.points
        way_m = 0.0
        rest = self._follower.rest(view.pose)
        for start, end in pairwise(rest):
            leg_m = start.distance_to(end)
            if way_m > LOOK_AHEAD_M or leg_m == 0.0:
                break
            ux, uy = (end.x_m - start.x_m) / leg_m, (end.y_m - start.y_m) / leg_m
            dx, dy = points[:, 0] - start.x_m, points[:, 1] - start.y_m
            along = np.clip(dx * ux + dy * uy, 0.0, leg_m)
            near = (np.hypot(dx - along * ux, dy - along * uy) < self._limits.radius_m) & (way_m + along > AT_ROBOT_M)
            if near.any():
                return True
            way_m += leg_m
        return False

    # -------------------------------------------------------------- trouble
    def _keep_hope(self, found: Plan, view: View) -> None:
        """Note progress: a cheaper rest of the way, or something new on the map."""
        grown = view.grid.known_cells - self._known_cells
        if found.cost_m < self._best_cost_m - STUCK_M or abs(grown) >= NEWS_CELLS:
            self._hope_s = view.now_s
            self._known_cells = view.grid.known_cells
        self._best_cost_m = min(self._best_cost_m, found.cost_m)
        if view.now_s - self._hope_s > PATIENCE_S:
            self._reason = Reason.STUCK

    def _is_stuck(self, view: View) -> bool:
        if self._anchor is None:
            self._anchor = (view.pose, view.now_s)
        pose, since_s = self._anchor
        moved = pose.point.distance_to(view.pose.point) > STUCK_M
        if moved or abs(wrap_angle(view.pose.yaw_rad - pose.yaw_rad)) > STUCK_RAD:
            self._anchor = (view.pose, view.now_s)
            return False
        return view.now_s - since_s > STUCK_S

    def _stuck(self, view: View) -> Drive:
        self._anchor = None
        if self._follower is not None and view.pose.point.distance_to(self._follower.goal) < NEAR_ENOUGH_M:
            # What the laser sees leaves no room for the last step, finer than the grid's cells can tell.
            self._moved_to = view.pose.point
            return self._arrived(view)
        self._follower = None
        self._planned_s = -math.inf
        if self._recovery.start(view.pose, view.now_s):
            return self._recover(view)
        return Drive(0.0, 0.0, State.FAILED, Phase.RECOVER, (), Reason.STUCK)

    def _recover(self, view: View) -> Drive:
        twist = self._recovery.step(view.pose, view.now_s)
        return Drive(twist.linear_mps, twist.angular_radps, State.ACTIVE, Phase.RECOVER)

    # -------------------------------------------------------------- arriving
    def _arrived(self, view: View) -> Drive:
        if self.goal.yaw_rad is None:
            return Drive(0.0, 0.0, State.ARRIVED, Phase.FOLLOW, (), None, self._moved_to)
        turn = Rotate(wrap_angle(self.goal.yaw_rad - view.pose.yaw_rad), self.goal.yaw_rad)
        self._aligning = Rotation(turn, view.pose.yaw_rad, self._limits)
        return self._align(view)

    def _align(self, view: View) -> Drive:
        assert self._aligning is not None
        angular = self._aligning.step(view.pose.yaw_rad, view.period_s)
        if self._aligning.is_done:
            return Drive(0.0, 0.0, State.ARRIVED, Phase.ALIGN, (), None, self._moved_to)
        return Drive(0.0, angular, State.ACTIVE, Phase.ALIGN, (), None, self._moved_to)

    def _clearance(self, view: View) -> float:
        return view.surroundings.clearance_m(view.pose)

    def _drive(self, twist: Twist, view: View) -> Drive:
        path = self._follower.rest(view.pose) if self._follower is not None else ()
        return Drive(twist.linear_mps, twist.angular_radps, State.ACTIVE, Phase.FOLLOW, path, None, self._moved_to)
