"""The wire contract of the Robotic Services Bridge: every command, feedback code and key, as frozen values.

Formats follow the bridge that the original robots ran (campusrover ``robot_services``); what Kirby adds never breaks a
client that knows only those. Lengths are metres and angles radians, except that turning commands carry degrees. The
frame is ROS ``odom``/``map`` (REP-103). Encoding is exact and decoding is strict: anything malformed raises
:class:`Malformed`, whose text says what is wrong and what would be right.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import Enum
from typing import Any

from .geometry import Point, Pose, Segment

COMMAND_MAX_CHARS = 200
ID_MAX_CHARS = 64
ENTRY_MAX_CHARS = COMMAND_MAX_CHARS + 12 * ID_MAX_CHARS + 100  # JSON may write a character as two escapes of six
MESSAGE_MAX_CHARS = 1_000_000
DISTANCE_MAX_M = 100.0
COORDINATE_MAX_M = 1_000.0
TURN_MAX_DEG = 3_600.0
PATROL_SIDES_MIN, PATROL_SIDES_MAX = 3, 360
PATROL_RADIUS_MAX_M = 100.0


class Malformed(ValueError):  # noqa: N818 - named for what it says of the text
    """A text on the wire that is not of the contract; ``str()`` of it is fit to show to a person."""


# ------------------------------------------------------------------ commands
class Side(Enum):
    """Which way a turn goes: left is counter-clockwise."""

    LEFT = "left"
    RIGHT = "right"


@dataclass(frozen=True, slots=True)
class GoForward:
    """Drive ahead; a negative distance lies behind."""

    distance_m: float = 1.0


@dataclass(frozen=True, slots=True)
class GoTo:
    """Drive to a place on the map; the heading at the end is the one before."""

    x_m: float
    y_m: float


@dataclass(frozen=True, slots=True)
class Turn:
    """Turn in place by a positive angle."""

    side: Side
    angle_deg: float = 90.0


@dataclass(frozen=True, slots=True)
class Patrol:
    """Concentric polygons around the place where it starts; the defaults are the paper's (section 3.1)."""

    sides: int = 16
    radius_m: float = 1.5
    increment_m: float = 1.0


class Control(Enum):
    """Commands without arguments."""

    STOP = "stop"
    CONTINUE = "continue"
    CANCEL = "cancel"
    CANCEL_ALL = "cancel all"
    GO_BACK = "go back"
    KEEP_GOING = "keep going"
    STOP_PATROL = "stop patrol"
    QUEUE = "queue"
    TAKE_PICTURE = "take picture"


@dataclass(frozen=True, slots=True)
class CancelCommand:
    """Drop the command that was sent under this id, whether it is being done or waits; the rest is recomputed (+)."""

    of: str


Movement = GoForward | GoTo | Turn | Patrol
Command = Movement | Control | CancelCommand

_NUMBER = re.compile(r"-?[0-9]+(\.[0-9]+)?|-?\.[0-9]+")
_CONTROLS = {control.value: control for control in Control}
_USAGE = (
    "go forward [d], go to X Y, turn left [a], turn right [a], patrol [s r i], "
    + ", ".join(control.value for control in Control)
    + ", cancel command ID"
)


def format_number(value: float) -> str:
    """Plain decimal with at most six places and no trailing zeros: ``1.524``, ``-2``, ``0.05``."""
    text = f"{value:.6f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def _number(text: str, what: str, limit: float, unit: str) -> float:
    if not _NUMBER.fullmatch(text):
        raise Malformed(f"{what} '{text}' is not a plain decimal number such as 1.5")
    value = float(text)
    if abs(value) > limit:
        raise Malformed(f"{what} {text} is out of range: at most {format_number(limit)} {unit}")
    return value


def _go_forward(words: list[str]) -> GoForward:
    if len(words) > 1:
        raise Malformed("'go forward' takes one distance: go forward [d]")
    return GoForward(*(_number(w, "distance", DISTANCE_MAX_M, "m") for w in words))


