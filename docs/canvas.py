"""Draws a world, the map that a robot made of it and the way it drove, for the pictures in docs/pictures."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import matplotlib as mpl
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.patches import Circle, FancyArrow, Polygon

from robot.control import Robot
from robot.geometry import Point, Pose
from voxml.scene import Scene, SceneObject

PICTURES = Path(__file__).parent / "pictures"
SVG_SALT = "kirby"  # the same picture has the same bytes
COLOURS = {"red": "#c0392b", "blue": "#2e6fb5", "yellow": "#d9a514", "green": "#3f8f4f", "grey": "#7f8c8d"}


def set_up() -> None:
    """The style of every picture."""
    mpl.rcParams.update({"svg.hashsalt": SVG_SALT, "svg.fonttype": "path", "font.size": 9})
    PICTURES.mkdir(exist_ok=True)


@contextmanager
def picture(name: str, size: tuple[float, float] = (9, 6.4)) -> Iterator[Axes]:
    """Axes in metres to draw on; the picture is saved under its name at the end."""
    figure, axes = plt.subplots(figsize=size, layout="constrained")
    yield axes
    axes.set_aspect("equal")
    axes.set_xlabel("x, metres")
    axes.set_ylabel("y, metres")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.1), ncols=4, frameon=False)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    figure.savefig(PICTURES / f"{name}.svg", metadata={"Date": None})
    plt.close(figure)


def draw_scene(axes: Axes, scene: Scene, named: bool = True) -> None:
    """Walls and objects as they truly are, with their names and fiducials if ``named``."""
    for index, wall in enumerate(scene.walls):
        label = "wall" if index == 0 else None
        axes.plot([wall.x1_m, wall.x2_m], [wall.y1_m, wall.y2_m], color="#d5d8dc", linewidth=6, zorder=1, label=label)
    for thing in scene.objects:
        axes.add_patch(_footprint(thing))
        if not named:
            continue
        name = " ".join((*thing.attributes, thing.type))
        number = f" ({thing.fiducial.id})" if thing.fiducial else ""
        axes.annotate(name + number, (thing.x_m, thing.y_m), (9, -3), textcoords="offset points", zorder=8)


def _footprint(thing: SceneObject) -> Polygon:
    length_m, width_m, _ = thing.size_m
    pose = Pose(thing.x_m, thing.y_m, thing.yaw_rad)
    corners = [(length_m / 2, width_m / 2), (-length_m / 2, width_m / 2)]
    corners += [(-x, -y) for x, y in corners]
    c, s = math.cos(pose.yaw_rad), math.sin(pose.yaw_rad)
    points = [(pose.x_m + c * x - s * y, pose.y_m + s * x + c * y) for x, y in corners]
    colour = next((COLOURS[each] for each in thing.attributes if each in COLOURS), "#7f8c8d")
    return Polygon(points, closed=True, color=colour, zorder=3)


def draw_map(axes: Axes, robot: Robot) -> None:
    """The walls that the robot has mapped."""
    for index, segment in enumerate(robot.mapper.segments()):
        axes.plot(
            [segment.start.x_m, segment.end.x_m],
            [segment.start.y_m, segment.end.y_m],
            color="#1f3a5f",
            linewidth=1.6,
            zorder=4,
            label="mapped by LIDAR" if index == 0 else None,
        )


def draw_way(axes: Axes, way: Sequence[Pose]) -> None:
    """The way driven, with a disc where it began and the robot where it ended."""
    axes.plot([p.x_m for p in way], [p.y_m for p in way], color="#e67e22", linewidth=2, zorder=5, label="way driven")
    end = way[-1]
    axes.add_patch(Circle((way[0].x_m, way[0].y_m), 0.05, color="#e67e22", zorder=6))
    axes.add_patch(Circle((end.x_m, end.y_m), 0.16, facecolor="#fdebd0", edgecolor="#e67e22", linewidth=1.5, zorder=6))
    dx, dy = 0.14 * math.cos(end.yaw_rad), 0.14 * math.sin(end.yaw_rad)
    axes.add_patch(
        FancyArrow(end.x_m, end.y_m, dx, dy, width=0.02, length_includes_head=True, color="#e67e22", zorder=7)
    )


def draw_plan(axes: Axes, path: Iterable[Point], label: str | None) -> None:
    """A planned path."""
    places = list(path)
    axes.plot(
        [place.x_m for place in places],
        [place.y_m for place in places],
        color="#8e44ad",
        linewidth=0.9,
        linestyle="--",
        zorder=5,
        label=label,
    )
