"""The conversation and the robot's condition as the panel shows them. Pure: values in, HTML out, everything escaped."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from html import escape

from dialogue.events import Tone

REMARKS_MAX = 200


class Side(Enum):
    """Whose remark it is."""

    PERSON = "person"
    KIRBY = "kirby"
    SYSTEM = "system"


@dataclass(frozen=True, slots=True)
class Remark:
    """One line of the conversation; ``who`` is shown with it."""

    side: Side
    who: str
    text: str
    tone: Tone = Tone.REPLY


@dataclass(frozen=True, slots=True)
class Errand:
    """A command that was sent and has not ended: ``text`` as on the wire, ``id`` to cancel it by."""

    id: str
    text: str


@dataclass(frozen=True, slots=True)
class Condition:
    """How robot and bridge are. ``notice`` is what everybody must know, such as that the robot is gone."""

    state: str = "waiting for the robot"
    robot_alive: bool = False
    bridge_alive: bool = False
    place: str = ""
    notice: str = ""


_KIRBY_COLOURS = {
    Tone.REPLY: ("#eef1f4", "#22272e"),
    Tone.NEWS: ("#e3f4e7", "#1d4a2a"),
    Tone.QUESTION: ("#fff2cc", "#5c4300"),
    Tone.REFUSAL: ("#fde4e1", "#7a1f1b"),
}


def conversation_html(remarks: tuple[Remark, ...]) -> str:
    """The newest remarks, the latest at the bottom and in view.

    A box that is laid out from its end keeps that end in view without a script.
    """
    rows = "".join(map(_remark_html, remarks[-REMARKS_MAX:]))
    return (
        '<div style="display:flex;flex-direction:column-reverse;height:260px;overflow-y:auto;padding:8px">'
        '<div id="kirby-conversation" role="log" style="display:flex;flex-direction:column;gap:6px;'
        f'font:14px/1.35 system-ui,sans-serif">{rows}</div></div>'
    )


def _remark_html(remark: Remark) -> str:
    if remark.side is Side.SYSTEM:
        return f'<div style="align-self:center;color:#6b7280;font-size:12px">{escape(remark.text)}</div>'
    mine = remark.side is Side.PERSON
    back, ink = ("#2f6fed", "#ffffff") if mine else _KIRBY_COLOURS[remark.tone]
    corner = "14px 14px 4px 14px" if mine else "14px 14px 14px 4px"
    return (
        f'<div style="align-self:{"flex-end" if mine else "flex-start"};max-width:88%">'
        f'<div style="font-size:11px;color:#6b7280;margin:0 4px;text-align:{"right" if mine else "left"}">'
        f"{escape(remark.who)}</div>"
        f'<div style="background:{back};color:{ink};border-radius:{corner};padding:6px 10px;overflow-wrap:anywhere">'
        f"{escape(remark.text)}</div></div>"
    )


def condition_html(condition: Condition) -> str:
    """State, place and health in one line, and the notice above it if there is one."""
    notice = (
        f'<div id="kirby-lost" role="alert" style="background:#7a1f1b;color:#fff;border-radius:8px;padding:7px 10px;'
        f'margin-bottom:6px">{escape(condition.notice)}</div>'
        if condition.notice
        else ""
    )
    lamps = _lamp("robot", condition.robot_alive) + _lamp("bridge", condition.bridge_alive)
    return (
        f'<div style="font:13px/1.4 system-ui,sans-serif;padding:6px 8px">{notice}'
        f'<div style="display:flex;gap:12px;align-items:center"><b id="kirby-state">{escape(condition.state)}</b>'
        f'<span style="flex:1"></span>{lamps}</div>'
        f'<div style="color:#6b7280">{escape(condition.place)}</div></div>'
    )


def _lamp(name: str, alive: bool) -> str:
    colour, word = ("#2f9e44", "ok") if alive else ("#d6312b", "gone")
    return (
        f'<span id="kirby-{name}" data-state="{word}" title="{name}: {word}">'
        f'<span style="color:{colour}">&#9679;</span> {name}</span>'
    )
