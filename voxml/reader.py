"""Reading one VoxML entry: XML text to a validated entry, with errors that name file, element and remedy."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from . import formulas
from .schema import (
    Affordance,
    Argument,
    AttributeEntry,
    EntityType,
    Entry,
    FormKind,
    FunctionEntry,
    HabitatCondition,
    Head,
    IrregularForm,
    Lex,
    ObjectEntry,
    ProgramEntry,
    RelationEntry,
    Subevent,
    Synonym,
    VoxmlError,
    WordKind,
)
from .terms import FormError, Quantity, Term, parse_form

FILE_MAX_BYTES = 100_000

OBJECT_TYPES = ("physobj", "human", "artifact", "location")
PROGRAM_TYPES = ("process", "transition_event", "state", "assignment", "test")
SHAPES = ("cylindroid", "ellipsoid", "rectangular_prism", "toroid", "pyramidoid", "sheet")
CONCAVITIES = ("Concave", "Flat", "Convex")
EMBODIMENT_SCALES = ("<agent", "agent", ">agent")
SCALES = ("nominal", "binary", "ordinal", "interval", "rational")
ARITIES = ("intransitive", "transitive")
RELATION_CLASSES = ("config", "force_dynamic")
DIRECTION_TYPES = ("axis", "side", "heading", "rotation", "way")
QUANTITY_TYPES = ("length", "angle", "duration", "count", "speed")
ARGUMENT_TYPES = (
    *("agent", "event", "physobj", "location", "human", "artifact"),
    *DIRECTION_TYPES,
    *QUANTITY_TYPES,
    *("path", "place", "question", "name", "any"),
)

_Value = TypeVar("_Value")


class _Fault(Exception):  # noqa: N818 - becomes an error once the file is known
    """What is wrong with which element; becomes a VoxmlError once the file is known."""


def read_entry(path: Path) -> Entry:
    """Read and validate the entry in a file.

    Raises:
        VoxmlError: unreadable, too large, not XML, a document type or entity declaration, or an element that is not as
            VoxML or ``docs/lexicon.md`` has it; the text names file, element and remedy.
    """
    return parse_entry(read_xml_text(path), str(path))


def read_xml_text(path: Path) -> str:
    """The text of an XML file of at most FILE_MAX_BYTES; raises VoxmlError."""
    try:
        data = path.read_bytes()
    except OSError as error:
        raise VoxmlError(f"{path}: cannot be read: {error.strerror}") from error
    if len(data) > FILE_MAX_BYTES:
        raise VoxmlError(f"{path}: {len(data)} bytes is too long for an entry: at most {FILE_MAX_BYTES}")
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        raise VoxmlError(f"{path}: is not UTF-8: save it as UTF-8") from None


def parse_xml(text: str, source: str, root: str) -> Element:
    """The root element; declarations of document types and entities are refused. Raises VoxmlError."""
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise VoxmlError(f"{source}: document type and entity declarations are not allowed: remove the <! ...> lines")
    try:
        element = ElementTree.fromstring(text)  # noqa: S314 - declarations, and so entities, are refused above
    except ElementTree.ParseError as error:
        raise VoxmlError(f"{source}: is not well-formed XML: {error}") from None
    if element.tag != root:
        raise VoxmlError(f"{source}: the root element is <{element.tag}>: it must be <{root}>")
    return element


def parse_entry(text: str, source: str) -> Entry:
    """As `read_entry`, from the XML text; ``source`` is what errors call it."""
    root = parse_xml(text, source, "VoxML")
    try:
        _check_children(root, ("Entity", "Lex", "Type", "Habitat", "Afford_Str", "Embodiment", "Attributes"))
        entity = EntityType(_one_of(root, "Entity", "Type", tuple(t.value for t in EntityType)))
        return _READERS[entity](root)
    except (_Fault, FormError) as fault:
        raise VoxmlError(f"{source}: {fault}") from None


# ------------------------------------------------------------------ elements
def _check_children(element: Element, allowed: tuple[str, ...]) -> None:
    for child in element:
        if child.tag not in allowed:
            raise _Fault(f"<{element.tag}>: <{child.tag}> is not of VoxML here: use {', '.join(allowed)}")


def _child(element: Element, path: str) -> Element:
    found = element.find(path)
    if found is None:
        raise _Fault(f"<{element.tag}>: <{path}> is missing: add it")
    return found


def _text(element: Element, path: str) -> str:
    text = (_child(element, path).text or "").strip()
    if not text:
        raise _Fault(f"<{path}> is empty: write its value")
    return text


def _optional_text(element: Element, path: str) -> str | None:
    found = element.find(path)
    return None if found is None or not (found.text or "").strip() else (found.text or "").strip()


def _attribute(element: Element, name: str) -> str:
    value = element.get(name)
    if value is None or not value.strip():
        raise _Fault(f'<{element.tag}>: the attribute {name} is missing: add {name}="..."')
    return value.strip()


def _one_of(root: Element, path: str, attribute: str, allowed: tuple[str, ...]) -> str:
    return _allowed(_attribute(_child(root, path), attribute), allowed, f"<{path} {attribute}>")


def _allowed(value: str, allowed: tuple[str, ...], at: str) -> str:
    if value not in allowed:
        raise _Fault(f"{at}: '{value}' is not known: use one of {', '.join(allowed)}")
    return value


def _flag(element: Element, name: str, default: bool) -> bool:
    value = element.get(name)
    return default if value is None else _allowed(value, ("true", "false"), f"<{element.tag} {name}>") == "true"


def _formula(read: Callable[..., _Value], at: str, *texts: str) -> _Value:
    try:
        return read(*texts)
    except FormError as error:
        raise _Fault(f"<{at}>: {error}") from None


# ------------------------------------------------------------------ parts of entries
def _lex(root: Element, allowed: tuple[str, ...] | None) -> Lex:
    lex = _child(root, "Lex")
    _check_children(lex, ("Pred", "Type", "Synonyms", "Forms"))
    types = tuple(_text(lex, "Type").split("*"))
    for name in types if allowed else ():
        _allowed(name, allowed or (), "<Lex><Type>")
    pred = _text(lex, "Pred")
    if not pred.replace("_", "").isalnum() or not pred.isascii() or not pred[0].isalpha() or pred.lower() != pred:
        raise _Fault(f"<Pred>: '{pred}' must be lower-case letters, digits and underscores, beginning with a letter")
    synonyms = tuple(_synonym(element) for element in lex.iterfind("Synonyms/Synonym"))
    forms = tuple(_irregular(element) for element in lex.iterfind("Forms/Form"))
    return Lex(pred, types, _flag(_child(lex, "Pred"), "Spoken", True), synonyms, forms)


def _synonym(element: Element) -> Synonym:
    text = (element.text or "").strip()
    if not text:
        raise _Fault("<Synonym> is empty: write the word or remove the element")
    kind, gives = element.get("Kind"), element.get("Gives")
    return Synonym(
        text,
        None if kind is None else WordKind(_allowed(kind, tuple(k.value for k in WordKind), "<Synonym Kind>")),
        None if gives is None else _formula(parse_form, "Synonym Gives", gives),
        None if element.get("Bare") is None else _flag(element, "Bare", True),
    )


def _irregular(element: Element) -> IrregularForm:
    kind = _allowed(_attribute(element, "Kind"), tuple(k.value for k in FormKind), "<Form Kind>")
    return IrregularForm(_attribute(element, "Of"), FormKind(kind), _attribute(element, "Value"))


def _arguments(root: Element) -> tuple[Argument, ...]:
    return tuple(_argument(element) for element in root.iterfind("Type/Args/Arg"))


def _argument(element: Element) -> Argument:
    variable, colon, types = _attribute(element, "Value").partition(":")
    if not colon or not variable.isidentifier():
        raise _Fault(f"<Arg>: '{element.get('Value')}' must be variable:type, such as y:physobj")
    names = tuple(types.strip().split("|"))
    for name in names:
        _allowed(name, ARGUMENT_TYPES, "<Arg>")
    default = element.get("Default")
    return Argument(
        variable,
        names,
        None if default is None else _formula(_default, "Arg Default", default),
        _flag(element, "Optional", False),
        tuple((element.get("Markers") or "").split()),
        _flag(element, "Bare", True),
    )


def _default(text: str) -> Quantity | Term:
    form = parse_form(text)
    if not isinstance(form, Quantity | Term):
        raise FormError(f"'{text}' is not a quantity such as 90deg or a word such as left")
    return form


def _body(root: Element) -> tuple[Subevent, ...]:
    return tuple(
        _formula(formulas.parse_subevent, "Subevent", _attribute(element, "Value"))
        for element in root.iterfind("Type/Body/Subevent")
    )


def _habitats(root: Element, kind: str, tag: str) -> tuple[HabitatCondition, ...]:
    return tuple(
        _formula(formulas.parse_habitat, tag, _attribute(element, "Name"), _attribute(element, "Value"))
        for element in root.iterfind(f"Habitat/{kind}/{tag}")
    )


def _affordances(root: Element) -> tuple[Affordance, ...]:
    return tuple(
        _formula(formulas.parse_affordance, "Affordance", _attribute(element, "Formula"))
        for element in root.iterfind("Afford_Str/Affordances/Affordance")
    )


def _head(root: Element) -> Head:
    head = _formula(formulas.parse_head, "Head", _text(root, "Type/Head"))
    _allowed(head.name, SHAPES, "<Type><Head>")
    return head


def _symmetry(root: Element, tag: str) -> tuple[str, ...]:
    text = _optional_text(root, f"Type/{tag}")
    return () if text is None else tuple(part.strip() for part in text.split(","))


# ------------------------------------------------------------------ entries
def _object(root: Element) -> ObjectEntry:
    concavity = _optional_text(root, "Type/Concavity")
    scale = _optional_text(root, "Embodiment/Scale")
    movable = _optional_text(root, "Embodiment/Movable")
    return ObjectEntry(
        _lex(root, OBJECT_TYPES),
        _head(root),
        tuple(
            _formula(formulas.parse_head, "Component", _attribute(element, "Value"))
            for element in root.iterfind("Type/Components/Component")
        ),
        None if concavity is None else _allowed(concavity, CONCAVITIES, "<Concavity>"),
        _symmetry(root, "RotatSym"),
        _symmetry(root, "ReflSym"),
        _habitats(root, "Intrinsic", "Intr"),
        _habitats(root, "Extrinsic", "Extr"),
        _affordances(root),
        None if scale is None else _allowed(scale, EMBODIMENT_SCALES, "<Embodiment><Scale>"),
        None if movable is None else _allowed(movable.lower(), ("true", "false"), "<Movable>") == "true",
        tuple(_attribute(element, "Value") for element in root.iterfind("Attributes/Attrs/Attr")),
    )


def _program(root: Element) -> ProgramEntry:
    args, body = _arguments(root), _body(root)
    if not args or "agent" not in args[0].types:
        raise _Fault('<Args>: the first argument must be the agent: add <Arg Value="x:agent" />')
    if not body:
        raise _Fault('<Body> has no subevents: add at least <Subevent Value="e1:..." />')
    return ProgramEntry(_lex(root, PROGRAM_TYPES), _text(root, "Type/Head"), args, body)


def _attribute_entry(root: Element) -> AttributeEntry:
    scale = _allowed(_text(root, "Type/Scale"), SCALES, "<Scale>")
    arity = _allowed(_text(root, "Type/Arity"), ARITIES, "<Arity>")
    return AttributeEntry(_lex(root, None), scale, arity, _arguments(root))


def _relation(root: Element) -> RelationEntry:
    return RelationEntry(
        _lex(root, None),
        _allowed(_text(root, "Type/Class"), RELATION_CLASSES, "<Class>"),
        _text(root, "Type/Value"),
        _arguments(root),
        _optional_text(root, "Type/Constr"),
        tuple(_attribute(element, "Value") for element in root.iterfind("Type/Corresps/Corresp")),
    )


def _function(root: Element) -> FunctionEntry:
    return FunctionEntry(_lex(root, None), _text(root, "Type/Referent"), _text(root, "Type/Mapping"), _arguments(root))


_READERS: dict[EntityType, Callable[[Element], Entry]] = {
    EntityType.OBJECT: _object,
    EntityType.PROGRAM: _program,
    EntityType.ATTRIBUTE: _attribute_entry,
    EntityType.RELATION: _relation,
    EntityType.FUNCTION: _function,
}
