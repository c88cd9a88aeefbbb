"""The robot's side of the keys against a real Redis: nothing lost, nothing twice, stop in front of everything."""

import json

import pytest
import redis

from robot.bridge import ENTRY_MAX_BYTES, TAKE_MAX, Bridge, ReplacedError, masked
from robot.errors import RobotError
from robot.geometry import Point, Segment
from robot.messages import (
    FEEDBACK_HISTORY,
    MAP_HISTORY,
    FeedbackCode,
    Keys,
    Map,
    Odom,
    Status,
    decode_feedback,
    decode_map,
    decode_odom,
    feedback,
    feedback_from_fields,
)
from robot.port import Boot, Entry, News
from robot.redis_server import RedisServer

KEYS = Keys()
ODOM = Odom(1, 1, (1.0, 2.0, 0.0), (0.0, 0.0, 0.5), 0.1, 0.2, 3.0)


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    with RedisServer(tmp_path_factory.mktemp("redis")) as running:
        yield running


@pytest.fixture
def client(server):
    client = redis.Redis.from_url(server.url)
    client.flushall()
    yield client
    client.close()


@pytest.fixture
def robots(server):
    opened = []

    def start(namespace=""):
        bridge = Bridge(server.url, namespace)
        opened.append(bridge)
        return bridge, bridge.open()

    yield start
    for bridge in opened:
        bridge.close()


def texts(incoming):
    return [entry.text for entry in incoming.entries]


def test_commands_come_once_and_stay_in_the_durable_list_until_they_end(client, robots):
    bridge, _ = robots()
    client.rpush(KEYS.commands, "go forward", "turn left")
    incoming = bridge.exchange(News())
    assert incoming.entries == (Entry(1, b"go forward"), Entry(2, b"turn left"))
    assert bridge.exchange(News()).entries == ()
    assert client.lrange(KEYS.queue, 0, -1) == [b"1 go forward", b"2 turn left"]
    assert client.llen(KEYS.commands) == 0
    bridge.exchange(News(ended=(1,)))
    assert client.lrange(KEYS.queue, 0, -1) == [b"2 turn left"]


def test_wait_ends_when_a_command_arrives(client, robots):
    bridge, _ = robots()
    bridge.exchange(News())
    client.rpush(KEYS.commands, "stop")
    assert bridge.wait(10.0)
    assert texts(bridge.exchange(News())) == [b"stop"]


def test_feedback_goes_to_the_list_and_the_stream(client, robots):
    bridge, _ = robots()
    told = feedback(FeedbackCode.FORWARD, at=Point(1, 2), id="a", time_s=1.5)
    bridge.exchange(News(feedback=(told,)))
    assert [decode_feedback(text) for text in client.lrange(KEYS.feedback, 0, -1)] == [told]
    ((_, fields),) = client.xrange(KEYS.feedback_stream)
    assert feedback_from_fields(fields) == told


def test_feedback_list_keeps_the_newest(client, robots):
    bridge, _ = robots()
    for start in range(0, FEEDBACK_HISTORY + 50, 50):
        batch = tuple(feedback(FeedbackCode.QUEUE, detail=str(n)) for n in range(start, start + 50))
        bridge.exchange(News(feedback=batch))
    kept = client.lrange(KEYS.feedback, 0, -1)
    assert len(kept) == FEEDBACK_HISTORY
    assert decode_feedback(kept[-1]).message == f"pending: {FEEDBACK_HISTORY + 49}"


def test_what_the_robot_senses_is_published_in_the_contracts_types(client, robots):
    bridge, _ = robots()
    for number in range(MAP_HISTORY + 3):
        walls = Map(number, 1.0, 2.0, Point(0, 0), (Segment(Point(0, 0), Point(1, 2)),))
        bridge.exchange(News(map=walls, odom=ODOM, status=Status("t", "ready", "1%")))
    assert client.type(KEYS.map) == b"list"
    assert client.llen(KEYS.map) == MAP_HISTORY
    assert decode_map(client.lindex(KEYS.map, -1)) == walls
    assert decode_odom(client.get(KEYS.odom)) == ODOM
    assert 0 < client.ttl(KEYS.status) <= 5


def test_after_a_restart_the_record_and_what_was_sent_meanwhile_are_there(client, robots):
    bridge, boot = robots()
    assert (boot.record, boot.unhandled) == (None, False)
    client.rpush(KEYS.commands, "go forward", "turn left")
    bridge.exchange(News())
    bridge.exchange(News(record="state"))
    bridge.close()
    client.rpush(KEYS.commands, "go to 1 1")
    again, boot = robots()
    assert boot.record == b"state"
    assert not boot.unhandled
    assert boot.admitted == 3
    assert again.exchange(News()).entries == (Entry(3, b"go to 1 1"),)


def test_entries_taken_but_not_handled_come_again(client, robots):
    bridge, _ = robots()
    client.rpush(KEYS.commands, "go forward", "turn left")
    bridge.exchange(News())
    bridge.close()
    again, boot = robots()
    assert boot.unhandled
    assert texts(again.exchange(News())) == [b"go forward", b"turn left"]


