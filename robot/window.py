"""What people may look in on beside the bridge: the planned path, and the camera's picture while somebody watches.

Nothing here is waited for, kept or repeated: the control loop leaves the newest of each, and a thread of its own
publishes it a few times a second. A picture is encoded only while the key `Camera_Watch` says that somebody looks.
"""

from __future__ import annotations

import threading
from typing import Protocol

import cv2
import redis

from .body import Image
from .geometry import Point
from .messages import Keys, PlannedPath, encode_path

PERIOD_S = 0.25
EXPIRY_S = 5  # a picture or a path that nobody renews is no news any more
JPEG_QUALITY = 70
TIMEOUT_S = 1.0


class Window(Protocol):
    """Where the control loop leaves what may be looked at; must return at once."""

    def show_path(self, points: tuple[Point, ...]) -> None: ...

    def show_image(self, image: Image) -> None: ...


class RedisWindow:
    """A :class:`Window` over Redis, by URL."""

    def __init__(self, url: str, namespace: str = "") -> None:
        self._client = redis.Redis.from_url(url, socket_timeout=TIMEOUT_S, socket_connect_timeout=TIMEOUT_S)
        self._keys = Keys(namespace)
        self._path: tuple[Point, ...] = ()
        self._image: Image | None = None
        self._closed = threading.Event()
        self._thread = threading.Thread(target=self._run, name="window", daemon=True)

    def start(self) -> None:
        self._thread.start()

    def close(self) -> None:
        self._closed.set()
        if self._thread.is_alive():
            self._thread.join(timeout=2 * TIMEOUT_S)
        self._client.close()

    def show_path(self, points: tuple[Point, ...]) -> None:
        self._path = points

    def show_image(self, image: Image) -> None:
        self._image = image

    def _run(self) -> None:
        while not self._closed.wait(PERIOD_S):
            try:
                self._publish()
            except redis.RedisError:
                continue  # the bridge says so; the next round tries again

    def _publish(self) -> None:
        pipe = self._client.pipeline(transaction=False)
        if self._path:
            pipe.set(self._keys.path, encode_path(PlannedPath(self._path)), ex=EXPIRY_S)
        else:
            pipe.delete(self._keys.path)
        pipe.exists(self._keys.camera_watch)
        watched = pipe.execute()[-1]
        image, self._image = (self._image, None) if watched else (None, self._image)
        if image is not None:
            self._client.set(self._keys.camera, as_jpeg(image), ex=EXPIRY_S)


def as_jpeg(image: Image) -> bytes:
    """The picture as JPEG."""
    pixels = cv2.cvtColor(image.pixels, cv2.COLOR_RGB2BGR)
    return bytes(cv2.imencode(".jpg", pixels, [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY])[1])