def _go_to(words: list[str]) -> GoTo:
    if len(words) != 2:
        raise Malformed("'go to' takes two coordinates: go to X Y")
    x_m, y_m = (_number(w, "coordinate", COORDINATE_MAX_M, "m") for w in words)
    return GoTo(x_m, y_m)


def _turn(side: Side, words: list[str]) -> Turn:
    if len(words) > 1:
        raise Malformed(f"'turn {side.value}' takes one angle in degrees: turn {side.value} [a]")
    if not words:
        return Turn(side)
    angle_deg = _number(words[0], "angle", TURN_MAX_DEG, "degrees")
    if angle_deg <= 0:
        raise Malformed(f"angle {words[0]} must be greater than 0: turn {side.value} [a]")
    return Turn(side, angle_deg)


def _cancel_command(words: list[str]) -> CancelCommand:
    if len(words) != 1 or len(words[0]) > ID_MAX_CHARS:
        raise Malformed(f"'cancel command' takes one id of at most {ID_MAX_CHARS} characters: cancel command ID")
    return CancelCommand(words[0])


def _patrol(words: list[str]) -> Patrol:
    if not words:
        return Patrol()
    if len(words) != 3:
        raise Malformed("'patrol' takes none or all three of sides, radius and increment: patrol [s r i]")
    if not re.fullmatch(r"[0-9]+", words[0]) or not PATROL_SIDES_MIN <= int(words[0][:9]) <= PATROL_SIDES_MAX:
        raise Malformed(f"sides '{words[0]}' must be a whole number from {PATROL_SIDES_MIN} to {PATROL_SIDES_MAX}")
    radius_m = _number(words[1], "radius", PATROL_RADIUS_MAX_M, "m")
    increment_m = _number(words[2], "increment", PATROL_RADIUS_MAX_M, "m")
    if radius_m <= 0 or increment_m <= 0:
        raise Malformed("radius and increment must be greater than 0: patrol [s r i]")
    return Patrol(int(words[0]), radius_m, increment_m)


_WITH_VALUES: dict[tuple[str, ...], Callable[[list[str]], Movement | CancelCommand]] = {
    ("go", "forward"): _go_forward,
    ("go", "to"): _go_to,
    ("turn", "left"): lambda words: _turn(Side.LEFT, words),
    ("turn", "right"): lambda words: _turn(Side.RIGHT, words),
    ("patrol",): _patrol,
    ("cancel", "command"): _cancel_command,
}


def decode_command(text: str) -> Command:
    """Read one command as it stands on the wire.

    Raises:
        Malformed: wrong words, wrong number of values, not plain decimals, or values beyond the limits above.
    """
    if len(text) > COMMAND_MAX_CHARS:
        raise Malformed(f"command of {len(text)} characters is too long: at most {COMMAND_MAX_CHARS}")
    words = text.split()
    control = _CONTROLS.get(" ".join(words))
    if control is not None:
        return control
    for length in (2, 1):
        read = _WITH_VALUES.get(tuple(words[:length]))
        if read is not None:
            return read(words[length:])
    shown = " ".join(words)[:40]
    hint = " (commands are lower case)" if shown.lower() != shown else ""
    raise Malformed(f"unknown command '{shown}'{hint}: expected one of {_USAGE}")


def encode_command(command: Command) -> str:
    """The command's text on the wire; ``decode_command`` reads it back to an equal value (to six decimals)."""
    match command:
        case GoForward(distance_m):
            return f"go forward {format_number(distance_m)}"
        case GoTo(x_m, y_m):
            return f"go to {format_number(x_m)} {format_number(y_m)}"
        case Turn(side, angle_deg):
            return f"turn {side.value} {format_number(angle_deg)}"
        case Patrol(sides, radius_m, increment_m):
            return f"patrol {sides} {format_number(radius_m)} {format_number(increment_m)}"
        case CancelCommand(of):
            return f"cancel command {of}"
        case Control():
            return command.value


