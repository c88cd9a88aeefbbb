"""hassil as the peer of the language benchmark: recognises a command and tells it in the corpus's terms."""

from __future__ import annotations

from typing import Any

from ._hassil_templates import EXPANSIONS, SKIP_WORDS, TEMPLATES, headings, numbers, units

TOLERANCE = 0.01

Step = dict[str, Any]


class Hassil:
    """The templates, compiled once."""

    def __init__(self) -> None:
        from hassil import Intents
        from hassil.intents import TextSlotList

        intents = {name: {"data": [{"sentences": sentences}]} for name, sentences in TEMPLATES.items()}
        self._intents = Intents.from_dict({"language": "en", "intents": intents, "expansion_rules": EXPANSIONS})
        self._lists: dict[str, Any] = {
            "number": TextSlotList.from_tuples(list(numbers().items())),
            "unit": TextSlotList.from_tuples(list(units().items())),
            "side": TextSlotList.from_strings(["left", "right"]),
            "heading": TextSlotList.from_tuples(list(headings().items())),
        }

    def recognise(self, text: str) -> Step | None:
        """The command as one step: ``{"kind": "turn", "dir": "left", "deg": 90}``; None where none fits."""
        from hassil import recognize

        found = recognize(text, self._intents, slot_lists=self._lists, skip_words=SKIP_WORDS)
        if found is None:
            return None
        slots = {name: entity.value for name, entity in found.entities.items()}
        return _step(found.intent.name, slots)


def _step(intent: str, slots: dict[str, Any]) -> Step:
    match intent:
        case "forward" | "back":
            return {"kind": intent, "metres": float(slots.get("number", 1.0)) * float(slots.get("unit", 1.0))}
        case "turn":
            return {"kind": "turn", "dir": slots.get("side"), "deg": float(slots.get("number", 90.0))}
        case "around":
            return {"kind": "turn", "dir": None, "deg": 180.0}
        case "face":
            return {"kind": "face", "heading": slots["heading"]}
        case _:
            return {"kind": {"picture": "image"}.get(intent, intent)}


def is_right(step: Step | None, gold: Step) -> bool:
    """Whether a recognised step is the gold one; a side that the gold leaves open may be either."""
    if step is None or step["kind"] != gold["kind"]:
        return False
    if step.get("heading") != gold.get("heading"):
        return False
    if gold.get("dir") is not None and step.get("dir") != gold["dir"]:
        return False
    return all(abs(step[name] - gold[name]) <= TOLERANCE * gold[name] for name in ("metres", "deg") if name in gold)
