"""The shared world in numbers: from a pose to the browsers, from a click to the highlight, and what it costs.

The world has 500 walls and 100 fiducials, and five browsers look at it; they are stood in for by sockets that speak
viser's protocol from a process of their own, so that what is measured ends where the browser's own work begins. Beside
it, a bare viser server that moves one node measures what the road itself costs, in the same run.

Run as ``kirby bench view [--json]``.
"""

from __future__ import annotations

import asyncio
import multiprocessing
import statistics
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing.connection import Connection
from typing import Any

import aiohttp
import msgspec
import numpy as np
import psutil
import viser
import zstandard

from dialogue.events import Gesture, Highlight, PointedObject, Pointing, Utterance
from grounding import Entities, Entity, World
from robot.geometry import Point, Pose, Segment
from voxworld.front import Address
from voxworld.view import VoxWorld, silent

WALLS, FIDUCIALS, CLIENTS = 500, 100, 5
POSES = 60
SETTLE_S = 0.7  # what is shown has arrived where it should be, so that the next step is known to be the next pose's
STEP_M = 0.1
RATE_HZ, DRIVE_S, SPEED_MPS = 20, 15.0, 0.26
CLICKS = 60
BARE_NAME = "/bare"
START_TIMEOUT_S = 60.0


# ------------------------------------------------------------------ browsers
@dataclass(frozen=True, slots=True)
class Arrival:
    """Something reached a browser: when (on the machine's monotonic clock), of which node, and what."""

    time_s: float
    node: str
    value: float


def _browsers(url: str, count: int, pipe: Connection) -> None:
    """A process of ``count`` browsers; tells what arrived, and clicks when it is told a ray."""
    asyncio.run(_all_browsers(url, count, pipe))


async def _all_browsers(url: str, count: int, pipe: Connection) -> None:
    arrivals: list[list[Arrival]] = [[] for _ in range(count)]
    async with aiohttp.ClientSession() as session:
        sockets = [
            await session.ws_connect(url, protocols=(f"viser-v{viser.__version__}",), max_msg_size=0)
            for _ in range(count)
        ]
        readers = [asyncio.create_task(_read(socket, seen)) for socket, seen in zip(sockets, arrivals, strict=True)]
        for socket in sockets:
            await socket.send_bytes(msgspec.msgpack.encode(_CAMERA))
        pipe.send("ready")
        while True:
            order = await asyncio.to_thread(pipe.recv)
            if order == "end":
                break
            if order == "tell":
                pipe.send([list(seen) for seen in arrivals])
                for seen in arrivals:
                    seen.clear()
            else:
                origin, direction = order
                click = _CLICK | {"ray_origin": origin, "ray_direction": direction}
                await sockets[0].send_bytes(msgspec.msgpack.encode(click))
        for reader in readers:
            reader.cancel()


_CAMERA: dict[str, Any] = {
    "type": "ViewerCameraMessage",
    "wxyz": (1.0, 0.0, 0.0, 0.0),
    "position": (0.0, 0.0, 10.0),
    "fov": 1.0,
    "near": 0.01,
    "far": 1000.0,
    "image_height": 800,
    "image_width": 1200,
    "look_at": (0.0, 0.0, 0.0),
    "up_direction": (0.0, 0.0, 1.0),
}
_CLICK: dict[str, Any] = {
    "type": "ScenePointerMessage",
    "event_type": "click",
    "screen_pos": ((0.5, 0.5),),
    "modifier": None,
}