def ideal_end(start: Pose, command: Command) -> Pose:
    """Where a movement ends if nothing goes wrong, from the ideal end of the one before (RSB: errors do not add up).

    A patrol ends where it began; commands that are not movements end where they start.
    """
    match command:
        case GoForward(distance_m):
            return start.ahead(distance_m)
        case GoTo(x_m, y_m):
            return start.at(Point(x_m, y_m))
        case Turn(side, angle_deg):
            return start.turned(math.radians(angle_deg if side is Side.LEFT else -angle_deg))
        case _:
            return start


@dataclass(frozen=True, slots=True)
class Envelope:
    """An entry of the ``Kirby`` list: a command, with an id where the client gave one."""

    command: Command
    id: str | None = None


def decode_entry(entry: str | bytes) -> Envelope:
    """Read one entry of the ``Kirby`` list: a plain command, or JSON ``{"id": str, "command": text}``.

    Raises:
        Malformed: as :func:`decode_command`, or an envelope that is not of that shape.
    """
    if isinstance(entry, bytes):
        try:
            entry = entry.decode("utf-8")
        except UnicodeDecodeError:
            raise Malformed("entry is not UTF-8 text") from None
    if entry.lstrip()[:1] != "{":
        return Envelope(decode_command(entry))
    data = decode_object(entry, ENTRY_MAX_CHARS)
    if set(data) != {"id", "command"} or not all(isinstance(v, str) for v in data.values()):
        raise Malformed('envelope must be {"id": "...", "command": "..."}')
    if not 0 < len(data["id"]) <= ID_MAX_CHARS:
        raise Malformed(f"id must have 1 to {ID_MAX_CHARS} characters")
    return Envelope(decode_command(data["command"]), data["id"])


def encode_entry(envelope: Envelope) -> str:
    """The entry's text: plain where there is no id."""
    text = encode_command(envelope.command)
    return text if envelope.id is None else json.dumps({"id": envelope.id, "command": text})


# ------------------------------------------------------------------ feedback
class FeedbackCode(Enum):
    """Codes are for programs and never change."""

    READY = "READY"
    INVALID = "INVALID"
    PAUSED = "PAUSED"
    RESTARTING = "RESTARTING"
    CANCELLED_GOAL = "CANCELLED_GOAL"
    CANCELLED_ALL = "CANCELLED_ALL"
    FORWARD = "FORWARD"
    GO_TO = "GO_TO"
    ESTIMATE_ROTATION = "ESTIMATE_ROTATION"
    VERIFY_ROTATION = "VERIFY_ROTATION"
    GO_BACK = "GO_BACK"
    SUCCESS_FORWARD = "SUCCESS_FORWARD"
    SUCCESS_GO_TO = "SUCCESS_GO_TO"
    SUCCESS_ESTIMATE_ROTATION = "SUCCESS_ESTIMATE_ROTATION"
    SUCCESS_VERIFY_ROTATION = "SUCCESS_VERIFY_ROTATION"
    SUCCESS_GO_BACK = "SUCCESS_GO_BACK"
    UNREACHABLE = "UNREACHABLE"
    STRAYED = "STRAYED"
    HELP = "HELP"
    PATROL = "PATROL"
    PLAN_LOOP = "PLAN_LOOP"
    COMPLETED_LOOP = "COMPLETED_LOOP"
    STOP_PATROL = "STOP_PATROL"
    FINISH_PATROL = "FINISH_PATROL"
    QUEUE = "QUEUE"
    PICTURE = "PICTURE"


