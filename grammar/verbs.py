"""What a verb means with what was said along with it: light verbs, event nouns, arguments without a verb."""

from __future__ import annotations

from typing import Any

from voxml.terms import Form, Quantity, Term
from voxml.vocabulary import Lexicon, Reading

from .arguments import Arg, Args, ArgumentFitter, Kind
from .looking import is_angle, seen_at, turning_to
from .machine import Refused
from .phrase_actions import of_place
from .phrases import pred_of

REPEATS_MAX = 20
DEGREES_ALONE_MIN = 45
_GOING = frozenset({"go", "turn"})
_DIRECTIONS = (Kind.AXIS, Kind.SIDE, Kind.HEADING)
_VERBLESS = ("turn", "go", "sidestep")  # what arguments alone can mean
_LED = ("go", "turn")  # what they mean behind "can you"


class VerbActions:
    """The actions of rules with a verb. A method is the action of the rule that has its name."""

    def __init__(self, lexicon: Lexicon) -> None:
        self._lexicon = lexicon
        self._fitter = ArgumentFitter(lexicon)
        self._headings = frozenset(word.value for word in lexicon.closed.words_of("HEADING") if word.value is not None)

    def verb(self, readings: Any, args: Args = ()) -> Form:
        """A verb with its arguments; light verbs leave the meaning to their noun ("take a picture")."""
        events = [arg for arg in args if arg.kind is Kind.EVENT]
        rest = tuple(arg for arg in args if arg.kind is not Kind.EVENT)
        if any(each.readings != events[0].readings for each in events):
            raise Refused("one thing to do")
        if events and isinstance(readings, tuple) and _is_next(args):
            return Term("seq", (self._fitter.program(readings, rest), self._done(None, events[0], ())))
        if events and isinstance(readings, tuple) and not _may_be_object(args):
            raise Refused("the end")
        if events:
            return self._done(readings, events[0], rest)
        if not isinstance(readings, Term):
            return self._fitter.program(readings, rest)
        if not rest or (len(rest) == 1 and _is_small(rest[0])):
            raise Refused("what to do")
        if (opening := _opening(rest)) is not None:
            return Term("go", (Term("through", (opening,)),))
        return self._fitter.program(self._readings(*(pred_of(arg) for arg in readings.args)), rest)

    def verb_led(self, lead: Form, readings: Any, args: Args = ()) -> Form:
        return self.verb(readings, args)

    def verb_perfect(self, you: Form, have: Form, readings: Any, args: Args = ()) -> Form:
        """ "(once) you have turned right"."""
        return self.verb(readings, args)

    def verb_after(self, before: Args, readings: Any, args: Args = ()) -> Form:
        """ "forty five degrees turn right"."""
        if any(arg.kind in (Kind.PHRASE, Kind.EVENT, Kind.PATH) for arg in before):
            raise Refused("a verb first")
        return self.verb(readings, (*before, *args))

    def verb_sized(self, readings: Any, mark: Form, amount: Form, event: tuple[Reading, ...]) -> Form:
        """ "drive in a two metre square": the figure says what to do, the verb no more."""
        return self._fitter.program(event, (Arg(Kind.QUANTITY, amount),))

    def light_bare(self, lead: Form, args: Args) -> Form:
        """ "can you ... left ninety degrees"."""
        implied = self.verbless(args)
        return self.verb(self._readings(*_LED), args) if implied is None else implied

    def verbless(self, args: Args) -> Form | None:
        """What arguments without a verb say all of: a side with an angle, a way with a distance, two pictures."""
        event = next((arg for arg in args if arg.kind is Kind.EVENT), None)
        if event is not None and event.readings[0].entry.lex.pred in _GOING:
            return None  # "the robot moves" is nobody's order
        if event is not None:
            rest = tuple(arg for arg in args if arg.kind is not Kind.EVENT)
            looking = self._looking(event.readings, rest)
            if looking is None and all(arg.kind in (Kind.NUMBER, Kind.OF) for arg in rest):
                return self._done(None, event, rest)
            return looking
        said = self._fitter.implied(args, _VERBLESS)
        return self._in_turn(args) if said is None else said

    def _in_turn(self, args: Args) -> Form | None:
        """ "forward two feet, left forty five degrees": one thing to do for each direction."""
        starts = [at for at, arg in enumerate(args) if arg.kind in _DIRECTIONS]
        if len(starts) < 2 or starts[0]:
            return None
        ends = (*starts[1:], len(args))
        steps = [self._fitter.implied(args[at:end], _VERBLESS) for at, end in zip(starts, ends, strict=True)]
        return None if None in steps else Term("seq", tuple(step for step in steps if step is not None))

    def shown(self, show: Form, what: Form, be: Form, args: Args) -> Form:
        """ "show me what is behind you"."""
        return self._done(None, Arg(Kind.EVENT, show, self._readings(pred_of(show))), (of_place(args),))

    def shown_side(self, show: Form, side: Form) -> Form:
        """ "show me your left"."""
        return self._done(None, Arg(Kind.EVENT, show, self._readings(pred_of(show))), (Arg(Kind.SIDE, side),))

    def shown_view(self, show: Form, view: Form) -> Form:
        """ "show me what you see"."""
        return self._done(
            None, Arg(Kind.EVENT, show, self._readings(pred_of(show))), (Arg(Kind.OF, Term("of", (view,))),)
        )

    def nearing(self, readings: Any, closer: Form, what: Form) -> Form:
        """ "move closer to the table"."""
        return self.nearing_by(readings, (), closer, what)

    def nearing_by(self, readings: Any, args: Args, closer: Form, what: Form) -> Form:
        """ "move a little closer to the table"."""
        return self._fitter.program(self._readings(pred_of(closer)), (Arg(Kind.PHRASE, what), *args))

    def nearing_alone(self, closer: Form, what: Form) -> Form:
        return self.nearing_by((), (), closer, what)

    def nearing_alone_by(self, args: Args, closer: Form, what: Form) -> Form:
        return self.nearing_by((), args, closer, what)

    def _done(self, verb: Any, event: Arg, args: Args) -> Form:
        """What an event noun says, of a light verb or its own ("turn a ten degree angle"); "two pictures" are two."""
        meant = {reading.entry.lex.pred for reading in event.readings}
        if isinstance(verb, tuple) and meant.isdisjoint(reading.entry.lex.pred for reading in verb):
            return self._about(verb, event, args)
        if _is_of_something(event.readings):
            args = tuple(seen_at(arg) for arg in args)
        looking = self._looking(event.readings, args)
        if looking is not None:
            return looking
        times = [arg.form for arg in args if arg.kind is Kind.NUMBER]
        try:
            return self._fitter.program(event.readings, args)
        except Refused:
            if len(times) != 1 or isinstance(verb, tuple) or not _is_count(times[0]):
                raise
        once = self._fitter.program(event.readings, tuple(arg for arg in args if arg.kind is not Kind.NUMBER))
        return once if times[0] == Quantity(1) else Term("repeat", (times[0], once))

    def _about(self, verb: tuple[Reading, ...], event: Arg, args: Args) -> Form:
        """A verb whose object may be something that is done: "cancel the turn"."""
        if not any("any" in slot.types and slot.bare for reading in verb for slot in reading.entry.args):
            raise Refused("a thing or place")
        named = Term("the", (Term(event.readings[0].entry.lex.pred),))
        return self._fitter.program(verb, (Arg(Kind.PHRASE, named), *args))

    def _looking(self, event: tuple[Reading, ...], args: Args) -> Form | None:
        """The event with turning to where it is to be done; None where it is to be done here, or turns by itself."""
        turnings = [(arg, turning) for arg in args if (turning := turning_to(arg, self._headings)) is not None]
        turns = any("side" in slot.types for reading in event for slot in reading.entry.args)
        if len(turnings) != 1 or turns:
            return None
        where, turning = turnings[0]
        rest = tuple(arg for arg in args if arg is not where)
        amount = next((arg for arg in rest if is_angle(arg)), None)
        if amount is not None and where.kind is Kind.SIDE and _is_of_something(event):
            turning = Term("turn", (where.form, amount.form))  # "a picture ten degrees to your left"
            rest = tuple(arg for arg in rest if arg is not amount)
        return Term("seq", (turning, self._fitter.program(event, rest)))

    def _readings(self, *preds: str) -> tuple[Reading, ...]:
        return tuple(Reading(self._lexicon.programs[pred]) for pred in preds)


