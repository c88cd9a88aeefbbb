"""Draws docs/pictures from real runs: a scene, the map the robot made of it, the markers it found, the way it drove."""

from __future__ import annotations

import math
from collections.abc import Iterable
from contextlib import closing
from pathlib import Path

import matplotlib as mpl
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.patches import Circle, FancyArrow, Polygon

from dialogue.events import Dispatch, RobotFeedback, WorldUpdate
from kirby.agent import Agent
from kirby.worlds import find_world
from robot.control import Robot
from robot.geometry import Pose
from robot.messages import encode_command
from robot.pacing import LOOK_S
from robot.port import MemoryPort
from robot.pybullet_body import PybulletBody
from robot.sightings import Markers
from voxml.scene import Scene, SceneObject

PICTURES = Path(__file__).parent / "pictures"
SVG_SALT = "kirby"  # the same picture has the same bytes
COLOURS = {"red": "#c0392b", "blue": "#2e6fb5", "yellow": "#d9a514", "green": "#3f8f4f", "grey": "#7f8c8d"}


def main() -> None:
    """Draw every picture."""
    mpl.rcParams.update({"svg.hashsalt": SVG_SALT, "svg.fonttype": "path", "font.size": 9})
    PICTURES.mkdir(exist_ok=True)
    figure3()


def figure3() -> None:
    """The paper's figure 3, after two commands."""
    scene = find_world("figure3")
    port, agent = MemoryPort(), Agent(world=scene)
    with closing(PybulletBody(scene)) as body:
        robot = Robot(body, port, markers=Markers(body.camera, scene.marker_size_m))
        robot.settle(LOOK_S)
        robot.attend()
        way = [body.truth()]
        for said in ("go to the first fiducial on the right", "go to the yellow box"):
            _tell(agent, port)
            for output in agent.hear(said, time_s=body.time_s):
                if isinstance(output, Dispatch):
                    for command in output.commands:
                        port.send(encode_command(command))
            robot.attend()
            while robot.busy:
                robot.tick()
                way.append(body.truth())
            robot.attend()
        _save("figure3", scene, robot, way)


def _tell(agent: Agent, port: MemoryPort) -> None:
    for feedback in port.feedback:
        agent.handle(RobotFeedback(feedback, feedback.time_s or 0.0))
    port.feedback.clear()
    agent.handle(WorldUpdate(0.0, port.latest.odom, port.latest.map, port.latest.fiducials))


def _save(name: str, scene: Scene, robot: Robot, way: Iterable[Pose]) -> None:
    figure, axes = plt.subplots(figsize=(9, 6.4), layout="constrained")
    _draw_scene(axes, scene)
    _draw_map(axes, robot)
    _draw_way(axes, list(way))
    axes.set_aspect("equal")
    axes.set_xlabel("x, metres")
    axes.set_ylabel("y, metres")
    axes.legend(loc="lower left", frameon=False)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    figure.savefig(PICTURES / f"{name}.svg", metadata={"Date": None})
    plt.close(figure)


def _draw_scene(axes: Axes, scene: Scene) -> None:
    for index, wall in enumerate(scene.walls):
        label = "wall" if index == 0 else None
        axes.plot([wall.x1_m, wall.x2_m], [wall.y1_m, wall.y2_m], color="#d5d8dc", linewidth=6, zorder=1, label=label)
    for thing in scene.objects:
        axes.add_patch(_footprint(thing))
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


def _draw_map(axes: Axes, robot: Robot) -> None:
    for index, segment in enumerate(robot.mapper.segments()):
        axes.plot(
            [segment.start.x_m, segment.end.x_m],
            [segment.start.y_m, segment.end.y_m],
            color="#1f3a5f",
            linewidth=1.6,
            zorder=4,
            label="mapped by LIDAR" if index == 0 else None,
        )


def _draw_way(axes: Axes, way: list[Pose]) -> None:
    axes.plot([p.x_m for p in way], [p.y_m for p in way], color="#e67e22", linewidth=2, zorder=5, label="way driven")
    end = way[-1]
    axes.add_patch(Circle((way[0].x_m, way[0].y_m), 0.05, color="#e67e22", zorder=6))
    axes.add_patch(Circle((end.x_m, end.y_m), 0.16, facecolor="#fdebd0", edgecolor="#e67e22", linewidth=1.5, zorder=6))
    dx, dy = 0.14 * math.cos(end.yaw_rad), 0.14 * math.sin(end.yaw_rad)
    axes.add_patch(
        FancyArrow(end.x_m, end.y_m, dx, dy, width=0.02, length_includes_head=True, color="#e67e22", zorder=7)
    )


if __name__ == "__main__":
    main()