_MESSAGES: dict[FeedbackCode, str] = {
    FeedbackCode.READY: "waiting for commands",
    FeedbackCode.INVALID: "invalid command: {detail}",
    FeedbackCode.PAUSED: "paused current goal",
    FeedbackCode.RESTARTING: "restarting current goal",
    FeedbackCode.CANCELLED_GOAL: "canceled goal",
    FeedbackCode.CANCELLED_ALL: "canceled all goals",
    FeedbackCode.FORWARD: "looking for path to ({x}, {y})",
    FeedbackCode.GO_TO: "looking for path to ({x}, {y})",
    FeedbackCode.ESTIMATE_ROTATION: "estimating rotation",
    FeedbackCode.VERIFY_ROTATION: "verifying rotation",
    FeedbackCode.GO_BACK: "returning to previous location ({x}, {y})",
    FeedbackCode.SUCCESS_FORWARD: "successfully navigated to ({x}, {y}){detail}",
    FeedbackCode.SUCCESS_GO_TO: "successfully navigated to ({x}, {y}){detail}",
    FeedbackCode.SUCCESS_ESTIMATE_ROTATION: "completed estimated rotation",
    FeedbackCode.SUCCESS_VERIFY_ROTATION: "verified rotation",
    FeedbackCode.SUCCESS_GO_BACK: "returned to previous location",
    FeedbackCode.UNREACHABLE: "unable to complete goal",
    FeedbackCode.STRAYED: "moved from expected path and failed to reach goal",
    FeedbackCode.HELP: "user input is required: keep going OR go back",
    FeedbackCode.PATROL: "patrolling",
    FeedbackCode.PLAN_LOOP: "planning loop {detail}",
    FeedbackCode.COMPLETED_LOOP: "completed loop {detail}",
    FeedbackCode.STOP_PATROL: "stopped patrolling",
    FeedbackCode.FINISH_PATROL: "no more explorable waypoints",
    FeedbackCode.QUEUE: "pending: {detail}",
    FeedbackCode.PICTURE: "took picture {detail}",
}


@dataclass(frozen=True, slots=True)
class Feedback:
    """One entry of ``Kirby_Feedback``. ``id`` is the command's where it had one; ``time_s`` is the robot's clock."""

    code: FeedbackCode
    message: str
    id: str | None = None
    time_s: float | None = None
    level: str = "INFO"
    sender: str = "/kirby"


def feedback(
    code: FeedbackCode, *, at: Point | None = None, detail: str = "", id: str | None = None, time_s: float | None = None
) -> Feedback:
    """A feedback with the contract's message for its code; ``at`` fills (x, y), ``detail`` the rest."""
    place = {} if at is None else {"x": format_number(round(at.x_m, 2)), "y": format_number(round(at.y_m, 2))}
    return Feedback(code, _MESSAGES[code].format(detail=detail, **place), id, time_s)


def encode_feedback(entry: Feedback) -> str:
    """The entry's JSON on the wire."""
    data: dict[str, Any] = {
        "level": entry.level,
        "from": entry.sender,
        "code": entry.code.value,
        "message": entry.message,
    }
    if entry.id is not None:
        data["id"] = entry.id
    if entry.time_s is not None:
        data["time"] = round(entry.time_s, 3)
    return json.dumps(data)


def decode_feedback(text: str | bytes) -> Feedback:
    """Raises Malformed on anything that is not a feedback with a known code."""
    return _feedback(decode_object(text))


def _feedback(data: Mapping[str, Any]) -> Feedback:
    try:
        code = FeedbackCode(data["code"])
    except (KeyError, ValueError):
        raise Malformed(f"feedback code {data.get('code')!r} is unknown") from None
    return Feedback(
        code,
        _text(data, "message"),
        None if data.get("id") is None else _text(data, "id"),
        None if data.get("time") is None else _finite(data, "time"),
        _text(data, "level"),
        _text(data, "from"),
    )


def feedback_fields(entry: Feedback) -> dict[str, str]:
    """The same fields as flat text, as an entry of the feedback stream holds them."""
    return {name: str(value) for name, value in json.loads(encode_feedback(entry)).items()}


