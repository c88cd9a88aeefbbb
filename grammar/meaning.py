"""What each rule of the grammar means: the actions of the automaton, by the rule's name in the ``.lark`` file."""

from __future__ import annotations

from voxml.terms import Form, Term
from voxml.vocabulary import Lexicon

from . import phrases
from .act_actions import ACT_ACTIONS, COMMAND_ACTIONS, Act
from .acts import Function
from .arguments import Args, Kind
from .machine import Refused
from .phrase_actions import ARGUMENT_ACTIONS, NOUN_PHRASE_ACTIONS
from .question_actions import CONDITION_ACTIONS, QUESTION_ACTIONS, STATEMENT_ACTIONS
from .tables import Action
from .verbs import VerbActions

_PLAIN: dict[str, Action] = {
    **ACT_ACTIONS,
    **COMMAND_ACTIONS,
    **ARGUMENT_ACTIONS,
    **NOUN_PHRASE_ACTIONS,
    **CONDITION_ACTIONS,
    **QUESTION_ACTIONS,
    **STATEMENT_ACTIONS,
    "second": lambda first, second, *rest: second,
    "fourth": lambda first, second, third, fourth: fourth,
    "first_of_two": lambda first, second: first,
}


class Meaning(VerbActions):
    """The actions over one lexicon. A method is the action of the rule that has its name."""

    def __init__(self, lexicon: Lexicon) -> None:
        super().__init__(lexicon)
        self._indefinite = frozenset(lexicon.closed.table("INDEFINITE"))

    def action(self, rule: str) -> Action | None:
        """The action of a rule; None for one that has none."""
        return _PLAIN.get(rule) or getattr(self, rule, None)

    def act_fragment(self, args: Args) -> Act:
        """ "ninety degrees" leans on what went before; "left ninety degrees" says all of an instruction."""
        said = self.verbless(args)
        if said is not None:
            return Function.INSTRUCT, said
        if len(args) != 1 or args[0].kind in (Kind.OF, Kind.EVENT):
            raise Refused("a verb")
        arg = args[0]
        return Function.FRAGMENT, Term("repeat", (arg.form,)) if arg.kind is Kind.REPEAT else arg.form

    def act_same(self, again: Form, args: Args) -> Act:
        """ "again forward three feet" says all of an instruction; "same thing on the left" does not."""
        said = self.verbless(args)
        if said is not None:
            return Function.INSTRUCT, said
        if len(args) == 1 and args[0].kind is Kind.REPEAT:
            return Function.FRAGMENT, Term("repeat", (args[0].form, Term("again")))
        if any(arg.kind in (Kind.PHRASE, Kind.EVENT) for arg in args):
            raise Refused("how")
        return Function.FRAGMENT, Term("again", tuple(arg.form for arg in args))

    def act_not(self, mark: Form, wrong: Args) -> Act:
        """ "not that one"; "not left, right" says what is right too."""
        if len(wrong) == 2 and wrong[0].kind is wrong[1].kind:
            return Function.CORRECT, wrong[1].form
        return Function.CORRECT, Term("not", (self._part(wrong),))

    def act_rather(self, mark: Form, wrong: Args, separator: Form, right: Args) -> Act:
        """ "not left, right ninety degrees"."""
        return Function.CORRECT, self._part(right)

    def act_rather_first(self, right: Args, separator: Form, mark: Form, wrong: Args) -> Act:
        return Function.CORRECT, self._part(right)

    def _part(self, args: Args) -> Form:
        """One argument, or the program that several say all of."""
        form = args[0].form if len(args) == 1 and args[0].kind is not Kind.EVENT else self.verbless(args)
        if form is None:
            raise Refused("a verb")
        return form

    def q_is_any(self, be: Form, what: Form, posts: tuple[Form, ...]) -> Form:
        """ "is anyone in the kitchen"."""
        return Term("exists", (what, *phrases.places(posts)))

    def q_exists(self, there: Form, what: Form) -> Form:
        """ "is there anything on your left" asks as "is there anything" does, of a place."""
        if isinstance(what, Term) and what.pred in self._indefinite:
            return Term("exists", (Term(what.pred), *what.args))
        return Term("exists", (what,))
