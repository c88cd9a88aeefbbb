"""A client that knows only the original bridge, written with redis and json alone; all it gets of Kirby is a URL."""

import json
import math
import re
import subprocess
import sys
import time

import pytest
import redis

pytestmark = pytest.mark.physics

PATIENCE_S = 120.0


class OriginalClient:
    """Plain strings in; what the robot says and senses out, under the keys that the original robots had."""

    def __init__(self, url):
        self.redis = redis.Redis.from_url(url, decode_responses=True)
        self.heard = 0

    def say(self, command):
        self.redis.rpush("Kirby", command)

    def hear(self, *codes):
        """Every code told, up to the first of ``codes``."""
        told = []
        end_s = time.monotonic() + PATIENCE_S
        while time.monotonic() < end_s:
            for text in self.redis.lrange("Kirby_Feedback", self.heard, -1):
                self.heard += 1
                entry = json.loads(text)
                assert entry["level"] == "INFO"
                assert entry["from"] == "/kirby"
                assert isinstance(entry["message"], str)
                told.append(entry["code"])
                if entry["code"] in codes:
                    return told
            time.sleep(0.02)
        raise AssertionError(f"none of {codes} in {told}")

    def place(self):
        """Where it says it is: x, y, yaw in degrees."""
        odom = json.loads(self.redis.get("Odom"))
        return odom["location"][0], odom["location"][1], math.degrees(odom["orientation"][2])

    def reset(self):
        self.redis.set("Bridge_Reset", "1")
        end_s = time.monotonic() + PATIENCE_S
        while self.redis.get("Bridge_Reset") != "0":
            assert time.monotonic() < end_s
            time.sleep(0.01)
        self.heard = 0


@pytest.fixture(scope="module")
def url(tmp_path_factory):
    arguments = ["robot", "--world", "figure3", "--speed", "max", "--state", tmp_path_factory.mktemp("state")]
    robot = subprocess.Popen([sys.executable, "-m", "kirby", *arguments], stderr=subprocess.PIPE, text=True)
    found = re.search(r"commands at (\S+);", robot.stderr.readline())
    yield found[1]
    robot.terminate()
    assert robot.wait(30) == 0
    robot.stderr.close()


@pytest.fixture(scope="module")
def client(url):
    client = OriginalClient(url)
    end_s = time.monotonic() + PATIENCE_S
    while True:
        try:
            assert client.hear("READY") == ["READY"]
            break
        except redis.ConnectionError:  # it is being started
            assert time.monotonic() < end_s
            time.sleep(0.05)
    yield client
    client.redis.close()


def test_what_is_sensed_has_the_original_types_and_fields(client):
    types = {"Map": "list", "Odom": "string", "Fiducials": "string", "Lidar": "string", "Kirby_Feedback": "list"}
    assert {key: client.redis.type(key) for key in types} == types
    odom = json.loads(client.redis.get("Odom"))
    assert {"odom_id", "location", "orientation", "linearvelocity", "angularvelocity"} <= set(odom)
    assert [len(odom["location"]), len(odom["orientation"])] == [3, 3]
    walls = json.loads(client.redis.lindex("Map", -1))
    assert walls["line_count"] == len(walls["data"]) > 0
    assert all(len(row) == 4 for row in walls["data"])
    assert len(walls["origin"]) == 2
    assert min(walls["width"], walls["height"]) > 0
    lidar = json.loads(client.redis.get("Lidar"))
    assert lidar["slices"] == len(lidar["data"])
    assert all(lidar["min_range"] <= range_m <= lidar["max_range"] for range_m in lidar["data"])


def test_it_drives_and_says_so(client):
    x_m, y_m, yaw_deg = client.place()
    client.say("go forward 0.5")
    assert client.hear("READY") == ["FORWARD", "SUCCESS_FORWARD", "READY"]
    ahead = (x_m + 0.5 * math.cos(math.radians(yaw_deg)), y_m + 0.5 * math.sin(math.radians(yaw_deg)))
    assert client.place()[:2] == pytest.approx(ahead, abs=0.05)
    client.say("turn left 90")
    turning = ["ESTIMATE_ROTATION", "SUCCESS_ESTIMATE_ROTATION", "VERIFY_ROTATION", "SUCCESS_VERIFY_ROTATION", "READY"]
    assert client.hear("READY") == turning
    assert math.remainder(client.place()[2] - yaw_deg - 90.0, 360.0) == pytest.approx(0.0, abs=3.0)
    client.say("go back")
    assert client.hear("READY") == ["GO_BACK", "SUCCESS_GO_BACK", "READY"]
    client.say(f"go to {x_m:.3f} {y_m:.3f}")
    assert client.hear("READY") == ["GO_TO", "SUCCESS_GO_TO", "READY"]
    assert client.place()[:2] == pytest.approx((x_m, y_m), abs=0.05)


def test_it_stops_continues_and_drops_what_was_queued(client):
    client.say("turn right 1080")
    client.hear("ESTIMATE_ROTATION")
    client.say("stop")
    assert client.hear("PAUSED", "SUCCESS_VERIFY_ROTATION")[-1] == "PAUSED"
    client.say("go forward 1")
    assert client.hear("INVALID") == ["INVALID"]
    client.say("continue")
    assert client.hear("READY")[-2:] == ["SUCCESS_VERIFY_ROTATION", "READY"]
    client.redis.rpush("Kirby", "turn right 1080", "turn left 1080")
    client.hear("ESTIMATE_ROTATION")
    client.say("cancel all")
    assert client.hear("READY")[-2:] == ["CANCELLED_ALL", "READY"]
    client.say("no such command")
    assert client.hear("INVALID") == ["INVALID"]


def test_it_sees_markers_on_its_way_round(client):
    client.redis.rpush("Kirby", *["turn left 45"] * 8)
    client.hear("READY")
    seen = json.loads(client.redis.get("Fiducials"))
    assert (seen["dict"], seen["frame"]) == (7, "odom")
    assert seen["fid_count"] == len(seen["data"]) > 0
    for row in seen["data"]:
        assert isinstance(row["fid"], str)
        assert [len(row["pose"]["location"]), len(row["pose"]["orientation"])] == [3, 3]


def test_a_reset_clears_the_keys_and_stops_what_was_begun(client):
    client.redis.rpush("Kirby", "turn left 1080", "turn left 1080")
    client.hear("ESTIMATE_ROTATION")
    client.reset()
    assert client.hear("READY") == ["READY"]
    client.say("queue")
    assert client.hear("QUEUE") == ["QUEUE"]
    assert json.loads(client.redis.lindex("Kirby_Feedback", -1))["message"] == "pending: nothing"
    client.say("turn right 30")
    assert client.hear("READY")[-2:] == ["SUCCESS_VERIFY_ROTATION", "READY"]
