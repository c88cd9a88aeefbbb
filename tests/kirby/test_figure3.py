"""The paper's scenario in pybullet over a real Redis: said, driven, and true in the end."""

import math

import pytest
from stage import stage

from robot.geometry import Point, Pose

STARTS = [
    Pose(0.0, 0.0, 0.0),
    Pose(-0.2, 0.15, math.radians(-5)),
    Pose(0.2, -0.2, math.radians(4)),
    Pose(0.1, 0.25, math.radians(-8)),
    Pose(-0.25, -0.1, math.radians(7)),
]
SAID = {
    "go to the first fiducial on the right": 1,
    "go to the second fiducial on the right": 3,
    "go to the third fiducial on the right": 5,
    "go to the first fiducial on the left": 2,
    "go to the second fiducial on the left": 4,
    "go to the last one on the right": 5,
}
NEAR_M = 0.4
FACING_RAD = math.radians(62.2 / 4)  # the marker is in the middle half of the camera's picture


@pytest.mark.physics
@pytest.mark.parametrize("start", range(len(STARTS)))
@pytest.mark.parametrize("text", SAID)
def test_the_robot_ends_before_the_fiducial_that_was_meant(tmp_path, text, start):
    with stage(tmp_path, "figure3", start=STARTS[start], seed=100 + start) as kirby:
        said = kirby.say(text)
        marker = kirby.marker(SAID[text]).point
        assert any(line.startswith("successfully navigated to") for line in said), said
        assert kirby.body.truth().point.distance_to(marker) <= NEAR_M
        assert kirby.off_by_rad(marker) <= FACING_RAD
        assert kirby.body.contacts() == ()


STRAY = "go to the third fiducial on the right"
HELP = "user input is required: keep going OR go back"


@pytest.mark.physics
def test_straying_and_going_back(tmp_path):
    with stage(tmp_path, "figure3_blocked") as kirby:
        began = kirby.body.truth()
        said = kirby.say(STRAY)
        assert "moved from expected path and failed to reach goal" in said
        assert any(HELP in line for line in said)
        assert kirby.body.truth().point.distance_to(began.point) >= 0.5
        assert "returned to previous location" in kirby.say("go back")
        assert kirby.body.truth().point.distance_to(began.point) <= 0.15
        assert kirby.conversation.agent.state == "idle"
        assert kirby.body.contacts() == ()


@pytest.mark.physics
def test_straying_and_keeping_going(tmp_path):
    """What was queued behind the failed movement is done from where the robot stands."""
    with stage(tmp_path, "figure3_blocked") as kirby:
        kirby.say(f"{STRAY} and then go forward half a meter")
        strayed = kirby.body.truth()
        said = kirby.say("keep going")
        assert any(line.startswith("successfully navigated to") for line in said), said
        assert kirby.body.truth().point.distance_to(strayed.point) == pytest.approx(0.5, abs=0.1)
        assert kirby.conversation.agent.state == "idle"
        assert kirby.body.contacts() == ()


@pytest.mark.physics
def test_straying_and_pointing_somewhere_else(tmp_path):
    with stage(tmp_path, "figure3_blocked") as kirby:
        kirby.say(STRAY)
        elsewhere = Point(1.4, 0.3)
        kirby.point(elsewhere)
        said = kirby.say("go there")
        assert any(line.startswith("successfully navigated to") for line in said), said
        assert kirby.body.truth().point.distance_to(elsewhere) <= 0.2
        assert kirby.conversation.agent.state == "idle"
        assert kirby.body.contacts() == ()


@pytest.mark.physics
def test_one_seed_one_run(tmp_path):
    """Two runs with one seed end in the same pose to the last digit."""
    ends = []
    for run in ("one", "two"):
        with stage(tmp_path / run, "figure3", seed=7) as kirby:
            for text in ("go to the first fiducial on the right", "turn around", "go forward one meter"):
                kirby.say(text)
            ends.append((kirby.body.truth(), kirby.robot.pose, kirby.body.time_s))
    assert ends[0] == ends[1]
