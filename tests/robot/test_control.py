"""The whole loop with a body without physics: in one process, and over Redis with a bare client."""

import json
import math
import os
import re
import signal
import threading
from pathlib import Path

import numpy as np
import pytest
import redis
from kinematic_body import EXACT, TYPICAL, KinematicBody, polygon

from robot.body import Image
from robot.bridge import Bridge
from robot.control import Robot
from robot.errors import RobotError
from robot.geometry import ORIGIN, Point, Segment
from robot.messages import decode_feedback, decode_lidar, decode_map, decode_odom
from robot.pacing import parse_speed, run
from robot.port import Boot, Entry, MemoryPort
from robot.queue import Mode
from robot.redis_server import RedisServer

ROOM = polygon((-3, -3), (3, -3), (3, 3), (-3, 3))


class BodyWithCamera(KinematicBody):
    """Pictures of a grey wall, twice a second."""

    _pictured_s = -1.0

    def image(self):
        if self.time_s - self._pictured_s < 0.5:
            return None
        self._pictured_s = self.time_s
        return Image(self.time_s, np.full((480, 640, 3), 128, np.uint8))


# ------------------------------------------------------------------ in one process
@pytest.fixture
def alone():
    port = MemoryPort()
    body = KinematicBody(ROOM, noise=TYPICAL, seed=3)
    robot = Robot(body, port)
    robot.settle(2.0)
    return robot


def codes(robot):
    return [feedback.code.value for feedback in robot.port.feedback]


def near(pose, x_m, y_m, yaw_deg=0.0):
    off_rad = math.remainder(pose.yaw_rad - math.radians(yaw_deg), math.tau)
    return pose.point.distance_to(Point(x_m, y_m)) < 0.06 and abs(off_rad) < math.radians(3)


def test_a_robot_can_be_embedded_without_redis(alone):
    for text in ("go forward 1", "turn left", "go forward 0.5"):
        alone.port.send(text)
    alone.run_until_idle()
    assert near(alone.body.pose, 1.0, 0.5, 90)
    assert codes(alone)[-1] == "READY"
    assert sorted(alone.port.ended) == [1, 2, 3]


def test_a_square_ends_where_it_began(alone):
    for _ in range(4):
        for text in ("go forward 1", "turn right"):
            alone.port.send(text)
            alone.run_until_idle()
            alone.settle(1.0)
    assert near(alone.body.pose, 0.0, 0.0)
    assert alone.body.contacts == 0


def test_stop_has_the_wheels_at_zero_at_once(alone):
    alone.port.send("go forward 2")
    for _ in range(20):
        alone.tick()
    alone.port.send("stop")
    alone.attend()
    assert alone.body._target == (0.0, 0.0)
    for _ in range(20):
        alone.tick()
        assert alone.body._target == (0.0, 0.0)
    assert not alone.busy


def test_a_paused_right_turn_resumes_by_what_is_left(alone):
    alone.port.send("turn right 120")
    while alone.body.pose.yaw_rad > -math.radians(50):
        alone.tick()
    alone.port.send("stop")
    alone.run_until_idle()
    alone.settle(1.0)
    assert -math.radians(80) < alone.body.pose.yaw_rad < -math.radians(45)
    alone.port.send("continue")
    alone.run_until_idle()
    assert near(alone.body.pose, 0, 0, -120)


def test_go_back_after_straying_goes_back(alone):
    alone.port.send("go to 2.5 0")
    while alone.body.pose.x_m < 1.0:
        alone.tick()
    x_m = alone.body.pose.x_m
    alone.body.set_walls((*ROOM, Segment(Point(x_m + 0.6, -3), Point(x_m + 0.6, 3))))
    alone.run_until_idle()
    assert codes(alone)[-2:] == ["STRAYED", "HELP"]
    assert alone.queue.mode is Mode.AWAITING
    alone.port.send("go back")
    alone.run_until_idle()
    assert codes(alone)[-2:] == ["SUCCESS_GO_BACK", "READY"]
    assert alone.body.pose.point.distance_to(Point(0, 0)) < 0.1
    assert alone.body.contacts == 0


