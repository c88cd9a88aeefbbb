"""Where the robot believes it is: lines, ends and markers that hold it, and what happens when they do not."""

from __future__ import annotations

import math

import pytest
from kinematic_body import EXACT, HARSH, TYPICAL, KinematicBody, Noise, box, polygon
from pilot import Pilot, offset

from robot.body import Odometry, Scan
from robot.fiducials import Sighting
from robot.geometry import ORIGIN, Point, Pose, Segment, wrap_angle
from robot.localisation import Localiser
from robot.mapping import Mapper
from robot.mapping.sighted_lines import sight_lines
from robot.navigation import Reach, State

ROOM = polygon((-3, -2), (3, -2), (3, 2), (-3, 2)) + box(1.5, -1.2, 0.4, 0.4) + box(-1.5, 1.0, 0.5, 0.3)
CORRIDOR = polygon((-50, -1), (50, -1), (50, 1), (-50, 1))
PLAIN = polygon((-90, -90), (90, -90), (90, 90), (-90, 90))  # nothing within the laser's reach
# Twelve boxes 4 m apart in a yard, around which a lap is 40 m: from where it starts its far side is out of sight.
YARD = PLAIN + tuple(
    side
    for x_m, y_m in ((0, 0), (4, 0), (8, 0), (12, 0), (12, 4), (12, 8), (8, 8), (4, 8), (0, 8), (0, 4), (6, 4), (8, 4))
    for side in box(x_m, y_m, 0.6, 0.5)
)
LAP = (Point(13.2, -1.2), Point(13.2, 9.2), Point(-1.2, 9.2), Point(-1.2, -1.2))
EYE = ORIGIN.ahead(0.1)


def seen_from(walls: tuple[Segment, ...], pose: Pose, time_s: float = 0.0, noise: Noise = EXACT) -> Scan:
    scan = KinematicBody(walls, pose, noise=noise, seed=round(1e3 * time_s)).scan()
    assert scan is not None
    return Scan(time_s, scan.angles_rad, scan.ranges_m, scan.min_range_m, scan.max_range_m)


class Walker:
    """Is put from pose to pose; odometry counts what it is told to."""

    def __init__(self, walls: tuple[Segment, ...], start: Pose = ORIGIN, noise: Noise = TYPICAL) -> None:
        self.walls, self.noise = walls, noise
        self.truth = self.counted = start
        self.time_s = 0.0
        self.localiser = Localiser(Mapper(), Odometry(0.0, start, 0.0, 0.0), start)
        self.look()

    def go(self, step: Pose, counted: Pose | None = None) -> None:
        """Move by ``step`` and look; odometry counts ``counted`` instead of it."""
        self.truth, self.counted = self.truth.compose(step), self.counted.compose(counted or step)
        self.time_s += 0.2
        self.localiser.move(Odometry(self.time_s, self.counted, 0.0, 0.0))
        self.look()

    def look(self) -> None:
        self.localiser.see(seen_from(self.walls, self.truth, self.time_s, self.noise))

    @property
    def off_m(self) -> float:
        return offset(self.localiser.pose, self.truth)

    @property
    def off_rad(self) -> float:
        return abs(wrap_angle(self.localiser.pose.yaw_rad - self.truth.yaw_rad))


def test_a_bare_corridor_does_not_drag_the_robot_along_its_axis() -> None:
    """Along the axis there is nothing to see: what odometry says stands; across it the walls do."""
    walker = Walker(CORRIDOR)
    for _ in range(40):
        walker.go(Pose(0.05, 0.0, 0.0), counted=Pose(0.05, 0.0, 0.001))
    assert walker.localiser.pose.x_m == pytest.approx(walker.counted.point.distance_to(Point(0, 0)), abs=0.01)
    assert walker.localiser.pose.y_m == pytest.approx(0.0, abs=0.01)
    assert walker.off_rad < math.radians(0.2)
    assert abs(walker.counted.yaw_rad) > math.radians(2.0)


def test_a_scan_that_fits_nowhere_leaves_the_robot_where_odometry_says() -> None:
    walker = Walker(ROOM)
    for _ in range(10):
        walker.go(Pose(0.05, 0.0, 0.0))
    walker.walls = polygon((-0.6, -0.5), (0.7, -0.4), (0.9, 0.8))
    walker.go(Pose(0.05, 0.0, 0.02))
    assert offset(walker.localiser.pose, walker.counted) < 0.02


@pytest.mark.parametrize("step", [ORIGIN, Pose(0.05, 0.0, 0.02)])
@pytest.mark.parametrize(
    "push",
    [Pose(0.08, 0.05, 0.0), Pose(0.0, 0.0, 0.1), Pose(-0.06, 0.04, -0.08), Pose(0, 0, 0.2), Pose(0.05, 0.0, -0.2)],
)
def test_a_push_that_the_wheels_do_not_feel_is_found_out(push: Pose, step: Pose) -> None:
    """Whether the robot then drives on or stands."""
    walker = Walker(ROOM)
    for _ in range(20):
        walker.go(Pose(0.05, 0.0, 0.02))
    walker.go(push, counted=ORIGIN)
    for _ in range(20):
        walker.go(step)
    assert walker.off_m < 0.02
    assert walker.off_rad < math.radians(0.5)


