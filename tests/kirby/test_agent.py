"""Kirby as a host embeds it."""

from __future__ import annotations

import subprocess
import sys
from importlib.resources import files
from pathlib import Path

import pytest

from kirby import (
    Agent,
    Dispatch,
    FeedbackCode,
    GestureKind,
    Point,
    PointedRay,
    Say,
    Tone,
    encode_command,
    feedback,
    understand,
)
from robot.messages import Command, Fiducial, Fiducials, Odom
from voxml.scene import find_scene

EXAMPLES = Path(__file__).parents[2] / "examples"
FIGURE3 = find_scene("figure3", files("corpora") / "worlds")
RED_BLOCK = Fiducials((Fiducial("1", (2.0, -1.0, 0.1), (0.0, 0.0, 3.14159)),))


class Robot:
    """Keeps what it is sent."""

    def __init__(self) -> None:
        self.sent: list[str] = []
        self.ids: list[str] = []

    def send(self, commands: tuple[Command, ...], ids: tuple[str, ...]) -> None:
        self.sent += [encode_command(command) for command in commands]
        self.ids += ids


def test_what_is_heard_is_sent_to_the_hosts_robot() -> None:
    robot = Robot()
    outputs = Agent(robot=robot).hear("turn left forty five degrees")
    assert robot.sent == ["turn left 45"]
    assert [output for output in outputs if isinstance(output, Dispatch)]


def test_things_are_known_once_their_fiducials_are_seen() -> None:
    robot = Robot()
    agent = Agent(FIGURE3, robot=robot)
    assert [o.tone for o in agent.hear("go to the red block") if isinstance(o, Say)] == [Tone.REFUSAL]
    agent.world(fiducials=RED_BLOCK)
    agent.hear("go to the red block")
    assert robot.sent == ["go to 1.65 -1"]


def test_pointing_and_gestures_drive() -> None:
    robot = Robot()
    agent = Agent(FIGURE3, robot=robot)
    agent.point(Point(1.0, 2.0), time_s=1.0)
    agent.gesture(GestureKind.THUMBS_UP, time_s=2.0)
    agent.gesture(GestureKind.OPEN_PALM, time_s=3.0)
    agent.point(PointedRay(Point(0.0, 0.0), 1.0), time_s=4.0)
    assert robot.sent == ["go to 1 2", "stop"]


def test_busy_until_the_robot_has_ended_what_it_was_told() -> None:
    robot = Robot()
    agent = Agent(robot=robot)
    assert not agent.busy
    agent.hear("go forward")
    assert (agent.busy, agent.state, len(agent.queue)) == (True, "executing", 1)
    agent.feedback(feedback(FeedbackCode.SUCCESS_FORWARD, at=Point(1.0, 0.0), id=robot.ids[0]))
    assert (agent.busy, agent.state, agent.queue) == (False, "idle", ())


def test_not_busy_while_it_asks_or_is_paused() -> None:
    agent = Agent()
    agent.hear("go forward")
    agent.feedback(feedback(FeedbackCode.HELP, id="k1"))
    assert (agent.busy, agent.asking) == (False, True)
    agent.hear("go forward")
    assert agent.busy
    agent.feedback(feedback(FeedbackCode.PAUSED, id="k9"))
    assert (agent.busy, agent.asking) == (False, False)


def test_the_pose_is_unknown_until_the_robot_has_said_it() -> None:
    agent = Agent(FIGURE3)
    assert agent.pose is None
    agent.world(odom=Odom(1, 1, (1.0, 2.0, 0.0), (0.0, 0.0, 0.5), 0.0, 0.0, 3.0))
    assert agent.pose is not None
    assert agent.pose.point == Point(1.0, 2.0)


def test_a_conversation_goes_on_after_it_was_written_and_read_back() -> None:
    agent = Agent(FIGURE3)
    agent.world(fiducials=RED_BLOCK)
    agent.hear("go there", time_s=1.0)
    robot = Robot()
    again = Agent.from_json(agent.to_json(), robot=robot)
    assert again.session == agent.session
    again.point("1", time_s=2.0)
    assert robot.sent[0] == "go to 1.65 -1"


# ------------------------------------------------------------------ one utterance by itself
def test_the_record_of_an_utterance_has_the_fields_of_the_command_line() -> None:
    assert understand("turn left forty five degrees") == {
        "utterance": "turn left forty five degrees",
        "status": "ok",
        "act": "instruct",
        "form": "turn(left,45deg)",
        "commands": ["turn left 45"],
    }


@pytest.mark.parametrize(
    ("text", "status", "commands"),
    [
        ("face north", "ok", ["turn left 90"]),
        ("go to the red block", "needs_world", None),
        ("turn left and go to the red block", "needs_world", None),
        ("yes", "ok", []),
        ("blorp", "not_understood", None),
        ("", "not_understood", None),
    ],
)
def test_an_utterance_by_itself(text: str, status: str, commands: list[str] | None) -> None:
    record = understand(text)
    assert (record["status"], record["commands"]) == (status, commands)


def test_what_is_not_understood_says_where_and_what_was_expected() -> None:
    record = understand("go forward blorp")
    assert record["span"][1] <= len("go forward blorp")
    assert "blorp" in "go forward blorp"[slice(*record["span"])]
    assert record["expected"]


def test_a_scene_is_a_world_known_in_full() -> None:
    assert understand("go to the first fiducial on the right", FIGURE3)["status"] == "ok"
    assert understand("go to the block", FIGURE3)["status"] == "ambiguous"


# ------------------------------------------------------------------ examples
@pytest.mark.parametrize("example", sorted(EXAMPLES.glob("*.py")), ids=lambda path: path.stem)
def test_examples_run_without_redis_and_pybullet(example: Path) -> None:
    code = (
        "import runpy, sys; runpy.run_path(sys.argv[1]); sys.exit('redis' in sys.modules or 'pybullet' in sys.modules)"
    )
    command = [sys.executable, "-c", code, str(example)]
    done = subprocess.run(command, check=False, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    assert "robot" in done.stdout
