"""The sense, map, decide, drive loop around a `KinematicBody`, for tests of mapping and navigation together."""

from __future__ import annotations

from collections.abc import Callable

from kinematic_body import KinematicBody

from robot.body import Scan
from robot.geometry import Pose
from robot.localisation import Localiser
from robot.mapping import Mapper
from robot.navigation import Drive, Goal, Navigator, State

PERIOD_S = 0.05


class Pilot:
    """Drives one body; ``pose`` is where it believes to be, ``driven_m`` how far it has really gone."""

    def __init__(self, body: KinematicBody) -> None:
        self.body = body
        self.mapper = Mapper()
        self.navigator = Navigator(body.limits)
        self.driven_m = 0.0
        self._localiser = Localiser(self.mapper, body.odometry(), body.pose)
        self._scan: Scan | None = None
        self._sense()

    @property
    def pose(self) -> Pose:
        return self._localiser.pose

    def pursue(self, goal: Goal, limit_s: float = 600.0, watch: Callable[[Drive], bool] | None = None) -> Drive:
        """Do ``goal`` to its end, or until ``watch`` says to stop; the last drive. The robot comes to rest."""
        self.navigator.start(goal, self.pose, self.body.time_s)
        return self.go_on(limit_s, watch)

    def go_on(self, limit_s: float = 600.0, watch: Callable[[Drive], bool] | None = None) -> Drive:
        """As :meth:`pursue`, with the goal that is under way."""
        end_s = self.body.time_s + limit_s
        drive = self._step()
        while drive.state is State.ACTIVE and self.body.time_s < end_s and not (watch and watch(drive)):
            drive = self._step()
        self.rest()
        return drive

    def rest(self, duration_s: float = 0.6) -> None:
        """Stand still, sensing."""
        self.body.drive(0.0, 0.0)
        for _ in range(round(duration_s / PERIOD_S)):
            self._tick()

    def _step(self) -> Drive:
        drive = self.navigator.step(self.pose, self._scan, self.mapper.grid, self.body.time_s)
        self.body.drive(drive.linear_mps, drive.angular_radps)
        if drive.state is State.ACTIVE:
            self._tick()
        return drive

    def _tick(self) -> None:
        before = self.body.pose
        self.body.step(PERIOD_S)
        self.driven_m += before.point.distance_to(self.body.pose.point)
        self._sense()

    def _sense(self) -> None:
        self._localiser.move(self.body.odometry())
        scan = self.body.scan()
        if scan is not None:
            self._scan = scan
            self._localiser.see(scan)


def offset(pose: Pose, truth: Pose) -> float:
    """Metres between two poses."""
    return pose.point.distance_to(truth.point)
