"""What Kirby says, in English: descriptions, commands, refusals, questions."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from grammar.acts import NotUnderstood
from grammar.forms import Form, Name, Quantity, Term
from grounding import Entity, Reason, Unresolved, World
from grounding.descriptions import PLURAL
from grounding.ordering import ORDERINGS
from robot.geometry import Point, Pose, wrap_angle
from robot.messages import CancelCommand, Command, Control, GoForward, GoTo, Patrol, Side, Turn, format_number

from .plans import Refusal, Refused

_EXPECTED_MAX = 6
_UNITS = {"m": "meter", "deg": "degree", "s": "second"}


# ------------------------------------------------------------------ things
def name_entities(entities: Sequence[Entity], world: World) -> tuple[str, ...]:
    """A short name for each that tells it from the others: by its own name, looks, side, or fiducial."""
    for naming in (_plain_name, lambda entity: f"{_plain_name(entity)} on the {_side(entity, world)}", _exact_name):
        names = tuple(naming(entity) for entity in entities)
        if len(set(names)) == len(names):
            return names
    return tuple(f"{_plain_name(entity)} {entity.id}" for entity in entities)


def _plain_name(entity: Entity) -> str:
    return entity.names[0] if entity.names else " ".join(("the", *entity.attributes, _words(entity.type)))


def _exact_name(entity: Entity) -> str:
    if entity.fiducial_id is None or entity.type == "fiducial":
        return f"{_plain_name(entity)} {entity.id}"
    return f"{_plain_name(entity)} with fiducial {entity.fiducial_id}"


def _side(entity: Entity, world: World) -> str:
    return "left" if world.robot.to_local(entity.point).y_m > 0 else "right"


def listed(items: Sequence[str], word: str = "or") -> str:
    """``a``; ``a or b``; ``a, b or c``."""
    return items[0] if len(items) == 1 else f"{', '.join(items[:-1])} {word} {items[-1]}"


def which_one(candidates: Sequence[Entity], world: World) -> str:
    """The question that several things leave open."""
    return f"Which one: {listed(name_entities(candidates, world))}?"


# ------------------------------------------------------------------ forms
def phrase(form: Form) -> str:
    """A noun phrase in English: ``the(first(red(block),on(right)))`` -> ``the first red block on the right``."""
    match form:
        case Quantity(value=value, unit=unit):
            word = _UNITS.get(unit.value, "")
            return f"{format_number(value)} {word}{'' if value == 1 or not word else 's'}".strip()
        case Name(text=text):
            return text
        case Term(pred="entity" | "pointed"):
            return "that"
        case Term(pred="number", args=(Quantity() as number,)):
            return phrase(number)
        case Term(pred="on" | "to", args=(Term(pred="left" | "right" as side, args=()),)):
            return f"on the {side}"
        case Term(pred=pred, args=()):
            return _words(pred)
        case Term(pred="plural", args=(noun,)):
            return plural(phrase(noun))
        case Term(pred=pred, args=(first, *modifiers)):
            return _with_rest(pred, first, " ".join(phrase(m) for m in modifiers if not _is_pointing(m)), modifiers)
    raise AssertionError(form)


def _with_rest(pred: str, first: Form, rest: str, modifiers: Sequence[Form]) -> str:
    if pred == "count" or (pred == "the" and _is_numbered(modifiers)):
        return f"{phrase(first)} {rest}"
    noun = plural(phrase(first)) if pred in PLURAL and pred != "every" else phrase(first)
    return f"{_words(pred)} {noun} {rest}".strip()


def plural(noun: str) -> str:
    """``blocks``, ``boxes``, ``people``, by the rule."""
    if noun.endswith("person"):
        return f"{noun.removesuffix('person')}people"
    return f"{noun}es" if noun.endswith(("s", "x", "ch", "sh")) else f"{noun}s"


def _is_numbered(parts: Iterable[Form]) -> bool:
    return any(isinstance(part, Term) and part.pred == "number" for part in parts)


def _is_pointing(form: Form) -> bool:
    return isinstance(form, Term) and form.pred == "pointed"


def _indefinite(form: Form) -> str:
    """What one does not see: ``a purple block`` for ``the(purple(block))``."""
    if isinstance(form, Term) and form.pred in ("the", "a", "this", "that", "some", "any") and form.args:
        core = form.args[0]
        if _is_pointing(core):
            return "anything"
        if not (isinstance(core, Term) and core.pred in ORDERINGS):
            rest = phrase(Term("the", form.args)).removeprefix("the ")
            return rest if _is_numbered(form.args) else f"{'an' if rest[0] in 'aeiou' else 'a'} {rest}"
    return phrase(form)


def _words(pred: str) -> str:
    return pred.replace("_", " ")


# ------------------------------------------------------------------ commands
def command_words(command: Command) -> str:
    """What a command does, as an order: ``turn left 90 degrees``."""
    match command:
        case GoForward(distance_m) if distance_m < 0:
            return f"go back {_metres(-distance_m)}"
        case GoForward(distance_m):
            return f"go forward {_metres(distance_m)}"
        case GoTo(x_m, y_m):
            return f"go to ({format_number(round(x_m, 2))}, {format_number(round(y_m, 2))})"
        case Turn(side, angle_deg):
            return f"turn {side.value} {format_number(angle_deg)} degrees"
        case Patrol(sides, radius_m, increment_m):
            return f"patrol in {sides} sides from {_metres(radius_m)} by {_metres(increment_m)}"
        case Control():
            return command.value
        case CancelCommand():
            return "cancel one command"


def turned(command: Turn) -> str:
    """Said when a turn is done."""
    return f"turned {'left' if command.side is Side.LEFT else 'right'} {format_number(command.angle_deg)} degrees"


def _metres(distance_m: float) -> str:
    return f"{format_number(distance_m)} meter{'' if distance_m == 1 else 's'}"


# ------------------------------------------------------------------ places
def metres(distance_m: float) -> str:
    """A measured distance, to the hand's breadth that a map is good for: ``2.3 meters``, ``0.24 meters``."""
    rough_m = round(distance_m, 1)
    return _metres(rough_m if rough_m >= 1 else round(distance_m, 2))


