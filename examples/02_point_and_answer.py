"""Pointing, a question and its answer, and a conversation that is put away and taken up again."""

import math

from kirby import Agent, Dispatch, Entities, Entity, Point, Pose, Say, World, encode_command

world = World(
    entities=Entities(
        (
            Entity("1", "block", Pose(2.0, -1.0, math.pi), ("red",)),
            Entity("2", "block", Pose(3.0, 1.0, math.pi), ("blue",)),
        )
    )
)


def show(outputs):
    """Print what comes out."""
    for output in outputs:
        match output:
            case Say(text):
                print(f"kirby: {text}")
            case Dispatch(commands):
                print("robot:", ", ".join(map(encode_command, commands)))


agent = Agent(world)
agent.point(Point(1.0, 0.5), time_s=0.0)
show(agent.hear("go there", time_s=1.0))
show(agent.hear("go to the block", time_s=2.0))
agent = Agent.from_json(agent.to_json())
show(agent.hear("the blue one", time_s=3.0))