@pytest.mark.parametrize("seed", range(3))
def test_wheels_much_worse_than_expected_are_found_out(seed: int) -> None:
    pilot = Pilot(KinematicBody(ROOM, noise=HARSH, seed=seed))
    farthest_m, counted_m = 0.0, 0.0

    def watch(_: object) -> bool:
        nonlocal farthest_m, counted_m
        farthest_m = max(farthest_m, offset(pilot.pose, pilot.body.pose))
        counted_m = max(counted_m, offset(pilot.body.odometry().pose, pilot.body.pose))
        return False

    for place in (Point(2.2, 1.2), Point(-2.2, 0.0), Point(0.5, -1.4), Point(0, 0)) * 2:
        assert pilot.pursue(Reach(place), watch=watch).state is State.ARRIVED
    assert farthest_m < 0.08
    assert offset(pilot.pose, pilot.body.pose) < 0.02
    assert counted_m > 0.1


def test_how_the_wheels_err_is_learnt_and_taken_off_what_they_count() -> None:
    walker = Walker(ROOM)
    for turn in range(400):  # to and fro in the middle of the room
        step_m = 0.05 if turn % 40 < 20 else -0.05
        walker.go(Pose(step_m, 0.0, 0.0), counted=Pose(step_m, 0.0, 0.005 * step_m))
    walker.walls = PLAIN
    before = walker.localiser.pose
    for _ in range(40):
        walker.go(Pose(0.05, 0.0, 0.0), counted=Pose(0.05, 0.0, 0.005 * 0.05))
    assert abs(wrap_angle(walker.localiser.pose.yaw_rad - before.yaw_rad)) < math.radians(0.1)


@pytest.mark.parametrize("seed", [0, 2])
def test_a_lap_among_sparse_things_closes(seed: int) -> None:
    """What was seen first puts right the pose after a lap, and with it the things on the far side."""
    pilot = Pilot(KinematicBody(YARD, Pose(-1.2, -1.2, 0.0), noise=TYPICAL, seed=seed))
    there: list[float] = []
    for place in LAP + LAP[:2]:
        assert pilot.pursue(Reach(place)).state is State.ARRIVED
        there.append(offset(pilot.pose, pilot.body.pose))
    assert max(there[:3]) > 0.04
    assert max(there[3:]) < 0.04


def test_a_thing_that_was_taken_away_is_not_held_on_to() -> None:
    """A box goes, another comes to stand 20 cm beside its place: the robot is not drawn after it."""
    here, there = box(1.6, 0.0, 0.5, 0.5), box(1.6, 0.2, 0.5, 0.5)
    walker = Walker(PLAIN + here + box(0.0, 1.5, 0.6, 0.3))
    for turn in range(40):
        walker.go(Pose(0.02, 0.0, 0.06 if turn % 20 < 10 else -0.06))
    walker.walls = PLAIN + there + box(0.0, 1.5, 0.6, 0.3)
    for turn in range(60):
        walker.go(Pose(0.02 if turn % 2 else -0.02, 0.0, 0.06 if turn % 20 < 10 else -0.06))
    assert walker.off_m < 0.03
    assert walker.off_rad < math.radians(1.0)


def test_a_laser_that_falls_silent_takes_nothing_away() -> None:
    walker = Walker(ROOM)
    for _ in range(40):
        walker.go(Pose(0.03, 0.0, 0.05))
    walker.walls = PLAIN
    for _ in range(12):
        walker.go(Pose(0.03, 0.0, 0.05), counted=Pose(0.032, 0.0, 0.052))
    walker.walls = ROOM
    for _ in range(5):
        walker.go(Pose(0.03, 0.0, 0.05))
    assert walker.off_m < 0.01
    assert walker.off_rad < math.radians(0.3)


def test_a_turn_of_which_no_scan_tells_counts_whole() -> None:
    """More than half a turn with a blind laser is the sum of what odometry says, not the difference of its ends."""
    walker = Walker(ROOM)
    for tick in range(1, 81):
        walker.counted = walker.counted.turned(0.05)
        walker.localiser.move(Odometry(0.05 * tick, walker.counted, 0.0, 1.0))
    assert walker.localiser.pose.yaw_rad == pytest.approx(wrap_angle(4.0))
    walker.truth, walker.time_s = walker.truth.turned(4.1), 4.0
    for _ in range(10):
        walker.go(Pose(0.03, 0.0, 0.0))
    assert walker.off_rad < math.radians(0.5)


def test_a_surveyed_map_tells_the_robot_where_it_is_and_leaves_it_there() -> None:
    walker = Walker(PLAIN)
    walker.walls = ROOM
    views = [Pose(x_m, 0.0, yaw_rad) for x_m in (-1.5, 0.0, 1.5) for yaw_rad in (0.0, math.pi)]
    walker.localiser.survey((pose, seen_from(ROOM, pose, 1.0 + n, TYPICAL)) for n, pose in enumerate(views))
    assert walker.off_m < 1e-9
    for _ in range(20):
        walker.go(Pose(0.05, 0.0, 0.0), counted=Pose(0.051, 0.0, 0.002))
    assert walker.off_m < 0.01
    assert walker.off_rad < math.radians(0.3)


