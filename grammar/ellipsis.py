"""What a clause leaves out because the one before has said it: "turn left, then right", "face north, then south"."""

from __future__ import annotations

from voxml.schema import RelationEntry
from voxml.terms import Form, Term
from voxml.vocabulary import Lexicon

_CLASSES = ("SIDE", "AXIS", "HEADING")


class Completer:
    """Completes fragments with the verb before them, by the words of one lexicon."""

    def __init__(self, lexicon: Lexicon) -> None:
        self._kinds = {word.value: name for name in _CLASSES for word in lexicon.closed.words_of(name)}
        self._paths = frozenset(pred for pred, entry in lexicon.relations.items() if _is_path(entry))

    def completed(self, before: Form, fragment: Form) -> Form | None:
        """The program before with the fragment in the place of its like; None where it had nothing of the kind.

        Amounts are not taken over: "turn left ten degrees and right" says of the right turn no more than that.
        """
        if not isinstance(before, Term):
            return None
        if before.pred == "seq" and before.args:
            return self.completed(before.args[-1], fragment)
        kind = self._kind(fragment)
        if kind is None or not any(self._kind(arg) == kind for arg in before.args):
            return None
        return Term(before.pred, (fragment,))

    def _kind(self, form: Form) -> str | None:
        if isinstance(form, Term) and form.args and form.pred in self._paths:
            return "path"
        return self._kinds.get(form)


def _is_path(entry: RelationEntry) -> bool:
    return entry.relation_class == "force_dynamic"
