"""The shared world wired to the conversation: what the dialogue says and does is seen, what people do is heard."""

from __future__ import annotations

import math
import sys
import threading
import uuid
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from dataclasses import replace

import redis

from dialogue.events import Dispatch, Highlight, MoveCamera, Naming, Output, Pointing, Say, Utterance, WorldUpdate
from dialogue.table import Activity
from dialogue.wording import command_words
from robot.geometry import Pose
from robot.messages import CancelCommand, Control
from voxml.vocabulary import Lexicon, load_lexicon
from voxworld.front import Address, is_loopback
from voxworld.talk import Condition, Errand, Remark, Side
from voxworld.view import Said, VoxWorld

from .conversation import Conversation, Happening
from .errors import UsageError
from .link import Found, Garbled, Lost, RobotLink
from .outlook import Outlook
from .view_options import ViewOptions

TERMINAL = "terminal"

_DOING = {
    Activity.RESTING: "at rest",
    Activity.MOVING: "driving",
    Activity.PATROLLING: "patrolling",
    Activity.PAUSED: "paused",
    Activity.STRAYED: "astray",
    Activity.LEFT_OVER: "paused since the last time",
}


class View:
    """One shared world beside one conversation."""

    def __init__(
        self,
        conversation: Conversation,
        send: Callable[[Dispatch], None],
        address: Address,
        lexicon: Lexicon,
        overheard: Callable[[str, str], None],
    ) -> None:
        """``send`` goes straight to the robot; ``overheard(who, text)`` tells the terminal what was said here."""
        self._conversation = conversation
        self._send = send
        self._overheard = overheard
        self._condition = Condition()
        self._errands: tuple[Errand, ...] = ()
        self.world = VoxWorld(self, heads(lexicon), address)

    def open(self) -> None:
        """Show what is known already, and whatever comes from now on.

        Raises:
            UsageError: the address is taken or not this machine's.
        """
        try:
            self.world.start()
        except OSError as error:
            raise UsageError(
                f"the view cannot listen there ({error.strerror}): choose another --port or --host"
            ) from None
        agent = self._conversation.agent
        self.world.show_world(agent.session.world)
        if agent.pose is not None:
            self.world.show_pose(agent.pose)
        self._tell_condition()
        self._conversation.watch(self._happened)

    def close(self) -> None:
        self._conversation.unwatch(self._happened)
        self.world.close()

    @property
    def pose(self) -> Pose | None:
        """Where the robot is; None before it has said so."""
        return self._conversation.agent.pose

    # ------------------------------------------------------------------ what people do
    def deliver(self, event: Said) -> None:
        self._conversation.deliver(event)

    def stop(self, who: str) -> str:
        """Past the dialogue and whatever it waits for, straight to the robot."""
        try:
            self._send(Dispatch((Control.STOP,), (f"stop-{uuid.uuid4().hex[:12]}",)))
        except redis.RedisError:
            return "Stop did not get through: Redis does not answer"
        self.world.show_remark(Remark(Side.SYSTEM, "", f"{who or 'somebody'} pressed Stop"))
        return ""

    def cancel(self, errand: str, who: str) -> None:
        """One command of several, being done or waiting: the dialogue hears from the robot that it is gone."""
        what = next((known.text for known in self._errands if known.id == errand), errand)
        try:
            self._send(Dispatch((CancelCommand(errand),), (f"cancel-{uuid.uuid4().hex[:12]}",)))
        except redis.RedisError:
            self.world.show_remark(Remark(Side.SYSTEM, "", f"'{what}' is not cancelled: Redis does not answer"))
            return
        self.world.show_remark(Remark(Side.SYSTEM, "", f"{who or 'somebody'} cancelled '{what}'"))

    def rename(self, entity: str, name: str, who: str) -> None:
        self._conversation.deliver(Naming(entity, name, self.clock(), who))

    def clock(self) -> float:
        return self._conversation.clock()

    # ------------------------------------------------------------------ what happens
    def _happened(self, event: Happening, outputs: tuple[Output, ...]) -> None:
        """Called in the conversation's thread after every event."""
        who = getattr(event, "speaker", None)
        match event:
            case Utterance(text=text):
                self.world.show_remark(Remark(Side.PERSON, who or TERMINAL, text))
                if who is not None:
                    self._overheard(who, text)
            case Pointing():
                self.world.show_pointing(replace(event, speaker=who or TERMINAL))
            case WorldUpdate(odom=odom):
                self._sensed(event)
                if odom is not None:
                    self.world.show_pose(odom.pose)
            case Lost(reason) | Garbled(reason):
                self.world.show_remark(Remark(Side.SYSTEM, "", reason))
            case Found():
                self.world.show_remark(Remark(Side.SYSTEM, "", "the robot is back"))
        for output in outputs:
            self._told(output, who)
        self._tell_condition()

    def _sensed(self, event: WorldUpdate) -> None:
        if event.map is not None or event.fiducials is not None:
            self.world.show_world(self._conversation.agent.session.world)

    def _told(self, output: Output, who: str | None) -> None:
        match output:
            case Say(text, tone):
                self.world.show_remark(Remark(Side.KIRBY, "Kirby", text, tone))
                self.world.show_world(self._conversation.agent.session.world)  # perhaps it was taught a name
            case Highlight():
                self.world.show_meant(output)
            case MoveCamera(move):
                self.world.move_camera(move, who)

    def _tell_condition(self) -> None:
        agent, lost = self._conversation.agent, self._conversation.lost
        pose = agent.pose
        place = "" if pose is None else _place(pose)
        state = _DOING[agent.session.activity] + (" - Kirby waits for an answer" if agent.asking else "")
        redis_lost = lost is not None and "Redis" in lost.reason
        condition = Condition(state, lost is None, not redis_lost, place, "" if lost is None else lost.reason)
        if condition != self._condition:
            self._condition = condition
            self.world.show_condition(condition)
        errands = tuple(Errand(task.id, command_words(task.command)) for task in agent.queue if task.moves)
        if errands != self._errands:
            self._errands = errands
            self.world.show_errands(errands)


def _place(pose: Pose) -> str:
    # Adding 0 makes a plain nought of a negative one.
    x_m, y_m = round(pose.x_m, 2) + 0.0, round(pose.y_m, 2) + 0.0
    return f"at ({x_m:.2f}, {y_m:.2f}), facing {round(math.degrees(pose.yaw_rad))}°"


def heads(lexicon: Lexicon) -> dict[str, str]:
    """The VoxML head of every type of thing in the lexicon."""
    return {name: entry.head.name for name, entry in lexicon.objects.items()}


@contextmanager
def showing(
    options: ViewOptions, conversation: Conversation, link: RobotLink, overheard: Callable[[str, str], None]
) -> Iterator[View]:
    """The view while the conversation lasts, and its one address on standard error.

    Raises:
        UsageError: as :meth:`View.open`.
    """
    address = Address(options.host, options.port, options.token_for(is_loopback(options.host)))
    with closing(View(conversation, link.send, address, load_lexicon(), overheard)) as view:
        view.open()
        print(f"the world is at {view.world.url}", file=sys.stderr, flush=True)
        world = view.world
        outlook = Outlook(
            link.url,
            link.namespace,
            watching=lambda: world.watching,
            show_path=world.show_path,
            show_image=world.show_image,
        )
        with closing(outlook):
            outlook.start()
            yield view


def serve(conversation: Conversation, stopping: threading.Event) -> None:
    """Run the conversation for those in the view alone, until told to stop."""
    while not stopping.is_set():
        conversation.step()
