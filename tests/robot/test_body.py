"""The simulated robot moves, senses and errs like a TurtleBot3 Waffle Pi, and the same calls give the same run."""

from __future__ import annotations

import math
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robot.body import Body
from robot.geometry import Pose
from robot.pybullet_body import PybulletBody
from robot.simulation.senses import NO_NOISE, Noise
from robot.turtlebot3 import LASER, LIMITS
from voxml.scene import Scene, SceneObject, Start, Wall

pytestmark = pytest.mark.physics

ROOM = Scene(
    "room",
    5,
    Start(0.0, 0.0, 0.0),
    (Wall(-1, -1, 2, -1), Wall(2, -1, 2, 1), Wall(2, 1, -1, 1), Wall(-1, 1, -1, -1)),
    (SceneObject("bin", "wastebasket", 1.5, 0.0, 0.0, (0.2, 0.2, 0.4)),),
)
FIELD = Scene("field", 5, Start(0.0, 0.0, 0.0), ())

Make = Callable[..., PybulletBody]


@pytest.fixture
def make() -> Iterator[Make]:
    made: list[PybulletBody] = []

    def build(scene: Scene = FIELD, noise: Noise = NO_NOISE, **options: object) -> PybulletBody:
        made.append(PybulletBody(scene, noise=noise, **options))  # type: ignore[arg-type]
        return made[-1]

    yield build
    for body in made:
        body.close()


def travelled(body: PybulletBody, duration_s: float) -> Pose:
    """How the robot moves in ``duration_s``, in the frame of where it was."""
    before = body.truth()
    body.step(duration_s)
    return body.truth().relative_to(before)


def test_it_is_a_body(make: Make) -> None:
    body: Body = make()
    assert body.limits == LIMITS
    assert body.time_s == 0


@pytest.mark.parametrize("speed_mps", [0.26, -0.26, 0.05])
def test_it_drives_straight_at_the_speed_asked_for(make: Make, speed_mps: float) -> None:
    body = make()
    body.drive(speed_mps, 0.0)
    body.step(1.0)
    moved = travelled(body, 2.0)
    assert moved.x_m == pytest.approx(2 * speed_mps, rel=0.005)
    assert abs(moved.y_m) < 0.002
    assert abs(moved.yaw_rad) < math.radians(0.2)


@pytest.mark.parametrize("speed_radps", [1.82, -1.82, 0.3])
def test_it_turns_on_the_spot_at_the_speed_asked_for(make: Make, speed_radps: float) -> None:
    body = make()
    body.drive(0.0, speed_radps)
    body.step(1.0)
    moved = travelled(body, 1.0)
    assert moved.yaw_rad == pytest.approx(speed_radps, rel=0.005)
    assert math.hypot(moved.x_m, moved.y_m) < 0.005


def test_it_drives_an_arc(make: Make) -> None:
    body = make()
    body.drive(0.2, 0.4)
    body.step(1.0)
    moved = travelled(body, math.pi / 2 / 0.4)
    assert (moved.x_m, moved.y_m) == pytest.approx((0.5, 0.5), abs=0.01)
    assert moved.yaw_rad == pytest.approx(math.pi / 2, abs=0.01)


def test_speeds_beyond_the_limits_are_clipped_and_no_number_is_refused(make: Make) -> None:
    body = make()
    body.drive(9.0, -9.0)
    body.step(1.5)
    assert body.odometry().linear_mps == pytest.approx(LIMITS.linear_max_mps, rel=0.01)
    assert body.odometry().angular_radps == pytest.approx(-LIMITS.angular_max_radps, rel=0.01)
    with pytest.raises(ValueError, match="cannot drive at nan"):
        body.drive(math.nan, 0.0)


def test_it_gathers_speed_no_faster_than_its_acceleration(make: Make) -> None:
    body = make()
    body.step(0.5)
    body.drive(LIMITS.linear_max_mps, 0.0)
    speeds = []
    for _ in range(12):
        body.step(1 / 60)
        speeds.append(body.odometry().linear_mps)
    assert speeds[-1] == pytest.approx(LIMITS.linear_max_mps, rel=0.01)
    assert all(after - before <= LIMITS.linear_acceleration_mps2 / 60 * 1.1 for before, after in pairwise(speeds))


def test_it_stands_still_where_it_was_put(make: Make) -> None:
    body = make(start=Pose(0.5, -0.25, 2.0))
    body.step(5.0)
    assert body.truth().point.distance_to(Pose(0.5, -0.25, 0).point) < 0.001
    assert body.truth().yaw_rad == pytest.approx(2.0, abs=0.002)
    assert body.contacts() == ()


def test_the_map_frame_is_the_scenes(make: Make) -> None:
    start = Pose(0.5, -0.25, 2.0)
    assert make(start=start).odometry().pose == start
    assert make(replace(FIELD, start=Start(1.0, 2.0, 0.5))).odometry().pose == Pose(1.0, 2.0, 0.5)


