"""The control loop: sense, map, decide, drive, publish, at 20 Hz on the body's own clock.

`Robot` knows no wall clock but for signs of life and no Redis: it talks through a :class:`robot.port.Port`. Pacing
against the wall clock is in :mod:`robot.pacing`.
"""

from __future__ import annotations

import logging
import math
import time
from collections.abc import Callable, Iterable
from dataclasses import replace
from pathlib import Path

from .body import Body, Image, Scan
from .entries import read_entry, read_orphan
from .geometry import Point, Pose
from .localisation import Localiser
from .mapping import Mapper
from .messages import Feedback, Malformed
from .navigation import Goal, Navigator, Phase, Rotate, State
from .pictures import save_picture
from .port import Boot, Entry, News, Port
from .publishing import Publisher
from .queue import (
    IDLE,
    Arrived,
    Begin,
    Effect,
    Estimated,
    Event,
    Failed,
    Forget,
    Halt,
    Here,
    Mode,
    Photograph,
    PictureFailed,
    PictureTaken,
    QueueState,
    Reset,
    Resumed,
    Started,
    Tell,
    handle,
)
from .record import Record, record_from_json, record_to_json
from .sightings import Markers
from .window import Window

PERIOD_S = 0.05
WATCHDOG_S = 1.0  # wheels stop when the port has been silent for so long
ROUNDS_MAX = 4  # exchanges in one go, while commands keep coming
RECORD_EVERY = 5  # periods, while moving

log = logging.getLogger(__name__)


def read_boot(boot: Boot) -> Record | None:
    """The record that was left, if there is one to go on from: an unreadable one is as good as none."""
    if boot.record is None:
        return None
    try:
        record = record_from_json(boot.record)
    except Malformed as error:
        log.warning("%s", error)
        return None
    queue = record.queue
    return record if boot.unhandled or queue.goals or queue.pictures or queue.mode is not Mode.READY else None


def orphans(boot: Boot, record: Record | None) -> tuple[Entry, ...]:
    """The entries that the record should know of and does not, because somebody has changed it by hand."""
    queue = IDLE if record is None else record.queue
    known = {goal.entry for goal in (*queue.goals, *queue.pictures)}
    return tuple(entry for entry in boot.left if entry.number not in known)