def test_a_silent_port_stops_the_wheels_until_it_is_heard_again(alone):
    alone.port.send("go forward 2")
    for _ in range(20):
        alone.tick()
    alone.port.silent_s = 1.1
    for _ in range(20):
        alone.tick()
    x_m = alone.body.pose.x_m
    assert alone.held
    assert alone.body._target == (0.0, 0.0)
    assert codes(alone)[-1] == "FORWARD"
    alone.port.silent_s = 0.0
    alone.run_until_idle()
    assert x_m < 1.0
    assert near(alone.body.pose, 2.0, 0.0)


def test_a_stop_further_back_holds_the_wheels(alone):
    alone.port.send("go forward 1")
    alone.port.held = True
    for _ in range(20):
        alone.tick()
    assert alone.body.pose == ORIGIN


def test_the_robot_takes_up_its_work_where_it_was(alone):
    alone.port.send("go forward 2")
    while alone.body.pose.x_m < 1.0:
        alone.tick()
    alone.rest()
    port = MemoryPort()
    robot = Robot(KinematicBody(ROOM, alone.pose), port, boot=Boot(alone.port.latest.record.encode(), False, 1))
    robot.run_until_idle()
    assert codes(robot) == ["PAUSED"]
    robot.settle(1.0)
    port.send("continue")
    robot.run_until_idle()
    assert near(robot.body.pose, 2.0, 0.0)
    assert codes(robot) == ["PAUSED", "RESTARTING", "SUCCESS_FORWARD", "READY"]


@pytest.mark.parametrize("record", [b"", b"{}", b"\xff", b'{"queue": "{}", "pose": [0, 0, 0], "turned": 0}'])
def test_an_unreadable_record_is_as_good_as_none(record):
    port = MemoryPort()
    robot = Robot(KinematicBody(ROOM), port, boot=Boot(record, False, 0))
    robot.attend()
    assert codes(robot) == ["READY"]


def test_what_nobody_knows_of_any_more_is_not_done_and_gets_an_ending(alone):
    alone.port.send("go forward 2")
    alone.port.send('{"id": "known", "command": "turn left"}')
    while alone.body.pose.x_m < 0.5:
        alone.tick()
    alone.rest()
    left = (Entry(1, b"go forward 2"), Entry(2, b"{}"), Entry(3, b'{"id": "gone", "command": "turn left"}'))
    for record, gone in ((None, [1, 2, 3]), (alone.port.latest.record.encode(), [3])):
        port = MemoryPort()
        robot = Robot(KinematicBody(ROOM, alone.pose), port, boot=Boot(record, False, 3, left))
        robot.run_until_idle()
        assert port.ended == gone
        assert [told.code.value for told in port.feedback][:-1] == ["CANCELLED_GOAL"] * len(gone)
        assert port.feedback[-2].id == "gone"


def test_one_seed_ends_in_one_pose_to_the_last_digit():
    def final_pose():
        port = MemoryPort()
        robot = Robot(KinematicBody(ROOM, noise=TYPICAL, seed=5), port)
        robot.settle(2.0)
        for text in ("go forward 1.2", "turn left 70", "go to -1 1"):
            port.send(text)
            robot.run_until_idle()
            robot.settle(1.0)
        return robot.body.pose, robot.pose, robot.body.time_s

    assert final_pose() == final_pose()


def test_what_is_published_is_news(alone):
    alone.port.send("go forward 0.5")
    alone.run_until_idle()
    news = alone.port.latest
    assert news.odom.pose.point.distance_to(alone.body.pose.point) < 0.03
    assert news.lidar.ranges_m[0] == pytest.approx(2.5, abs=0.1)
    assert len(news.map.segments) >= 4
    assert news.status.status in {"moving", "ready"}


