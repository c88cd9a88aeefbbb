"""The robot as a process of its own: ``python -m robot.process --redis URL --world FILE``."""

from __future__ import annotations

import argparse
import logging
import os
import signal
import sys
import threading
from collections.abc import Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

from voxml.scene import SceneError, load_scene

from .bridge import Bridge
from .child import Child, require_linux
from .control import Robot, read_boot
from .errors import RobotError
from .pacing import parse_speed, run
from .state_folder import default_state_folder

REDIS_VARIABLE = "KIRBY_REDIS"


@dataclass(frozen=True, slots=True)
class RobotOptions:
    """What a robot's process is started with.

    ``redis_url`` and ``world`` are as on the command line; ``speed`` is a number or ``max``; ``seed`` None is the
    world's own; ``state`` is the folder for pictures and logs.
    """

    redis_url: str
    world: Path
    state: Path
    namespace: str = ""
    speed: str = "1"
    seed: int | None = None


def run_robot(options: RobotOptions, stopping: threading.Event | None = None) -> None:
    """Run a simulated robot in this process until ``stopping`` is set.

    Raises:
        RobotError: there is no Redis, no such world, or another robot took over.
    """
    from .pybullet_body import PybulletBody  # a second to import: only where it is simulated
    from .sightings import Markers
    from .window import RedisWindow

    speed = parse_speed(options.speed)
    try:
        scene = load_scene(options.world)
    except SceneError as error:
        raise RobotError(str(error)) from None
    bridge = Bridge(options.redis_url, options.namespace)
    try:
        boot = bridge.open()
        record = read_boot(boot)
        body = PybulletBody(scene, start=None if record is None else record.pose, seed=options.seed)
        try:
            markers = Markers(body.camera, scene.marker_size_m)
            pictures = options.state / "pictures"
            with closing(RedisWindow(options.redis_url, options.namespace)) as window:
                robot = Robot(body, bridge, boot=boot, markers=markers, pictures=pictures, window=window)
                window.start()
                run(robot, speed, stopping or threading.Event())
                robot.rest()
        finally:
            body.close()
    finally:
        bridge.close()


class RobotProcess:
    """The same as a child process: it ends with us however we end, and is started again if something kills it."""

    def __init__(self, options: RobotOptions) -> None:
        require_linux()
        self._log = options.state / "robot.log"
        # -P: the folder Kirby was started in may hold a package called robot, and it is not ours.
        command = [sys.executable, "-P", "-m", "robot.process", *_arguments(options)]
        # The URL may hold a password: everybody may read a command line, but not an environment.
        self._child = Child(command, self._log, environment={REDIS_VARIABLE: options.redis_url})

    def start(self) -> None:
        """Returns when the process exists; it says READY on the bridge when it is up."""
        self._child.start()

    @property
    def pid(self) -> int | None:
        return self._child.pid

    @property
    def failure(self) -> str | None:
        """Why it gave up, in one line; None as long as it has not."""
        if self._child.exit_status is None:
            return None
        return self._child.last_words() or f"the robot's process ended (status {self._child.exit_status})"

    def close(self) -> None:
        self._child.close()


def main(arguments: Sequence[str] | None = None) -> int:
    """The command line; the exit status is 1 if it could not run, 2 for wrong use."""
    options, verbose = _parse(arguments)
    logging.basicConfig(stream=sys.stderr, level=logging.INFO if verbose else logging.CRITICAL)
    stopping = threading.Event()
    stop_on_signals(stopping)
    try:
        run_robot(options, stopping)
    except RobotError as error:
        print(f"robot: {error}", file=sys.stderr)
        return 1
    return 0


def stop_on_signals(stopping: threading.Event) -> None:
    """SIGTERM and Ctrl-C end the run between two control periods. To be called in the main thread."""
    for sign in (signal.SIGTERM, signal.SIGINT):
        signal.signal(sign, lambda *_: stopping.set())


def _arguments(options: RobotOptions) -> list[str]:
    arguments = ["--world", str(options.world), "--state", str(options.state)]
    arguments += ["--namespace", options.namespace, "--speed", options.speed]
    return arguments if options.seed is None else [*arguments, "--seed", str(options.seed)]


def _parse(arguments: Sequence[str] | None) -> tuple[RobotOptions, bool]:
    parser = argparse.ArgumentParser(prog="python -m robot.process", description="Run a simulated robot.")
    url = os.environ.get(REDIS_VARIABLE)
    parser.add_argument(
        "--redis", default=url, required=url is None, metavar="URL", help="redis://, rediss://, unix://"
    )
    parser.add_argument("--world", required=True, type=Path, metavar="FILE", help="a world file")
    parser.add_argument("--namespace", default="", help="prefix of every key")
    parser.add_argument("--speed", default="1", metavar="X", help="simulated seconds a second, or max")
    parser.add_argument("--state", type=Path, default=default_state_folder(), metavar="DIR", help="for pictures")
    parser.add_argument("--seed", type=int, help="of the simulated noise (default: the world's)")
    parser.add_argument("--verbose", action="store_true", help="log to standard error")
    read = parser.parse_args(arguments)
    options = RobotOptions(read.redis, read.world, read.state, read.namespace, read.speed, read.seed)
    return options, read.verbose


if __name__ == "__main__":
    sys.exit(main())