def test_an_exchange_whose_answer_was_lost_is_not_done_twice(client, robots, monkeypatch):
    bridge, _ = robots()
    client.rpush(KEYS.commands, "go forward")
    run = bridge._run

    def run_and_lose_the_answer():
        run()
        raise redis.TimeoutError

    monkeypatch.setattr(bridge, "_run", run_and_lose_the_answer)
    assert bridge.exchange(News(feedback=(feedback(FeedbackCode.READY),))).entries == ()
    monkeypatch.setattr(bridge, "_run", run)
    assert bridge._connections.wait_until_up(10.0)
    assert texts(bridge.exchange(News())) == [b"go forward"]
    assert client.llen(KEYS.feedback) == 1
    assert client.llen(KEYS.queue) == 1


def test_a_stop_far_back_holds_the_wheels_until_it_is_reached(client, robots):
    bridge, _ = robots()
    client.rpush(KEYS.commands, *["queue"] * (3 * TAKE_MAX), '{"id": "s", "command": "stop"}', *["queue"] * TAKE_MAX)
    held, stops = [], []
    for _ in range(5):
        incoming = bridge.exchange(News())
        held.append(incoming.held)
        stops.append(any(b"stop" in text for text in texts(incoming)))
    assert held == [True, True, True, False, False]
    assert stops == [False, False, False, True, False]


def test_only_the_beginning_of_an_overlong_entry_is_fetched(client, robots):
    bridge, _ = robots()
    client.rpush(KEYS.commands, b"x" * 1_000_000)
    (entry,) = bridge.exchange(News()).entries
    assert entry.text == b"x" * ENTRY_MAX_BYTES


def test_reset_clears_every_key_and_is_told_once(client, robots):
    bridge, _ = robots()
    client.rpush(KEYS.commands, "go forward")
    bridge.exchange(News(odom=ODOM, feedback=(feedback(FeedbackCode.READY),)))
    client.rpush(KEYS.commands, "turn left")
    client.set(KEYS.reset, "1")
    incoming = bridge.exchange(News())
    assert incoming.reset
    assert incoming.entries == ()
    assert client.get(KEYS.reset) == b"0"
    assert set(client.keys()) <= {KEYS.reset.encode(), b"Kirby_Queue_Record"}
    assert not bridge.exchange(News()).reset
    client.rpush(KEYS.commands, "stop")
    assert texts(bridge.exchange(News())) == [b"stop"]


def test_keys_of_other_types_are_made_anew(client, robots):
    bridge, _ = robots()
    names = [KEYS.commands, KEYS.queue, KEYS.feedback, KEYS.feedback_stream, KEYS.reset, KEYS.map, KEYS.odom]
    for name in names:
        client.delete(name)
        client.sadd(name, "nonsense")
    client.delete("Kirby_Queue_Record")
    client.set("Kirby_Queue_Record", "nonsense")
    assert bridge.exchange(News(odom=ODOM, feedback=(feedback(FeedbackCode.READY),))).entries == ()
    client.rpush(KEYS.commands, "stop")
    assert texts(bridge.exchange(News())) == [b"stop"]


def test_junk_in_the_durable_list_is_thrown_out(client, robots):
    bridge, _ = robots()
    client.rpush(KEYS.queue, "junk", "99999 go forward")
    client.rpush(KEYS.commands, "stop")
    assert texts(bridge.exchange(News())) == [b"stop"]
    assert client.lrange(KEYS.queue, 0, -1) == [b"1 stop"]


def test_entries_that_the_record_should_know_of_are_told_of(client, robots):
    bridge, _ = robots()
    client.rpush(KEYS.commands, "go forward", "turn left", "go to 1 1")
    bridge.exchange(News())
    bridge.exchange(News(record="state", ended=(1,)))
    bridge.close()
    client.rpush(KEYS.queue, "junk")
    _, boot = robots()
    assert boot.left == (Entry(2, b"turn left"), Entry(3, b"go to 1 1"))
    assert client.llen(KEYS.queue) == 2


def test_a_record_deleted_by_hand_makes_no_number_come_twice(client, robots):
    bridge, _ = robots()
    client.rpush(KEYS.commands, "go forward", "turn left")
    bridge.exchange(News())
    bridge.exchange(News(record="state"))
    bridge.close()
    client.delete("Kirby_Queue_Record")
    again, boot = robots()
    assert boot == Boot(None, False, 2, (Entry(1, b"go forward"), Entry(2, b"turn left")))
    client.rpush(KEYS.commands, "stop")
    assert again.exchange(News()).entries == (Entry(3, b"stop"),)


