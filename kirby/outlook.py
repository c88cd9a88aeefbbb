"""What the view reads beside the link: the planned path and the robot's picture, a few times a second."""

from __future__ import annotations

import io
import threading
from collections.abc import Callable
from typing import Any

import imageio.v3 as imageio
import redis
from numpy.typing import NDArray

from robot.geometry import Point
from robot.messages import Keys, Malformed, decode_path

from .link import connect

PERIOD_S = 0.25
WATCH_EXPIRY_S = 3


class Outlook:
    """Reads in a thread of its own. ``watching`` says whether anybody would see the picture."""

    def __init__(
        self,
        url: str,
        namespace: str,
        *,
        watching: Callable[[], bool],
        show_path: Callable[[tuple[Point, ...]], None],
        show_image: Callable[[NDArray[Any] | None], None],
    ) -> None:
        self._client = connect(url)
        self._keys = Keys(namespace)
        self._watching, self._show_path, self._show_image = watching, show_path, show_image
        self._seen: tuple[bytes | None, bytes | None] = (None, None)
        self._closed = threading.Event()
        self._thread = threading.Thread(target=self._run, name="outlook", daemon=True)

    def start(self) -> None:
        self._thread.start()

    def close(self) -> None:
        self._closed.set()
        if self._thread.is_alive():
            self._thread.join(timeout=2.0)
        self._client.close()

    def _run(self) -> None:
        while not self._closed.wait(PERIOD_S):
            try:
                self._look()
            except redis.RedisError:
                continue  # the link says so; the next round tries again

    def _look(self) -> None:
        pipe = self._client.pipeline(transaction=False)
        pipe.get(self._keys.path)
        pipe.get(self._keys.camera)
        if self._watching():
            pipe.set(self._keys.camera_watch, "1", ex=WATCH_EXPIRY_S)
        path, picture, *_ = pipe.execute()
        known_path, known_picture = self._seen
        self._seen = (path, picture)
        if path != known_path:
            self._show_path(_points(path))
        if picture != known_picture:
            self._show_image(_pixels(picture))


def _points(text: bytes | None) -> tuple[Point, ...]:
    """The path; none when it cannot be read, for a wrong line is worse than no line."""
    try:
        return () if text is None else decode_path(text).points
    except Malformed:
        return ()


def _pixels(picture: bytes | None) -> NDArray[Any] | None:
    """Shape (height, width, 3); None when there is no picture in it."""
    if picture is None:
        return None
    try:
        return imageio.imread(io.BytesIO(picture), extension=".jpg")
    except (OSError, ValueError):
        return None
