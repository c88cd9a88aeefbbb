"""One utterance -> its dialogue acts: clause by clause, each the longest the grammar can make of what follows."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

from voxml.terms import Form, Term
from voxml.vocabulary import Lexicon

from .acts import DialogueAct, Function, NotUnderstood
from .amounts import AmountReader
from .disfluency import Fluency
from .ellipsis import Completer
from .expectations import describe_expected
from .language import language_grammar
from .lattice import SEPARATORS, Lattice
from .machine import Action, Machine, Tables, Trace, build_tables
from .meaning import Meaning
from .tokens import MARKS, Token, Tokenizer
from .word_edges import DERIVED_TERMINALS, WordReader

TEXT_MAX_CHARS = 2_000
READINGS_MAX = 12
CLAUSES_MAX = 150
_SOCIAL = frozenset({Function.ACKNOWLEDGE, Function.GREET, Function.THANK, Function.BYE, Function.CONFIRM})
_STOP = Term("stop")


@dataclass(frozen=True, slots=True)
class Clause:
    """One act and the tokens it was read from, ``[start, end)``; ``before`` where it was said to come first."""

    function: Function
    form: Form
    start: int
    end: int
    before: bool = False


class Reader:
    """Reads utterances with one lexicon and one language's grammar. Immutable; building it takes about 0.2 s."""

    def __init__(self, lexicon: Lexicon, language: str = "en") -> None:
        amounts = AmountReader(lexicon.closed)
        meaning = Meaning(lexicon)
        self._lexicon = lexicon
        self._tables = tables_of(lexicon, language, meaning.action)
        self._machine = Machine(self._tables)
        self._words = WordReader(lexicon, amounts)
        self._tokenizer = Tokenizer(lexicon.closed)
        self._fluency = Fluency(lexicon, amounts)
        self._completer = Completer(lexicon)

    def read(self, text: str) -> tuple[DialogueAct, ...] | NotUnderstood:
        """Every act of the utterance in order, or where it went wrong. An utterance without words is not understood."""
        if len(text) > TEXT_MAX_CHARS:
            return NotUnderstood((TEXT_MAX_CHARS, len(text)), (f"at most {TEXT_MAX_CHARS} characters",))
        tokens, corrects = self._fluency.clean(self._tokenizer(text))
        attempt = self._attempt(tokens)
        clauses = attempt.clauses(0)
        if clauses:
            return _acts(tokens, self._completed(_repeated(clauses)), corrects, self._is_control)
        return self._not_understood(text, tokens, attempt.trace)

    def tokens(self, text: str) -> tuple[Token, ...]:
        """The words that are read: without hesitations, repetitions and what was taken back."""
        return self._fluency.clean(self._tokenizer(text))[0]

    def lattice(self, tokens: tuple[Token, ...]) -> Lattice:
        """The ways to read them, by the lexicon."""
        return Lattice(tokens, self._words)

    def is_fluent(self, text: str) -> bool:
        """Whether nothing in the text looks like a hesitation, a repetition or a repair."""
        tokens = self._tokenizer(text)
        return self._fluency.clean(tokens) == (tuple(tokens), False)

    def readings(self, text: str) -> Iterator[tuple[Function, Form]]:
        """Every reading of the text as one act, the preferred first; the same one may come by several ways."""
        tokens = self.tokens(text)
        lattice = self.lattice(tokens)
        for reading, end in self._machine.readings(0, lattice.edges, lattice.may_end, Trace()):
            if end == len(tokens):
                yield reading

    def _completed(self, clauses: tuple[Clause, ...]) -> tuple[Clause, ...]:
        """Fragments behind an instruction are instructions of the same kind, where they fit it."""
        made: list[Clause] = []
        for clause in clauses:
            form = None
            if made and made[-1].function is Function.INSTRUCT and clause.function is Function.FRAGMENT:
                form = self._completer.completed(made[-1].form, clause.form)
            made.append(clause if form is None else replace(clause, function=Function.INSTRUCT, form=form))
        return _taught(tuple(made))

    def _attempt(self, tokens: tuple[Token, ...]) -> _Attempt:
        return _Attempt(tokens, self.lattice(tokens), self._machine)

    def _is_control(self, form: Form) -> bool:
        """Whether the form only tells the robot's queue what to do: that corrects nothing, whatever came before."""
        entry = self._lexicon.programs.get(form.pred) if isinstance(form, Term) else None
        return entry is not None and entry.body[0].event.pred == "control"

    def _not_understood(self, text: str, tokens: tuple[Token, ...], trace: Trace) -> NotUnderstood:
        expected = describe_expected(self._tables.expected(trace.states), trace)
        if trace.furthest >= len(tokens):
            return NotUnderstood((len(text), len(text)), expected)
        token = tokens[trace.furthest]
        return NotUnderstood((token.start, token.end), expected)


def _repeated(clauses: tuple[Clause, ...]) -> tuple[Clause, ...]:
    """ "A and B, twice" and "twice, A and B": said apart, how often counts for all of it."""
    at = next((index for index, clause in enumerate(clauses) if _is_times(clause)), None)
    if at is None or len(clauses) == 1:
        return clauses
    done = clauses[:at] if at else clauses[1:]
    rest = clauses[at + 1 :] if at else ()
    if any(clause.function is not Function.INSTRUCT for clause in done):
        return clauses
    often = clauses[at].form
    assert isinstance(often, Term)
    once = done[0].form if len(done) == 1 else Term("seq", tuple(clause.form for clause in done))
    whole = Term("repeat", (often.args[0], once))
    first, last = min(clauses[at].start, done[0].start), max(clauses[at].end, done[-1].end)
    return (Clause(Function.INSTRUCT, whole, first, last), *rest)


