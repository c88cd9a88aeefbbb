"""What a clause leaves out because the one before has said it: "turn left, then right", "face north, then south"."""

from __future__ import annotations

from voxml.schema import RelationEntry
from voxml.terms import Form, Term
from voxml.vocabulary import Lexicon

_BACK, _BACK_THERE = Term("back"), Term("back_there")
_CLASSES = ("SIDE", "AXIS", "HEADING", "PLACE")


class Completer:
    """Completes fragments with the verb before them, by the words of one lexicon."""

    def __init__(self, lexicon: Lexicon) -> None:
        self._kinds = {word.value: name for name in _CLASSES for word in lexicon.closed.words_of(name)}
        self._paths = frozenset(pred for pred, entry in lexicon.relations.items() if _is_path(entry))

    def completed(self, before: Form, fragment: Form) -> Form | None:
        """The program before with the fragment in the place of its like; None where it had nothing of the kind.

        Amounts are not taken over: "turn left ten degrees and right" says of the right turn no more than that.
        """
        match before, fragment:
            case Term("seq", (*_, turning, last)), _:
                done = self.completed(last, fragment)
                turned = self._turned(turning, fragment) if done is None else None
                return done if turned is None else Term("seq", (turned, last))
            case Term() as program, Term("again", (changed,)):  # "a left and another left"
                return self._with(program, changed)
            case Term() as program, Term("again", ()):
                return program
            case Term() as program, _:
                done = self._with(program, fragment)
                return Term("turn", (fragment,)) if done is None and self._turns(program, fragment) else done
        return None

    def _turned(self, turning: Form, where: Form) -> Form | None:
        """ "pictures to the north and south", "to your left and right": from one side to the other is half a turn."""
        match turning:
            case Term("turn", (side,)) if side != where and self._kind(side) == self._kind(where) == "SIDE":
                return Term("turn_around")
            case Term("face"):
                return self._with(turning, where)
        return None

    def _turns(self, program: Term, fragment: Form) -> bool:
        """Whether a side behind the program is a turn: "go forward ten feet and right"."""
        return self._kind(fragment) == "SIDE" and program.pred == "go"

    def _with(self, program: Term, part: Form) -> Form | None:
        kind = self._kind(part)
        for arg in program.args:
            if kind is not None and self._kind(arg) == kind:
                return Term(program.pred, (part,))
            if self._kind(arg) == "path" and kind == "PLACE":  # "go there and then there"
                return Term(program.pred, (Term("to", (part,)),))
            if self._kind(arg) == "path" and part == _BACK:  # "go to the door and back"
                return Term(program.pred, (Term("to", (_BACK_THERE,)),))
        return None

    def _kind(self, form: Form) -> str | None:
        if isinstance(form, Term) and form.args and form.pred in self._paths:
            return "path"
        return self._kinds.get(form)


def _is_path(entry: RelationEntry) -> bool:
    return entry.relation_class == "force_dynamic"