def place_words(place: Point) -> str:
    """A place on the map: ``(2.1, -0.5)``."""
    return f"({format_number(round(place.x_m, 2))}, {format_number(round(place.y_m, 2))})"


_AHEAD_DEG = 20.0
_BESIDE_DEG = 70.0


def direction(robot: Pose, place: Point) -> str:
    """Which way from the robot: ``ahead``, ``ahead on the right``, ``on the left``, ``behind on the right``."""
    angle_deg = math.degrees(wrap_angle(robot.point.bearing_to(place) - robot.yaw_rad))
    along = "ahead" if abs(angle_deg) < _BESIDE_DEG else "behind" if abs(angle_deg) > 180 - _BESIDE_DEG else ""
    if abs(angle_deg) <= _AHEAD_DEG or abs(angle_deg) >= 180 - _AHEAD_DEG:
        return along
    return f"{along} on the {'left' if angle_deg > 0 else 'right'}".strip()


# ------------------------------------------------------------------ refusals
def not_understood(text: str, failure: NotUnderstood) -> str:
    """Where it went wrong, what could have stood there, and the nearest known thing."""
    begin, end = failure.span
    said = f"I didn't understand '{text[begin:end]}'" if text[begin:end].strip() else "I didn't understand"
    more = len(failure.expected) - _EXPECTED_MAX
    expected = list(failure.expected[:_EXPECTED_MAX]) + ([f"{more} more"] if more > 0 else [])
    hint = f": I expected {listed(expected).rstrip(' .')}" if expected else ""
    nearest = f" Did you mean '{failure.nearest}'?" if failure.nearest else ""
    return f"{said}{hint}.{nearest}"


def unmet(condition: Term) -> str:
    """Said when what was to happen on the way did not."""
    if condition.pred in ("see", "perceive", "find", "exists") and condition.args:
        return f"I did not find {phrase(condition.args[-1])}."
    return f"I have come to an end before it was so: {phrase(condition)}."


_REFUSALS = {
    Refusal.UNKNOWN_PROGRAM: "I don't know how to {}.",
    Refusal.WRONG_ARGUMENT: "I can't {}.",
    Refusal.NO_SIDE: "Which way shall I turn: left or right?",
    Refusal.NOT_ABLE: "I am not able to {}.",
    Refusal.CONDITION: "I can't tell in advance when to {}.",
    Refusal.BEYOND_LIMITS: "That is too far for me: {}.",
    Refusal.TOO_LONG: "That is too much at once: at most {} commands.",
}


def refused(refusal: Refused) -> str:
    """Why it cannot be done."""
    match refusal:
        case Refused(Refusal.NOT_AFFORDED, Term(pred=way, args=(thing,))):
            return f"I can't go {_words(way)} {_indefinite(thing)}."
        case Refused(Refusal.NO_PART, Term(pred=part, args=(wanted,))):
            few = "" if part.endswith("s") else "an " if part[0] in "aeiou" else "a "
            return f"I can't {phrase(wanted)}: that takes {few}{_words(part)}."
    return _REFUSALS[refusal.reason].format(phrase(refusal.form))


def unresolved(failure: Unresolved) -> str:
    """Why nothing is meant."""
    match failure.reason:
        case Reason.NOTHING_FITS:
            return f"I don't see {_indefinite(failure.form)}."
        case Reason.TOO_FEW if not failure.count:
            return f"I don't see {phrase(failure.form)}."
        case Reason.TOO_FEW:
            return f"I don't see {phrase(failure.form)}: there {_there_are(failure.count)}."
        case Reason.POINTED_ELSEWHERE:
            return f"I don't see {_indefinite(failure.form)} where you point."
        case Reason.NEEDS_POINTING:
            return "Where? Please point there."
        case Reason.NO_ANTECEDENT:
            return f"What do you mean by '{phrase(failure.form)}'?"
        case Reason.NOT_A_PLACE:
            return f"I can't tell where '{phrase(failure.form)}' is."


def _there_are(count: int) -> str:
    return f"{'is' if count == 1 else 'are'} only {count}"
