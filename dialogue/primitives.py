"""The primitives of program bodies as commands of the robot (``docs/lexicon.md`` lists them).

Each follows the robot's ideal pose, as the robot itself does (RSB: a goal is computed from the ideal end of the one
before), so that "turn around and go to the first block" means the first one after turning.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from grammar.forms import Form, Quantity, Term, Unit
from grounding import Entity, Grounded, Heading, Reason, Unresolved, World, approach, resolve
from grounding.places import BEFORE, free_way_m, goal_place
from grounding.tours import tour
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

from .affordances import check_afforded, check_thing
from .plans import COMMANDS_MAX, Refusal, Refused, Stops
from .programs import is_amount, is_way

_ANGLE_STEP_DEG = 0.1  # what a turn that was computed is rounded to
_HOUR_DEG = 30.0
_QUARTER_DEG = 90.0
_PLACE_DECIMALS = 3
_LITTLE = {Unit.METRE: 0.3, Unit.DEGREE: 15.0}  # "a little": about the robot's own length, and a glance aside

Meant = Entity | Point | Heading


class Draft:
    """A plan in the making: the world as it will be when the next command begins, and the commands so far.

    ``world`` None is a world of which nothing is known: what leans on it is left unresolved.
    """

    def __init__(self, world: World | None, lexicon: Lexicon) -> None:
        self.is_known = world is not None
        self.world = world or World()
        self.lexicon = lexicon
        self.commands: list[Command] = []
        self.entities: list[Entity] = []
        self.places: list[Point] = []

    def add(self, command: Command) -> None:
        """One more command; the robot is where it ideally ends from here on."""
        if len(self.commands) == COMMANDS_MAX:
            raise Stops(Refused(Refusal.TOO_LONG, Quantity(COMMANDS_MAX)))
        self.commands.append(command)
        self.world = self.world.with_robot(ideal_end(self.world.robot, command))

    @property
    def moves(self) -> bool:
        """Whether the robot moves in what was planned so far."""
        return any(not isinstance(command, Control) for command in self.commands)

    def meant(self, form: Form) -> tuple[Meant, ...]:
        """The things, the place or the heading that a form means at this point of the plan."""
        outcome = resolve(form, self.world, self.lexicon)
        if not isinstance(outcome, Grounded):
            raise Stops(outcome)
        self.entities += [each for each in outcome.referents if isinstance(each, Entity)]
        self.places += [each for each in outcome.referents if isinstance(each, Point)]
        ids = tuple(each.id for each in outcome.referents if isinstance(each, Entity))
        self.world = self.world.speaking_of(ids)
        return outcome.referents

    # -------------------------------------------------------------- driving
    def translate(self, form: Term) -> None:
        """``translate([way,]distance)``: forward or back along the heading; towards a side or heading after turning."""
        ways = [term for term in _terms(form) if term not in (Term("forward"), Term("back"))]
        for way in ways:
            self.orient(Term("orient", (way,)))
        back = Term("back") in form.args
        distance_m = self._free_way_m(form, back) if Term("max") in form.args else _quantity(form, Unit.METRE, 1.0)
        _check_limit(form, distance_m, DISTANCE_MAX_M)
        if distance_m:
            self.add(GoForward(-distance_m if back else distance_m))

    def _free_way_m(self, form: Term, back: bool) -> float:
        """As far as the map lets the robot go."""
        if not self.is_known:
            raise Stops(Unresolved(Reason.NOTHING_FITS, form))
        heading = self.world.robot.turned(math.pi) if back else self.world.robot
        return round(free_way_m(heading, self.world.walls), 2)

    def rotate(self, form: Term) -> None:
        """``rotate([side,]angle)``: without a side only half and full turns say which way does not matter.

        A way that was pointed out is turned to, or, by another than the usual angle, only towards.
        """
        angle_deg = _quantity(form, Unit.DEGREE, _QUARTER_DEG)
        for way in (term for term in _terms(form) if is_way(term)):
            if angle_deg == _QUARTER_DEG:
                self._face(self.meant(way)[0])
            else:
                self.add(Turn(self._side_of(self.meant(way)[0]), angle_deg))
            return
        sides = [Side(term.pred) for term in _terms(form) if term.pred in ("left", "right")]
        if not sides and math.fmod(angle_deg, 180.0):
            raise Stops(Refused(Refusal.NO_SIDE, form))
        _check_limit(form, angle_deg, TURN_MAX_DEG)
        if angle_deg:
            self.add(Turn(sides[0] if sides else Side.LEFT, angle_deg))

    def orient(self, form: Term) -> None:
        """``orient(target)``: look along a heading or side, or at a thing or place."""
        (target,) = form.args
        if target in (Term("left"), Term("right")):
            assert isinstance(target, Term)
            self.add(Turn(Side(target.pred)))
        elif target == Term("back"):
            self.add(Turn(Side.LEFT, 180.0))
        elif isinstance(target, Term) and target.pred == "clock":
            self._face_hour(target)
        elif target != Term("forward"):
            self._face(self.meant(target)[0])

    def _face_hour(self, form: Term) -> None:
        """Look to an hour of a clock face that has twelve straight ahead."""
        right_deg = sum(hour.value for hour in form.args if isinstance(hour, Quantity)) % 12 * _HOUR_DEG
        if right_deg >= 180.0:
            self.add(Turn(Side.LEFT, 360.0 - right_deg))
        elif right_deg:
            self.add(Turn(Side.RIGHT, right_deg))

    def _side_of(self, target: Meant) -> Side:
        return Side.LEFT if self._off_deg(target) > 0 else Side.RIGHT

    def _off_deg(self, target: Meant) -> float:
        """How far to the left a target is of where the robot looks."""
        here = self.world.robot
        if isinstance(target, Heading):
            yaw_rad = target.yaw_rad
        else:
            yaw_rad = here.point.bearing_to(target.point if isinstance(target, Entity) else target)
        return math.degrees(wrap_angle(yaw_rad - here.yaw_rad))

    def _face(self, target: Meant) -> None:
        steps = round(self._off_deg(target) / _ANGLE_STEP_DEG)
        if steps:
            self.add(Turn(Side.LEFT if steps > 0 else Side.RIGHT, round(abs(steps) * _ANGLE_STEP_DEG, 1)))

    def reach(self, form: Term) -> None:
        """``reach(place)``: go there; before a thing, facing it at the end; to several things one after another."""
        goals = self._goals(form)
        entities = tuple(goal for goal in goals if isinstance(goal, Entity))
        for goal in tour(self.world.robot.point, entities) if len(goals) > 1 else goals:
            place = goal if isinstance(goal, Point) else self._stand(goal)
            _check_limit(form, max(abs(place.x_m), abs(place.y_m)), COORDINATE_MAX_M)
            self.add(GoTo(round(place.x_m, _PLACE_DECIMALS), round(place.y_m, _PLACE_DECIMALS)))
            if isinstance(goal, Entity) and any(goal.size_m):
                self._face(goal)

    def _stand(self, goal: Entity) -> Point:
        """Before a thing; on a place, which has no size."""
        return approach(goal, self.world.walls).point if any(goal.size_m) else goal.point

    def _goals(self, form: Term) -> tuple[Point | Entity, ...]:
        """The place to be at, or the things to stand before."""
        if not form.args:
            raise Stops(Refused(Refusal.WRONG_ARGUMENT, form))
        (goal,) = form.args
        if goal in (Term("here"), Term("to", (Term("here"),))):
            # To come here is to come to the speaker, whose place is not known.
            raise Stops(Unresolved(Reason.NEEDS_POINTING, Term("here")))
        relation = self.lexicon.relations.get(goal.pred) if isinstance(goal, Term) and goal.args else None
        if relation is None or not isinstance(goal, Term):
            return self._places_or_things(goal, form)
        for landmark in goal.args:
            check_afforded(goal.pred, landmark, self.lexicon)
        if relation.value in BEFORE and len(goal.args) == 1:
            return self._places_or_things(goal.args[0], form)
        landmarks = tuple(m for arg in goal.args for m in self.meant(arg) if isinstance(m, Entity))
        for thing in landmarks:
            check_thing(goal.pred, thing, self.lexicon)
        place = goal_place(relation.value, self.world, landmarks)
        if place is None:
            raise Stops(Refused(Refusal.NOT_ABLE, form))
        self.places.append(place)
        return (place,)

    def _places_or_things(self, goal: Form, form: Term) -> tuple[Point | Entity, ...]:
        meant = self.meant(goal)
        goals = tuple(each for each in meant if not isinstance(each, Heading))
        if len(goals) < len(meant):
            raise Stops(Refused(Refusal.WRONG_ARGUMENT, form))
        return goals

    # -------------------------------------------------------------- the rest
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
        """``picture``."""
        self.add(Control.TAKE_PICTURE)


PRIMITIVES: Mapping[str, Callable[[Draft, Term], None]] = {
    "translate": Draft.translate,
    "rotate": Draft.rotate,
    "orient": Draft.orient,
    "reach": Draft.reach,
    "patrol": Draft.patrol,
    "control": Draft.control,
    "picture": Draft.picture,
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
                raise Stops(Refused(Refusal.CONDITION, form))
    return otherwise


def _added(form: Form) -> Form:
    return form.args[0] if isinstance(form, Term) and form.pred == "more" and form.args else form


def _terms(form: Term) -> list[Term]:
    return [arg for arg in form.args if isinstance(arg, Term) and not is_amount(arg)]


def _check_limit(form: Form, value: float, limit: float) -> None:
    if not abs(value) <= limit:
        raise Stops(Refused(Refusal.BEYOND_LIMITS, form))
