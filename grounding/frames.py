"""Whose left, front or north it is: the frame of reference that a description takes."""

from __future__ import annotations

from enum import Enum

from grammar.forms import Form, Term
from voxml.vocabulary import Lexicon


class Frame(Enum):
    """Levinson's frames ("Space in Language and Cognition", 2003); his relative frame needs a viewer."""

    ROBOT = "robot"  # the robot's own sides: "on the left"
    VIEWER = "viewer"  # relative: the robot's, as it looks at the landmark: "left of the table"
    OWN = "own"  # intrinsic: the landmark's: "in front of the desk"
    MAP = "map"  # absolute: "north of the table"


_SIDES = frozenset({"left", "right", "ahead", "behind", "front", "back", "forward", "leftmost", "rightmost"})
_VALUES = {
    "projective.left": Frame.VIEWER,
    "projective.right": Frame.VIEWER,
    "path.past": Frame.VIEWER,
    "path.across": Frame.VIEWER,
    "path.through": Frame.VIEWER,
    "projective.front": Frame.OWN,
    "projective.back": Frame.OWN,
    "projective.across": Frame.OWN,
}


def frame_of(term: Term, lexicon: Lexicon) -> Frame | None:
    """The frame of one word or relation: ``left`` (the robot's), ``left_of(...)``; None where none is needed."""
    entry = lexicon.relations.get(term.pred)
    if term.args and term.args[-1] == Term("you"):
        return None if entry is None or entry.value not in _VALUES else Frame.ROBOT
    if entry is not None and (term.args or term.pred not in _SIDES):
        return Frame.MAP if entry.value.startswith("cardinal.") else _VALUES.get(entry.value)
    return Frame.ROBOT if term.pred in _SIDES else None


def frames_in(form: Form, lexicon: Lexicon) -> tuple[tuple[Term, Frame], ...]:
    """Every part of a form that takes a frame, from the outside in."""
    if not isinstance(form, Term):
        return ()
    frame = frame_of(form, lexicon)
    own = () if frame is None else ((form, frame),)
    return own + tuple(found for arg in form.args for found in frames_in(arg, lexicon))