def test_speeds_are_read_strictly():
    assert parse_speed("max") is None
    assert parse_speed("2.5") == 2.5
    for text in ("0", "-1", "nan", "inf", "fast", "1e9", ""):
        with pytest.raises(RobotError, match="speed"):
            parse_speed(text)


# ------------------------------------------------------------------ over Redis
class Bare:
    """A client that knows the original bridge only: strings in, keys and the feedback list out."""

    def __init__(self, url):
        self.redis = redis.Redis.from_url(url)
        self._read = 0

    def push(self, *texts):
        self.redis.rpush("Kirby", *texts)

    def until(self, *wanted, seconds=60.0):
        """The codes told up to the first of ``wanted``."""
        told = []
        for _ in range(int(seconds / 0.005)):
            text = self.redis.lindex("Kirby_Feedback", self._read)
            if text is None:
                threading.Event().wait(0.005)
                continue
            self._read += 1
            entry = json.loads(text)
            assert {"level", "from", "code", "message"} <= set(entry)
            told.append(entry["code"])
            if entry["code"] in wanted:
                return told
        raise AssertionError(f"none of {wanted} in {told}")

    def messages(self):
        return [json.loads(text)["message"] for text in self.redis.lrange("Kirby_Feedback", 0, -1)]


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    with RedisServer(tmp_path_factory.mktemp("redis")) as running:
        yield running


@pytest.fixture
def run_robot(server, tmp_path):
    started = []

    def start(body=None, speed=None):
        bridge = Bridge(server.url)
        robot = Robot(body or BodyWithCamera(ROOM, noise=EXACT), bridge, pictures=tmp_path / "pictures")
        stopping = threading.Event()
        thread = threading.Thread(target=run, args=(robot, speed, stopping), daemon=True)
        thread.start()
        started.append((bridge, stopping, thread))
        return robot

    yield start
    for bridge, stopping, thread in started:
        stopping.set()
        thread.join(30.0)
        assert not thread.is_alive()
        bridge.close()


@pytest.fixture
def client(server):
    bare = Bare(server.url)
    bare.redis.flushall()
    yield bare
    bare.redis.close()


@pytest.fixture
def kirby(run_robot, client):
    robot = run_robot()
    assert client.until("READY") == ["READY"]
    return robot


@pytest.mark.parametrize(
    ("text", "x_m", "y_m", "yaw_deg", "told"),
    [
        ("go forward", 1, 0, 0, ["FORWARD", "SUCCESS_FORWARD", "READY"]),
        ("go forward 0.5", 0.5, 0, 0, ["FORWARD", "SUCCESS_FORWARD", "READY"]),
        ("go forward -0.5", -0.5, 0, 0, ["FORWARD", "SUCCESS_FORWARD", "READY"]),
        ("go to 1 -1", 1, -1, 0, ["GO_TO", "SUCCESS_GO_TO", "READY"]),
    ],
)
def test_rows_of_driving(kirby, client, text, x_m, y_m, yaw_deg, told):
    client.push(text)
    assert client.until("READY") == told
    assert near(kirby.body.pose, x_m, y_m, yaw_deg)


@pytest.mark.parametrize(
    ("text", "yaw_deg"), [("turn left", 90), ("turn right", -90), ("turn left 45", 45), ("turn right 400", -40)]
)
def test_rows_of_turning(kirby, client, text, yaw_deg):
    client.push(text)
    phases = ["ESTIMATE_ROTATION", "SUCCESS_ESTIMATE_ROTATION", "VERIFY_ROTATION", "SUCCESS_VERIFY_ROTATION", "READY"]
    assert client.until("READY") == phases
    assert near(kirby.body.pose, 0, 0, yaw_deg)


