"""VoxML as types: what an entry may hold (Pustejovsky and Krishnaswamy, LREC 2016), after validation."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from .errors import KirbyError
from .terms import Form, Quantity, Term


class VoxmlError(KirbyError):
    """A lexicon that cannot be used; ``str()`` names file, element and remedy."""


class EntityType(Enum):
    """What kind of entry; the value is the attribute's text."""

    OBJECT = "Object"
    PROGRAM = "Program"
    ATTRIBUTE = "Attribute"
    RELATION = "Relation"
    FUNCTION = "Function"


class WordKind(Enum):
    """What a word of an entry is used as."""

    VERB = "verb"
    NOUN = "noun"
    ADJECTIVE = "adjective"
    ADVERB = "adverb"
    RELATION = "relation"
    DETERMINER = "determiner"


class FormKind(Enum):
    """Inflected forms that an entry may spell out where the rule would get them wrong."""

    PAST = "past"
    PARTICIPLE = "participle"
    ING = "ing"
    THIRD = "third"
    PLURAL = "plural"
    COMPARATIVE = "comparative"
    SUPERLATIVE = "superlative"


@dataclass(frozen=True, slots=True)
class Synonym:
    """Another word for the predicate; ``kind`` only where it differs from what the entry's type says.

    ``gives`` is an argument that the word says by itself: "back up" is ``go`` with ``back``. ``bare`` says, other than
    the argument does, whether the word takes a thing without a marker: "photograph it", but "turn to it".
    """

    text: str
    kind: WordKind | None = None
    gives: Form | None = None
    bare: bool | None = None


@dataclass(frozen=True, slots=True)
class IrregularForm:
    """An inflected form that the rule would get wrong: ``IrregularForm("go", FormKind.PAST, "went")``."""

    of: str
    kind: FormKind
    value: str


@dataclass(frozen=True, slots=True)
class Lex:
    """The words of an entry. ``types`` are the parts of ``physobj*artifact``."""

    pred: str
    types: tuple[str, ...]
    spoken: bool = True
    synonyms: tuple[Synonym, ...] = ()
    forms: tuple[IrregularForm, ...] = ()


@dataclass(frozen=True, slots=True)
class Argument:
    """A typed argument: ``x:agent``. ``markers`` are relations that may introduce it; without ``bare`` one must."""

    variable: str
    types: tuple[str, ...]
    default: Quantity | Term | None = None
    optional: bool = False
    markers: tuple[str, ...] = ()
    bare: bool = True


@dataclass(frozen=True, slots=True)
class Guard:
    """``while(c)`` or ``if(c)`` before an event."""

    operator: str
    condition: Term


@dataclass(frozen=True, slots=True)
class Subevent:
    """One step of a body: ``e1:if(known(y)):reach(x,near(y))``."""

    label: str
    guards: tuple[Guard, ...]
    event: Term


@dataclass(frozen=True, slots=True)
class HabitatCondition:
    """``UP[2]`` = ``align(Y,E_y)`` (a term) or ``CONSTR[2]`` = ``Y > X`` (a chain of axes and comparisons)."""

    name: str
    index: int | None
    value: Term | AxisConstraint | AxisDirection


@dataclass(frozen=True, slots=True)
class AxisConstraint:
    """How extents along the axes compare: ``X = Y = Z``, ``Y > X``."""

    axes: tuple[str, ...]
    comparisons: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class AxisDirection:
    """A signed axis: ``+Y``; the argument of ``top(+Y)``."""

    predicate: str
    direction: str


@dataclass(frozen=True, slots=True)
class Affordance:
    """``H[i](,condition)->[EVENT]RESULT``: in that habitat the event is possible and leads to the result."""

    habitat: int
    conditions: tuple[Form, ...]
    event: Term
    result: Term | None
    indexed: bool = True


@dataclass(frozen=True, slots=True)
class Head:
    """The shape of an object or the kind of a program: ``cylindroid[1]``."""

    name: str
    index: int | None = None


@dataclass(frozen=True, slots=True)
class ObjectEntry:
    """A thing or a place: its geometry, habitats, affordances and embodiment."""

    lex: Lex
    head: Head
    components: tuple[Head, ...] = ()
    concavity: str | None = None
    rotational_symmetry: tuple[str, ...] = ()
    reflectional_symmetry: tuple[str, ...] = ()
    intrinsic: tuple[HabitatCondition, ...] = ()
    extrinsic: tuple[HabitatCondition, ...] = ()
    affordances: tuple[Affordance, ...] = ()
    scale: str | None = None
    movable: bool | None = None
    attributes: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class ProgramEntry:
    """A verb: typed arguments and a body in primitives and other programs."""

    lex: Lex
    head: str
    args: tuple[Argument, ...] = ()
    body: tuple[Subevent, ...] = ()


@dataclass(frozen=True, slots=True)
class AttributeEntry:
    """A property: what it modifies and the scale it is measured on."""

    lex: Lex
    scale: str
    arity: str
    args: tuple[Argument, ...] = ()


@dataclass(frozen=True, slots=True)
class RelationEntry:
    """A relation of place (config) or of path and force (force_dynamic)."""

    lex: Lex
    relation_class: str
    value: str
    args: tuple[Argument, ...] = ()
    constraint: str | None = None
    correspondences: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class FunctionEntry:
    """A determiner, quantifier or deictic: what it refers to and how many it maps to how many."""

    lex: Lex
    referent: str
    mapping: str
    args: tuple[Argument, ...] = ()


Entry = ObjectEntry | ProgramEntry | AttributeEntry | RelationEntry | FunctionEntry

ENTITY_TYPES: dict[type, EntityType] = {
    ObjectEntry: EntityType.OBJECT,
    ProgramEntry: EntityType.PROGRAM,
    AttributeEntry: EntityType.ATTRIBUTE,
    RelationEntry: EntityType.RELATION,
    FunctionEntry: EntityType.FUNCTION,
}
