"""What each rule of the grammar means: the actions of the automaton, by the rule's name in the ``.lark`` file."""

from __future__ import annotations

from typing import Any

from voxml.terms import Form, Quantity, Term, Unit
from voxml.vocabulary import Lexicon, Reading

from . import phrases
from .acts import Function
from .arguments import Arg, Args, ArgumentFitter, Kind
from .machine import Action, Refused
from .phrases import YOU, Nominal, Pre, Such

Act = tuple[Function, Form]
_ALONE = frozenset({"through", "out_of", "past", "across", "around", "along", "over", "down", "up"})
REPEATS_MAX = 20
SIDES = (Term("left"), Term("right"))
BEHIND = Term("behind")
_IMPLIED = ("turn", "go", "sidestep")


class Meaning:
    """The actions over one lexicon. A method is the action of the rule that has its name."""

    def __init__(self, lexicon: Lexicon) -> None:
        self._fitter = ArgumentFitter(lexicon)
        self._lexicon = lexicon
        self._indefinite = frozenset(lexicon.closed.table("INDEFINITE"))

    def action(self, rule: str) -> Action | None:
        """The action of a rule; None for one that has none."""
        return _PLAIN.get(rule) or getattr(self, rule, None)

    # ------------------------------------------------------------ acts
    def act_fragment(self, args: Args) -> Act:
        """ "ninety degrees" leans on what went before; "left ninety degrees" says all of an instruction."""
        implied = self._fitter.implied(args, _IMPLIED)
        if implied is not None:
            return Function.INSTRUCT, implied
        if len(args) != 1 or args[0].kind in (Kind.EVENT, Kind.OF):
            if len(args) == 1 and args[0].readings:
                return Function.INSTRUCT, self._fitter.program(args[0].readings, ())
            raise Refused("a verb")
        arg = args[0]
        return Function.FRAGMENT, Term("repeat", (arg.form,)) if arg.kind is Kind.REPEAT else arg.form

    def act_halt(self, value: Form) -> Act:
        return Function.INSTRUCT, Term("stop")

    def act_same(self, again: Form, args: Args) -> Act:
        return Function.FRAGMENT, Term("again", tuple(arg.form for arg in args))

    def act_forbid(self, no: Form, what: Form) -> Act:
        return Function.INSTRUCT, Term("not", (what,))

    # ------------------------------------------------------------ verbs
    def verb(self, readings: Any, args: Args = ()) -> Form:
        """A verb with its arguments; light verbs leave the meaning to their noun ("take a picture")."""
        events = [arg for arg in args if arg.kind is Kind.EVENT]
        rest = tuple(arg for arg in args if arg.kind is not Kind.EVENT)
        if len(events) > 1:
            raise Refused("one thing to do")
        if events:
            return self._done(readings, events[0].readings, rest)
        if isinstance(readings, Term):
            if not rest:
                raise Refused("what to do")
            readings = tuple(
                Reading(self._lexicon.programs[arg.pred]) for arg in readings.args if isinstance(arg, Term)
            )
        return self._fitter.program(readings, rest)

    def _done(self, verb: Any, event: tuple[Reading, ...], args: Args) -> Form:
        """What an event noun says, of a light verb or its own ("turn a ten degree angle"); "two pictures" are two."""
        meant = {each.entry.lex.pred for each in event}
        if isinstance(verb, tuple) and meant.isdisjoint(each.entry.lex.pred for each in verb):
            raise Refused("a thing or place")
        times = [arg.form for arg in args if arg.kind is Kind.NUMBER]
        looking = self._looking(event, args)
        if looking is not None:
            return looking
        try:
            return self._fitter.program(event, args)
        except Refused:
            if len(times) != 1 or isinstance(verb, tuple) or not _is_count(times[0]):
                raise
        once = self._fitter.program(event, tuple(arg for arg in args if arg.kind is not Kind.NUMBER))
        return once if times[0] == Quantity(1) else Term("repeat", (times[0], once))

    def _looking(self, event: tuple[Reading, ...], args: Args) -> Form | None:
        """What is to be done towards a side begins with turning there: "take a picture to your left"."""
        sides = [arg for arg in args if arg.kind is Kind.SIDE or _side_of(arg) is not None]
        takes_side = any("side" in slot.types for reading in event for slot in reading.entry.args)
        if len(sides) != 1 or takes_side:
            return None
        side = sides[0].form if sides[0].kind is Kind.SIDE else _side_of(sides[0])
        turning = Term("turn_around") if side is None or side == BEHIND else Term("turn", (side,))
        return Term("seq", (turning, self._fitter.program(event, tuple(arg for arg in args if arg not in sides))))

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

    def light_bare(self, lead: Form, args: Args) -> Form:
        """ "can you ... left ninety degrees"."""
        implied = self._fitter.implied(args, _IMPLIED)
        if implied is None:
            return self.verb(tuple(Reading(self._lexicon.programs[pred]) for pred in ("go", "turn")), args)
        return implied

    # ------------------------------------------------------------ arguments
    def path(self, relation: Form, place: Form) -> Arg:
        return Arg(Kind.PATH, phrases.relation(relation, place))

    def path_alone(self, relation: Form) -> Arg:
        """ "go through", "go around": a way without what it leads past; "go to" wants its place."""
        if _pred(relation) not in _ALONE:
            raise Refused("a thing or place")
        return Arg(Kind.PATH, relation)

    def path_point(self, relation: Form, x: Quantity, y: Quantity) -> Arg:
        """ "to 2 3", "to coordinates 2 3": a place on the map."""
        point = Term("point", (Quantity(x.value, Unit.METRE), Quantity(y.value, Unit.METRE)))
        return Arg(Kind.PATH, Term(_pred(relation), (point,)))

    def event(self, readings: tuple[Reading, ...]) -> Arg:
        return Arg(Kind.EVENT, Term("event"), readings)

    def of_what(self, of: Form, what: Form, be: Form, args: Args) -> Arg:
        """ "(a picture) of what is on your left"."""
        where = args[0].form
        return Arg(Kind.OF, Term("of", (_where(args[0].kind, where),)))

    # ------------------------------------------------------------ conditions
    def seeing(self, who: Form, see: Form, what: Form) -> Form:
        return Term(_pred(see), (what,))

    def done_verb(self, readings: tuple[Reading, ...]) -> Form:
        return Term("done", (Term(readings[0].entry.lex.pred),))

    # ------------------------------------------------------------ questions
    def q_see_where(self, see: Form, args: Args) -> Form:
        return Term("see", (Term("what"), *(_where(arg.kind, arg.form) for arg in args)))

    def q_form(self, form: Form, args: Args = ()) -> Form:
        return form

    def q_count(self, how_many: Form, what: Nominal, *rest: Any) -> Form:
        return Term("count", (what.described(), *what.modifiers))

    def q_count_where(self, how_many: Form, what: Nominal, be: Form, posts: tuple[Form, ...]) -> Form:
        return Term("count", (what.described(), *what.modifiers, *phrases.places(posts)))

    def q_what_kind(self, what: Form, kind: Nominal, be: Form, posts: tuple[Form, ...]) -> Form:
        return Term("see", (phrases.phrase(Term("what"), kind), *phrases.places(posts)))

    def q_exists(self, there: Form, what: Form) -> Form:
        """ "is there anything on your left" asks as "is there anything" does, of a place."""
        if isinstance(what, Term) and what.pred in self._indefinite:
            return Term("exists", (Term(what.pred), *what.args))
        return Term("exists", (what,))

    def q_is_last(self, be: Form, determiner: Form, what: Nominal) -> Form:
        """ "is the block on the left": what was taken for a modifier is asked about."""
        return Term("is", phrases.without_last(phrases.phrase(determiner, what)))

    def q_which_ordered(self, which: Form, kind: Nominal, be: Form, ordering: Form) -> Form:
        """ "which door is nearest": the same as which is the nearest door."""
        return phrases.phrase(Term("which"), phrases.ordered(kind, ordering))

    def q_which_where(self, which: Form, kind: Nominal, be: Form, posts: tuple[Form, ...]) -> Form:
        return Term("see", (phrases.phrase(Term("which"), kind), *phrases.places(posts)))

    def q_see_kind(self, what: Form, kind: Nominal, see: Form) -> Form:
        return Term("see", (phrases.phrase(Term("what"), kind),))


