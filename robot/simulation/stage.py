"""Builds a scene in the physics engine: floor, walls, objects, and the markers on them. All of it stands fixed."""

from __future__ import annotations

import math
from pathlib import Path
from tempfile import TemporaryDirectory

import cv2
import numpy as np

from voxml.scene import MarkerPose, Scene, SceneObject, Wall

from .engine import FLOOR_GROUP, ROBOT_GROUP, pybullet

DICTIONARY = cv2.aruco.DICT_5X5_1000
_MODULES = 7  # 5 by 5 bits and the black border
_MODULE_PX = 16
_PAPER_GAP_M = 0.002  # in front of the side it is stuck to, so that the two surfaces do not fight in the depth buffer

_WALL_COLOUR = (0.80, 0.80, 0.76)
_PLAIN = (0.72, 0.58, 0.42)
_COLOURS = {
    "red": (0.80, 0.10, 0.10),
    "orange": (0.90, 0.45, 0.08),
    "yellow": (0.90, 0.80, 0.12),
    "green": (0.12, 0.58, 0.20),
    "blue": (0.12, 0.25, 0.75),
    "purple": (0.50, 0.20, 0.62),
    "pink": (0.92, 0.55, 0.68),
    "brown": (0.42, 0.27, 0.14),
    "black": (0.10, 0.10, 0.10),
    "gray": (0.50, 0.50, 0.50),
    "white": (0.95, 0.95, 0.95),
}


def build_stage(scene: Scene, client: int) -> dict[int, str]:
    """Put the scene into the engine; returns the names of what can be touched, by the engine's body id.

    Walls are called ``wall 0``, ``wall 1`` ... in the order of the file; objects by their ids. The floor is not listed.
    """
    _lay_floor(client)
    names = {_stand_wall(wall, client): f"wall {index}" for index, wall in enumerate(scene.walls)}
    names |= {_stand_object(thing, client): thing.id for thing in scene.objects}
    _stick_markers(scene, client)
    return names


def _lay_floor(client: int) -> None:
    ground = pybullet.createCollisionShape(pybullet.GEOM_PLANE, physicsClientId=client)
    floor = pybullet.createMultiBody(0, ground, physicsClientId=client)
    pybullet.changeDynamics(floor, -1, lateralFriction=1.0, physicsClientId=client)
    pybullet.setCollisionFilterGroupMask(floor, -1, FLOOR_GROUP, ROBOT_GROUP, physicsClientId=client)
    pybullet.changeVisualShape(floor, -1, rgbaColor=[0, 0, 0, 0], physicsClientId=client)  # the camera paints it


def _stand_wall(wall: Wall, client: int) -> int:
    centre = ((wall.x1_m + wall.x2_m) / 2, (wall.y1_m + wall.y2_m) / 2, wall.height_m / 2)
    # Walls that meet at a corner overlap there, so that no beam slips through.
    half = ((wall.length_m + wall.thickness_m) / 2, wall.thickness_m / 2, wall.height_m / 2)
    return _box(centre, half, wall.direction_rad, _WALL_COLOUR, client)


def _stand_object(thing: SceneObject, client: int) -> int:
    length_m, width_m, height_m = thing.size_m
    colour = next((_COLOURS[name] for name in thing.attributes if name in _COLOURS), _PLAIN)
    centre, half = (thing.x_m, thing.y_m, height_m / 2), (length_m / 2, width_m / 2, height_m / 2)
    return _box(centre, half, thing.yaw_rad, colour, client)


def _box(
    centre: tuple[float, float, float],
    half: tuple[float, float, float],
    yaw_rad: float,
    colour: tuple[float, float, float],
    client: int,
) -> int:
    solid = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=half, physicsClientId=client)
    visible = pybullet.createVisualShape(
        pybullet.GEOM_BOX, halfExtents=half, rgbaColor=[*colour, 1], specularColor=[0, 0, 0], physicsClientId=client
    )
    turned = pybullet.getQuaternionFromEuler([0, 0, yaw_rad])
    return int(pybullet.createMultiBody(0, solid, visible, centre, turned, physicsClientId=client))


def _stick_markers(scene: Scene, client: int) -> None:
    with TemporaryDirectory(prefix="kirby-markers-") as folder:
        for thing in scene.objects:
            if thing.fiducial is not None and thing.marker is not None:
                paper = _print_marker(thing.fiducial.id, Path(folder), client)
                _stick(paper, thing.marker, scene.marker_size_m, client)


def _print_marker(id: int, folder: Path, client: int) -> int:
    """The engine's texture of a marker with its white margin, one module wide."""
    side_px = _MODULES * _MODULE_PX
    marker = cv2.aruco.generateImageMarker(cv2.aruco.getPredefinedDictionary(DICTIONARY), id, side_px)
    paper = np.pad(marker, _MODULE_PX, constant_values=255)
    path = folder / f"{id}.png"
    cv2.imwrite(str(path), np.repeat(paper[:, :, np.newaxis], 3, axis=2))
    return int(pybullet.loadTexture(str(path), physicsClientId=client))


def _stick(texture: int, marker: MarkerPose, size_m: float, client: int) -> None:
    half = size_m / 2 * (_MODULES + 2) / _MODULES
    shape = pybullet.createVisualShape(
        pybullet.GEOM_MESH,
        # Looking along +x, with the picture's left edge at the viewer's left.
        vertices=[[0, -half, half], [0, half, half], [0, half, -half], [0, -half, -half]],
        uvs=[[0, 1], [1, 1], [1, 0], [0, 0]],  # the engine counts v upwards
        normals=[[1, 0, 0]] * 4,
        indices=[0, 2, 1, 0, 3, 2],
        rgbaColor=[1, 1, 1, 1],
        specularColor=[0, 0, 0],
        physicsClientId=client,
    )
    place = [
        marker.x_m + _PAPER_GAP_M * math.cos(marker.yaw_rad),
        marker.y_m + _PAPER_GAP_M * math.sin(marker.yaw_rad),
        marker.z_m,
    ]
    turned = pybullet.getQuaternionFromEuler([0, 0, marker.yaw_rad])
    quad = pybullet.createMultiBody(0, -1, shape, place, turned, physicsClientId=client)
    pybullet.changeVisualShape(quad, -1, textureUniqueId=texture, physicsClientId=client)
