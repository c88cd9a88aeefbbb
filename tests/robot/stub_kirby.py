"""A Kirby with nobody to talk to, for killing: the Redis child, and a robot child with a body without physics.

``stub_kirby.py STATE`` is the parent; ``stub_kirby.py STATE URL`` the robot.
"""

import sys
import threading
from pathlib import Path

from kinematic_body import TYPICAL, KinematicBody, polygon

ROOM = polygon((-3, -3), (3, -3), (3, 3), (-3, 3))
SPEED = 10.0


def robot(state, url):
    from robot.bridge import Bridge
    from robot.control import Robot, read_boot
    from robot.geometry import ORIGIN
    from robot.pacing import run

    bridge = Bridge(url)
    boot = bridge.open()
    record = read_boot(boot)
    body = KinematicBody(ROOM, ORIGIN if record is None else record.pose, TYPICAL)
    run(Robot(body, bridge, boot=boot, pictures=state / "pictures"), SPEED, threading.Event())


def parent(state):
    from robot.child import Child
    from robot.redis_server import RedisServer
    from robot.state_folder import StateFolder

    folder = StateFolder(state)
    server = RedisServer(folder.path)
    server.start()
    child = Child([sys.executable, __file__, str(state), server.url], state / "robot.log")
    child.start()
    print(server.url, server.pid, child.pid, flush=True)
    sys.stdin.read()


if __name__ == "__main__":
    if len(sys.argv) > 2:
        robot(Path(sys.argv[1]), sys.argv[2])
    else:
        parent(Path(sys.argv[1]))
