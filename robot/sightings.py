"""Markers in images, remembered where they stand in the map frame."""

from __future__ import annotations

from collections.abc import Mapping

from .body import CameraModel, Image
from .fiducial_map import FiducialMap
from .fiducials import FiducialDetector
from .geometry import Pose
from .messages import Fiducials


class Markers:
    """The robot's memory of fiducials. Marker sides are in metres; ``sizes_m`` are those that differ, by id."""

    def __init__(self, camera: CameraModel, size_m: float, sizes_m: Mapping[int, float] | None = None) -> None:
        self._detector = FiducialDetector(camera, size_m, sizes_m)
        self._map = FiducialMap()

    def see(self, image: Image, pose: Pose) -> None:
        """Take in an image that was taken at ``pose``."""
        self._map.observe(self._detector.detect(image), pose)

    def message(self) -> Fiducials:
        """Every marker so far."""
        return self._map.message()
