"""Following a path: regulated pure pursuit (Macenski et al., Autonomous Robots 47, 2023), with turning in place."""

from __future__ import annotations

import math
from dataclasses import dataclass

from robot.body import Limits
from robot.geometry import Point, Pose, wrap_angle

from .rotation import turn_speed

LOOKAHEAD_MIN_M = 0.2
LOOKAHEAD_MAX_M = 0.4
LOOKAHEAD_S = 1.5
TURN_IN_PLACE_RAD = 0.8  # off by more: stop and turn
TURNED_RAD = 0.12
NEAR_GOAL_M = 0.15
NEAR_GOAL_TURN_RAD = 0.3
ARRIVED_M = 0.008
PASSED_M = 0.018  # good enough once the goal is abeam
BRAKE_SHARE = 0.3
SLOW_RADIUS_M = 0.5  # curves tighter than this are taken more slowly
SLOW_CLEARANCE_M = 0.25  # beyond the robot's circle
SLOWEST_SHARE = 0.4
CREEP_MPS = 0.03
STEER_GAIN = 2.5  # radians a second per radian, near the goal


@dataclass(frozen=True, slots=True)
class Twist:
    """Linear and angular velocity to command."""

    linear_mps: float
    angular_radps: float


class Follower:
    """Drives along one path, forwards or backwards, and remembers how far it has come."""

    def __init__(self, path: tuple[Point, ...], limits: Limits, backwards: bool = False) -> None:
        self.path = path
        self.backwards = backwards
        self._limits = limits
        self._leg = 0
        self._turning = False

    @property
    def goal(self) -> Point:
        return self.path[-1]

    def rest(self, pose: Pose) -> tuple[Point, ...]:
        """The path that is still ahead, from the robot on."""
        return (pose.point, *self.path[self._leg + 1 :])

    def has_arrived(self, pose: Pose) -> bool:
        """Whether the goal is reached as well as a wheeled robot can without turning back."""
        distance_m = pose.point.distance_to(self.goal)
        ahead_m = self._facing(pose).to_local(self.goal).x_m
        return distance_m <= ARRIVED_M or (distance_m <= PASSED_M and ahead_m <= 0.002)

    def step(self, pose: Pose, speed_mps: float, clearance_m: float) -> Twist:
        """The velocities to command now; ``speed_mps`` is the present one, ``clearance_m`` to the nearest echo."""
        facing = self._facing(pose)
        self._advance(facing.point)
        goal_m = facing.point.distance_to(self.goal)
        if len(self.path) - self._leg <= 2 and goal_m < NEAR_GOAL_M:
            return self._dock(facing, goal_m)
        lookahead_m = min(max(abs(speed_mps) * LOOKAHEAD_S, LOOKAHEAD_MIN_M), LOOKAHEAD_MAX_M)
        carrot = self._carrot(facing.point, min(lookahead_m, max(clearance_m, LOOKAHEAD_MIN_M)))
        off_rad = wrap_angle(facing.point.bearing_to(carrot) - facing.yaw_rad)
        if self._must_turn(off_rad, TURN_IN_PLACE_RAD):
            return Twist(0.0, turn_speed(off_rad, self._limits))
        curvature = 2.0 * math.sin(off_rad) / max(facing.point.distance_to(carrot), 0.05)
        speed = self._regulated(curvature, clearance_m - self._limits.radius_m, goal_m)
        return self._signed(speed, speed * curvature)

    def _dock(self, facing: Pose, goal_m: float) -> Twist:
        """The last centimetres: straight at the goal, or straight back to it when it was passed."""
        off_rad = wrap_angle(facing.point.bearing_to(self.goal) - facing.yaw_rad)
        way = 1.0
        if abs(off_rad) > math.pi / 2.0:
            off_rad, way = wrap_angle(off_rad + math.pi), -1.0
        if self._must_turn(off_rad, NEAR_GOAL_TURN_RAD):
            return Twist(0.0, turn_speed(off_rad, self._limits) * 0.5)
        speed = min(max(goal_m, CREEP_MPS), self._braking(goal_m))
        return self._signed(way * speed, STEER_GAIN * off_rad)

    def _regulated(self, curvature: float, room_m: float, goal_m: float) -> float:
        speed = self._limits.linear_max_mps
        speed *= min(1.0, max(SLOWEST_SHARE, 1.0 / max(abs(curvature) * SLOW_RADIUS_M, 1e-6)))
        speed *= min(1.0, max(SLOWEST_SHARE, room_m / SLOW_CLEARANCE_M))
        if abs(curvature) > 1e-6:
            speed = min(speed, self._limits.angular_max_radps / abs(curvature))
        return max(min(speed, self._braking(goal_m)), CREEP_MPS)

    def _braking(self, distance_m: float) -> float:
        return math.sqrt(2.0 * BRAKE_SHARE * self._limits.linear_acceleration_mps2 * max(distance_m, 1e-4))

    def _must_turn(self, off_rad: float, threshold_rad: float) -> bool:
        """With hysteresis: once turning, until nearly straight."""
        self._turning = abs(off_rad) > (TURNED_RAD if self._turning else threshold_rad)
        return self._turning

    def _facing(self, pose: Pose) -> Pose:
        return pose.turned(math.pi) if self.backwards else pose

    def _signed(self, linear_mps: float, angular_radps: float) -> Twist:
        return Twist(-linear_mps if self.backwards else linear_mps, angular_radps)

    def _advance(self, place: Point) -> None:
        """Go on to the next leg of the path when its line is as near as the present one's."""
        while self._leg + 2 < len(self.path):
            here = place.distance_to(_nearest(place, self.path[self._leg], self.path[self._leg + 1]))
            there = place.distance_to(_nearest(place, self.path[self._leg + 1], self.path[self._leg + 2]))
            if there > here:
                return
            self._leg += 1

    def _carrot(self, place: Point, lookahead_m: float) -> Point:
        """The place on the path ``lookahead_m`` beyond the one nearest to ``place``."""
        here = _nearest(place, self.path[self._leg], self.path[self._leg + 1])
        for corner in self.path[self._leg + 1 :]:
            leg_m = here.distance_to(corner)
            if leg_m >= lookahead_m:
                return here.moved(lookahead_m, here.bearing_to(corner))
            here, lookahead_m = corner, lookahead_m - leg_m
        return here


def _nearest(place: Point, start: Point, end: Point) -> Point:
    """The place on the straight way from ``start`` to ``end`` that is nearest to ``place``."""
    dx, dy = end.x_m - start.x_m, end.y_m - start.y_m
    squared = dx * dx + dy * dy
    if squared == 0.0:
        return start
    share = ((place.x_m - start.x_m) * dx + (place.y_m - start.y_m) * dy) / squared
    share = min(max(share, 0.0), 1.0)
    return Point(start.x_m + share * dx, start.y_m + share * dy)
