"""A scene: walls and voxeme instances on a flat floor, and where the robot starts.

One file says what stands in a world; the simulator builds bodies from it, grounding learns from it what each fiducial
stands for, and the corpora name it. The frame is the map's (ROS REP-103: x forward, y left, yaw counter-clockwise),
lengths are metres; files carry degrees, the types radians.

The file is YAML::

    name: hall                      # required, as are seed, robot and walls
    seed: 7                         # of all the noise in a simulated run
    robot: {x: 0.0, y: 0.0, yaw_deg: 0}
    marker_size: 0.10               # side of every marker's black square (default 0.10, as in the paper)
    walls:
      - [0.0, 1.0, 4.0, 1.0]        # x1, y1, x2, y2
      - {line: [4.0, 1.0, 4.0, -1.0], height: 0.30, thickness: 0.05}
    objects:
      - id: red_block
        type: block                 # a predicate of the lexicon
        attributes: [red]           # optional, as are names, yaw_deg and fiducial
        names: [rosie]
        x: 2.0
        y: 0.0
        yaw_deg: 180
        size: [0.2, 0.3, 0.4]       # along the object's own x and y, and up
        fiducial: {id: 1, height: 0.2, face: front}   # the marker's centre, on the side that faces the object's +x
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

import yaml

from ._fields import (
    FieldError,
    StrictLoader,
    check_fields,
    check_unique,
    read_angle,
    read_coordinate,
    read_each,
    read_length,
    read_row,
    read_text,
    read_whole,
)
from .errors import KirbyError

FIDUCIAL_ID_MAX = 999  # ArUco 5x5_1000, the dictionary on the wire
MARKER_SIZE_M = 0.10  # "approximately 10 x 10cm" (Krajovic et al., section 3.2.1)
WALL_HEIGHT_M = 0.60
WALL_THICKNESS_M = 0.05


class SceneError(KirbyError):
    """A world file that cannot be used; ``str()`` of it is one line naming the file, the field and the remedy."""


class Face(Enum):
    """A side of an object, in the object's own frame: its front looks along its +x, its left along its +y."""

    FRONT = "front"
    LEFT = "left"
    BACK = "back"
    RIGHT = "right"

    @property
    def yaw_rad(self) -> float:
        """The way the side looks, counter-clockwise from the object's +x."""
        return {Face.FRONT: 0.0, Face.LEFT: math.pi / 2, Face.BACK: math.pi, Face.RIGHT: -math.pi / 2}[self]


@dataclass(frozen=True, slots=True)
class Start:
    """Where the robot stands at first, map frame."""

    x_m: float
    y_m: float
    yaw_rad: float


@dataclass(frozen=True, slots=True)
class Wall:
    """An upright slab on the floor; the line runs along the middle of its thickness."""

    x1_m: float
    y1_m: float
    x2_m: float
    y2_m: float
    height_m: float = WALL_HEIGHT_M
    thickness_m: float = WALL_THICKNESS_M

    @property
    def length_m(self) -> float:
        return math.hypot(self.x2_m - self.x1_m, self.y2_m - self.y1_m)

    @property
    def direction_rad(self) -> float:
        """From the first end to the second."""
        return math.atan2(self.y2_m - self.y1_m, self.x2_m - self.x1_m)


@dataclass(frozen=True, slots=True)
class FiducialMount:
    """A marker on a side of an object, centred across it; ``height_m`` is its centre's above the floor."""

    id: int
    height_m: float
    face: Face


@dataclass(frozen=True, slots=True)
class MarkerPose:
    """Where a marker's centre is, map frame; ``yaw_rad`` is the way its printed face looks."""

    x_m: float
    y_m: float
    z_m: float
    yaw_rad: float


@dataclass(frozen=True, slots=True)
class SceneObject:
    """A voxeme instance: a box of ``size_m`` (length along its own x, width along its y, height) standing on the floor.

    ``type`` is a VoxML predicate such as ``block``; ``attributes`` are predicates such as ``red``.
    """

    id: str
    type: str
    x_m: float
    y_m: float
    yaw_rad: float
    size_m: tuple[float, float, float]
    attributes: tuple[str, ...] = ()
    names: tuple[str, ...] = ()
    fiducial: FiducialMount | None = None

    @property
    def marker(self) -> MarkerPose | None:
        """Where its marker is, if it has one."""
        if self.fiducial is None:
            return None
        length_m, width_m, _ = self.size_m
        along_x = self.fiducial.face in (Face.FRONT, Face.BACK)
        yaw_rad = math.remainder(self.yaw_rad + self.fiducial.face.yaw_rad, math.tau)
        reach_m = (length_m if along_x else width_m) / 2
        return MarkerPose(
            self.x_m + reach_m * math.cos(yaw_rad),
            self.y_m + reach_m * math.sin(yaw_rad),
            self.fiducial.height_m,
            yaw_rad,
        )


@dataclass(frozen=True, slots=True)
class Scene:
    """A whole world. Object ids and fiducial ids are unique in it."""

    name: str
    seed: int
    start: Start
    walls: tuple[Wall, ...]
    objects: tuple[SceneObject, ...] = ()
    marker_size_m: float = MARKER_SIZE_M

    def find(self, id: str) -> SceneObject | None:
        """The object with this id."""
        return next((thing for thing in self.objects if thing.id == id), None)

    def with_fiducial(self, id: int) -> SceneObject | None:
        """The object that carries this fiducial."""
        return next((thing for thing in self.objects if thing.fiducial and thing.fiducial.id == id), None)


