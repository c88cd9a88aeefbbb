"""The whole circle with a robot of your own: commands out, and back in what it senses and what came of them."""

import math

from kirby import Agent, FeedbackCode, Odom, Point, Say, encode_command, feedback


class Turtle:
    """Jumps where it is told to, at once; a real one would answer later, from its own loop."""

    def __init__(self):
        self.sent = []

    def send(self, commands, ids):
        self.sent += zip(commands, ids, strict=True)


turtle = Turtle()
agent = Agent(robot=turtle)
for text in ("go to 2 1", "what are you doing", "and back again", "where are you"):
    for output in agent.hear(text):
        if isinstance(output, Say):
            print(f"kirby: {output.text}")
    for command, name in turtle.sent:
        print(f"robot {name}: {encode_command(command)}")
        place = Point(command.x_m, command.y_m)
        agent.world(odom=Odom(1, 1, (place.x_m, place.y_m, 0.0), (0.0, 0.0, math.pi / 2), 0.0, 0.0, 0.0))
        agent.feedback(feedback(FeedbackCode.SUCCESS_GO_TO, at=place, id=name))
    turtle.sent.clear()
