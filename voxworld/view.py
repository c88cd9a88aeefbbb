"""VoxWorld: one shared world, any number of people at it. Told by the application; tells it what people do."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Protocol

import rich
import viser
from numpy.typing import NDArray

from dialogue.events import CameraMove, Gesture, GestureKind, Highlight, Pointing, Utterance
from grounding import World
from robot.geometry import Point, Pose

from . import pointing
from .cameras import bounds_of
from .coordinates import to_map
from .front import Address, Front, hidden_host
from .motion import Vector
from .nodes import Scene, Thing, diff
from .panel import OwnPanel, SharedPanel
from .people import NAME_KEY, Person, fit_name
from .scene import Heads, scene_of, to_json
from .shared import Pointed, Shared
from .stage import Stage
from .talk import REMARKS_MAX, Condition, Errand, Remark

FRAME_S = 1 / 25
NAME_PATIENCE_S = 3.0

Said = Utterance | Pointing | Gesture


class Host(Protocol):
    """What the view asks of the application. Called from threads of its own."""

    def deliver(self, event: Said) -> None:
        """Somebody said, pointed or gestured."""

    def stop(self, who: str) -> str:
        """Stop the robot at once, whatever else waits; empty, or why it could not be done."""

    def cancel(self, errand: str, who: str) -> None:
        """Somebody wants this errand cancelled."""

    def rename(self, entity: str, name: str, who: str) -> None:
        """Somebody gave a thing a name."""

    def clock(self) -> float:
        """The time for events, seconds."""


class _Server(viser.ViserServer):
    """viser without its tunnel to another machine: no request leaves this one."""

    def request_share_url(self, verbose: bool = True) -> str | None:
        return None


@contextmanager
def silent() -> Iterator[None]:
    """viser announces its own address and end, which are no news for anybody here."""
    console = rich.get_console()
    loud, console.quiet = console.quiet, True
    try:
        yield
    finally:
        console.quiet = loud


class VoxWorld:
    """The shared world behind one address. Every method may be called from any thread."""

    def __init__(self, host: Host, heads: Heads, address: Address) -> None:
        """``heads``: the VoxML head of each type of thing."""
        self._host, self._heads = host, heads
        self._lock = threading.RLock()
        self._shared = Shared()
        self._scene = Scene()
        self._bounds = bounds_of(())
        self._remarks: tuple[Remark, ...] = ()
        self._image: NDArray[Any] | None = None
        self._people: dict[int, tuple[Person, OwnPanel]] = {}
        self._news = threading.Event()
        self._closed = threading.Event()
        inner = hidden_host()
        with silent():
            self._server = _Server(host=inner, port=0, label="Kirby", verbose=False)
        self._front = Front(address, (inner, self._server.get_port()), self)
        self._stage = Stage(self._server)
        self._panel = SharedPanel(self._server, cancel=self._cancel, rename=self._rename, gesture=self._gesture)
        self._thread = threading.Thread(target=self._run, name="view-stage", daemon=True)

    @property
    def url(self) -> str:
        """The one address to open."""
        return self._front.url

    def start(self) -> None:
        """Open the door.

        Raises:
            OSError: the address is taken or not this machine's.
        """
        self._front.start()
        self._thread.start()
        self._server.on_client_connect(self._arrived)
        self._server.on_client_disconnect(self._left)
        self._server.scene.on_click()(self._clicked)
        self._server.scene.on_click(modifier="alt")(self._pressed_long)
        self._stage.ground.on_drag("left", modifier="shift")(self._dragged)

    def close(self) -> None:
        """Send everybody home."""
        self._closed.set()
        self._news.set()
        if self._thread.is_alive():
            self._thread.join(timeout=2.0)
        self._front.close()
        with silent():
            self._server.stop()

    # ------------------------------------------------------------------ told by the application
    def show_pose(self, pose: Pose) -> None:
        """The robot is here."""
        self._change(lambda shared: shared.with_pose(pose))

    def show_world(self, world: World) -> None:
        """The walls and things that are known."""
        self._change(lambda shared: shared.with_world(world))

    def show_path(self, path: tuple[Point, ...]) -> None:
        """The way that the robot means to drive."""
        self._change(lambda shared: shared.with_path(path))

    def show_meant(self, meant: Highlight) -> None:
        """The referents of the moment."""
        self._change(lambda shared: shared.with_meant(meant))

    def show_pointing(self, mark: Pointing) -> None:
        """Somebody pointed, here or with a hand elsewhere."""
        self._change(lambda shared: shared.with_pointing(mark))

    def show_remark(self, remark: Remark) -> None:
        """A new line of the conversation."""
        with self._lock:
            self._remarks = (*self._remarks, remark)[-REMARKS_MAX:]
            self._panel.show_remarks(self._remarks)

    def show_condition(self, condition: Condition) -> None:
        """How robot and bridge are."""
        with self._lock:
            self._panel.show_condition(condition)

    def show_errands(self, errands: tuple[Errand, ...]) -> None:
        """What is being done and what comes after it."""
        with self._lock:
            self._panel.show_errands(errands)

    def show_image(self, pixels: NDArray[Any] | None) -> None:
        """What the robot's camera sees, shape (height, width, 3), uint8; None: nothing."""
        with self._lock:
            self._image = pixels
            people = list(self._people.values())
        for person, panel in people:
            if person.viewpoint.watching:
                panel.show_image(pixels)

    def move_camera(self, move: CameraMove, who: str | None) -> None:
        """Move the camera of the person who asked; of everybody when it is not known who did."""
        with self._lock:
            people = list(self._people.values())
        named = [(person, panel) for person, panel in people if person.name == who]
        for person, panel in named or people:
            self._move(person, panel, move)

    @property
    def people(self) -> tuple[Person, ...]:
        """Who is here, in the order in which they came."""
        with self._lock:
            return tuple(person for person, _ in self._people.values())

    @property
    def pointed(self) -> tuple[Pointed, ...]:
        """What everybody pointed at last."""
        return self._shared.pointed

    @property
    def watching(self) -> bool:
        """Whether somebody would see the robot's picture."""
        return any(person.viewpoint.watching for person in self.people)

    # ------------------------------------------------------------------ asked by the front
    def stop(self, who: str) -> str:
        return self._host.stop(who)

    def scene_json(self) -> str:
        return to_json(self._scene)

    # ------------------------------------------------------------------ people come, go, point and press
    def _arrived(self, client: viser.ClientHandle) -> None:
        try:
            wanted = client.local_storage.get_item(NAME_KEY, timeout=NAME_PATIENCE_S) or "Guest"
        except (RuntimeError, TimeoutError):
            wanted = "Guest"  # a browser that keeps nothing, or has left already
        with self._lock:
            name = fit_name(wanted, {person.name for person, _ in self._people.values()})
            person = Person(client, name)
            panel = OwnPanel(
                client,
                name,
                say=lambda text: self._host.deliver(Utterance(text, self._host.clock(), speaker=person.name)),
                camera=lambda move: self._move(person, panel, move),
                renamed=lambda text: self._renamed(person, panel, text),
            )
            self._people[client.client_id] = (person, panel)
        client.camera.on_update(person.noticed)
        self._news.set()

    def _left(self, client: viser.ClientHandle) -> None:
        with self._lock:
            person, _ = self._people.pop(client.client_id, (None, None))
        if person is not None:
            self._change(lambda shared: shared.without(person.name))

    def _renamed(self, person: Person, panel: OwnPanel, text: str) -> None:
        with self._lock:
            others = {other.name for other, _ in self._people.values() if other is not person}
            old, person.name = person.name, fit_name(text, others)
            panel.show_name(person.name)
        person.client.local_storage.set_item(NAME_KEY, person.name)
        self._change(lambda shared: shared.without(old))

    def _move(self, person: Person, panel: OwnPanel, move: CameraMove) -> None:
        person.move(move)
        panel.show_image(self._image if person.viewpoint.watching else None)
        self._news.set()

    def _who(self, client_id: int | None) -> str:
        with self._lock:
            entry = None if client_id is None else self._people.get(client_id)
        return "" if entry is None else entry[0].name

    def _point(self, who: str, target: Any) -> None:
        self._host.deliver(Pointing(target, self._host.clock(), spread_m=pointing.SPREAD_M, speaker=who))

    def _clicked(self, event: viser.SceneClickEvent) -> None:
        target = pointing.pointed_at(event.ray_origin, event.ray_direction, self._scene)
        if target is not None:
            self._point(self._who(event.client_id), target)

    def _pressed_long(self, event: viser.SceneClickEvent) -> None:
        """A long press: the page's script makes a click with Alt of it."""
        target = pointing.pointed_at(event.ray_origin, event.ray_direction, self._scene)
        with self._lock:
            entry = self._people.get(event.client_id)
        if target is None or entry is None:
            return
        person, panel = entry

        def go() -> None:
            self._point(person.name, target)
            self._host.deliver(Utterance("go there", self._host.clock(), speaker=person.name))

        mark = Pointing(target, self._host.clock(), speaker=person.name)
        self.show_pointing(mark)
        panel.ask("Go there?", go)

    async def _dragged(self, event: viser.SceneNodeDragEvent[viser.BoxHandle]) -> None:
        """A drag with Shift over the floor shows a direction."""
        if event.phase != "end":
            return
        eye = _vector(event.client.camera.position)
        start = pointing.floor_point(eye, _vector(event.start_position))
        end = pointing.floor_point(eye, _vector(event.end_position))
        ray = None if start is None or end is None else pointing.dragged(start, end)
        if ray is not None:
            self._point(self._who(event.client_id), ray)

    def _gesture(self, client_id: int | None, kind: GestureKind) -> None:
        self._host.deliver(Gesture(kind, self._host.clock(), speaker=self._who(client_id), at_view=True))

    def _cancel(self, client_id: int | None, errand: str) -> None:
        self._host.cancel(errand, self._who(client_id))

    def _rename(self, client_id: int | None, entity: str, name: str) -> None:
        if name.strip():
            self._host.rename(entity, name.strip(), self._who(client_id))

    # ------------------------------------------------------------------ the stage
    def _change(self, change: Callable[[Shared], Shared]) -> None:
        with self._lock:
            self._shared = change(self._shared)
        self._news.set()

    def _run(self) -> None:
        """Show what is new, and move what moves: a frame whenever there is news, and `FRAME_S` after the last."""
        moving, shown_s = False, time.monotonic()
        while not self._closed.is_set():
            self._news.wait(FRAME_S if moving else None)
            self._news.clear()
            now_s = time.monotonic()
            moving = self._frame(now_s - shown_s if moving else FRAME_S)
            shown_s = now_s

    def _frame(self, duration_s: float) -> bool:
        with self._lock:
            shared, people = self._shared, list(self._people.values())
        scene = scene_of(shared, self._heads)
        updates = diff(self._scene, scene)
        self._scene = scene
        self._stage.apply(updates)
        self._stage.frame(duration_s)
        touched = {type(getattr(update, "after", None) or getattr(update, "node", None)) for update in updates}
        if Thing in touched:
            with self._lock:
                self._panel.show_things(tuple(node for node in scene.nodes if isinstance(node, Thing)))
        self._keep_in_view(scene, shared)
        robot = self._stage.robot
        pose = None if robot is None else Pose(robot.position_m[0], robot.position_m[1], robot.yaw_rad)
        gliding = False
        for person, _ in people:
            person.aim(pose, self._bounds)
            gliding = person.glide(duration_s) or gliding
        return gliding or self._stage.moving

    def _keep_in_view(self, scene: Scene, shared: Shared) -> None:
        """Widen what the bird's-eye view holds when something lies outside of it."""
        places = [to_map(node.centre) for node in scene.nodes if isinstance(node, Thing)]
        for segment in shared.walls.segments:
            places += (segment.start, segment.end)
        if shared.robot is not None:
            places.append(shared.robot.point)
        if not all(map(self._bounds.holds, places)):
            self._bounds = bounds_of(tuple(places))


def _vector(values: Any) -> Vector:
    x, y, z = (float(value) for value in values)
    return x, y, z
