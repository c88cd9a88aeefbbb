"""The robot's process: what it says when it cannot run, how it ends, and that one seed makes one run."""

import signal
import subprocess
import sys
import threading
from pathlib import Path

import pytest
import redis

from robot.messages import decode_feedback
from robot.process import RobotOptions, RobotProcess, main
from robot.redis_server import RedisServer

WORLD = """
name: corner
seed: 4
robot: {x: 0, y: 0, yaw_deg: 0}
walls: [[2, -2, 2, 2], [-2, 2, 2, 2]]
objects:
  - {id: box, type: block, x: 1.8, y: 0.5, yaw_deg: 180, size: [0.2, 0.3, 0.4],
     fiducial: {id: 3, height: 0.2, face: front}}
"""


@pytest.fixture
def world(tmp_path):
    path = tmp_path / "corner.yaml"
    path.write_text(WORLD)
    return path


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    with RedisServer(tmp_path_factory.mktemp("redis")) as running:
        yield running


def fails(capsys, *arguments):
    assert main(arguments) == 1
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    return error


def test_errors_are_one_line_that_says_what_to_do(capsys, world, server, tmp_path):
    at = ("--state", str(tmp_path))
    assert "world" in fails(capsys, "--redis", server.url, "--world", str(tmp_path / "none.yaml"), *at)
    assert "speed" in fails(capsys, "--redis", server.url, "--world", str(world), "--speed", "fast", *at)
    refused = fails(capsys, "--redis", "redis://u:geheim@127.0.0.1:1", "--world", str(world), *at)
    assert "--redis" in refused
    assert "geheim" not in refused


def codes(client):
    return [decode_feedback(text).code.value for text in client.lrange("Kirby_Feedback", 0, -1)]


def wait_until(client, condition):
    for _ in range(6000):
        if condition(codes(client)):
            return
        threading.Event().wait(0.01)
    raise AssertionError(codes(client))


def one_run(server, world, state):
    """The feedback with the robot's own times, and where it ended."""
    with redis.Redis.from_url(server.url) as client:
        client.flushall()
        process = RobotProcess(RobotOptions(server.url, world, state, speed="max", seed=9))
        process.start()
        try:
            for number, text in enumerate(("go forward 0.8", "turn left 60", "go to 0.5 1"), start=1):
                wait_until(client, lambda told, number=number: told.count("READY") == number)
                client.rpush("Kirby", text)
            wait_until(client, lambda told: told.count("READY") == 4)
            command = Path(f"/proc/{process.pid}/cmdline").read_bytes()
            assert server.url.encode() not in command  # it may hold a password
            return client.lrange("Kirby_Feedback", 0, -1), client.hget("Kirby_Queue_Record", "state")
        finally:
            process.close()


@pytest.mark.physics
def test_one_seed_ends_in_one_pose_to_the_last_digit(server, world, tmp_path):
    assert one_run(server, world, tmp_path) == one_run(server, world, tmp_path)


@pytest.mark.physics
@pytest.mark.parametrize("sign", [signal.SIGTERM, signal.SIGINT])
def test_a_signal_ends_it_cleanly_and_its_work_waits(server, world, tmp_path, sign):
    with redis.Redis.from_url(server.url) as client:
        client.flushall()
        arguments = ["--redis", server.url, "--world", str(world), "--state", str(tmp_path), "--speed", "2"]
        for first in ("READY", "PAUSED"):
            robot = subprocess.Popen([sys.executable, "-m", "robot.process", *arguments])
            wait_until(client, lambda told, first=first: first in told)
            if first == "READY":
                client.rpush("Kirby", "go forward 1.5")
                wait_until(client, lambda told: "FORWARD" in told)
            robot.send_signal(sign)
            assert robot.wait(20) == 0
        assert codes(client) == ["READY", "FORWARD", "PAUSED"]
        assert client.llen("Kirby_Queue") == 1


@pytest.mark.physics
def test_a_package_called_robot_in_the_current_folder_does_no_harm(server, world, tmp_path, monkeypatch):
    (tmp_path / "robot").mkdir()
    (tmp_path / "robot" / "__init__.py").write_text("raise SystemExit('not ours')")
    monkeypatch.chdir(tmp_path)
    with redis.Redis.from_url(server.url) as client:
        client.flushall()
        process = RobotProcess(RobotOptions(server.url, world, tmp_path, speed="max"))
        process.start()
        try:
            wait_until(client, lambda told: told == ["READY"] or process.failure)
            assert process.failure is None
        finally:
            process.close()
