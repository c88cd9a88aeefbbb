"""From a form to the robot's commands, through the bodies of the lexicon's programs.

A plan follows the robot's ideal pose from command to command, as the robot itself does (RSB: each goal is computed from
the ideal end of the one before), so that "turn around and go to the first block" means the first one after turning.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from enum import Enum

from grammar.forms import Form, Quantity, Term, Unit
from grounding import Ambiguous, Entity, Grounded, Heading, Reason, Resolution, Unresolved, World, approach, resolve
from grounding.places import BEFORE, goal_place
from robot.geometry import Point, wrap_angle
from robot.messages import (
    COORDINATE_MAX_M,
    DISTANCE_MAX_M,
    TURN_MAX_DEG,
    Command,
    Control,
    GoForward,
    GoTo,
    Patrol,
    Side,
    Turn,
    ideal_end,
)
from voxml.vocabulary import Lexicon

from .programs import bind, is_amount, substitute

COMMANDS_MAX = 100
"""In one utterance; more is more likely misunderstood than meant."""

_ANGLE_STEP_DEG = 0.1  # what a turn that was computed is rounded to
_PLACE_DECIMALS = 3
_LITTLE = {Unit.METRE: 0.3, Unit.DEGREE: 15.0}  # "a little": about the robot's own length, and a glance aside
_CONDITIONS = frozenset({"if", "when", "until"})


class Refusal(Enum):
    """Why something that was understood cannot be done."""

    UNKNOWN_PROGRAM = "unknown program"
    WRONG_ARGUMENT = "wrong argument"
    NO_SIDE = "no side"  # an angle without left or right
    NOT_ABLE = "not able"  # the robot has no such command
    CONDITION = "condition"  # an end or a condition that only what is met on the way can tell
    BEYOND_LIMITS = "beyond limits"
    TOO_LONG = "too long"


@dataclass(frozen=True, slots=True)
class Refused:
    """``form`` is the part that cannot be done."""

    reason: Refusal
    form: Form


@dataclass(frozen=True, slots=True)
class Plan:
    """What to send, and what it is about: the things and places that were meant, in the order of their mention."""

    commands: tuple[Command, ...]
    entities: tuple[Entity, ...] = ()
    places: tuple[Point, ...] = ()


Planning = Plan | Ambiguous | Unresolved | Refused


def plan(forms: tuple[Form, ...], world: World, lexicon: Lexicon) -> Planning:
    """The commands for ``forms`` one after another, for a robot that stands where ``world`` says when they begin.

    All or nothing: where one part cannot be resolved or done, that is the result.
    """
    planner = _Planner(world, lexicon)
    try:
        for form in forms:
            planner.run(form)
    except _Stops as stop:
        return stop.outcome
    return Plan(tuple(planner.commands), tuple(planner.entities), tuple(planner.places))


class _Stops(Exception):  # noqa: N818 - a result that ends planning early, never seen outside
    def __init__(self, outcome: Ambiguous | Unresolved | Refused) -> None:
        self.outcome = outcome


class _Planner:
    """A plan in the making: the world as it will be when the next command begins, and the commands so far."""

    def __init__(self, world: World, lexicon: Lexicon) -> None:
        self.world = world
        self.lexicon = lexicon
        self.commands: list[Command] = []
        self.entities: list[Entity] = []
        self.places: list[Point] = []

    # -------------------------------------------------------------- programs
    def run(self, form: Form) -> None:
        """Carry out a program, or an operator over programs."""
        if not isinstance(form, Term):
            raise _Stops(Refused(Refusal.UNKNOWN_PROGRAM, form))
        match form:
            case Term(pred="seq", args=parts):
                for part in parts:
                    self.run(part)
            case Term(pred="repeat", args=(Quantity(value=times), part)):
                for _ in range(min(int(times), COMMANDS_MAX + 1)):
                    self.run(part)
            case Term(pred="not", args=(_,)):
                pass  # what was forbidden is left undone
            case Term(pred=operator, args=(_, _, *_)) if operator in _CONDITIONS:
                raise _Stops(Refused(Refusal.CONDITION, form))
            case Term(pred=manner, args=(part,)) if self._is_manner(manner):
                self.run(part)  # the robot has one speed
            case _:
                self._unfold(form)

    def _is_manner(self, pred: str) -> bool:
        entry = self.lexicon.attributes.get(pred)
        return entry is not None and any("event" in arg.types for arg in entry.args)

    def _unfold(self, form: Term) -> None:
        """A program by its body."""
        entry = self.lexicon.programs.get(form.pred)
        if entry is None:
            raise _Stops(Refused(Refusal.UNKNOWN_PROGRAM, form))
        bound = bind(entry, form.args)
        if bound is None:
            raise _Stops(Refused(Refusal.WRONG_ARGUMENT, form))
        variables = frozenset(arg.variable for arg in entry.args)
        for step in entry.body:
            if not all(self._holds(guard.condition, bound) for guard in step.guards if guard.operator == "if"):
                continue
            if any(guard.operator == "while" for guard in step.guards):
                raise _Stops(Refused(Refusal.NOT_ABLE, form))
            try:
                self._event(substitute(step.event, bound, variables))
            except _Stops as stop:
                # What a primitive refuses is told of what was said.
                if isinstance(stop.outcome, Refused):
                    stop.outcome = replace(stop.outcome, form=form)
                raise

    def _event(self, event: Term) -> None:
        """A step of a body: a primitive, which may have the name of a verb ("patrol"), or else another program."""
        primitive = _PRIMITIVES.get(event.pred)
        if primitive is None:
            self._unfold(event)
        else:
            primitive(self, event)

    def _holds(self, condition: Term, bound: Mapping[str, Form]) -> bool:
        match condition:
            case Term(pred="not", args=(Term() as inner,)):
                return not self._holds(inner, bound)
            case Term(pred="bound", args=(Term(pred=variable),)):
                return variable in bound
            case Term(pred="known", args=(Term(pred=variable),)) if variable in bound:
                return not isinstance(resolve(bound[variable], self.world, self.lexicon), Unresolved)
            case _:
                raise _Stops(Refused(Refusal.NOT_ABLE, condition))

    # -------------------------------------------------------------- primitives
    def translate(self, form: Term) -> None:
        """``translate([way,]distance)``: forward or back along the heading; towards a side or heading after turning."""
        distance_m = _quantity(form, Unit.METRE, 1.0)
        for way in _terms(form):
            if way == Term("back"):
                distance_m = -distance_m
            elif way != Term("forward"):
                self.orient(Term("orient", (way,)))
        _check_limit(form, distance_m, DISTANCE_MAX_M)
        self.add(GoForward(distance_m))

    def rotate(self, form: Term) -> None:
        """``rotate([side,]angle)``: without a side only half and full turns say which way does not matter."""
        angle_deg = _quantity(form, Unit.DEGREE, 90.0)
        sides = [Side(term.pred) for term in _terms(form) if term.pred in ("left", "right")]
        if not sides and math.fmod(angle_deg, 180.0):
            raise _Stops(Refused(Refusal.NO_SIDE, form))
        _check_limit(form, angle_deg, TURN_MAX_DEG)
        self.add(Turn(sides[0] if sides else Side.LEFT, angle_deg))

    def orient(self, form: Term) -> None:
        """``orient(target)``: look along a heading or side, or at a thing or place."""
        (target,) = form.args
        if target in (Term("left"), Term("right")):
            assert isinstance(target, Term)
            self.add(Turn(Side(target.pred)))
        elif target == Term("back"):
            self.add(Turn(Side.LEFT, 180.0))
        elif target != Term("forward"):
            self._face(self._meant(target))

    def reach(self, form: Term) -> None:
        """``reach(place)``: go there; in front of a thing, and facing it at the end."""
        target = self._goal(form)
        place = target if isinstance(target, Point) else approach(target, self.world.walls).point
        _check_limit(form, max(abs(place.x_m), abs(place.y_m)), COORDINATE_MAX_M)
        self.add(GoTo(round(place.x_m, _PLACE_DECIMALS), round(place.y_m, _PLACE_DECIMALS)))
        if isinstance(target, Entity):
            self._face(target)

    def _goal(self, form: Term) -> Point | Entity:
        """The place to be at, or the thing to stand before."""
        (goal,) = form.args
        if goal in (Term("here"), Term("to", (Term("here"),))):
            # To come here is to come to the speaker, whose place is not known.
            raise _Stops(Unresolved(Reason.NEEDS_POINTING, Term("here")))
        relation = self.lexicon.relations.get(goal.pred) if isinstance(goal, Term) and goal.args else None
        if relation is None or not isinstance(goal, Term):
            return self._place_or_thing(goal, form)
        if relation.value in BEFORE and len(goal.args) == 1:
            return self._place_or_thing(goal.args[0], form)
        landmarks = tuple(m for arg in goal.args if isinstance(m := self._meant(arg), Entity))
        place = goal_place(relation.value, self.world.robot.point, landmarks)
        if place is None:
            raise _Stops(Refused(Refusal.NOT_ABLE, form))
        self.places.append(place)
        return place

    def _place_or_thing(self, goal: Form, form: Term) -> Point | Entity:
        target = self._meant(goal)
        if isinstance(target, Heading):
            raise _Stops(Refused(Refusal.WRONG_ARGUMENT, form))
        return target

    def patrol(self, form: Term) -> None:
        """``patrol([sides,radius,increment])``."""
        values = [arg.value for arg in form.args if isinstance(arg, Quantity)]
        self.add(Patrol(int(values[0]), *values[1:3]) if len(values) == 3 else Patrol())

    def control(self, form: Term) -> None:
        """``control(name)``: a command without arguments."""
        (name,) = form.args
        assert isinstance(name, Term)
        self.add(Control(name.pred.replace("_", " ")))

    def picture(self, form: Term) -> None:
        self.add(Control.TAKE_PICTURE)

    def refuse(self, form: Term) -> None:
        """For what the lexicon can say and the robot cannot do."""
        raise _Stops(Refused(Refusal.NOT_ABLE, form))

    # -------------------------------------------------------------- parts
    def _meant(self, form: Form) -> Entity | Point | Heading:
        """The one thing, place or heading that a form means at this point of the plan."""
        outcome: Resolution = resolve(form, self.world, self.lexicon)
        if not isinstance(outcome, Grounded):
            raise _Stops(outcome)
        if isinstance(outcome.one, Entity):
            self.entities.append(outcome.one)
            self.world = self.world.speaking_of((outcome.one.id,))
        elif isinstance(outcome.one, Point):
            self.places.append(outcome.one)
        return outcome.one

    def _face(self, target: Entity | Point | Heading) -> None:
        here = self.world.robot
        if isinstance(target, Heading):
            yaw_rad = target.yaw_rad
        else:
            yaw_rad = here.point.bearing_to(target.point if isinstance(target, Entity) else target)
        steps = round(math.degrees(wrap_angle(yaw_rad - here.yaw_rad)) / _ANGLE_STEP_DEG)
        if steps:
            self.add(Turn(Side.LEFT if steps > 0 else Side.RIGHT, round(abs(steps) * _ANGLE_STEP_DEG, 1)))

    def add(self, command: Command) -> None:
        """One more command; the robot is where it ideally ends from here on."""
        if len(self.commands) == COMMANDS_MAX:
            raise _Stops(Refused(Refusal.TOO_LONG, Quantity(COMMANDS_MAX)))
        self.commands.append(command)
        self.world = self.world.with_robot(ideal_end(self.world.robot, command))


_PRIMITIVES: Mapping[str, Callable[[_Planner, Term], None]] = {
    "translate": _Planner.translate,
    "rotate": _Planner.rotate,
    "orient": _Planner.orient,
    "reach": _Planner.reach,
    "patrol": _Planner.patrol,
    "control": _Planner.control,
    "picture": _Planner.picture,
    "wait": _Planner.refuse,
    "perceive": _Planner.refuse,
}


def _quantity(form: Term, unit: Unit, otherwise: float) -> float:
    """The amount of that unit among the arguments; "two more feet" are two feet, and "a little" is what it is here."""
    for arg in form.args:
        match amount := _added(arg):
            case Quantity(value) if amount.unit is unit:
                return value
            case Term("little"):
                return _LITTLE[unit]
            case Term("max"):
                raise _Stops(Refused(Refusal.CONDITION, form))
    return otherwise


def _added(form: Form) -> Form:
    return form.args[0] if isinstance(form, Term) and form.pred == "more" and form.args else form


def _terms(form: Term) -> list[Term]:
    return [arg for arg in form.args if isinstance(arg, Term) and not is_amount(arg)]


def _check_limit(form: Form, value: float, limit: float) -> None:
    if not abs(value) <= limit:
        raise _Stops(Refused(Refusal.BEYOND_LIMITS, form))
