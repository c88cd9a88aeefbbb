"""Kirby, its robot and its Redis killed at random moments: no child stays, no command is lost or done twice."""

import json
import random
import signal
import subprocess
import sys
import threading
import time
from collections import Counter
from pathlib import Path

import psutil
import redis

STUB = Path(__file__).parent / "stub_kirby.py"
ENDINGS = {"SUCCESS_FORWARD", "SUCCESS_VERIFY_ROTATION", "SUCCESS_GO_TO"}
OTHER_ENDINGS = {"UNREACHABLE", "STRAYED", "CANCELLED_GOAL", "INVALID"}


def dead(pid):
    try:
        return psutil.Process(pid).status() == psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return True


def wait_for(condition, seconds=60.0):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        try:
            found = condition()
        except redis.ConnectionError:
            found = None
        if found:
            return found
        threading.Event().wait(0.005)
    raise AssertionError("waited in vain")


class Kirby:
    """A running stub, and a client that pushes numbered commands and answers PAUSED with continue."""

    def __init__(self, state, cursor="0-0"):
        self.process = subprocess.Popen(
            [sys.executable, STUB, state], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        url, redis_pid, robot_pid = self.process.stdout.readline().split()
        self.children = [int(redis_pid), int(robot_pid)]
        self.client = redis.Redis.from_url(url)
        self.cursor = cursor
        self.told = []
        self.answered = 0  # of the times that it said PAUSED

    def read(self):
        """The codes told since the last time."""
        entries = self.client.xrange("Kirby_Feedback_Stream", f"({self.cursor}")
        if entries:
            self.cursor = entries[-1][0].decode()
        news = [(fields[b"code"].decode(), fields.get(b"id", b"").decode()) for _, fields in entries]
        self.told += news
        return [code for code, _ in news]

    def up(self):
        """Wait until it says READY, or PAUSED and is told to continue."""
        codes = wait_for(lambda: {"READY", "PAUSED"} & set(self.read()))
        if "PAUSED" in codes:
            self.go_on()
            wait_for(lambda: "RESTARTING" in self.read() or "RESTARTING" in dict(self.told))

    def push(self, *texts):
        self.client.rpush("Kirby", *texts)

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()
        wait_for(lambda: all(dead(pid) for pid in self.children), 2.0)
        self.process.stdin.close()
        self.process.stdout.close()

    def drained(self):
        """Nothing is left to do, and all that was said of it has been read: an ending comes with its removal."""
        empty = self.client.llen("Kirby") + self.client.llen("Kirby_Queue") == 0
        self.read()
        return empty

    def finished(self):
        """Everything done; a robot that came up paused is told to go on."""
        empty = self.drained()
        self.go_on()
        return empty

    def go_on(self):
        """Answer every PAUSED that was read, once."""
        paused = sum(code == "PAUSED" for code, _ in self.told)
        if paused > self.answered:
            self.answered = paused
            self.push("continue")


def command(number):
    text = random.choice(["go forward 0.3", "turn left 40", "go to 1 0.5", "turn right 70", "go forward -0.2"])
    return json.dumps({"id": f"c{number}", "command": text})


def test_kirby_killed_at_random_moments_leaves_nobody_and_loses_nothing(tmp_path):
    random.seed(11)
    pushed, told, cursor = 0, [], "0-0"
    for _ in range(20):
        kirby = Kirby(tmp_path, cursor)
        kirby.up()
        kirby.push(*(command(pushed + n) for n in range(3)))
        pushed += 3
        threading.Event().wait(random.uniform(0.0, 0.4))
        kirby.read()
        kirby.kill()
        told, cursor = told + kirby.told, kirby.cursor
    kirby = Kirby(tmp_path, cursor)
    kirby.up()
    wait_for(kirby.drained)
    kirby.kill()
    endings = Counter(name for code, name in told + kirby.told if code in ENDINGS | OTHER_ENDINGS)
    assert endings == {f"c{n}": 1 for n in range(pushed)}
    assert not [code for code, name in told + kirby.told if code in OTHER_ENDINGS]


def test_robot_and_redis_killed_in_turn_lose_nothing(tmp_path):
    random.seed(12)
    kirby = Kirby(tmp_path)
    kirby.up()
    for turn in range(10):
        kirby.push(command(2 * turn), command(2 * turn + 1))
        threading.Event().wait(random.uniform(0.0, 0.3))
        children = psutil.Process(kirby.process.pid).children()
        (victim,) = [child for child in children if ("redis" in child.name()) == (turn % 2 == 0)]
        victim.kill()
        wait_for(kirby.finished)
    kirby.kill()
    endings = Counter(name for code, name in kirby.told if code in ENDINGS | OTHER_ENDINGS)
    assert endings == {f"c{n}": 1 for n in range(20)}
    assert not [code for code, name in kirby.told if code in OTHER_ENDINGS]