def feedback_from_fields(fields: Mapping[bytes, bytes]) -> Feedback:
    """Reads an entry of the feedback stream. Raises Malformed as :func:`decode_feedback` does."""
    data: dict[str, Any] = {name.decode(): value.decode(errors="replace") for name, value in fields.items()}
    if "time" in data:
        try:
            data["time"] = float(data["time"])
        except ValueError:
            raise Malformed("'time' must be a number") from None
    return _feedback(data)


# ------------------------------------------------------------------ what the robot publishes
@dataclass(frozen=True, slots=True)
class Odom:
    """Where the robot believes it is, and how fast it drives. Orientation is (roll, pitch, yaw)."""

    odom_id: int
    real_odom_id: int
    location_m: tuple[float, float, float]
    orientation_rad: tuple[float, float, float]
    linear_mps: float
    angular_radps: float
    time_s: float

    @property
    def pose(self) -> Pose:
        return Pose(self.location_m[0], self.location_m[1], self.orientation_rad[2])


@dataclass(frozen=True, slots=True)
class Map:
    """The walls met so far. ``width_m`` and ``height_m`` span the walls from ``origin`` (their lower left corner)."""

    id: int
    width_m: float
    height_m: float
    origin: Point
    segments: tuple[Segment, ...]


@dataclass(frozen=True, slots=True)
class Fiducial:
    """One marker: x of its frame points out of its printed face, so ``orientation_rad[2]`` is the way it faces."""

    id: str
    location_m: tuple[float, float, float]
    orientation_rad: tuple[float, float, float]

    @property
    def pose(self) -> Pose:
        return Pose(self.location_m[0], self.location_m[1], self.orientation_rad[2])


@dataclass(frozen=True, slots=True)
class Fiducials:
    """Every marker seen so far."""

    fiducials: tuple[Fiducial, ...]
    frame: str = "odom"
    dictionary: int = 7  # cv2.aruco.DICT_5X5_1000


@dataclass(frozen=True, slots=True)
class Lidar:
    """The nearest range in each slice, from straight ahead counter-clockwise. ``max_range_m`` stands for no echo."""

    max_range_m: float
    min_range_m: float
    fov_rad: float
    ranges_m: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Status:
    """Signs of life; expires on its own so that a dead robot is seen."""

    time: str
    status: str
    cpu: str
    errors: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class PlannedPath:
    """The way that the robot means to drive from where it is; empty when it means to drive nowhere."""

    points: tuple[Point, ...] = ()


def _round3(values: tuple[float, ...]) -> list[float]:
    return [round(v, 3) for v in values]


def encode_odom(odom: Odom) -> str:
    """JSON, rounded to three decimals."""
    return json.dumps(
        {
            "odom_id": odom.odom_id,
            "real_odom_id": odom.real_odom_id,
            "location": _round3(odom.location_m),
            "orientation": _round3(odom.orientation_rad),
            "linearvelocity": round(odom.linear_mps, 3),
            "angularvelocity": round(odom.angular_radps, 3),
            "time": round(odom.time_s, 3),
        }
    )


def decode_odom(text: str | bytes) -> Odom:
    """Raises Malformed on anything that is not of the contract."""
    data = decode_object(text)
    return Odom(
        _whole(data, "odom_id"),
        _whole(data, "real_odom_id"),
        _triple(data, "location"),
        _triple(data, "orientation"),
        _finite(data, "linearvelocity"),
        _finite(data, "angularvelocity"),
        _finite(data, "time"),
    )


def encode_map(message: Map) -> str:
    """JSON, rounded to three decimals."""
    return json.dumps(
        {
            "id": message.id,
            "line_count": len(message.segments),
            "width": round(message.width_m, 3),
            "height": round(message.height_m, 3),
            "origin": _round3((message.origin.x_m, message.origin.y_m)),
            "data": [_round3((s.start.x_m, s.start.y_m, s.end.x_m, s.end.y_m)) for s in message.segments],
        }
    )