def test_rows_of_pausing(kirby, client):
    client.push("go forward 2.5")
    client.until("FORWARD")
    client.push("stop")
    assert client.until("PAUSED") == ["PAUSED"]
    client.push("turn left")
    assert client.until("INVALID") == ["INVALID"]
    assert "robot is paused" in client.messages()[-1]
    client.push("continue")
    assert client.until("READY") == ["RESTARTING", "SUCCESS_FORWARD", "READY"]
    assert near(kirby.body.pose, 2.5, 0)


def test_rows_of_cancelling(kirby, client):
    client.push("go forward 2.5", "turn left 30")
    client.until("FORWARD")
    client.push("cancel")
    assert client.until("READY")[:2] == ["CANCELLED_GOAL", "ESTIMATE_ROTATION"]
    client.push("go forward 2", "turn left", "go to 1 1")
    client.until("FORWARD")
    client.push("cancel all")
    assert client.until("READY") == ["CANCELLED_ALL", "READY"]
    assert client.redis.llen("Kirby_Queue") == 0


def test_row_of_going_back(kirby, client):
    client.push("turn left 30")
    client.until("READY")
    client.push("go forward 2", "turn left")
    client.until("FORWARD")
    client.push("go back")
    assert client.until("READY") == ["GO_BACK", "SUCCESS_GO_BACK", "READY"]
    assert near(kirby.body.pose, 0, 0, 30)


def test_rows_of_patrolling(kirby, client):
    client.push("patrol 4 0.5 0.5")
    assert client.until("COMPLETED_LOOP") == ["PATROL", "PLAN_LOOP", "COMPLETED_LOOP"]
    client.push("go forward")
    assert "INVALID" in client.until("INVALID")
    client.push("stop patrol")
    assert client.until("READY")[-2:] == ["STOP_PATROL", "READY"]


def test_a_patrol_ends_when_nothing_is_left(run_robot, client):
    run_robot(BodyWithCamera(polygon((-1, -1), (1, -1), (1, 1), (-1, 1))))
    client.until("READY")
    client.push("patrol 4 0.5 1.5")
    told = client.until("READY")
    assert told == ["PATROL", "PLAN_LOOP", "COMPLETED_LOOP", "PLAN_LOOP", "FINISH_PATROL", "READY"]
    assert client.messages()[-2] == "no more explorable waypoints"


def test_row_of_keeping_going(kirby, client):
    client.push("go to 2.5 0", "turn left")
    client.until("GO_TO")
    while kirby.body.pose.x_m < 1.0:
        threading.Event().wait(0.001)
    wall = kirby.body.pose.x_m + 0.7
    kirby.body.set_walls((*ROOM, Segment(Point(wall, -3), Point(wall, 3))))
    assert client.until("HELP") == ["STRAYED", "HELP"]
    client.push("keep going")
    assert client.until("READY")[:2] == ["RESTARTING", "ESTIMATE_ROTATION"]


def test_rows_of_asking_and_photographing(kirby, client):
    client.push("queue")
    client.until("QUEUE")
    assert client.messages()[-1] == "pending: nothing"
    client.push("take picture")
    assert client.until("READY") == ["PICTURE", "READY"]
    path = client.messages()[-2].removeprefix("took picture ")
    with open(path, "rb") as file:  # noqa: PTH123
        assert file.read(4) == b"\x89PNG"


def test_malformed_commands_are_answered_and_change_nothing(kirby, client):
    texts = [
        "fly",
        "go forward nan",
        "go forward 1e309",
        "turn left -5",
        "patrol 1",
        b"\xff\xfe",
        "x" * 100_000,
        "{",
    ] * 40
    client.push(*texts)
    client.push("queue")
    assert client.until("QUEUE") == ["INVALID"] * len(texts) + ["QUEUE"]
    assert kirby.body.pose == ORIGIN
    assert client.redis.llen("Kirby_Queue") == 0


