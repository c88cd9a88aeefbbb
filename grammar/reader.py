"""One utterance -> its dialogue acts."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from voxml.terms import Form, Term
from voxml.vocabulary import Lexicon

from .acts import DialogueAct, Function, NotUnderstood
from .amounts import AmountReader
from .clauses import Clauses, Composer
from .disfluency import Fluency
from .ellipsis import Completer
from .expectations import describe_expected
from .language import language_grammar
from .lattice import Lattice
from .machine import Machine, Trace
from .meaning import Meaning
from .search import Search
from .tables import Action, Tables, build_tables
from .tokens import Token, Tokenizer
from .word_edges import DERIVED_TERMINALS, WordReader

TEXT_MAX_CHARS = 2_000
_LEADING = ("SIDE", "AXIS", "HEADING", "VAGUE")


class Reader:
    """Reads utterances with one lexicon and one language's grammar. Immutable."""

    def __init__(self, lexicon: Lexicon, language: str = "en") -> None:
        amounts = AmountReader(lexicon.closed)
        self._lexicon = lexicon
        self._tables = tables_of(lexicon, language, Meaning(lexicon).action)
        self._machine = Machine(self._tables)
        self._thorough_machine = Machine(self._tables, thorough=True)
        self._words = WordReader(lexicon, amounts)
        self._tokenizer = Tokenizer(lexicon.closed)
        self._fluency = Fluency(lexicon, amounts)
        self._composer = Composer(Completer(lexicon), self._is_control)
        self._instead = frozenset(lexicon.closed.table("instead"))
        self._leading = frozenset(
            word.value for name in _LEADING for word in lexicon.closed.words_of(name) if word.value is not None
        )

    def read(self, text: str, thorough: bool = True) -> tuple[DialogueAct, ...] | NotUnderstood:
        """Every act of the utterance in order, or where it went wrong. An utterance without words is not understood.

        ``thorough`` is for what people say; what is only tried out must make sense at once.
        """
        if len(text) > TEXT_MAX_CHARS:
            return NotUnderstood((TEXT_MAX_CHARS, len(text)), (f"at most {TEXT_MAX_CHARS} characters",))
        failure = None
        for tokens, corrects, machine in self._attempts(tuple(self._tokenizer(text)), thorough):
            search = Search(self.lattice(tokens), machine, self._leading)
            clauses = search.clauses()
            if clauses:
                instead = any(token.text in self._instead for token in tokens)
                return _acts(self._composer.composed(clauses, corrects or instead), tokens)
            failure = failure or self._not_understood(text, tokens, search.trace)
        assert failure is not None
        return failure

    def _attempts(self, said: tuple[Token, ...], thorough: bool) -> Iterator[tuple[tuple[Token, ...], bool, Machine]]:
        """The words to read, whether they correct, and what reads them: each where nothing came of the one before."""
        cleaned, corrects = self._fluency.clean(said)
        yield cleaned, corrects, self._machine
        if not thorough:
            return
        yield cleaned, corrects, self._thorough_machine
        fewer = self._fluency.cleaned_again(cleaned)
        if fewer != cleaned:
            yield fewer, corrects, self._machine
        if said != cleaned:
            yield said, False, self._thorough_machine  # what looks like a slip of the tongue may be none: "i am sorry"

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
        """Every reading of the text as one act that the rules allow; the same one may come by several ways."""
        tokens = self.tokens(text)
        lattice = self.lattice(tokens)
        for reading, end in self._thorough_machine.readings(0, lattice.edges, lattice.may_end, Trace()):
            if end == len(tokens):
                yield reading

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


def _acts(clauses: Clauses, tokens: tuple[Token, ...]) -> tuple[DialogueAct, ...]:
    return tuple(
        DialogueAct(clause.function, clause.form, (tokens[clause.start].start, tokens[clause.end - 1].end))
        for clause in clauses
    )


def tables_of(lexicon: Lexicon, language: str, actions: Callable[[str], Action | None]) -> Tables:
    """A language's grammar as tables over the categories of a lexicon."""
    terminals = {*DERIVED_TERMINALS, *lexicon.categories(), *lexicon.closed.classes}
    return build_tables(language_grammar(language), terminals, actions)