def decode_map(text: str | bytes) -> Map:
    """Raises Malformed on anything that is not of the contract."""
    data = decode_object(text)
    origin = _numbers(data.get("origin"), 2, "origin")
    rows = [_numbers(row, 4, "data row") for row in _list(data, "data")]
    if _whole(data, "line_count") != len(rows):
        raise Malformed(f"line_count is {data['line_count']} but data has {len(rows)} rows")
    segments = tuple(Segment(Point(x1, y1), Point(x2, y2)) for x1, y1, x2, y2 in rows)
    return Map(_whole(data, "id"), _finite(data, "width"), _finite(data, "height"), Point(*origin), segments)


def encode_fiducials(message: Fiducials) -> str:
    """JSON, rounded to three decimals."""
    return json.dumps(
        {
            "fid_count": len(message.fiducials),
            "dict": message.dictionary,
            "frame": message.frame,
            "data": [
                {
                    "fid": f.id,
                    "pose": {"location": _round3(f.location_m), "orientation": _round3(f.orientation_rad)},
                }
                for f in message.fiducials
            ],
        }
    )


def decode_fiducials(text: str | bytes) -> Fiducials:
    """Raises Malformed on anything that is not of the contract."""
    data = decode_object(text)
    found = []
    for row in _list(data, "data"):
        if not isinstance(row, dict) or not isinstance(row.get("pose"), dict):
            raise Malformed("a fiducial must have 'fid' and 'pose'")
        found.append(Fiducial(_text(row, "fid"), _triple(row["pose"], "location"), _triple(row["pose"], "orientation")))
    if _whole(data, "fid_count") != len(found):
        raise Malformed(f"fid_count is {data['fid_count']} but data has {len(found)} rows")
    return Fiducials(tuple(found), _text(data, "frame"), _whole(data, "dict"))


def encode_lidar(lidar: Lidar) -> str:
    """JSON, rounded to three decimals."""
    return json.dumps(
        {
            "max_range": lidar.max_range_m,
            "min_range": lidar.min_range_m,
            "slices": len(lidar.ranges_m),
            "fov": round(lidar.fov_rad, 6),
            "data": _round3(lidar.ranges_m),
        }
    )


def decode_lidar(text: str | bytes) -> Lidar:
    """Raises Malformed on anything that is not of the contract."""
    data = decode_object(text)
    ranges = _numbers(data.get("data"), _whole(data, "slices"), "data")
    return Lidar(_finite(data, "max_range"), _finite(data, "min_range"), _finite(data, "fov"), ranges)


def encode_status(status: Status) -> str:
    """The status as JSON."""
    return json.dumps({"time": status.time, "status": status.status, "cpu": status.cpu, "errors": list(status.errors)})


def decode_status(text: str | bytes) -> Status:
    """Raises Malformed on anything that is not of the contract."""
    data = decode_object(text)
    errors = _list(data, "errors")
    if not all(isinstance(e, str) for e in errors):
        raise Malformed("'errors' must be a list of texts")
    return Status(_text(data, "time"), _text(data, "status"), _text(data, "cpu"), tuple(errors))


def encode_path(path: PlannedPath) -> str:
    """JSON ``{"data": [[x, y], ...]}``, rounded to three decimals."""
    return json.dumps({"data": [_round3((point.x_m, point.y_m)) for point in path.points]})


def decode_path(text: str | bytes) -> PlannedPath:
    """Raises Malformed on anything that is not of the contract."""
    rows = [_numbers(row, 2, "data row") for row in _list(decode_object(text), "data")]
    return PlannedPath(tuple(Point(x_m, y_m) for x_m, y_m in rows))