def test_reset_clears_and_is_ready(kirby, client):
    client.push("go forward 2", "turn left")
    client.until("FORWARD")
    client.redis.set("Bridge_Reset", "1")
    while client.redis.get("Bridge_Reset") != b"0":
        threading.Event().wait(0.005)
    client._read = 0
    assert client.until("READY") == ["READY"]
    assert client.redis.llen("Kirby_Queue") == 0
    client.push("turn left 30")
    assert client.until("READY")[0] == "ESTIMATE_ROTATION"


def test_a_client_of_the_original_bridge_finds_its_keys(kirby, client):
    client.push("go forward 0.5")
    client.until("READY")
    types = {"Map": b"list", "Odom": b"string", "Lidar": b"string", "Kirby_Feedback": b"list", "Status": b"string"}
    assert {name: client.redis.type(name) for name in types} == types
    odom = json.loads(client.redis.get("Odom"))
    assert set(odom) == {
        *("odom_id", "real_odom_id", "location", "orientation", "linearvelocity", "angularvelocity", "time"),
    }
    assert odom["location"][0] == pytest.approx(0.5, abs=0.05)
    walls = json.loads(client.redis.lindex("Map", -1))
    assert walls["line_count"] == len(walls["data"])
    assert decode_map(json.dumps(walls)).segments
    assert decode_odom(json.dumps(odom)).pose.x_m == odom["location"][0]
    assert decode_lidar(client.redis.get("Lidar")).ranges_m


def test_the_guides_example_runs(kirby, client, server, capsys):
    guide = (Path(__file__).parents[2] / "docs" / "bridge.md").read_text()
    (example,) = re.findall(r"```python\n(.*?)```", guide, re.DOTALL)
    exec(compile(example.replace("redis://localhost:6379", server.url), "docs/bridge.md", "exec"), {})
    said = capsys.readouterr().out.splitlines()
    assert {"SUCCESS_VERIFY_ROTATION", "SUCCESS_FORWARD"} <= {line.split()[0] for line in said}
    assert said[-1].startswith("at [")


def test_at_its_own_pace_a_stop_between_two_periods_is_obeyed(run_robot, client):
    robot = run_robot(speed=2.0)
    client.until("READY")
    client.push("go forward 2")
    client.until("FORWARD")
    while robot.body.pose.x_m < 0.1:
        threading.Event().wait(0.005)
    client.push("stop")
    client.until("PAUSED")
    assert robot.body._target == (0.0, 0.0)
    assert robot.body.pose.x_m < 1.0


def test_redis_may_die_and_come_back_while_the_robot_drives(server, run_robot, client):
    robot = run_robot(speed=4.0)
    client.until("READY")
    client.push("go forward 2")
    client.until("FORWARD")
    server.kill()
    for _ in range(2000):
        try:
            told = [decode_feedback(text).code.value for text in client.redis.lrange("Kirby_Feedback", 0, -1)]
        except redis.ConnectionError:
            told = []
        if told[-1:] == ["READY"] and len(told) > 1:
            break
        threading.Event().wait(0.01)
    assert told == ["READY", "FORWARD", "SUCCESS_FORWARD", "READY"]
    assert near(robot.body.pose, 2.0, 0.0)


def test_a_redis_that_hangs_stops_the_wheels_until_it_goes_on(server, run_robot, client):
    robot = run_robot(speed=1.0)
    client.until("READY")
    client.push("go forward 2")
    client.until("FORWARD")
    while robot.body.pose.x_m < 0.05:
        threading.Event().wait(0.005)
    os.kill(server.pid, signal.SIGSTOP)
    try:
        while not robot.held:
            threading.Event().wait(0.005)
        assert robot.body._target == (0.0, 0.0)
    finally:
        os.kill(server.pid, signal.SIGCONT)
    while robot.held:
        threading.Event().wait(0.005)
    client.push("cancel all")
    assert client.until("READY") == ["CANCELLED_ALL", "READY"]
