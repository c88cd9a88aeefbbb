"""Lines from standard input, said in turn: the way to drive Kirby from a script, and to keep what came of it."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from dialogue.events import Event, Output, RobotFeedback, Say, Tone
from robot.messages import FeedbackCode

from .conversation import Conversation, Line, Speaker
from .lines import HELP, BadLine, Help, Quit, read_line
from .link import LinkEvent

LOST_PATIENCE_S = 10.0

_FAILED = {FeedbackCode.INVALID, FeedbackCode.UNREACHABLE, FeedbackCode.STRAYED}


class Transcript:
    """Runs lines through a conversation, each when the robot is idle or asks something."""

    def __init__(self, conversation: Conversation, show: Callable[[Line], None]) -> None:
        self._conversation = conversation
        self._show = show
        self._clean = True

    def run(self, lines: Iterable[str]) -> bool:
        """True when every line was understood and done, and no question is left open."""
        for text in lines:
            self._settle()
            line = read_line(text, self._conversation.clock())
            match line:
                case None:
                    continue
                case Quit():
                    break
                case Help():
                    self._show(Line(Speaker.SYSTEM, HELP))
                case BadLine(reason):
                    self._clean = False
                    self._show(Line(Speaker.SYSTEM, reason, Tone.REFUSAL))
                case _:
                    self._show(Line(Speaker.PERSON, text.strip()))
                    self._judge(line, self._conversation.handle(line))
        self._settle()
        return self._clean and not self._conversation.agent.asking

    def _settle(self) -> None:
        """Let events come in until the robot is idle or Kirby asks something.

        Raises:
            TimeoutError: the robot or Redis was gone for longer than `LOST_PATIENCE_S`.
        """
        lost_since_s: float | None = None
        while self._conversation.agent.busy or self._conversation.pending:
            event, outputs = self._conversation.step()
            self._judge(event, outputs)
            if self._conversation.lost is None:
                lost_since_s = None
                continue
            lost_since_s = lost_since_s if lost_since_s is not None else self._conversation.clock()
            if self._conversation.clock() - lost_since_s > LOST_PATIENCE_S:
                raise TimeoutError("the robot did not come back: what was said last is not done")

    def _judge(self, event: Event | LinkEvent, outputs: tuple[Output, ...]) -> None:
        """A refusal, or a movement that failed, makes the run a failed one."""
        if isinstance(event, RobotFeedback) and event.feedback.code in _FAILED:
            self._clean = False
        if any(isinstance(output, Say) and output.tone is Tone.REFUSAL for output in outputs):
            self._clean = False
