"""Draws docs/pictures from real runs: a scene, the map the robot made of it, the markers it found, the way it drove."""

from __future__ import annotations

from contextlib import closing

from dialogue.events import Dispatch, RobotFeedback, WorldUpdate
from docs import draw_robot
from docs.canvas import draw_map, draw_scene, draw_way, picture, set_up
from kirby.agent import Agent
from kirby.worlds import find_world
from robot.control import Robot
from robot.messages import encode_command
from robot.pacing import LOOK_S
from robot.port import MemoryPort
from robot.pybullet_body import PybulletBody
from robot.sightings import Markers


def main() -> None:
    """Draw every picture."""
    set_up()
    figure3()
    draw_robot.main()


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
        with picture("figure3") as axes:
            draw_scene(axes, scene)
            draw_map(axes, robot)
            draw_way(axes, way)


def _tell(agent: Agent, port: MemoryPort) -> None:
    for feedback in port.feedback:
        agent.handle(RobotFeedback(feedback, feedback.time_s or 0.0))
    port.feedback.clear()
    agent.handle(WorldUpdate(0.0, port.latest.odom, port.latest.map, port.latest.fiducials))


if __name__ == "__main__":
    main()