class Robot:
    """One robot: a body, and a port through which it is commanded.

    Args:
        body: stands at the pose of the record that was left, if one was.
        port: opened already if ``boot`` is given.
        markers: finds fiducials in images; without it none are reported.
        pictures: folder for ``take picture``; without it pictures fail.
        window: is left the planned path and every image, for people to look at.
        clock: the wall's, in seconds, for signs of life alone.
    """

    def __init__(
        self,
        body: Body,
        port: Port,
        *,
        boot: Boot | None = None,
        markers: Markers | None = None,
        pictures: Path | None = None,
        window: Window | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.body = body
        self.port = port
        self.mapper = Mapper()
        self._markers = markers
        self._pictures = pictures
        self._window = window
        self._navigator = Navigator(body.limits)
        boot = boot or port.open()
        record = read_boot(boot)
        self._eye = Pose(*body.camera.mount_m[:2], 0.0)
        self._localiser = Localiser(self.mapper, body.odometry(), None if record is None else record.pose)
        self._queue = IDLE if record is None else record.queue
        self._target: Goal | None = None
        self._phase: Phase | None = None
        self._photos: dict[int, float] = {}  # entry -> body time from which on a picture will do
        self._scan: Scan | None = None
        self._held = False
        self._news = News()
        self._publisher = Publisher(clock)
        self._ticks = 0
        for entry in orphans(boot, record):
            self._feed(read_orphan(entry))
        resumed = record is not None or boot.unhandled
        event = Resumed(boot.admitted, boot.unhandled) if resumed else Started()
        self._feed(event, turned_rad=0.0 if record is None else record.turned_rad)

    # ------------------------------------------------------------------ for those who run it
    @property
    def queue(self) -> QueueState:
        return self._queue

    @property
    def pose(self) -> Pose:
        """Where the robot believes it is, map frame."""
        return self._localiser.pose

    @property
    def busy(self) -> bool:
        """Whether simulated time must pass for anything to come of what was asked."""
        return self._queue.mode is Mode.MOVING or bool(self._photos)

    @property
    def held(self) -> bool:
        """Whether the wheels must stand although there is something to do."""
        return self._held

    def tick(self) -> None:
        """One control period, from commands to the next senses."""
        self.attend()
        self.advance()

    def attend(self) -> None:
        """Publish, and act on what has come in; ``stop`` has the wheels at zero when this returns.

        What was done about a command is durable before anything moves for it.
        """
        self._publish()
        for _ in range(ROUNDS_MAX):
            incoming = self.port.exchange(self._take_news())
            self._held = incoming.held or self.port.silent_s > WATCHDOG_S
            if incoming.reset:
                self._publisher.repeat()
                self._feed(Reset())
                self._publish()
            for entry in incoming.entries:
                self._feed(read_entry(entry))
            if not incoming.entries and not incoming.reset:
                break
        else:
            self._held = True  # more than can be read in one go: the wheels wait for the rest
        if self._held:
            self.body.drive(0.0, 0.0)

    def advance(self) -> None:
        """One control period without the port."""
        self._drive()
        self.body.step(PERIOD_S)
        self._sense()
        self._ticks += 1
        if self._queue.mode is Mode.MOVING and self._ticks % RECORD_EVERY == 0:
            self._write_down()

    def survey(self, views: Iterable[tuple[Pose, Scan]]) -> None:
        """Learn the map from scans of which it is known where they were taken (map frame), before the first drive."""
        self._localiser.survey(views)

    def settle(self, duration_s: float) -> None:
        """Let time pass without listening, so that the robot comes to rest and has looked around."""
        for _ in range(math.ceil(duration_s / PERIOD_S)):
            self.advance()

    def rest(self) -> None:
        """Wheels to zero, and the last news out; what was being done stays in the record for the next time."""
        self.body.drive(0.0, 0.0)
        self._write_down()
        self._publish()
        self.port.exchange(self._take_news())

    def run_until_idle(self, limit_s: float = 600.0) -> None:
        """Tick until everything that was asked is done (or paused), at most ``limit_s`` of the body's time."""
        end_s = self.body.time_s + limit_s
        self.attend()
        while self.busy and self.body.time_s < end_s:
            self.tick()
            if not self.busy:
                self.attend()

    # ------------------------------------------------------------------ decide and drive
    def _drive(self) -> None:
        if self._target is None or self._held:
            self.body.drive(0.0, 0.0)
            self._show_path(())
            return
        drive = self._navigator.step(self.pose, self._scan, self.mapper.grid, self.body.time_s)
        self.body.drive(drive.linear_mps, drive.angular_radps)
        self._show_path(drive.path)
        turned = isinstance(self._target, Rotate) and drive.phase is not self._phase
        self._phase = drive.phase
        if turned and drive.phase is Phase.VERIFY_ROTATION:
            self._feed(Estimated())
        if drive.state is not State.ACTIVE:
            self._target = None
            self._feed(Arrived(drive.moved_to) if drive.state is State.ARRIVED else Failed())

    def _show_path(self, path: tuple[Point, ...]) -> None:
        if self._window is not None:
            self._window.show_path(path)

    def _feed(self, event: Event, turned_rad: float | None = None) -> None:
        here = Here(self.pose, self._turned_rad() if turned_rad is None else turned_rad)
        self._queue, effects = handle(self._queue, event, here)
        for effect in effects:
            self._carry_out(effect)
        asked = {goal.entry for goal in (*self._queue.pictures, *self._queue.goals[:1])}
        self._photos = {entry: time_s for entry, time_s in self._photos.items() if entry in asked}
        self._write_down()

    def _carry_out(self, effect: Effect) -> None:
        match effect:
            case Tell(feedback):
                self._tell(feedback)
            case Begin(target):
                self._target, self._phase = target, None
                self._navigator.start(target, self.pose, self.body.time_s)
            case Halt():
                self._target = None
                self.body.drive(0.0, 0.0)
            case Photograph(entry):
                self._photos[entry] = self.body.time_s
            case Forget(entry):
                self._news = replace(self._news, ended=(*self._news.ended, entry))

    def _turned_rad(self) -> float:
        left = self._navigator.remaining
        if not isinstance(self._target, Rotate) or not isinstance(left, Rotate):
            return 0.0
        return self._target.angle_rad - left.angle_rad

    # ------------------------------------------------------------------ sense
    def _sense(self) -> None:
        self._localiser.move(self.body.odometry())
        scan = self.body.scan()
        if scan is not None:
            self._scan = scan
            self._localiser.see(scan)
        image = self.body.image()
        if image is not None:
            self._look(image)

    def _look(self, image: Image) -> None:
        if self._window is not None:
            self._window.show_image(image)
        if self._markers is not None:
            sightings = self._markers.find(image)
            self._localiser.see_markers(image.time_s, sightings, self._eye)
            self._markers.remember(sightings, self._localiser.pose_at(image.time_s))
        for entry in [entry for entry, since_s in self._photos.items() if image.time_s >= since_s]:
            path = None if self._pictures is None else save_picture(image, self._pictures)
            self._feed(PictureFailed(entry) if path is None else PictureTaken(entry, str(path)))

    # ------------------------------------------------------------------ publish
    def _publish(self) -> None:
        news = self._publisher.add(self._news, self.pose, self.body.odometry())
        fiducials = None if self._markers is None else self._markers.message()
        news = self._publisher.add_seen(news, self._scan, self.mapper, fiducials)
        errors = ("wheels held: Redis is silent or swamped",) if self._held else ()
        self._news = self._publisher.add_status(news, self._queue.mode.value, errors)

    def _write_down(self) -> None:
        self._news = replace(self._news, record=record_to_json(Record(self._queue, self.pose, self._turned_rad())))

    def _tell(self, feedback: Feedback) -> None:
        told = replace(feedback, time_s=self.body.time_s)
        self._news = replace(self._news, feedback=(*self._news.feedback, told))

    def _take_news(self) -> News:
        news, self._news = self._news, News()
        return news
