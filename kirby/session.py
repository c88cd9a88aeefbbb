"""A talk with Kirby from beginning to end.

Redis and the robot are started where there are none, then the terminal or the pipe has the word, and everything that
was started is gone afterwards.
"""

from __future__ import annotations

import secrets
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing, contextmanager
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console

from dialogue.events import RobotFeedback
from robot import process
from robot.bridge import masked
from robot.pacing import parse_speed
from robot.redis_server import RedisServer
from robot.state_folder import StateFolder
from voxml.vocabulary import load_lexicon

from .agent import Agent
from .conversation import Conversation, Line, Speaker
from .errors import KirbyError, UsageError
from .link import RobotLink
from .proposer import trained_here
from .replay import logged
from .transcript import Transcript
from .view_options import ViewOptions
from .worlds import DEFAULT_WORLD, world_file

START_PATIENCE_S = 60.0


@dataclass(frozen=True, slots=True)
class Options:
    """What was asked for on the command line; None stands for the default."""

    world: str | None = None
    redis: str | None = None
    speed: str | None = None
    state: Path | None = None
    seed: int | None = None
    namespace: str = ""
    view: ViewOptions | None = None
    log: Path | None = None


@dataclass(frozen=True, slots=True)
class Backstage:
    """What a talk needs behind it: a Redis and the link to it, the folder for what outlives the talk, and the robot if

    it is ours.
    """

    url: str
    folder: Path
    link: RobotLink
    robot: process.RobotProcess | None


def talk(options: Options) -> bool:
    """Talk in a terminal, or take lines from a pipe; True when every line was understood and done.

    Raises:
        KirbyError: there is no Redis, no robot, no such world.
    """
    typed = sys.stdin.isatty()
    show = _terminal_line if typed else _plain_line
    with ExitStack() as stack:
        backstage, conversation = stack.enter_context(_conversation(options, show, "1" if typed else "max"))
        stack.enter_context(_shown(options.view, backstage, conversation, show))
        if typed:
            from .repl import Repl

            Repl(conversation, load_lexicon().words(), backstage.folder / "history").run()
            return True
        return Transcript(conversation, show).run(sys.stdin)


def run_view(options: Options) -> None:
    """Show the world and talk in it alone, until told to end.

    Raises:
        KirbyError: as :func:`talk`; the view's address cannot be had.
    """
    from .view import serve

    stopping = threading.Event()
    with ExitStack() as stack:
        backstage, conversation = stack.enter_context(_conversation(options, _error_line, "1"))
        process.stop_on_signals(stopping)  # before the address is told: who reads it may end us at once
        stack.enter_context(_shown(options.view, backstage, conversation, _error_line))
        serve(conversation, stopping)


@contextmanager
def _shown(
    view: ViewOptions | None, backstage: Backstage, conversation: Conversation, show: Callable[[Line], None]
) -> Iterator[None]:
    """The conversation with a view beside it, if one was asked for."""
    if view is None:
        yield
        return
    from .view import showing

    def overheard(who: str, text: str) -> None:
        show(Line(Speaker.SYSTEM, f"{who}: {text}"))

    with showing(view, conversation, backstage.link, overheard):
        yield


def run_robot(options: Options) -> None:
    """Run the robot's side alone, in this process, until it is told to end.

    Raises:
        KirbyError: as :func:`talk`.
    """
    _speed(options.speed or "1")
    world, scene = world_file(options.world or DEFAULT_WORLD)
    stopping = threading.Event()
    process.stop_on_signals(stopping)
    with StateFolder(options.state) as folder, ExitStack() as stack:
        url = options.redis or stack.enter_context(RedisServer(folder.path)).url
        print(f"robot in {scene.name}: commands at {masked(url)}; Ctrl-C ends it", file=sys.stderr)
        process.run_robot(_robot_options(options, url, world, folder.path, "1"), stopping)


@contextmanager
def _conversation(
    options: Options, show: Callable[[Line], None], speed: str
) -> Iterator[tuple[Backstage, Conversation]]:
    with ExitStack() as stack:
        lexicon = load_lexicon()
        _speed(options.speed or speed)
        simulated = options.world is not None or options.redis is None
        world, scene = world_file(options.world or DEFAULT_WORLD) if simulated else (None, None)
        folder = stack.enter_context(StateFolder(options.state)).path
        url = options.redis or stack.enter_context(RedisServer(folder)).url
        link = stack.enter_context(closing(RobotLink(url, options.namespace)))
        name = f"{secrets.token_hex(4)}-"
        conversation = Conversation(Agent(scene, lexicon, name=name, proposer=trained_here()), link.send, show)
        stack.enter_context(logged(conversation, options.log))
        link.start(conversation.deliver)
        robot = None
        if world is not None and (options.redis is None or not link.alive()):
            robot = process.RobotProcess(_robot_options(options, url, world, folder, speed))
            stack.enter_context(closing(robot))
            robot.start()
        elif not link.alive():
            raise KirbyError(f"no robot is alive at {masked(url)}: start one (kirby robot --redis URL) or give --world")
        backstage = Backstage(url, folder, link, robot)
        _wake(conversation, backstage)
        yield backstage, conversation


def _wake(conversation: Conversation, backstage: Backstage) -> None:
    """Let events in until the robot has said where it is, and a robot of ours that it is up."""
    told = backstage.robot is None
    deadline_s = time.monotonic() + START_PATIENCE_S
    with Console(stderr=True).status("Kirby is waking up ..."):
        while not told or conversation.agent.pose is None or conversation.pending:
            event, _ = conversation.step(0.1)
            told = told or isinstance(event, RobotFeedback)
            failure = None if backstage.robot is None else backstage.robot.failure
            if failure is not None:
                raise KirbyError(failure.removeprefix("robot: "))
            if time.monotonic() > deadline_s:
                raise KirbyError(f"the robot does not answer: look at {backstage.folder / 'robot.log'}")


def _robot_options(options: Options, url: str, world: Path, folder: Path, speed: str) -> process.RobotOptions:
    return process.RobotOptions(url, world, folder, options.namespace, options.speed or speed, options.seed)


def _speed(text: str) -> None:
    try:
        parse_speed(text)
    except KirbyError as error:
        raise UsageError(str(error)) from None


def _plain_line(line: Line) -> None:
    print(f"{line.speaker.value}: {line.text}", flush=True)


def _error_line(line: Line) -> None:
    print(f"{line.speaker.value}: {line.text}", file=sys.stderr, flush=True)


def _terminal_line(line: Line) -> None:
    from .repl import show_line

    show_line(line)
