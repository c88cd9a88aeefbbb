"""Markers in images, remembered where they stand in the map frame."""

from __future__ import annotations

from collections.abc import Mapping

from .body import CameraModel, Image
from .fiducial_map import FiducialMap
from .fiducials import FiducialDetector, Sighting
from .geometry import Pose
from .messages import Fiducials


class Markers:
    """The robot's memory of fiducials. Marker sides are in metres; ``sizes_m`` are those that differ, by id."""

    def __init__(self, camera: CameraModel, size_m: float, sizes_m: Mapping[int, float] | None = None) -> None:
        self._detector = FiducialDetector(camera, size_m, sizes_m)
        self._map = FiducialMap()

    def find(self, image: Image) -> tuple[Sighting, ...]:
        """The markers in an image, as the robot sees them."""
        return self._detector.detect(image)

    def remember(self, sightings: tuple[Sighting, ...], pose: Pose) -> None:
        """Take in what was found in an image that was taken at ``pose``."""
        self._map.observe(sightings, pose)

    def message(self) -> Fiducials:
        """Every marker so far."""
        return self._map.message()