def _pred(form: Form) -> str:
    assert isinstance(form, Term), form
    return form.pred


def _side_of(arg: Arg) -> Form | None:
    """The side of "(a picture) of what is on your left" or "behind you"."""
    match arg.kind, arg.form:
        case Kind.OF, Term(_, (Term("on", (Term() as side,)),)) if side in SIDES:
            return side
        case Kind.OF, Term(_, (Term("behind", (Term("you"),)),)):
            return BEHIND
    return None


def _is_count(form: Form) -> bool:
    return isinstance(form, Quantity) and form.value == int(form.value) and 1 <= form.value <= REPEATS_MAX


def _where(kind: Kind, form: Form) -> Form:
    """A place as a modifier: "on your left" is ``on(left)``."""
    if kind is Kind.SIDE:
        return phrases.on_side(form)
    if kind is Kind.AXIS:
        return phrases.ahead(form)
    return form


def _second(first: Any, second: Any, *rest: Any) -> Any:
    return second


def _arg(kind: Kind) -> Action:
    return lambda form: Arg(kind, form)


def _of(kind: Function) -> Action:
    return lambda form: (kind, form)


def _says(kind: Function, pred: str) -> Action:
    return lambda form: (kind, Term(pred))


def _holds(operator: str) -> Action:
    return lambda marker, condition, core: Term(operator if operator != "if" else _pred(marker), (condition, core))