def _is_times(clause: Clause) -> bool:
    form = clause.form
    return (
        clause.function is Function.FRAGMENT
        and isinstance(form, Term)
        and form.pred == "repeat"
        and len(form.args) == 1
    )


def _acts(
    tokens: tuple[Token, ...],
    clauses: tuple[Clause, ...],
    corrects: bool,
    is_control: Callable[[Form], bool],
) -> tuple[DialogueAct, ...]:
    return tuple(
        DialogueAct(clause.function, clause.form, (tokens[clause.start].start, tokens[clause.end - 1].end))
        for clause in _ordered(clauses, corrects, is_control)
    )


def _taught(clauses: tuple[Clause, ...]) -> tuple[Clause, ...]:
    """ "learn the loop: go forward, turn right" is one act: what follows is taught, not done."""
    first, *rest = clauses
    if not rest or not isinstance(first.form, Term) or first.form.pred != "learn" or len(first.form.args) != 1:
        return clauses
    steps = Term("seq", tuple(clause.form for clause in rest)) if len(rest) > 1 else rest[0].form
    return (replace(first, form=Term("learn", (*first.form.args, steps)), end=rest[-1].end),)


class _Attempt:
    """The search through one utterance: what can be made of the tokens from each position on, found once."""

    def __init__(self, tokens: tuple[Token, ...], lattice: Lattice, machine: Machine) -> None:
        self.trace = Trace()
        self.steps = 0
        self._depth = 0
        self._count = len(tokens)
        self._lattice = lattice
        self._machine = machine
        self._known: dict[int, tuple[Clause, ...] | None] = {}

    def clauses(self, at: int) -> tuple[Clause, ...] | None:
        """The clauses from ``at`` to the end; None where the rest cannot be read."""
        start, before = self._past_connectives(at)
        if start >= self._count:
            return ()
        if start not in self._known:
            self._known[start] = self._read_from(start)
        found = self._known[start]
        return None if found is None else (replace(found[0], before=before), *found[1:])

    def _read_from(self, start: int) -> tuple[Clause, ...] | None:
        if self._depth >= CLAUSES_MAX:
            return None
        self._depth += 1
        trace = Trace(steps=self.steps)
        found = None
        for count, ((function, form), end) in enumerate(
            self._machine.readings(start, self._lattice.edges, self._lattice.may_end, trace)
        ):
            self.steps = trace.steps
            rest = self.clauses(end)
            trace.steps = self.steps
            if rest is not None:
                found = (Clause(function, form, start, end), *rest)
                break
            if count >= READINGS_MAX:
                break
        self._depth -= 1
        self.steps = max(self.steps, trace.steps)
        if trace.furthest > self.trace.furthest:
            self.trace = trace
        return found

    def _past_connectives(self, at: int) -> tuple[int, bool]:
        """Past marks, "and", "then", "but"; and whether "before that" was among them."""
        before = False
        while at < self._count:
            edges = self._lattice.edges(at)
            longest = max((edge.length for edge in edges), default=0)
            step = next((edge for edge in edges if edge.terminal in SEPARATORS and edge.length == longest), None)
            if step is None and self._lattice.texts[at] not in MARKS:
                break
            before = before or (step is not None and step.terminal == "BEFORE_THAT")
            at += 1 if step is None else step.length
        return at, before


def _ordered(clauses: tuple[Clause, ...], corrects: bool, is_control: Callable[[Form], bool]) -> tuple[Clause, ...]:
    """What was said to come first, first; and pleasantries only where nothing else was said."""
    ordered: list[Clause] = []
    for clause in clauses:
        if ordered and ordered[-1].form == clause.form and (clause.form == _STOP or clause.function in _SOCIAL):
            continue
        ordered.insert(max(len(ordered) - 1, 0) if clause.before else len(ordered), clause)
    if any(clause.function not in _SOCIAL for clause in ordered):
        ordered = [clause for clause in ordered if clause.function not in _SOCIAL]
    return tuple(_corrected(ordered, corrects, is_control))


def _corrected(clauses: list[Clause], corrects: bool, is_control: Callable[[Form], bool]) -> list[Clause]:
    """ "no, turn left" and "I mean left" correct; "no, stop" stops."""
    if len(clauses) > 1 and clauses[0].function is Function.DENY:
        corrects, clauses = clauses[1].function is not Function.QUESTION, clauses[1:]
    first, *others = clauses
    if not corrects or is_control(first.form) or first.function not in (Function.INSTRUCT, Function.FRAGMENT):
        return clauses
    return [replace(first, function=Function.CORRECT), *others]


def tables_of(lexicon: Lexicon, language: str, actions: Callable[[str], Action | None]) -> Tables:
    """A language's grammar as tables over the categories of a lexicon."""
    terminals = {*DERIVED_TERMINALS, *lexicon.categories(), *lexicon.closed.classes}
    return build_tables(language_grammar(language), terminals, actions)
