"""The real Kirby killed with SIGKILL while the robot drives: no child stays, and no queued command is lost."""

import os
import random
import subprocess
import sys
import threading
import time

import psutil
import pytest

from kirby.link import connect
from robot.messages import Keys, decode_entry
from robot.redis_server import RedisServer

KILLS = int(os.environ.get("KIRBY_KILLS", "3"))
GONE_S = 2.0
KEYS = Keys()
ENDINGS = {
    *(b"SUCCESS_FORWARD", b"SUCCESS_VERIFY_ROTATION", b"UNREACHABLE", b"STRAYED", b"CANCELLED_GOAL", b"INVALID"),
    *(b"RESTARTING", b"PAUSED"),  # of the commands without an end of their own: continue, stop
}
LINE = "go forward ten centimeters, turn left twenty degrees, go back ten centimeters, and turn right twenty degrees"


def children_of(state):
    """Living processes that belong to a Kirby with this state folder: its Redis and its robot."""
    found = []
    for process in psutil.process_iter():
        try:
            if process.status() != psutil.STATUS_ZOMBIE and str(state) in " ".join(process.cmdline()):
                found.append(process)
        except psutil.Error:
            continue
    return found


def wait_until(holds, seconds):
    end_s = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end_s, "waited in vain"
        threading.Event().wait(0.02)


def ids_known(url):
    """The ids of the commands that wait or are being done, and of those that have ended."""
    with connect(url) as client:
        entries = client.lrange(KEYS.commands, 0, -1)
        entries += [entry.split(b" ", 1)[-1] for entry in client.lrange(KEYS.queue, 0, -1)]
        waiting = {decode_entry(entry).id for entry in entries}
        stream = [fields for _, fields in client.xrange(KEYS.feedback_stream) if b"id" in fields]
    return waiting, [fields[b"id"].decode() for fields in stream if fields[b"code"] in ENDINGS]


@pytest.mark.physics
def test_killed_at_any_moment_nothing_stays_and_nothing_is_lost(tmp_path):
    chance = random.Random(5)
    ours = set()
    for _ in range(KILLS):
        said = f"continue\n{LINE}\n" if ours else f"{LINE}\n"
        kirby = subprocess.Popen(
            [sys.executable, "-m", "kirby", "--speed", "2", "--state", str(tmp_path)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        kirby.stdin.write(said)
        kirby.stdin.flush()
        wait_until(lambda: len(children_of(tmp_path)) >= 3, 60)
        threading.Event().wait(chance.uniform(0.0, 8.0))
        kirby.kill()
        kirby.wait()
        wait_until(lambda: not children_of(tmp_path), GONE_S)
        with RedisServer(tmp_path) as server:
            waiting, ended = ids_known(server.url)
        assert ours <= {*waiting, *ended}
        assert len(ended) == len(set(ended))
        assert waiting.isdisjoint(ended)
        ours = {*waiting, *ended}
    assert ours