# ------------------------------------------------------------------ finding and reading files
def find_scene(name_or_path: str, worlds: Traversable) -> Scene:
    """The scene of that name in the folder ``worlds``, or in the file of that path if it ends in ``.yaml``/``.yml``.

    Raises:
        SceneError: there is no such world (the names that there are get listed), or its file is broken.
    """
    if name_or_path.endswith((".yaml", ".yml")):
        return load_scene(Path(name_or_path))
    known = {entry.name.removesuffix(".yaml"): entry for entry in worlds.iterdir() if entry.name.endswith(".yaml")}
    if name_or_path not in known:
        raise SceneError(
            f"no world '{name_or_path}': use one of {', '.join(sorted(known))}, or the path of a .yaml file"
        )
    return load_scene(known[name_or_path])


def load_scene(path: Path | Traversable) -> Scene:
    """Read a world file.

    Raises:
        SceneError: it cannot be read, or does not say what the module's docstring asks for.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise SceneError(f"{path}: cannot be read ({error.strerror}): give the path of a world file") from None
    except UnicodeDecodeError:
        raise SceneError(f"{path}: is not UTF-8 text: save it as UTF-8") from None
    return read_scene(text, str(path))


def read_scene(text: str, source: str = "scene") -> Scene:
    """The scene that a YAML text describes; ``source`` names it in errors.

    Raises:
        SceneError: as :func:`load_scene`.
    """
    try:
        data = yaml.load(text, Loader=StrictLoader)  # noqa: S506 - a safe loader, made stricter
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        raise SceneError(f"{source}: is not YAML: {' '.join(str(error).split())}") from None
    try:
        return _scene(data)
    except FieldError as error:
        raise SceneError(f"{source}: {error}") from None


def _scene(data: Any) -> Scene:
    check_fields(data, "the file", {"name", "seed", "robot", "walls"}, {"objects", "marker_size"})
    marker_size_m = read_length(data.get("marker_size", MARKER_SIZE_M), "marker_size")
    walls = read_each(data["walls"], "walls", _wall)
    objects = read_each(data.get("objects", []), "objects", lambda row, at: _object(row, at, marker_size_m))
    check_unique([thing.id for thing in objects], "objects", "id")
    check_unique([thing.fiducial.id for thing in objects if thing.fiducial], "objects", "fiducial id")
    return Scene(
        read_text(data["name"], "name"),
        read_whole(data["seed"], "seed", 2**32 - 1),
        _start(data["robot"]),
        walls,
        objects,
        marker_size_m,
    )


def _start(data: Any) -> Start:
    check_fields(data, "robot", {"x", "y", "yaw_deg"}, set())
    x_m, y_m = read_coordinate(data["x"], "robot.x"), read_coordinate(data["y"], "robot.y")
    return Start(x_m, y_m, read_angle(data["yaw_deg"], "robot.yaw_deg"))


def _wall(row: Any, at: str) -> Wall:
    if isinstance(row, list):
        row = {"line": row}
    check_fields(row, at, {"line"}, {"height", "thickness"})
    x1_m, y1_m, x2_m, y2_m = read_row(row["line"], f"{at}.line", 4, "[x1, y1, x2, y2]", read_coordinate)
    wall = Wall(
        x1_m,
        y1_m,
        x2_m,
        y2_m,
        read_length(row.get("height", WALL_HEIGHT_M), f"{at}.height"),
        read_length(row.get("thickness", WALL_THICKNESS_M), f"{at}.thickness"),
    )
    if wall.length_m == 0:
        raise FieldError(f"{at}: both ends are the same: give two different points")
    return wall


def _object(row: Any, at: str, marker_size_m: float) -> SceneObject:
    optional = {"attributes", "names", "yaw_deg", "fiducial"}
    check_fields(row, at, {"id", "type", "x", "y", "size"}, optional)
    length_m, width_m, height_m = read_row(row["size"], f"{at}.size", 3, "[length, width, height]", read_length)
    thing = SceneObject(
        id=read_text(row["id"], f"{at}.id"),
        type=read_text(row["type"], f"{at}.type"),
        x_m=read_coordinate(row["x"], f"{at}.x"),
        y_m=read_coordinate(row["y"], f"{at}.y"),
        yaw_rad=read_angle(row.get("yaw_deg", 0), f"{at}.yaw_deg"),
        size_m=(length_m, width_m, height_m),
        attributes=read_each(row.get("attributes", []), f"{at}.attributes", read_text),
        names=read_each(row.get("names", []), f"{at}.names", read_text),
        fiducial=_fiducial(row["fiducial"], f"{at}.fiducial") if "fiducial" in row else None,
    )
    _check_marker_fits(thing, marker_size_m, f"{at}.fiducial")
    return thing


def _fiducial(data: Any, at: str) -> FiducialMount:
    check_fields(data, at, {"id", "height", "face"}, set())
    faces = [face.value for face in Face]
    if data["face"] not in faces:
        raise FieldError(f"{at}.face: '{data['face']}' is not a side: use {', '.join(faces)}")
    height_m = read_length(data["height"], f"{at}.height")
    return FiducialMount(read_whole(data["id"], f"{at}.id", FIDUCIAL_ID_MAX), height_m, Face(data["face"]))


def _check_marker_fits(thing: SceneObject, marker_size_m: float, at: str) -> None:
    if thing.fiducial is None:
        return
    length_m, width_m, height_m = thing.size_m
    across_m = width_m if thing.fiducial.face in (Face.FRONT, Face.BACK) else length_m
    half_m = marker_size_m / 2
    low_m, high_m = half_m, height_m - half_m
    if across_m < marker_size_m or not low_m - 1e-9 <= thing.fiducial.height_m <= high_m + 1e-9:
        raise FieldError(
            f"{at}: a marker of {marker_size_m:g} m does not fit its side of {across_m:g} x {height_m:g} m: "
            "make the object larger or change the marker's height"
        )
