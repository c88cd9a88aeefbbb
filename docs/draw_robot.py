"""The pictures of docs/robot.md: the map against the truth, planned paths against the way driven, a patrol."""

from __future__ import annotations

import math
from contextlib import closing

from matplotlib.axes import Axes
from matplotlib.patches import Polygon

from docs.canvas import draw_map, draw_plan, draw_scene, draw_way, picture, set_up
from kirby.worlds import find_world
from robot.body import Image
from robot.control import Robot
from robot.geometry import Point, Pose
from robot.messages import Patrol, encode_command
from robot.pacing import LOOK_S
from robot.port import MemoryPort
from robot.pybullet_body import PybulletBody

TOUR = (
    "go to 0.4 2.6",
    "go to 5.3 2.2",
    "go to 7.8 2.2",
    "go to 8 -1.8",
    "go to 4.4 -2.4",
    "go to 1.8 -2.6",
    "go to 0 0",
)
KEEP_EVERY = 8  # control periods between drawn plans
PATROL = Patrol(12, 1.5, 1.0)
PATROL_S = 420.0


class Watch:
    """A robot's run as it can be drawn: where it truly was, and what it planned."""

    def __init__(self, world: str) -> None:
        self.scene = find_world(world)
        self.body = PybulletBody(self.scene, camera_rate_hz=0.0)
        self.port = MemoryPort()
        self.robot = Robot(self.body, self.port, window=self)
        self.way: list[Pose] = [self.body.truth()]
        self.plans: list[tuple[Point, ...]] = []
        self.robot.settle(LOOK_S)

    def show_path(self, points: tuple[Point, ...]) -> None:
        if points:
            self.plans.append(points)

    def show_image(self, image: Image) -> None:
        """Pictures are not drawn."""

    def tell(self, command: str, limit_s: float = 300.0) -> None:
        """Command, and watch until it is done."""
        end_s = self.body.time_s + limit_s
        self.port.send(command)
        self.robot.attend()
        while self.robot.busy and self.body.time_s < end_s:
            self.robot.tick()
            self.way.append(self.body.truth())

    def close(self) -> None:
        self.body.close()


def main() -> None:
    """Draw all three."""
    set_up()
    map_against_truth()
    path()
    patrol()


def map_against_truth() -> None:
    """The apartment after a tour of its rooms."""
    with closing(Watch("apartment")) as watch, picture("robot-map", (9, 7.6)) as axes:
        for command in TOUR:
            watch.tell(command)
        draw_scene(axes, watch.scene, named=False)
        draw_map(axes, watch.robot)
        draw_way(axes, watch.way)


def path() -> None:
    """Through a maze that the robot does not know, with what it planned on the way."""
    with closing(Watch("maze")) as watch, picture("robot-path", (8, 7.6)) as axes:
        watch.tell("go to 5.4 3.6")
        draw_scene(axes, watch.scene, named=False)
        for number, plan in enumerate(watch.plans[::KEEP_EVERY]):
            draw_plan(axes, plan, None if number else "planned")
        draw_map(axes, watch.robot)
        draw_way(axes, watch.way)


def patrol() -> None:
    """A patrol of the lab: concentric polygons, what cannot be reached left out."""
    with closing(Watch("lab")) as watch, picture("robot-patrol", (9, 7.6)) as axes:
        watch.tell(encode_command(PATROL), PATROL_S)
        draw_scene(axes, watch.scene, named=False)
        _draw_loops(axes, watch.way[0])
        draw_map(axes, watch.robot)
        draw_way(axes, watch.way)


def _draw_loops(axes: Axes, centre: Pose) -> None:
    """The polygons that were asked for."""
    for loop in range(4):
        radius_m = PATROL.radius_m + loop * PATROL.increment_m
        corners = [centre.turned(number * math.tau / PATROL.sides).ahead(radius_m) for number in range(PATROL.sides)]
        axes.add_patch(
            Polygon(
                [(corner.x_m, corner.y_m) for corner in corners],
                fill=False,
                edgecolor="#27ae60",
                linestyle=":",
                zorder=2,
                label=None if loop else "loops of the patrol",
            )
        )


if __name__ == "__main__":
    main()
