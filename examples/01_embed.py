"""Kirby inside an agent of your own, with your own robot and your own world: neither Redis nor pybullet."""

import math

from kirby import Agent, Entities, Entity, Pose, Say, World, encode_command


class MyRobot:
    """Anything with ``send`` is a robot."""

    def send(self, commands, ids):
        for command, name in zip(commands, ids, strict=True):
            print(f"robot {name}: {encode_command(command)}")


plant = Entity("plant", "plant", Pose(2.0, -1.0, math.pi))
agent = Agent(world=World(entities=Entities((plant,))), robot=MyRobot())

for text in ("turn around", "go to the plant on the left", "go to the piano"):
    for output in agent.hear(text):
        if isinstance(output, Say):
            print(f"kirby: {output.text}")