_PLAIN: dict[str, Action] = {
    # acts
    "act_instruct": _of(Function.INSTRUCT),
    "act_question": _of(Function.QUESTION),
    "act_rather": lambda mark, wrong, separator, right: (Function.CORRECT, right[0].form),
    "act_rather_first": lambda right, separator, mark, wrong: (Function.CORRECT, right[0].form),
    "act_not": lambda mark, wrong: (Function.CORRECT, Term("not", (wrong[0].form,))),
    "stopping": lambda *said: Term("stop"),
    "act_until": lambda marker, condition: (Function.FRAGMENT, Term("until", (condition,))),
    "act_inform": _of(Function.INFORM),
    "act_confirm": _says(Function.CONFIRM, "yes"),
    "act_deny": _says(Function.DENY, "no"),
    "act_greet": _of(Function.GREET),
    "act_thank": _of(Function.THANK),
    "act_bye": _of(Function.BYE),
    "act_acknowledge": _of(Function.ACKNOWLEDGE),
    "act_praise": lambda praise, event: (Function.ACKNOWLEDGE, Term("ok")),
    "act_again": _says(Function.FRAGMENT, "again"),
    "act_answer": _of(Function.ANSWER),
    # commands
    "conditional": _holds("if"),
    "conditional_marked": lambda marker, condition, mark, core: Term(_pred(marker), (condition, core)),
    "conditional_marked2": lambda marker, condition, mark, then, core: Term(_pred(marker), (condition, core)),
    "conditional_after": lambda core, marker, condition: Term(_pred(marker), (condition, core)),
    "until": lambda core, marker, condition: Term("until", (condition, core)),
    "until_first": lambda marker, condition, core: Term("until", (condition, core)),
    "until_first_marked": lambda marker, condition, mark, core: Term("until", (condition, core)),
    "naming": lambda call, what, name: Term("name", (what, name)),
    "naming_as": lambda call, what, mark, name: Term("name", (what, name)),
    "before_first": lambda before, later, core: Term("seq", (core, later)),
    "before_first_marked": lambda before, later, mark, core: Term("seq", (core, later)),
    "before_last": lambda core, before, later: Term("seq", (core, later)),
    "after_first": lambda after, first, core: Term("seq", (first, core)),
    "after_first_marked": lambda after, first, mark, core: Term("seq", (first, core)),
    "after_last": lambda core, after, first: Term("seq", (first, core)),
    # arguments
    "second": _second,
    "fourth": lambda first, second, third, fourth: fourth,
    "first": lambda arg: (arg,),
    "first_np": lambda form: (Arg(Kind.PHRASE, form),),
    "more": lambda args, arg: (*args, arg),
    "axis": _arg(Kind.AXIS),
    "side": _arg(Kind.SIDE),
    "arg_heading": _arg(Kind.HEADING),
    "quantity": _arg(Kind.QUANTITY),
    "quantity_more": _arg(Kind.QUANTITY),
    "vague": _arg(Kind.VAGUE),
    "number": _arg(Kind.NUMBER),
    "times": lambda number, times: Arg(Kind.REPEAT, number),
    "repeat": _arg(Kind.REPEAT),
    "path_place": lambda relation, place: Arg(Kind.PATH, Term(_pred(relation), (place,))),
    "path_axis": lambda relation, axis: Arg(Kind.AXIS, axis),
    "place": _arg(Kind.PLACE),
    "location": lambda relation, place: Arg(Kind.LOCATION, phrases.relation(relation, place)),
    "facing": lambda facing, what: Arg(Kind.FACING, Term("facing", (what,))),
    "facing_heading": lambda facing, what: Arg(Kind.FACING, Term("facing", (what,))),
    "of": lambda of, what: Arg(Kind.OF, Term("of", (what,))),
    "of_quantity": lambda of, amount: Arg(Kind.QUANTITY, amount),
    "of_view": lambda of, view, *place: Arg(Kind.OF, Term("of", (view,))),
    "manner": _arg(Kind.MANNER),
    "way": lambda demonstrative, way: Arg(Kind.WAY, Term(_pred(demonstrative), (Term("way"),))),
    "opposite": _arg(Kind.WAY),
    "first_of_two": lambda heading, way: heading,
    # noun phrases
    "both": lambda one, mark, other: Term("and", (one, other)),
    "alternatives": lambda one, mark, other: Term("or", (one, other)),
    "determined": phrases.phrase,
    "demonstrative": lambda form: form,
    "bare": phrases.bare_phrase,
    "pronoun": lambda form: form,
    "indefinite": lambda form, posts: Term(_pred(form), phrases.places(posts)),
    "nominal": phrases.nominal,
    "nominal_post": lambda noun, posts: phrases.nominal(noun, (), posts),
    "nominal_pre": lambda pres, noun: phrases.nominal(noun, pres),
    "nominal_around": lambda pres, noun, others, posts=(): phrases.nominal(noun, (*pres, *others), posts),
    "nominal_pre_post": lambda pres, noun, posts: phrases.nominal(noun, pres, posts),
    "headless": phrases.headless,
    "headless_post": phrases.headless,
    "compound": phrases.compound,
    "one_pre": lambda pre: (pre,),
    "more_pres": lambda pres, pre: (*pres, pre),
    "more_pres_marked": lambda pres, mark, pre: (*pres, pre),
    "more_pres_or": lambda pres, mark, pre: (*pres, pre),
    "ordinal": lambda form: Pre(form, True),
    "cardinal": lambda form: Pre(form, True),
    "adjective": lambda form: Pre(form, False),
    "one_post": lambda post: (post,),
    "more_posts": lambda posts, post: (*posts, post),
    "relation": phrases.relation,
    "relation_of_two": phrases.relation_of_two,
    "relation_you": lambda relation, you: Term(_pred(relation), (YOU,)),
    "on_side": phrases.on_side,
    "ahead": phrases.ahead,
    "relation_heading": lambda facing, heading: Term("facing", (heading,)),
    "numbered": lambda mark, number: Term("number", (number,)),
    "numbered_bare": lambda number: Term("number", (number,)),
    "toward_heading": lambda mark, heading: Term("to", (heading,)),
    "at_place": lambda place: place,
    "that_facing": lambda *parts: Term("in_front_of", (YOU,)),
    "that_such": lambda that, quality: Such(quality),
    "that_seen": lambda *parts: Term("visible"),
    "where_thing": lambda that, thing, be, *post: Term("with", (thing, *post)),
    "where_seen": lambda that, you, see, thing: Term("with", (thing,)),
    # conditions
    "existing": lambda there, what: Term("exists", (what,)),
    "being": lambda what, be, where: Term("is", (what, where)),
    "you_being": lambda you, be, where: Term("is", (YOU, where)),
    # questions
    "q_where": lambda where, what: Term("where", (what,)),
    "q_where_you": lambda where, you: Term("where", (YOU,)),
    "q_exists_any": lambda there, posts: Term("exists", (Term("anything"), *phrases.places(posts))),
    "q_see": lambda see, what: Term("exists", (what,)),
    "q_far": lambda far, what: Term("distance", (what,)),
    "q_far_place": lambda far, place: Term("distance", (place,)),
    "q_property": lambda kind, what: Term(_pred(kind), (what,)),
    "q_what": lambda what, be, thing: Term("what", (thing,)),
    "q_what_where": lambda what, be, posts: Term("see", (Term("what"), *phrases.places(posts))),
    "q_is": lambda be, this, what: Term("is", (this, what)),
    "q_is_where": lambda be, what, where: Term("is", (what, where)),
    "q_know_what": lambda know, what, thing, be: Term("what", (thing,)),
    "q_know_where": lambda know, where, thing, be: Term("where", (thing,)),
    "q_know_far": lambda know, far, thing, be: Term("distance", (thing,)),
    "q_which": lambda which, be, determiner, kind: phrases.phrase(Term("which"), kind),
    "q_which_such": lambda which, kind, be, quality: Term("is", (phrases.phrase(Term("which"), kind), quality)),
    "q_know": lambda know, what: Term("know", (what,)),
    # statements
    "is_a": lambda what, be, thing: Term("is", (what, thing)),
    "is_not": lambda what, be, mark, thing: Term("not", (Term("is", (what, thing)),)),
    "i_see": lambda you, see, what: Term("see", (what,)),
    "is_where": lambda what, be, where: Term("is", (what, where)),
    "is_such": lambda what, be, quality: Term("is", (what, quality)),
    "there_is": lambda there, what: Term("exists", (what,)),
}