async def _read(socket: aiohttp.ClientWebSocketResponse, seen: list[Arrival]) -> None:
    """A frame is 8 bytes of length unpacked, 8 of length packed, then msgpack under zstandard (viser 1.1)."""
    unpack = zstandard.ZstdDecompressor()
    async for frame in socket:
        now_s = time.monotonic()
        size, packed = (int.from_bytes(frame.data[at : at + 8], "little") for at in (0, 8))
        content = msgspec.msgpack.decode(unpack.decompress(frame.data[16 : 16 + packed], max_output_size=size))
        for message in content["messages"]:
            if message["type"] == "SetPositionMessage" and message["name"] in ("/robot", BARE_NAME):
                seen.append(Arrival(now_s, message["name"], float(message["position"][0])))
            elif message["type"] == "SetSceneNodeVisibilityMessage" and message["name"].endswith("/halo"):
                seen.append(Arrival(now_s, message["name"], float(message["visible"])))


@dataclass(frozen=True, slots=True)
class Audience:
    """The browsers' process."""

    pipe: Connection

    def told(self) -> list[list[Arrival]]:
        """What arrived at each browser since the last time."""
        self.pipe.send("tell")
        answer: list[list[Arrival]] = self.pipe.recv()
        return answer


@contextmanager
def _audience(url: str, count: int) -> Iterator[Audience]:
    context = multiprocessing.get_context("spawn")
    here, there = context.Pipe()
    process = context.Process(target=_browsers, args=(url, count, there), daemon=True)
    process.start()
    if not here.poll(START_TIMEOUT_S):
        raise TimeoutError("the browsers did not come up")
    here.recv()
    try:
        yield Audience(here)
    finally:
        here.send("end")
        process.join(timeout=5)
        process.kill()


# ------------------------------------------------------------------ the world
class _Host:
    """Answers a pointing at a thing as the dialogue does: what was pointed at is lit up."""

    def __init__(self) -> None:
        self.world: VoxWorld | None = None

    def deliver(self, event: Utterance | Pointing | Gesture) -> None:
        if self.world is not None and isinstance(event, Pointing) and isinstance(event.target, PointedObject):
            self.world.show_meant(Highlight((event.target.id,)))

    def stop(self, who: str) -> str:
        return ""

    def cancel(self, errand: str, who: str) -> None:
        """Nobody cancels here."""

    def rename(self, entity: str, name: str, who: str) -> None:
        """Nobody renames here."""

    def clock(self) -> float:
        return time.monotonic()