def sighting(number: int, marker: Point, robot: Pose) -> Sighting:
    place = robot.to_local(marker)
    return Sighting(number, (place.x_m, place.y_m, 0.2), 0.0, 0.02, 0.05)


def drive_past(markers: dict[int, Point]) -> Walker:
    """6 m straight through nothing, seeing markers, with wheels that count a turn of 2 degrees in each metre."""
    walker = Walker(PLAIN)
    for _ in range(60):
        walker.go(Pose(0.1, 0.0, 0.0), counted=Pose(0.1, 0.0, math.radians(0.2)))
        see_markers(walker, markers)
    return walker


def see_markers(walker: Walker, markers: dict[int, Point]) -> None:
    found = [sighting(number, place, walker.truth) for number, place in markers.items()]
    walker.localiser.see_markers(walker.time_s, [each for each in found if each.position_m[0] > 0.3], EYE)


def test_markers_hold_the_heading_where_the_laser_sees_nothing() -> None:
    walker = drive_past({7: Point(8.0, 1.0), 8: Point(8.5, -1.5), 9: Point(5.0, 0.6)})
    assert abs(wrap_angle(walker.counted.yaw_rad)) > math.radians(10.0)
    assert walker.off_rad < math.radians(1.0)
    assert walker.off_m < 0.1


def test_a_marker_that_was_moved_counts_again_at_its_new_place() -> None:
    markers = {7: Point(8.0, 1.0), 8: Point(8.5, -1.5), 9: Point(9.0, 0.6)}
    walker = drive_past(markers)
    markers[7] = Point(8.0, -0.2)
    for _ in range(10):
        see_markers(walker, markers)
    assert walker.off_rad < math.radians(1.0)
    assert walker.off_m < 0.1


def test_a_push_is_not_taken_for_markers_that_were_moved() -> None:
    markers = {7: Point(8.0, 1.0), 8: Point(8.5, -1.5), 9: Point(9.0, 0.6)}
    walker = drive_past(markers)
    walker.go(Pose(0.05, 0.0, 0.15), counted=ORIGIN)
    for _ in range(6):
        see_markers(walker, markers)
    assert walker.off_rad < math.radians(1.5)


@pytest.mark.parametrize("where", [(math.nan, 0.0, 0.2), (0.1, 0.0, 0.2), (math.inf, 0.0, 0.2)])
def test_a_marker_nowhere_or_at_the_lens_is_passed_over(where: tuple[float, float, float]) -> None:
    walker = Walker(ROOM)
    for _ in range(3):
        walker.localiser.see_markers(walker.time_s, [Sighting(7, where, 0.0, 0.02, 0.05)], EYE)
    walker.localiser.see_markers(walker.time_s, [Sighting(8, (2.0, 0.0, 0.2), 0.0, math.nan, 0.05)], EYE)
    walker.go(Pose(0.05, 0.0, 0.0))
    assert walker.off_m < 0.01


def test_an_image_from_before_anything_that_is_remembered_corrects_nothing() -> None:
    walker = Walker(PLAIN)
    markers = {7: Point(9.0, 0.5), 8: Point(9.5, -0.5)}
    for _ in range(60):
        walker.go(Pose(0.05, 0.0, 0.0))
        see_markers(walker, markers)
    for _ in range(60):
        walker.go(Pose(0.0, 0.0, 0.0))
    before = walker.localiser.pose
    walker.localiser.see_markers(0.3, [sighting(number, at, ORIGIN) for number, at in markers.items()], EYE)
    assert walker.localiser.pose == before


def test_of_a_box_seen_from_the_front_the_face_and_both_ends_are_measured() -> None:
    lines = sight_lines(seen_from(PLAIN + box(1.5, 0.1, 0.4, 0.6), ORIGIN))
    assert len(lines) == 1
    line = lines[0]
    assert line.centre_m[0] == pytest.approx(1.3, abs=0.005)
    assert line.direction_rad == pytest.approx(math.pi / 2, abs=0.01)
    right, left = line.ends
    assert right is not None
    assert left is not None
    assert line.centre_m[1] + right.along_m == pytest.approx(-0.2, abs=0.02)
    assert line.centre_m[1] + left.along_m == pytest.approx(0.4, abs=0.02)


def test_an_end_that_something_hides_or_a_corner_is_no_end() -> None:
    hidden = PLAIN + box(2.0, 0.0, 0.4, 2.0) + box(1.0, 0.6, 0.2, 0.3)
    faces = [line for line in sight_lines(seen_from(hidden, ORIGIN)) if abs(line.centre_m[0] - 1.8) < 0.02]
    assert all(line.ends[1] is None or line.centre_m[1] + line.ends[1].along_m > 0.9 for line in faces)
    room = polygon((-2, -1.5), (2, -1.5), (2, 1.5), (-2, 1.5))
    assert all(end is None for line in sight_lines(seen_from(room, Pose(0.3, 0.2, 0.4))) for end in line.ends)