def test_it_feels_what_it_touches_and_never_the_floor(make: Make) -> None:
    body = make(ROOM)
    body.drive(0.26, 0.0)
    body.step(4.0)
    assert body.contacts() == ()
    body.step(2.0)
    assert body.contacts() == ("bin",)
    assert body.truth().x_m == pytest.approx(1.4 - 0.069, abs=0.01)
    body.drive(-0.26, 0.0)
    body.step(9.0)
    assert body.contacts() == ("bin", "wall 3")


def test_without_noise_the_odometry_is_the_truth(make: Make) -> None:
    body = make()
    for linear, angular in ((0.26, 0.0), (0.1, 0.8), (0.0, -1.8), (-0.2, 0.1)):
        body.drive(linear, angular)
        body.step(2.0)
    error = body.odometry().pose.relative_to(body.truth())
    assert math.hypot(error.x_m, error.y_m) < 0.01
    assert abs(error.yaw_rad) < math.radians(0.5)


def test_with_noise_the_odometry_drifts_by_tenths_of_a_degree_in_a_metre() -> None:
    drifts = []
    for seed in range(12):
        body = PybulletBody(FIELD, seed=seed)
        body.drive(0.26, 0.0)
        body.step(10.0)
        drifts.append(math.degrees(body.odometry().pose.yaw_rad - body.truth().yaw_rad) / 2.6)
        body.close()
    assert 0.05 < np.std(drifts) < 0.8


@given(st.lists(st.integers(1, 40), min_size=1, max_size=6))
@settings(max_examples=10, deadline=None)
def test_the_run_does_not_depend_on_how_time_is_cut(pieces: list[int]) -> None:
    cut, whole = PybulletBody(ROOM), PybulletBody(ROOM)
    for body in (cut, whole):
        body.drive(0.2, 0.5)
    for piece in pieces:
        cut.step(piece / 100)
    whole.step(sum(pieces) / 100)
    assert abs(cut.time_s - sum(pieces) / 100) <= 1 / 480
    assert cut.time_s == pytest.approx(whole.time_s, abs=1 / 240)
    if cut.time_s == whole.time_s:
        assert cut.truth() == whole.truth()
        assert cut.odometry() == whole.odometry()
    cut.close()
    whole.close()


def run(seed: int, pictures: bool = True) -> tuple[object, ...]:
    body = PybulletBody(ROOM, seed=seed)
    heard: list[object] = []
    for step in range(40):
        body.drive(0.2, math.sin(step))
        body.step(0.05)
        scan = body.scan()
        heard.append(scan and scan.ranges_m.tobytes())
        if pictures and (image := body.image()):
            heard.append(image.pixels.tobytes())
    ended = (body.truth(), body.odometry(), tuple(heard))
    body.close()
    return ended


def test_the_same_seed_gives_the_same_run_to_the_last_bit() -> None:
    assert run(1) == run(1)
    assert run(1)[1] != run(2)[1]


def test_a_sense_that_is_not_read_changes_nothing_else() -> None:
    assert run(1)[:2] == run(1, pictures=False)[:2]


def test_scans_are_in_the_bodys_frame_and_see_the_walls(make: Make) -> None:
    body = make(ROOM, start=Pose(0.5, 0.2, math.pi / 2))
    scan = body.scan()
    assert scan is not None
    assert scan.angles_rad.shape == scan.ranges_m.shape == (LASER.beams,)
    heard = np.isfinite(scan.ranges_m)
    assert heard.all()
    x = 0.5 - scan.ranges_m * np.sin(scan.angles_rad)  # the robot faces +y
    y = 0.2 + scan.ranges_m * np.cos(scan.angles_rad)
    to_walls = np.min([abs(x - 1.975), abs(x + 0.975), abs(y - 0.975), abs(y + 0.975)], axis=0)
    to_bin = np.maximum(abs(x - 1.5), abs(y)) - 0.1
    assert (np.minimum(to_walls, abs(to_bin)) < 0.003).all()
    assert (abs(to_bin) < 0.003).sum() > 5


def test_no_echo_is_infinite_and_noise_is_a_centimetre(make: Make) -> None:
    scan = make().scan()
    assert scan is not None
    assert np.isinf(scan.ranges_m).all()
    exact, noisy = make(ROOM).scan(), make(ROOM, Noise()).scan()
    assert exact is not None
    assert noisy is not None
    assert 0.007 < np.std(noisy.ranges_m - exact.ranges_m) < 0.013


def test_senses_come_at_their_rates(make: Make) -> None:
    body = make(ROOM)
    scans = images = 0
    for _ in range(61):
        scans += body.scan() is not None
        images += body.image() is not None
        body.step(0.05)
    assert (scans, images) == (16, 7)
    assert body.image() is None


def test_several_bodies_live_side_by_side(make: Make) -> None:
    one, other = make(), make()
    one.drive(0.26, 0.0)
    one.step(1.0)
    other.step(1.0)
    assert one.truth().x_m > 0.2
    assert abs(other.truth().x_m) < 0.001
    one.close()
    one.close()
    other.step(0.1)


def test_nothing_is_printed_on_import() -> None:
    code = "import robot.pybullet_body"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True, timeout=60)
    assert (done.stdout, done.stderr) == (b"", b"")