def large_world() -> World:
    """500 walls around cells of 2 m, and 100 fiducials in rows of ten."""
    walls = []
    for number in range(WALLS):
        row, column = divmod(number // 2, 16)
        corner = Point(2.0 * column, 2.0 * row)
        end = Point(corner.x_m + 1.6, corner.y_m) if number % 2 else Point(corner.x_m, corner.y_m + 1.6)
        walls.append(Segment(corner, end))
    things = tuple(
        Entity(str(n), "fiducial", Pose(1.0 + 3.0 * (n % 10), 1.0 + 3.0 * (n // 10), 0.0), fiducial_id=str(n))
        for n in range(FIDUCIALS)
    )
    return World(entities=Entities(things), walls=tuple(walls))


@contextmanager
def _voxworld() -> Iterator[VoxWorld]:
    host = _Host()
    world = VoxWorld(host, {}, Address(port=0))
    host.world = world
    world.start()
    world.show_world(large_world())
    world.show_pose(Pose(0.0, 0.0, 0.0))
    try:
        yield world
    finally:
        world.close()


# ------------------------------------------------------------------ figures
def run(poses: int = POSES, clicks: int = CLICKS, drive_s: float = DRIVE_S) -> dict[str, float]:
    """Milliseconds at the median and the 99th percentile, ratios to the bare road, and shares of a core."""
    bare_ms = _bare_ms(poses)
    with _voxworld() as world, _audience(world.url, CLIENTS) as audience:
        _wait_for(lambda: len(world.people) == CLIENTS)
        time.sleep(3.0)  # walls grow, cameras glide
        moved_ms = _moved_ms(world.show_pose, audience, poses)
        lit_ms = _lit_ms(audience, clicks)
        driving, resting = _core_share(world.show_pose, drive_s), _core_share(lambda _: None, drive_s / 3)
    return {
        "walls": WALLS,
        "fiducials": FIDUCIALS,
        "clients": CLIENTS,
        "pose_to_browser_median_ms": round(statistics.median(moved_ms), 2),
        "pose_to_browser_p99_ms": round(_p99(moved_ms), 2),
        "bare_pose_to_browser_median_ms": round(statistics.median(bare_ms), 2),
        "bare_pose_to_browser_p99_ms": round(_p99(bare_ms), 2),
        "pose_to_browser_ratio": round(statistics.median(moved_ms) / statistics.median(bare_ms), 2),
        "click_to_highlight_median_ms": round(statistics.median(lit_ms), 2),
        "click_to_highlight_p99_ms": round(_p99(lit_ms), 2),
        "core_share_driving_at_20_hz": round(driving, 3),
        "core_share_at_rest": round(resting, 3),
    }


def _moved_ms(show: Callable[[Pose], None], audience: Audience, poses: int, node: str = "/robot") -> list[float]:
    """Milliseconds from each pose to the first step towards it at each browser."""
    audience.told()
    delays_ms = []
    for number in range(poses):
        sent_s = time.monotonic()
        show(Pose(STEP_M * (number % 2 + 1), 0.0, 0.0))
        time.sleep(SETTLE_S)
        for seen in audience.told():
            steps = [arrival for arrival in seen if arrival.node == node]
            delays_ms += [(arrival.time_s - sent_s) * 1000 for arrival in steps[:1]]
    return delays_ms


def _core_share(show: Callable[[Pose], None], duration_s: float) -> float:
    """The share of a core used while the robot drives along at 20 poses a second."""
    process = psutil.Process()
    start_s, before = time.monotonic(), process.cpu_times()
    for number in range(int(duration_s * RATE_HZ)):
        time.sleep(max(0.0, start_s + number / RATE_HZ - time.monotonic()))
        show(Pose(SPEED_MPS * number / RATE_HZ, 0.5, 0.0))
    after, passed_s = process.cpu_times(), time.monotonic() - start_s
    return float(after.user + after.system - before.user - before.system) / passed_s


def _lit_ms(audience: Audience, clicks: int) -> list[float]:
    """Milliseconds from a browser's click on a thing to its highlight there."""
    audience.told()
    delays_ms = []
    for number in range(clicks):
        at = (0.93 + 3.0 * (number % 10), 1.0 + 3.0 * (number // 10 % 10))
        sent_s = time.monotonic()
        audience.pipe.send(((*at, 8.0), (0.0, 0.0, -1.0)))
        time.sleep(0.25)
        name = f"/things/thing-{number % FIDUCIALS}/halo"
        lit = [a for a in audience.told()[0] if a.node == name and a.value == 1.0]
        if lit:
            delays_ms.append((lit[0].time_s - sent_s) * 1000)
    return delays_ms


def _bare_ms(poses: int) -> list[float]:
    """The same poses on a viser server with nothing else on it, to as many browsers."""
    with silent():
        server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    node = server.scene.add_frame(BARE_NAME)
    url = f"http://127.0.0.1:{server.get_port()}/"

    def show(pose: Pose) -> None:
        node.position = np.array((pose.x_m, pose.y_m, 0.0))
        server.flush()

    try:
        with _audience(url, CLIENTS) as audience:
            _wait_for(lambda: len(server.get_clients()) == CLIENTS)
            return _moved_ms(show, audience, poses, BARE_NAME)
    finally:
        with silent():
            server.stop()


def _p99(values: list[float]) -> float:
    return float(np.percentile(values, 99))


def _wait_for(holds: Callable[[], bool]) -> None:
    poll = threading.Event()
    end_s = time.monotonic() + START_TIMEOUT_S
    while not holds():
        if time.monotonic() > end_s:
            raise TimeoutError("the browsers were not seen")
        poll.wait(0.05)
