"""The terminal: history, completion, a live status line, and the robot's news while one types."""

from __future__ import annotations

import math
import threading
from collections.abc import Iterable
from pathlib import Path

from prompt_toolkit import PromptSession
from prompt_toolkit.auto_suggest import AutoSuggestFromHistory
from prompt_toolkit.completion import WordCompleter
from prompt_toolkit.formatted_text import FormattedText
from prompt_toolkit.history import FileHistory
from prompt_toolkit.patch_stdout import patch_stdout
from prompt_toolkit.shortcuts import print_formatted_text
from prompt_toolkit.styles import Style

from dialogue.events import GestureKind, Tone

from .conversation import Conversation, Line, Speaker
from .lines import HELP, BadLine, Help, Quit, read_line

_STYLE = Style.from_dict(
    {
        "kirby": "ansicyan bold",
        "question": "ansiyellow",
        "refusal": "ansired",
        "news": "ansigreen",
        "system": "ansibrightblack",
    }
)
_SLASH = ("/point", "/gesture", "/help", "/quit", *(f"/gesture {kind.value}" for kind in GestureKind))


def show_line(line: Line) -> None:
    """Print one line of the transcript in colour; what the person typed stands on the screen already."""
    if line.speaker is Speaker.SYSTEM:
        print_formatted_text(FormattedText([("class:system", line.text)]), style=_STYLE)
    elif line.speaker is Speaker.KIRBY:
        tone = "" if line.tone is Tone.REPLY else f"class:{line.tone.value}"
        print_formatted_text(FormattedText([("class:kirby", "Kirby: "), (tone, line.text)]), style=_STYLE)


class Repl:
    """A prompt in the calling thread; the conversation runs in one of its own."""

    def __init__(self, conversation: Conversation, words: Iterable[str], history: Path) -> None:
        self._conversation = conversation
        self._leaving = threading.Event()
        completer = WordCompleter([*words, *_SLASH], sentence=False, ignore_case=True, WORD=True)
        self._prompt: PromptSession[str] = PromptSession(
            "> ",
            history=FileHistory(str(history)),
            auto_suggest=AutoSuggestFromHistory(),
            completer=completer,
            complete_while_typing=False,
            bottom_toolbar=self._status,
            refresh_interval=0.5,
        )

    def run(self) -> None:
        """Talk until the person leaves (/quit, Ctrl-D, or Ctrl-C on an empty line)."""
        worker = threading.Thread(target=self._work, name="conversation", daemon=True)
        with patch_stdout(raw=True):
            show_line(Line(Speaker.SYSTEM, HELP))
            worker.start()
            try:
                self._read()
            finally:
                self._leaving.set()
                worker.join(timeout=2.0)

    def _work(self) -> None:
        while not self._leaving.is_set():
            self._conversation.step()

    def _read(self) -> None:
        while True:
            try:
                line = read_line(self._prompt.prompt(), self._conversation.clock())
            except (EOFError, KeyboardInterrupt):
                return
            match line:
                case None:
                    continue
                case Quit():
                    return
                case Help():
                    show_line(Line(Speaker.SYSTEM, HELP))
                case BadLine(reason):
                    show_line(Line(Speaker.SYSTEM, reason))
                case _:
                    self._conversation.deliver(line)

    def _status(self) -> str:
        """State, place and queue, as they are now."""
        if self._conversation.lost is not None:
            return f" {self._conversation.lost.reason}"
        agent = self._conversation.agent
        pose = agent.pose
        place = (
            ""
            if pose is None
            else f" | at ({pose.x_m:.2f}, {pose.y_m:.2f}) facing {round(math.degrees(pose.yaw_rad))} deg"
        )
        pending = f" | {len(agent.queue)} to do" if agent.queue else ""
        return f" {agent.state}{place}{pending}"