# ------------------------------------------------------------------ keys
@dataclass(frozen=True, slots=True)
class Keys:
    """The names of the bridge's keys, under a namespace where one robot of several is meant."""

    namespace: str = ""

    def _key(self, name: str) -> str:
        return f"{self.namespace}/{name}" if self.namespace else name

    @property
    def map(self) -> str:
        return self._key("Map")

    @property
    def odom(self) -> str:
        return self._key("Odom")

    @property
    def fiducials(self) -> str:
        return self._key("Fiducials")

    @property
    def lidar(self) -> str:
        return self._key("Lidar")

    @property
    def commands(self) -> str:
        return self._key("Kirby")

    @property
    def queue(self) -> str:
        """The robot's own durable list: a command is here from being taken until it has ended."""
        return self._key("Kirby_Queue")

    @property
    def feedback(self) -> str:
        return self._key("Kirby_Feedback")

    @property
    def feedback_stream(self) -> str:
        return self._key("Kirby_Feedback_Stream")

    @property
    def reset(self) -> str:
        return self._key("Bridge_Reset")

    @property
    def status(self) -> str:
        return self._key("Status")

    @property
    def path(self) -> str:
        """The planned path, while there is one (+)."""
        return self._key("Path")

    @property
    def camera(self) -> str:
        """The camera's picture as JPEG, while `camera_watch` is set (+)."""
        return self._key("Camera")

    @property
    def camera_watch(self) -> str:
        """Set, with an expiry, by whoever looks at the picture (+)."""
        return self._key("Camera_Watch")


MAP_HISTORY = 7
FEEDBACK_HISTORY = 1_000
FEEDBACK_STREAM_HISTORY = 10_000
STATUS_EXPIRY_S = 5


# ------------------------------------------------------------------ strict reading
def decode_object(text: str | bytes, limit_chars: int = MESSAGE_MAX_CHARS) -> dict[str, Any]:
    """A JSON object without NaN or infinities, at most ``limit_chars`` long.

    Raises:
        Malformed: too long, not JSON, or not an object.
    """
    if len(text) > limit_chars:
        raise Malformed(f"message of {len(text)} characters is too long: at most {limit_chars}")

    def refuse(constant: str) -> float:
        raise Malformed(f"{constant} is not a number on this wire")

    try:
        data = json.loads(text, parse_constant=refuse)
    except Malformed:
        raise
    except (ValueError, RecursionError):  # no JSON, no UTF-8, or an integer of too many digits
        raise Malformed("message is not JSON") from None
    if not isinstance(data, dict):
        raise Malformed("message is not a JSON object")
    return data


def _finite(data: Mapping[str, Any], name: str) -> float:
    return _numbers([data.get(name)], 1, name)[0]


def _whole(data: Mapping[str, Any], name: str) -> int:
    value = data.get(name)
    if not isinstance(value, int) or isinstance(value, bool):
        raise Malformed(f"'{name}' must be a whole number")
    return value


def _text(data: Mapping[str, Any], name: str) -> str:
    value = data.get(name)
    if not isinstance(value, str):
        raise Malformed(f"'{name}' must be text")
    return value


def _list(data: Mapping[str, Any], name: str) -> list[Any]:
    value = data.get(name)
    if not isinstance(value, list):
        raise Malformed(f"'{name}' must be a list")
    return value


def _numbers(values: Any, count: int, name: str) -> tuple[float, ...]:
    if not isinstance(values, list) or len(values) != count:
        raise Malformed(f"'{name}' must be {count} numbers")
    for value in values:
        # 1e400 is read as infinity, and an int beyond float's range overflows only later: both are malformed here.
        if not isinstance(value, int | float) or isinstance(value, bool) or not abs(value) < 1e15:
            raise Malformed(f"'{name}' must hold finite numbers")
    return tuple(float(v) for v in values)


def _triple(data: Mapping[str, Any], name: str) -> tuple[float, float, float]:
    x, y, z = _numbers(data.get(name), 3, name)
    return x, y, z
