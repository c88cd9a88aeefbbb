"""The wire contract: everything that is encoded is read back, and nothing malformed is let in."""

import json
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robot.entries import read_entry
from robot.geometry import ORIGIN, Point, Pose, Segment, wrap_angle
from robot.messages import (
    COORDINATE_MAX_M,
    DISTANCE_MAX_M,
    TURN_MAX_DEG,
    Control,
    Envelope,
    Feedback,
    FeedbackCode,
    Fiducial,
    Fiducials,
    GoForward,
    GoTo,
    Keys,
    Lidar,
    Malformed,
    Map,
    Odom,
    Patrol,
    Side,
    Status,
    Turn,
    decode_command,
    decode_entry,
    decode_feedback,
    decode_fiducials,
    decode_lidar,
    decode_map,
    decode_odom,
    decode_status,
    encode_command,
    encode_entry,
    encode_feedback,
    encode_fiducials,
    encode_lidar,
    encode_map,
    encode_odom,
    encode_status,
    feedback_fields,
    feedback_from_fields,
    ideal_end,
)
from robot.port import Entry
from robot.queue import IDLE, Garbled, Here, handle


def micro(low, high):
    return st.integers(math.ceil(low * 1e6), math.floor(high * 1e6)).map(lambda n: n / 1e6)


def milli(low=-1000.0, high=1000.0):
    return st.integers(round(low * 1e3), round(high * 1e3)).map(lambda n: n / 1e3)


commands = st.one_of(
    st.builds(GoForward, micro(-DISTANCE_MAX_M, DISTANCE_MAX_M)),
    st.builds(GoTo, micro(-COORDINATE_MAX_M, COORDINATE_MAX_M), micro(-COORDINATE_MAX_M, COORDINATE_MAX_M)),
    st.builds(Turn, st.sampled_from(Side), micro(1e-6, TURN_MAX_DEG)),
    st.builds(Patrol, st.integers(3, 360), micro(1e-6, 100.0), micro(1e-6, 100.0)),
    st.sampled_from(Control),
)
texts = st.text(st.characters(exclude_categories=["Cs"]), min_size=1, max_size=40)
triples = st.tuples(milli(), milli(), milli())
points = st.builds(Point, milli(), milli())
feedbacks = st.builds(
    Feedback, st.sampled_from(FeedbackCode), texts, st.none() | texts, st.none() | milli(0.0), texts, texts
)


@given(commands)
def test_commands_are_read_back(command):
    assert decode_command(encode_command(command)) == command


@given(commands, st.none() | st.text(min_size=1, max_size=64))
def test_entries_are_read_back_from_text_and_bytes(command, name):
    envelope = Envelope(command, name)
    assert decode_entry(encode_entry(envelope)) == envelope
    assert decode_entry(encode_entry(envelope).encode()) == envelope


@given(feedbacks)
def test_feedback_is_read_back_from_list_and_stream(entry):
    assert decode_feedback(encode_feedback(entry)) == entry
    fields = {name.encode(): value.encode() for name, value in feedback_fields(entry).items()}
    assert feedback_from_fields(fields) == entry


@given(
    st.builds(Odom, st.integers(0), st.integers(0), triples, triples, milli(), milli(), milli(0.0)),
    st.builds(
        Map, st.integers(0), milli(0.0), milli(0.0), points, st.lists(st.builds(Segment, points, points)).map(tuple)
    ),
    st.builds(Fiducials, st.lists(st.builds(Fiducial, texts, triples, triples)).map(tuple)),
    st.builds(Lidar, milli(0.1), milli(0.0), micro(0.1, 6.2), st.lists(milli(0.0), min_size=1).map(tuple)),
    st.builds(Status, texts, texts, texts, st.lists(texts).map(tuple)),
)
@settings(max_examples=50)
def test_what_the_robot_publishes_is_read_back(odom, walls, fiducials, lidar, status):
    assert decode_odom(encode_odom(odom)) == odom
    assert decode_map(encode_map(walls)) == walls
    assert decode_fiducials(encode_fiducials(fiducials)) == fiducials
    assert decode_lidar(encode_lidar(lidar)) == lidar
    assert decode_status(encode_status(status)) == status


BAD_NUMBERS = (
    *("nan", "NaN", "-nan", "inf", "-inf", "Infinity", "1e309", "-1e309", "1e3", "1E2", "1e-400", "1e", "0x10", "0b1"),
    *(
        "0o7",
        "1_000",
        "1,5",
        "1.",
        ".",
        "--1",
        "+1",
        "-",
        "1.2.3",
        "one",
        "\u0663",
        "\uff11",
        "\xbd",
        "1/2",
        "5m",
        "'1'",
    ),
    *("[1]", "(1)", "null", "true", "1;2", "$1", "1%", "2^3", "1000000", "-1000000", "", "5 ft", "9" * 180, "1\x002"),
)


