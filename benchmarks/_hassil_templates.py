"""Templates for hassil, the sentence matcher of Home Assistant: the peer of the language benchmark.

Written for plain commands as people give them to a mobile robot: amounts of way and turn, headings, pictures, stopping.
"""

from __future__ import annotations

_UNITS = {
    "feet": 0.3048, "foot": 0.3048, "meters": 1.0, "meter": 1.0, "metres": 1.0, "metre": 1.0, "inches": 0.0254,
    "inch": 0.0254, "yards": 0.9144, "yard": 0.9144, "centimeters": 0.01, "steps": 0.75, "step": 0.75,
}  # fmt: skip
_HEADINGS = ("northeast", "northwest", "southeast", "southwest", "north", "south", "east", "west")
_HEADING_WORDS = {"north east": "northeast", "north west": "northwest", "south east": "southeast",
                  "south west": "southwest"}  # fmt: skip

TEMPLATES: dict[str, list[str]] = {
    "forward": [
        "<polite> (<move>|<move> <ahead>) <about> <amount> [<ahead>|to the front] <end>",
        "<polite> <ahead> <about> <amount> <end>",
        "<polite> <about> <amount> <ahead> <end>",
        "<polite> <move> <ahead> <end>",
    ],
    "back": [
        "<polite> (<move> <backward>|back up|backup|reverse|back|<backward>) [up] <about> <amount> <end>",
        "<polite> <move> <about> <amount> <backward> <end>",
        "<polite> <about> <amount> <backward> <end>",
        "<polite> (<move> <backward>|back up|reverse) <end>",
    ],
    "turn": [
        "<polite> [<turn>] <side> <about> <degrees> <end>",
        "<polite> [<turn>] <about> <degrees> <side> <end>",
        "<polite> <turn> <about> <degrees> <end>",
        "<polite> (<turn>|make a|take a) <side> [turn] <end>",
        "<polite> (make|do|take|turn) (a|another) <degrees> [turn|rotation|spin|angle] [<side>] <end>",
        "<polite> (make|do) (a|another) <degrees> <side> [turn] <end>",
        "<polite> <turn> around <degrees> [<side>] <end>",
        "<polite> (make|do|turn|rotate) [a] {number} [degree] [turn] <end>",
    ],
    "around": [
        "<polite> (turn|spin|rotate) (around|all the way around) <end>",
        "<polite> (make|do) a (u turn|one eighty|full turn) <end>",
    ],
    "face": ["<polite> (<turn>|face|<turn> to face|<turn> to|<turn> towards|turn to the) [due|the] {heading} <end>"],
    "picture": [
        "<polite> (take|send|get|snap|show|give) [me] (a|another|one more|the) (picture|photo|image) [there] <end>",
        "<polite> (picture|photo|image) [please]",
        "<polite> [take] another (picture|photo|image) <end>",
    ],
    "stop": ["<polite> (stop|halt|freeze) [stop] [there|right there|now|moving] <end>"],
    "cancel": ["<polite> (cancel|never mind|nevermind|abort|disregard) [that|the|last|command] <end>"],
}

EXPANSIONS: dict[str, str] = {
    "polite": "[okay|ok|alright|now|then|and|so|uh|um|robot|kirby] [please|now|uh] "
    "[can you|could you|would you|i want you to|i need you to|i would like you to|let's|you can|go ahead and] [please]",
    "end": "[please|now|thank you|again|from there|from here]",
    "about": "[about|another|an additional|approximately|by|exactly|just]",
    "move": "(move|move up|moving|step|go|drive|proceed|travel|head|walk|come|continue|advance|keep going|roll)",
    "ahead": "(forward|forwards|straight|ahead|straight ahead|straight forward)",
    "backward": "(back|backward|backwards|in reverse)",
    "turn": "(turn|turn around|turn round|move up|rotate|pivot|spin|move|face|go)",
    "amount": "{number} [more|additional] {unit} [more]",
    "degrees": "{number} [more] (degree|degrees|deg) [angle] [more]",
    "side": "[to the|to your|towards the|toward the|to|towards your|on your] {side} [side|hand side]",
}


def units() -> dict[str, float]:
    """Names of lengths, in metres."""
    return dict(_UNITS)


def headings() -> dict[str, str]:
    """How headings are said, and which they are."""
    return {**{name: name for name in _HEADINGS}, **_HEADING_WORDS}


SKIP_WORDS = ["uh", "uhh", "um", "umm", "er", "like", "maybe", "at least", "robot", "okay", "please"]

_ONES = [
    "zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve",
    "thirteen", "fourteen", "fifteen", "sixteen", "seventeen", "eighteen", "nineteen",
]  # fmt: skip
_TENS = {20: "twenty", 30: "thirty", 40: "forty", 50: "fifty", 60: "sixty", 70: "seventy", 80: "eighty", 90: "ninety"}
_HUNDREDS_MAX = 4


def numbers() -> dict[str, float]:
    """Every way in which an amount of a command is said: "a hundred and eighty", "one eighty", "five and a half"."""
    below = {_below_hundred(value): float(value) for value in range(100)}
    found = dict(below)
    for hundreds in range(1, _HUNDREDS_MAX):
        names = [f"{_ONES[hundreds]} hundred"] + (["a hundred"] if hundreds == 1 else [])
        for name in names:
            found[name] = 100.0 * hundreds
            for rest, value in below.items():
                found[f"{name} {rest}"] = found[f"{name} and {rest}"] = 100.0 * hundreds + value
        found.update({f"{_ONES[hundreds]} {rest}": 100.0 * hundreds + v for rest, v in below.items() if v >= 10})
    for value in range(1, 20):
        found[f"{_ONES[value]} and a half"] = value + 0.5
    tenths = {f"{_ONES[whole]} point {_ONES[digit]}": whole + digit / 10 for whole in range(10) for digit in range(10)}
    found.update({**tenths, **{str(value): float(value) for value in range(361)}})
    return {**found, "half a": 0.5, "a half a": 0.5, "a": 1.0, "a hundred": 100.0}


def _below_hundred(value: int) -> str:
    if value < 20:
        return _ONES[value]
    tens, ones = value - value % 10, value % 10
    return f"{_TENS[tens]} {_ONES[ones]}" if ones else _TENS[tens]