def _opening(args: Args) -> Form | None:
    """The opening that "(take) the second right" means."""
    match args:
        case (Arg(Kind.PHRASE, Term("the", (Term(ordering, (Term("one"), Term("on", (side,)))),))),):
            return Term("the", (Term(ordering, (Term("opening"), Term("on", (side,)))),))
    return None


def _may_be_object(args: Args) -> bool:
    """Whether an event noun stands where its verb's object does: "turn a ten degree angle", not "turn left, pivot"."""
    at = next(at for at, arg in enumerate(args) if arg.kind is Kind.EVENT)
    return at == 0 or args[at - 1].kind in (Kind.QUANTITY, Kind.NUMBER)


def _is_next(args: Args) -> bool:
    """Whether an event noun at the end is the next thing to do: "turn left forty degrees, photo"."""
    event = args[-1]
    return len(args) > 1 and event.kind is Kind.EVENT and event.readings[0].entry.lex.pred not in _GOING


def _is_of_something(event: tuple[Reading, ...]) -> bool:
    """Whether what is done is done of a thing or place, as a picture is."""
    return any("of" in slot.markers for reading in event for slot in reading.entry.args)


def _is_small(arg: Arg) -> bool:
    """Whether a number is too small to be an angle by itself: "do a one eighty", but not "take five"."""
    return arg.kind is Kind.NUMBER and isinstance(arg.form, Quantity) and arg.form.value < DEGREES_ALONE_MIN


def _is_count(form: Form) -> bool:
    return isinstance(form, Quantity) and form.value == int(form.value) and 1 <= form.value <= REPEATS_MAX