def malformed_texts():
    """Well over 500 variants, each wrong in a way of its own."""
    for number in BAD_NUMBERS:
        if number:
            yield f"go forward {number}"
            yield f"turn left {number}"
            yield f"turn right {number}"
        yield f"go to {number} 1"
        yield f"go to 1 {number}"
        yield f"go to {number} {number}"
        yield f"patrol {number} 1 1"
        yield f"patrol 16 {number} 1"
        yield f"patrol 16 1 {number}"
    for control in Control:
        yield from (f"{control.value} 1", f"{control.value} now", control.value.upper(), control.value.title())
        yield from (f"{control.value};", f"please {control.value}", f"{control.value}\x00", control.value[:-1])
    yield from (
        "go",
        "go to",
        "go to 1",
        "go to 1 2 3",
        "go forward 1 2",
        "turn",
        "turn 90",
        "turn left 0",
        "turn left -5",
    )
    yield from (
        "turn right 90 90",
        "turn around",
        "patrol 1",
        "patrol 1 2",
        "patrol 2 1 1",
        "patrol 361 1 1",
        "patrol 3.5 1 1",
    )
    yield from (
        "patrol 16 0 1",
        "patrol 16 1 0",
        "patrol 16 -1 1",
        "patrol 3 1 1 1",
        "turn left 3601",
        "go forward 100.01",
    )
    yield from (
        "go to 1000.5 0",
        "Go Forward 1",
        "GO FORWARD",
        "go forwards",
        "forward",
        "fly",
        "",
        " ",
        "\n",
        "\x00",
        "💥",
    )
    yield from (
        "x" * 201,
        "go forward " + "1" * 200,
        "go  to",
        "stop stop",
        "cancel everything",
        "drop table",
        "{",
        "{}",
        "[]",
    )
    for command in ("fly", "go forward nan", "", "STOP"):
        yield json.dumps({"id": "a", "command": command})
    for envelope in (
        {"id": "a"},
        {"command": "stop"},
        {"id": 1, "command": "stop"},
        {"id": "", "command": "stop"},
        {"id": "a" * 65, "command": "stop"},
        {"id": "a", "command": ["stop"]},
        {"id": "a", "command": "stop", "more": 1},
        {"id": "a", "command": None},
        {"id": None, "command": "stop"},
    ):
        yield json.dumps(envelope)
    yield from (
        '{"id": "a", "command": "stop"',
        '{"id": NaN, "command": "stop"}',
        '{"a":' * 60,
        '{"id": "a" "command": 1}',
    )


MALFORMED = sorted(set(malformed_texts()))


def test_there_are_enough_malformed_commands():
    assert len(MALFORMED) >= 500


def test_every_malformed_command_is_refused_in_words_and_changes_nothing():
    for text in MALFORMED:
        event = read_entry(Entry(7, text.encode()))
        assert isinstance(event, Garbled), text
        state, effects = handle(IDLE, event, Here(ORIGIN))
        assert state == IDLE
        told, forgotten = effects
        assert told.feedback.code is FeedbackCode.INVALID
        assert 0 < len(told.feedback.message) < 500
        assert forgotten.entry == 7


@given(st.binary(max_size=300))
def test_random_bytes_are_a_command_or_are_refused(data):
    event = read_entry(Entry(1, data))
    assert event.entry == 1


@given(st.text(alphabet='gotfrwardlenpisc {}":,.-0123456789', max_size=80))
@settings(max_examples=300)
def test_texts_made_of_the_same_letters_raise_nothing_else(text):
    event = read_entry(Entry(1, text.encode()))
    assert isinstance(event, Garbled) or decode_command(encode_command(event.envelope.command)) is not None


def test_the_sender_of_a_malformed_envelope_is_told_under_its_id():
    assert read_entry(Entry(1, b'{"id": "q7", "command": "fly"}')).id == "q7"
    assert read_entry(Entry(1, b'{"id": "q7", "command": "fly", "x": 1}')).id == "q7"
    assert read_entry(Entry(1, b'{"id": 7, "command": "fly"}')).id is None
    assert read_entry(Entry(1, b"\xff\xfe")).id is None


@pytest.mark.parametrize(
    "decode", [decode_odom, decode_map, decode_fiducials, decode_lidar, decode_status, decode_feedback]
)
@given(data=st.binary(max_size=100) | st.recursive(st.none() | st.floats() | st.text(), st.lists).map(json.dumps))
@settings(max_examples=50)
def test_published_values_are_read_strictly(decode, data):
    with pytest.raises(Malformed):
        decode(data)


def test_every_command_has_its_ideal_end():
    start = Pose(1.0, 2.0, math.pi / 2)
    assert ideal_end(start, GoForward(2.0)).point.distance_to(Point(1.0, 4.0)) < 1e-12
    assert ideal_end(start, GoForward(-2.0)).point.distance_to(Point(1.0, 0.0)) < 1e-12
    assert ideal_end(start, GoTo(3.0, 3.0)) == Pose(3.0, 3.0, math.pi / 2)
    assert ideal_end(start, Turn(Side.RIGHT, 90.0)).yaw_rad == pytest.approx(0.0)
    assert ideal_end(start, Patrol()) == start


poses = st.builds(Pose, milli(), milli(), st.floats(-10.0, 10.0).map(wrap_angle))


@given(poses, poses)
def test_relative_poses_compose_back(a, b):
    back = a.compose(b.relative_to(a))
    assert back.point.distance_to(b.point) < 1e-8
    assert abs(wrap_angle(back.yaw_rad - b.yaw_rad)) < 1e-9


@given(poses, points)
def test_points_go_to_the_local_frame_and_back(pose, point):
    assert pose.to_map(pose.to_local(point)).distance_to(point) < 1e-8


@given(st.floats(-1e6, 1e6))
def test_wrapped_angles_are_the_same_direction(angle_rad):
    wrapped = wrap_angle(angle_rad)
    assert -math.pi < wrapped <= math.pi
    assert math.cos(wrapped) == pytest.approx(math.cos(angle_rad), abs=1e-6)
    assert math.sin(wrapped) == pytest.approx(math.sin(angle_rad), abs=1e-6)


def test_keys_stand_under_their_namespace():
    assert Keys().commands == "Kirby"
    assert Keys("r2").commands == "r2/Kirby"
    assert Keys("r2").feedback_stream == "r2/Kirby_Feedback_Stream"
