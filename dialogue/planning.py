"""From forms to the robot's commands, through the bodies of the lexicon's programs and the operators over programs."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping
from dataclasses import replace

from grammar.forms import Form, Quantity, Term, Unit
from grounding import Ambiguous, Reason, Unresolved, World, resolve
from robot.messages import Patrol
from voxml.schema import Guard, ProgramEntry
from voxml.vocabulary import Lexicon

from .conditions import ELAPSED, holds
from .plans import COMMANDS_MAX, Deferred, Plan, Planning, Refusal, Refused, Stops
from .primitives import PRIMITIVES, Draft
from .programs import bind, substitute

_STEPS_MAX = 10_000
"""Of unfolding; a lexicon may hold programs that unfold into themselves."""

_STOPPING = Term("control", (Term("stop"),))
_GO_ON = "go_on"  # in a plan's list: what follows begins once the condition holds, and what came before goes on
_HALT = "halt"  # ends what is being done


def plan(forms: tuple[Form, ...], world: World | None, lexicon: Lexicon) -> Planning:
    """The commands for ``forms`` one after another, for a robot that stands where ``world`` says when they begin.

    All or nothing: where one part cannot be resolved or done, that is the result. Without a world nothing that leans on
    it can be resolved, and the robot stands at the origin, facing east.
    """
    planner = _Planner(world, lexicon)
    try:
        then = planner.run(forms)
    except Stops as stop:
        return stop.outcome
    draft = planner.draft
    return Plan(tuple(draft.commands), tuple(draft.entities), tuple(draft.places), then, tuple(planner.events))


class _Planner:
    """A list of what is to be done, unfolded from its head: programs into events, events into commands."""

    def __init__(self, world: World | None, lexicon: Lexicon) -> None:
        self.draft = Draft(world, lexicon)
        self.lexicon = lexicon
        self.events: list[Term] = []
        self.known = tuple(self.draft.world.entities.index)

    def run(self, forms: Iterable[Form]) -> Deferred | None:
        """Plan as far as can be told now; what has to wait for something to happen is returned."""
        todo = deque((form, form) for form in forms)
        for _ in range(_STEPS_MAX):
            if not todo:
                return None
            form, said = todo.popleft()
            if isinstance(form, Term) and form.pred == _GO_ON:
                return self._deferred(form, tuple(self._later(left) for left, _ in todo))
            try:
                following = self._step(form)
            except Stops as stop:
                raise Stops(_told(stop.outcome, said)) from None
            is_operator = isinstance(form, Term) and form.pred in _OPERATORS
            todo.extendleft((next_, next_ if is_operator else said) for next_ in reversed(following))
        raise Stops(Refused(Refusal.TOO_LONG, Quantity(COMMANDS_MAX)))

    def _deferred(self, form: Term, rest: tuple[Form, ...]) -> Deferred:
        condition, moving = form.args
        assert isinstance(condition, Term)
        if condition.pred != ELAPSED:
            self._check(condition)
        return Deferred(condition, rest, moving == Term("moving"), self.known)

    def _later(self, form: Form) -> Form:
        """What ends will end what was planned here."""
        if form != Term(_HALT):
            return form
        patrols = any(isinstance(command, Patrol) for command in self.draft.commands)
        return Term("event", (Term("control", (Term("stop_patrol" if patrols else "cancel"),)),))

    # -------------------------------------------------------------- operators
    def _step(self, form: Form) -> list[Form]:
        """Do a form, or return what it unfolds into."""
        match form:
            case Term("seq", parts):
                return list(parts)
            case Term("repeat", (Quantity(value=times), part)):
                return [part] * min(int(times), COMMANDS_MAX + 1)
            case Term("not", (_,)):
                return []  # what was forbidden is left undone
            case Term("until" | "when" | "if" as operator, (Term() as condition, part, *otherwise)):
                return self._conditional(operator, condition, part, otherwise)
            case Term("endless", (part,)):
                return self._endless(part)
            case Term(manner, (part,)) if self._is_manner(manner):
                return [part]  # the robot has one speed
            case Term("event", (Term() as event,)):
                return self._event(event)
            case Term(pred) if pred in self.lexicon.programs:
                return self._unfolded(form, self.lexicon.programs[pred])
        raise Stops(Refused(Refusal.UNKNOWN_PROGRAM, form))

    def _conditional(self, operator: str, condition: Term, part: Form, otherwise: list[Form]) -> list[Form]:
        holds_now = self._check(condition)
        match operator:
            case "until":
                return [Term("endless", (part,)), Term(_GO_ON, (condition, Term("moving"))), Term(_HALT)]
            case "when":
                return [Term(_GO_ON, (condition, Term("waiting"))), part]
            case _:
                return [part] if holds_now else otherwise

    def _check(self, condition: Term) -> bool:
        if not self.draft.is_known:
            raise Stops(Unresolved(Reason.NOTHING_FITS, condition))
        return holds(condition, self.draft.world, self.lexicon)

    def _endless(self, part: Form) -> list[Form]:
        """A program without an amount goes on as far as it can."""
        entry = self.lexicon.programs.get(part.pred) if isinstance(part, Term) else None
        return [part] if entry is None or not isinstance(part, Term) else self._unfolded(part, entry, endless=True)

    def _is_manner(self, pred: str) -> bool:
        entry = self.lexicon.attributes.get(pred)
        return entry is not None and any("event" in arg.types for arg in entry.args)

    # -------------------------------------------------------------- programs and primitives
    def _event(self, event: Term) -> list[Form]:
        """A step of a body: a primitive, which may have the name of a verb ("patrol"), or else another program."""
        primitive = PRIMITIVES.get(event.pred)
        if event.pred == "wait":
            return [_after(event.args)]
        if event.pred == "unable":
            raise Stops(Refused(Refusal.NO_PART, event.args[0]))
        if event.pred == "dialogue":
            return self._said(event)
        if event == _STOPPING and self.draft.moves:
            return []  # every movement ends with standing still; the command would halt it before
        if primitive is None:
            return [event]
        primitive(self.draft, event)
        return []

    def _said(self, event: Term) -> list[Form]:
        """What the dialogue does itself comes when what was sent before it has ended."""
        if self.draft.commands:
            return [_after((Quantity(0.0, Unit.SECOND),)), Term("event", (event,))]
        self.events.append(event)
        return []

    def _unfolded(self, form: Term, entry: ProgramEntry, endless: bool = False) -> list[Form]:
        """A program by its body. Whether its conditions hold is settled before it begins."""
        bound = bind(entry, form.args, endless)
        if bound is None:
            raise Stops(Refused(Refusal.WRONG_ARGUMENT, form))
        variables = frozenset(arg.variable for arg in entry.args)
        events: list[Form] = []
        for step in entry.body:
            if not all(self._is_met(guard, bound) for guard in step.guards if guard.operator == "if"):
                continue
            events.append(Term("event", (substitute(step.event, bound, variables),)))
            loops = [guard.condition for guard in step.guards if guard.operator == "while"]
            events += [_go_on(substitute(condition, bound, variables)) for condition in loops]
        return events

    def _is_met(self, guard: Guard, bound: Mapping[str, Form]) -> bool:
        return self._guarded(guard.condition, bound)

    def _guarded(self, condition: Term, bound: Mapping[str, Form]) -> bool:
        match condition:
            case Term("not", (Term() as inner,)):
                return not self._guarded(inner, bound)
            case Term("bound", (Term(variable),)):
                return variable in bound
            case Term("known", (Term(variable),)) if variable in bound:
                outcome = resolve(bound[variable], self.draft.world, self.lexicon)
                if isinstance(outcome, Unresolved) and not self.draft.is_known:
                    raise Stops(outcome)
                return not isinstance(outcome, Unresolved)
            case _:
                raise Stops(Refused(Refusal.NOT_ABLE, condition))


def _after(duration: tuple[Form, ...]) -> Term:
    return Term(_GO_ON, (Term(ELAPSED, duration), Term("waiting")))


def _told(outcome: Ambiguous | Unresolved | Refused, said: Form) -> Ambiguous | Unresolved | Refused:
    """What a primitive refuses is told of what was said."""
    match outcome:
        case Refused(Refusal.TOO_LONG | Refusal.NOT_AFFORDED):
            return outcome
        case Refused(Refusal.NO_PART, Term(pred=part, args=())):
            return replace(outcome, form=Term(part, (said,)))
        case Refused():
            return replace(outcome, form=said)
    return outcome


def _go_on(condition: Term) -> Term:
    """``while(not(c)):e``: e goes on until c holds."""
    match condition:
        case Term("not", (Term() as inner,)):
            return Term(_GO_ON, (inner, Term("moving")))
        case _:
            return Term(_GO_ON, (Term("not", (condition,)), Term("moving")))


_OPERATORS = frozenset({"seq", "repeat", "until", "when", "if", "endless"})