@pytest.mark.parametrize("value", ["", "-1", "nan", "1e9", "9" * 400, "9" * 15, b"\xff"])
@pytest.mark.parametrize("name", ["batch", "seq", "handled", "resets_handled", "scanned", "hold", "owner"])
def test_a_spoilt_record_makes_nobody_deaf_or_mute(client, robots, name, value):
    bridge, _ = robots()
    bridge.exchange(News(feedback=(feedback(FeedbackCode.READY),)))
    client.hset("Kirby_Queue_Record", name, value)
    client.rpush(KEYS.commands, "queue")
    incoming = bridge.exchange(News())
    assert texts(incoming) == [b"queue"]
    assert not incoming.held
    bridge.exchange(News(feedback=(feedback(FeedbackCode.QUEUE),)))
    assert decode_feedback(client.lindex(KEYS.feedback, -1)).code is FeedbackCode.QUEUE
    client.hset("Kirby_Queue_Record", name, value)
    bridge.close()
    again, _ = robots()
    client.rpush(KEYS.commands, "stop")
    assert texts(again.exchange(News()))[-1] == b"stop"


def test_a_stream_whose_last_id_is_used_up_is_made_anew(client, robots):
    bridge, _ = robots()
    client.xadd(KEYS.feedback_stream, {"code": "junk"}, id=f"{2**64 - 1}-{2**64 - 1}")
    bridge.exchange(News(feedback=(feedback(FeedbackCode.READY),)))
    assert len(client.xrange(KEYS.feedback_stream)) == 1


def test_half_a_character_in_an_id_is_no_obstacle(client, robots):
    bridge, _ = robots()
    bridge.exchange(News(feedback=(feedback(FeedbackCode.INVALID, id="\ud800", detail="\udfff"),)))
    assert decode_feedback(client.lindex(KEYS.feedback, -1)).id == "\ud800"
    ((_, fields),) = client.xrange(KEYS.feedback_stream)
    assert fields[b"id"] == b"?"


def test_a_command_is_handed_over_with_the_waking(client, robots, monkeypatch):
    bridge, _ = robots()
    bridge.exchange(News())
    client.rpush(KEYS.commands, "stop")
    assert bridge.wait(10.0)
    monkeypatch.setattr(bridge, "_run", lambda: pytest.fail("no round trip is needed"))
    assert texts(bridge.exchange(News(odom=ODOM))) == [b"stop"]


def test_what_came_by_an_exchange_does_not_wake_again(client, robots):
    bridge, _ = robots()
    assert not bridge.wait(0.01)  # from now on Redis hands over what is pushed
    client.rpush(KEYS.commands, "stop")
    assert texts(bridge.exchange(News())) == [b"stop"]
    assert not bridge.wait(0.05)
    client.rpush(KEYS.commands, "queue")
    assert bridge.wait(10.0)
    assert texts(bridge.exchange(News())) == [b"queue"]


def test_emptied_redis_is_no_reason_to_miss_what_comes_next(client, robots):
    bridge, _ = robots()
    client.rpush(KEYS.commands, "go forward", "go forward")
    bridge.exchange(News())
    client.flushall()
    client.rpush(KEYS.commands, "stop")
    assert bridge.exchange(News()).entries == (Entry(3, b"stop"),)


def test_a_second_robot_takes_over_and_the_first_learns_of_it(client, robots):
    first, _ = robots()
    second, _ = robots()
    second.exchange(News())
    with pytest.raises(ReplacedError, match="--namespace"):
        first.exchange(News())


def test_namespaces_keep_robots_apart(client, robots):
    (one, _), (two, _) = robots("one"), robots("two")
    client.rpush("two/Kirby", "go forward")
    assert one.exchange(News()).entries == ()
    assert texts(two.exchange(News())) == [b"go forward"]


def test_a_lost_redis_is_survived_and_nothing_that_was_said_is_lost(tmp_path):
    with RedisServer(tmp_path) as server, redis.Redis.from_url(server.url) as client:
        bridge = Bridge(server.url)
        bridge.open()
        client.rpush(KEYS.commands, "go forward")
        assert bridge.wait(10.0)
        assert texts(bridge.exchange(News())) == [b"go forward"]
        server.kill()
        bridge.exchange(News(feedback=(feedback(FeedbackCode.READY),), record="state"))
        for _ in range(1000):
            if bridge.wait(0.05) and (bridge.exchange(News()), bridge.silent_s < 0.01)[1]:
                break
        assert [decode_feedback(text).code for text in client.lrange(KEYS.feedback, 0, -1)] == [FeedbackCode.READY]
        assert client.lrange(KEYS.queue, 0, -1) == [b"1 go forward"]
        bridge.close()


def test_an_unusable_url_is_refused_in_one_line_without_the_password():
    with pytest.raises(RobotError, match="use redis://"):
        Bridge("http://example.org")
    bridge = Bridge("redis://kirby:geheim@127.0.0.1:1/0")
    with pytest.raises(RobotError) as error:
        bridge.open()
    assert "geheim" not in str(error.value)
    assert "\n" not in str(error.value)
    assert masked("rediss://me:geheim@host:6380/1") == "rediss://me:***@host:6380/1"


def test_status_is_json_of_the_contract(client, robots):
    bridge, _ = robots()
    bridge.exchange(News(status=Status("2026-01-01T00:00:00Z", "ready", "3%", ("odd",))))
    assert json.loads(client.get(KEYS.status)) == {
        "time": "2026-01-01T00:00:00Z",
        "status": "ready",
        "cpu": "3%",
        "errors": ["odd"],
    }
