"""What a verb means with what was said along with it: light verbs, event nouns, arguments without a verb."""

from __future__ import annotations

from typing import Any

from voxml.terms import Form, Quantity, Term
from voxml.vocabulary import Lexicon, Reading

from .arguments import Arg, Args, ArgumentFitter, Kind
from .machine import Refused
from .phrases import pred_of

REPEATS_MAX = 20
DEGREES_ALONE_MIN = 45
_SIDES = (Term("left"), Term("right"))
_BEHIND = Term("behind")
_VERBLESS = ("turn", "go", "sidestep")  # what arguments alone can mean
_LED = ("go", "turn")  # what they mean behind "can you"


class VerbActions:
    """The actions of rules with a verb. A method is the action of the rule that has its name."""

    def __init__(self, lexicon: Lexicon) -> None:
        self._lexicon = lexicon
        self._fitter = ArgumentFitter(lexicon)

    def verb(self, readings: Any, args: Args = ()) -> Form:
        """A verb with its arguments; light verbs leave the meaning to their noun ("take a picture")."""
        events = [arg for arg in args if arg.kind is Kind.EVENT]
        rest = tuple(arg for arg in args if arg.kind is not Kind.EVENT)
        if len(events) > 1:
            raise Refused("one thing to do")
        if events:
            return self._done(readings, events[0], rest)
        if not isinstance(readings, Term):
            return self._fitter.program(readings, rest)
        if not rest or (len(rest) == 1 and _is_small(rest[0])):
            raise Refused("what to do")
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
        events = [arg for arg in args if arg.kind is Kind.EVENT]
        if events and all(arg.kind in (Kind.EVENT, Kind.NUMBER, Kind.OF) for arg in args):
            return self._done(None, events[0], tuple(arg for arg in args if arg is not events[0]))
        return self._fitter.implied(args, _VERBLESS)

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
        """What is to be done towards a side begins with turning there: "take a picture to your left"."""
        sides = [arg for arg in args if arg.kind is Kind.SIDE or _side_of(arg) is not None]
        takes_side = any("side" in slot.types for reading in event for slot in reading.entry.args)
        if len(sides) != 1 or takes_side:
            return None
        side = sides[0].form if sides[0].kind is Kind.SIDE else _side_of(sides[0])
        turning = Term("turn_around") if side is None or side == _BEHIND else Term("turn", (side,))
        return Term("seq", (turning, self._fitter.program(event, tuple(arg for arg in args if arg not in sides))))

    def _readings(self, *preds: str) -> tuple[Reading, ...]:
        return tuple(Reading(self._lexicon.programs[pred]) for pred in preds)


def _side_of(arg: Arg) -> Form | None:
    """The side of "(a picture) of what is on your left" or "behind you"."""
    match arg.kind, arg.form:
        case Kind.OF, Term(_, (Term("on", (Term() as side,)),)) if side in _SIDES:
            return side
        case Kind.OF, Term(_, (Term("behind", (Term("you"),)),)):
            return _BEHIND
    return None


def _is_small(arg: Arg) -> bool:
    """Whether a number is too small to be an angle by itself: "do a one eighty", but not "take five"."""
    return arg.kind is Kind.NUMBER and isinstance(arg.form, Quantity) and arg.form.value < DEGREES_ALONE_MIN


def _is_count(form: Form) -> bool:
    return isinstance(form, Quantity) and form.value == int(form.value) and 1 <= form.value <= REPEATS_MAX
