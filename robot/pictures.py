"""Pictures that were asked for, as PNG files."""

from __future__ import annotations

import logging
from pathlib import Path

import cv2

from .body import Image

PICTURES_MAX = 1_000  # in one folder: whoever may push commands shall not fill the disk

log = logging.getLogger(__name__)


def save_picture(image: Image, folder: Path) -> Path | None:
    """Save as the next free ``picture-NNNN.png``; None when it cannot be."""
    written, encoded = cv2.imencode(".png", cv2.cvtColor(image.pixels, cv2.COLOR_RGB2BGR))
    if not written:
        return None
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        for number in range(1, PICTURES_MAX + 1):
            path = folder / f"picture-{number:04}.png"
            if not path.exists():
                path.write_bytes(encoded.tobytes())
                return path
    except OSError as error:
        log.warning("the picture cannot be saved: %s", error)
    return None
