"""Lines from a pipe, through the whole of Kirby: what is printed, the exit status, and what is left behind."""

import os
import subprocess
import sys
from contextlib import closing

import psutil
import pytest

from kirby.link import RobotLink
from kirby.worlds import world_file
from robot.process import RobotOptions, RobotProcess
from robot.redis_server import RedisServer

pytestmark = pytest.mark.physics


def talk(*lines: str, state, options: tuple[str, ...] = ()) -> subprocess.CompletedProcess[str]:
    said = "".join(f"{line}\n" for line in lines)
    command = [sys.executable, "-m", "kirby", *options, "--state", str(state)]
    environment = os.environ | {"NO_COLOR": "1"}
    return subprocess.run(
        command, input=said, capture_output=True, text=True, timeout=300, check=False, env=environment
    )


def test_every_line_is_done_in_turn(tmp_path):
    shown = talk("go to the first fiducial on the right", "turn around", state=tmp_path)
    assert shown.returncode == 0, shown
    lines = shown.stdout.splitlines()
    arrived = next(i for i, line in enumerate(lines) if line.startswith("Kirby: successfully navigated to"))
    assert lines.index("You: go to the first fiducial on the right") < arrived < lines.index("You: turn around")
    assert lines[-1] == "Kirby: waiting for commands"
    assert not [child for child in psutil.process_iter() if str(tmp_path) in " ".join(_command(child))]


def _command(process: psutil.Process) -> list[str]:
    try:
        return process.cmdline()
    except psutil.Error:
        return []


@pytest.mark.parametrize(
    ("lines", "says"),
    [
        (("blorp",), "I didn't understand"),
        (("go to the purple block",), "I don't see"),
        (("/jump", "turn left"), "/gesture NAME"),
    ],
)
def test_what_was_not_done_is_told_and_status_1(tmp_path, lines, says):
    shown = talk(*lines, state=tmp_path)
    assert shown.returncode == 1, shown
    assert says in shown.stdout


def test_an_open_question_at_the_end_is_status_1(tmp_path):
    shown = talk("go to the block", state=tmp_path)
    assert shown.returncode == 1
    assert "Which one" in shown.stdout


def test_a_question_is_answered_by_the_next_line(tmp_path):
    shown = talk("go to the block", "the red one", state=tmp_path)
    assert shown.returncode == 0, shown
    assert "Kirby: successfully navigated to" in shown.stdout


def test_a_robot_that_runs_already_is_used(tmp_path):
    (tmp_path / "robot").mkdir()
    world, _ = world_file("figure3")
    with RedisServer(tmp_path / "robot") as server:
        robot = RobotProcess(RobotOptions(server.url, world, tmp_path / "robot", speed="max"))
        robot.start()
        try:
            with closing(RobotLink(server.url)) as link:
                while not link.alive():
                    assert robot.failure is None
            options = ("--redis", server.url, "--world", "figure3")
            assert talk("go forward half a meter", state=tmp_path / "one", options=options).returncode == 0
            shown = talk("go back", state=tmp_path / "two", options=options)
        finally:
            robot.close()
    assert shown.returncode == 0, shown
    assert "returned to previous location" in shown.stdout


def test_no_robot_at_the_url_is_said_in_one_line(tmp_path):
    with RedisServer(tmp_path) as server:
        shown = talk("stop", state=tmp_path / "people", options=("--redis", server.url))
    assert shown.returncode == 1
    assert shown.stderr.startswith("kirby: no robot is alive")
    assert shown.stderr.count("\n") == 1
