"""Whose left it is: the frames of reference that were taken for what was said."""

from __future__ import annotations

from dialogue.wording import listed, phrase
from grammar.forms import Term
from grounding import Frame, frame_of, frames_in

from .asked import Asked, Report

_WORDS = {
    Frame.ROBOT: "my own, as I face",
    Frame.VIEWER: "as I see it when I look at it",
    Frame.OWN: "its own, by the way it faces",
    Frame.MAP: "by the map",
}


def frame(asked: Asked) -> Report:
    """The frames taken in what was said last; of a word that was not in it, the one that it would have."""
    (word,) = asked.args
    taken = [found for form in asked.session.heard for found in frames_in(form, asked.lexicon)]
    if isinstance(word, Term) and word != Term("what"):
        of_word = [(term, whose) for term, whose in taken if term.pred.split("_")[0] == word.pred.split("_")[0]]
        alone = frame_of(word, asked.lexicon)
        taken = of_word or ([] if alone is None else [(word, alone)])
    if not taken:
        return Report("It makes no difference from where one looks")
    told = [f"'{phrase(term)}' to be {_WORDS[whose]}" for term, whose in taken]
    return Report(f"I take {listed(told, 'and')}")
