"""The Redis that Kirby starts: private, durable, and gone when its parent is, however it ended."""

import os
import signal
import subprocess
import sys
import threading
import time

import psutil
import pytest
import redis

from robot.child import Child
from robot.errors import RobotError
from robot.redis_server import SOCKET_PATH_MAX, RedisServer
from robot.state_folder import StateFolder, default_state_folder

PARENT = """
import sys, time
from pathlib import Path
from robot.redis_server import RedisServer
from robot.state_folder import StateFolder
folder = StateFolder(Path(sys.argv[1]))
server = RedisServer(folder.path)
server.start()
print(server.pid, flush=True)
sys.stdin.read()
"""


def gone_within(pid, seconds):
    """Whether the process is dead by then; some init processes take their time to bury the dead."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        try:
            if psutil.Process(pid).status() == psutil.STATUS_ZOMBIE:
                return True
        except psutil.NoSuchProcess:
            return True
        threading.Event().wait(0.01)
    return False


def start_parent(folder):
    parent = subprocess.Popen(
        [sys.executable, "-c", PARENT, str(folder)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    return parent, int(parent.stdout.readline())


def test_it_answers_on_a_private_socket_and_never_on_tcp(tmp_path):
    with RedisServer(tmp_path) as server, redis.Redis.from_url(server.url) as client:
        assert client.ping()
        socket = tmp_path / "redis.sock"
        assert socket.stat().st_mode & 0o077 == 0
        assert client.config_get("port")["port"] == "0"
        kinds = {c.type for c in psutil.Process(server.pid).net_connections("inet")}
        assert kinds == set()


def test_what_was_written_survives_a_kill_and_a_restart(tmp_path):
    with RedisServer(tmp_path) as server, redis.Redis.from_url(server.url) as client:
        client.rpush("Kirby", "go forward")
        first = server.pid
        server.kill()
        while server.pid == first:
            threading.Event().wait(0.01)
        assert poll(lambda: client.lrange("Kirby", 0, -1)) == [b"go forward"]
    with RedisServer(tmp_path) as server, redis.Redis.from_url(server.url) as client:
        assert client.lrange("Kirby", 0, -1) == [b"go forward"]


def poll(read, seconds=10.0):
    end = time.monotonic() + seconds
    while True:
        try:
            return read()
        except redis.ConnectionError:
            if time.monotonic() > end:
                raise
            threading.Event().wait(0.01)


@pytest.mark.parametrize("sign", [signal.SIGKILL, signal.SIGTERM, signal.SIGHUP])
def test_it_is_gone_when_its_parent_was_killed(tmp_path, sign):
    parent, pid = start_parent(tmp_path)
    parent.send_signal(sign)
    parent.wait()
    assert gone_within(pid, 2.0)


def test_it_is_gone_when_its_parent_ended_by_itself(tmp_path):
    parent, pid = start_parent(tmp_path)
    parent.stdin.close()
    parent.wait()
    assert gone_within(pid, 2.0)


def test_a_thread_that_started_it_may_end(tmp_path):
    server = RedisServer(tmp_path)
    starter = threading.Thread(target=server.start)
    starter.start()
    starter.join()
    with redis.Redis.from_url(server.url) as client:
        assert client.ping()
        assert not gone_within(server.pid, 0.2)
    server.close()


def test_a_folder_in_use_is_refused_in_one_line(tmp_path):
    parent, pid = start_parent(tmp_path)
    with pytest.raises(RobotError, match="in use by another Kirby") as error:
        StateFolder(tmp_path)
    assert "\n" not in str(error.value)
    parent.kill()
    parent.wait()
    assert gone_within(pid, 2.0)
    with StateFolder(tmp_path) as folder, RedisServer(folder.path) as server:  # the stale lock and socket do no harm
        assert server.pid


def test_a_folder_that_cannot_be_made_is_refused_in_one_line(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(RobotError, match="--state"):
        StateFolder(tmp_path / "file" / "state")


def test_a_folder_of_any_length_will_do(tmp_path):
    folder = tmp_path / ("d" * 80) / ("e" * 80)
    folder.mkdir(parents=True)
    with RedisServer(folder) as server, redis.Redis.from_url(server.url) as client:
        path = server.url.removeprefix("unix://")
        assert client.ping()
        assert len(path) <= SOCKET_PATH_MAX
        assert os.stat(os.path.dirname(path)).st_mode & 0o077 == 0  # noqa: PTH116, PTH120
    assert not os.path.exists(os.path.dirname(path))  # noqa: PTH110, PTH120


def test_a_broken_file_is_told_in_one_line(tmp_path):
    (tmp_path / "kirby.aof").write_text("this is no append-only file")
    with pytest.raises(RobotError, match=r"redis\.log") as error:
        RedisServer(tmp_path).start()
    assert "\n" not in str(error.value)


def test_the_state_folder_is_chosen_by_the_environment(monkeypatch, tmp_path):
    monkeypatch.setenv("KIRBY_STATE", str(tmp_path / "here"))
    assert default_state_folder() == tmp_path / "here"
    with StateFolder() as folder:
        assert folder.path == tmp_path / "here"
        assert folder.path.stat().st_mode & 0o077 == 0
    monkeypatch.delenv("KIRBY_STATE")
    assert default_state_folder().name == "kirby"


def test_a_child_that_ends_by_itself_is_not_started_again(tmp_path):
    child = Child([sys.executable, "-c", "print('sorry'); raise SystemExit(3)"], tmp_path / "log")
    child.start()
    assert child.wait(10.0)
    assert child.exit_status == 3
    assert child.last_words() == "sorry"
    assert child.pid is None


def test_a_child_that_cannot_be_killed_softly_is_killed(tmp_path):
    stubborn = (
        "import signal, time; signal.signal(signal.SIGTERM, signal.SIG_IGN); print('up', flush=True); time.sleep(60)"
    )
    child = Child([sys.executable, "-c", stubborn], tmp_path / "log")
    child.start()
    while child.last_words() != "up":
        threading.Event().wait(0.01)
    child.close(patience_s=0.1)
    assert child.exit_status == -signal.SIGKILL
