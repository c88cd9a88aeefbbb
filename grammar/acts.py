"""What an utterance amounts to: dialogue acts with communicative functions (ISO 24617-2) and logical forms."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from .forms import Form


class Function(Enum):
    """The communicative function of an act; ISO 24617-2's name in brackets where it differs."""

    INSTRUCT = "instruct"
    CONFIRM = "confirm"
    DENY = "deny"  # disconfirm
    QUESTION = "question"
    ANSWER = "answer"
    FRAGMENT = "fragment"  # elliptical: leans on what went before
    CORRECT = "correct"  # correction of the speaker's own earlier act
    INFORM = "inform"
    GREET = "greet"  # initialGreeting
    THANK = "thank"  # thanking
    BYE = "bye"  # initialGoodbye
    ACKNOWLEDGE = "acknowledge"  # autoPositive


@dataclass(frozen=True, slots=True)
class DialogueAct:
    """One act. ``span`` is where it stands in the utterance (character offsets, end exclusive).

    ``repaired`` holds the text as it was understood where words were repaired or a reading was guessed: such an act is
    confirmed before anything moves.
    """

    function: Function
    form: Form
    span: tuple[int, int]
    repaired: str | None = None


@dataclass(frozen=True, slots=True)
class NotUnderstood:
    """Nothing the grammar knows: where it went wrong, what could have stood there, and the nearest known thing."""

    span: tuple[int, int]
    expected: tuple[str, ...]
    nearest: str | None = None
