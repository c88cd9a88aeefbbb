"""Writing entries: the XML that `voxml.reader` reads back to an equal entry, in the order of elements of the schema."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any
from xml.sax.saxutils import escape

from . import formulas
from .schema import (
    ENTITY_TYPES,
    Argument,
    AttributeEntry,
    Entry,
    FunctionEntry,
    HabitatCondition,
    Lex,
    ObjectEntry,
    ProgramEntry,
    RelationEntry,
    Synonym,
)

_HEADER = '<?xml version="1.0" encoding="utf-8"?>'
_Attributes = tuple[tuple[str, str], ...]


def write_entry(entry: Entry) -> str:
    """The entry's XML; ``parse_entry(write_entry(entry))`` is equal to it."""
    parts: list[Any] = [_leaf("Entity", (("Type", ENTITY_TYPES[type(entry)].value),)), _lex(entry.lex)]
    parts.extend(_PARTS[type(entry)](entry))
    return "\n".join([_HEADER, *_lines(("VoxML", parts), "")]) + "\n"


# ------------------------------------------------------------------ elements: a line, or a name with what it holds
def _lines(part: Any, indent: str) -> Iterable[str]:
    if isinstance(part, str):
        yield indent + part
        return
    name, children = part
    if not children:
        yield f"{indent}<{name} />"
        return
    yield f"{indent}<{name}>"
    for child in children:
        yield from _lines(child, indent + "  ")
    yield f"{indent}</{name}>"


def _quoted(value: str) -> str:
    return escape(value, {'"': "&quot;"})


def _leaf(name: str, attributes: _Attributes = (), text: str | None = None) -> str:
    said = "".join(f' {key}="{_quoted(value)}"' for key, value in attributes)
    return f"<{name}{said} />" if text is None else f"<{name}{said}>{escape(text)}</{name}>"


def _texts(**texts: str | None) -> list[str]:
    return [_leaf(name, text=text) for name, text in texts.items() if text is not None]


def _values(outer: str, inner: str, values: Iterable[str], attribute: str = "Value") -> list[Any]:
    leaves = [_leaf(inner, ((attribute, value),)) for value in values]
    return [(outer, leaves)] if leaves else []


# ------------------------------------------------------------------ parts of entries
def _lex(lex: Lex) -> Any:
    spoken: _Attributes = () if lex.spoken else (("Spoken", "false"),)
    parts: list[Any] = [_leaf("Pred", spoken, lex.pred), _leaf("Type", text="*".join(lex.types))]
    if lex.synonyms:
        parts.append(("Synonyms", [_leaf("Synonym", _synonym(each), each.text) for each in lex.synonyms]))
    if lex.forms:
        forms = [(("Of", form.of), ("Kind", form.kind.value), ("Value", form.value)) for form in lex.forms]
        parts.append(("Forms", [_leaf("Form", form) for form in forms]))
    return "Lex", parts


def _synonym(word: Synonym) -> _Attributes:
    said = (
        ("Kind", None if word.kind is None else word.kind.value),
        ("Gives", None if word.gives is None else str(word.gives)),
        ("Bare", None if word.bare is None else str(word.bare).lower()),
    )
    return tuple((key, value) for key, value in said if value is not None)


def _args(args: tuple[Argument, ...]) -> list[Any]:
    return [("Args", [_leaf("Arg", _argument(argument)) for argument in args])] if args else []


def _argument(argument: Argument) -> _Attributes:
    said = (
        ("Value", f"{argument.variable}:{'|'.join(argument.types)}"),
        ("Default", None if argument.default is None else str(argument.default)),
        ("Optional", "true" if argument.optional else None),
        ("Markers", " ".join(argument.markers) or None),
        ("Bare", None if argument.bare else "false"),
    )
    return tuple((key, value) for key, value in said if value is not None)


def _habitats(outer: str, inner: str, conditions: tuple[HabitatCondition, ...]) -> Any:
    pairs = [formulas.format_habitat(condition) for condition in conditions]
    return outer, [_leaf(inner, (("Name", name), ("Value", value))) for name, value in pairs]


def _object(entry: ObjectEntry) -> list[Any]:
    components = [_leaf("Component", (("Value", formulas.format_head(head)),)) for head in entry.components]
    shape: list[Any] = [_leaf("Head", text=formulas.format_head(entry.head)), ("Components", components)]
    shape += _texts(Concavity=entry.concavity)
    for name, planes in (("RotatSym", entry.rotational_symmetry), ("ReflSym", entry.reflectional_symmetry)):
        shape.append(_leaf(name, text=",".join(planes) or None))
    habitat = [_habitats("Intrinsic", "Intr", entry.intrinsic), _habitats("Extrinsic", "Extr", entry.extrinsic)]
    affordances = [formulas.format_affordance(affordance) for affordance in entry.affordances]
    movable = None if entry.movable is None else str(entry.movable).lower()
    embodiment = _texts(Scale=entry.scale, Movable=movable)
    parts: list[Any] = [("Type", shape), ("Habitat", habitat)]
    parts.append(("Afford_Str", _values("Affordances", "Affordance", affordances, "Formula")))
    if embodiment:
        parts.append(("Embodiment", embodiment))
    if entry.attributes:
        parts.append(("Attributes", _values("Attrs", "Attr", entry.attributes)))
    return parts


def _program(entry: ProgramEntry) -> list[Any]:
    body = _values("Body", "Subevent", map(formulas.format_subevent, entry.body))
    return [("Type", [_leaf("Head", text=entry.head), *_args(entry.args), *body])]


def _attribute(entry: AttributeEntry) -> list[Any]:
    return [("Type", [*_args(entry.args), *_texts(Scale=entry.scale, Arity=entry.arity)])]


def _relation(entry: RelationEntry) -> list[Any]:
    texts = _texts(Class=entry.relation_class, Value=entry.value, Constr=entry.constraint)
    return [("Type", [*_args(entry.args), *texts, *_values("Corresps", "Corresp", entry.correspondences)])]


def _function(entry: FunctionEntry) -> list[Any]:
    return [("Type", [*_args(entry.args), *_texts(Referent=entry.referent, Mapping=entry.mapping)])]


_PARTS: dict[type, Callable[[Any], list[Any]]] = {
    ObjectEntry: _object,
    ProgramEntry: _program,
    AttributeEntry: _attribute,
    RelationEntry: _relation,
    FunctionEntry: _function,
}
