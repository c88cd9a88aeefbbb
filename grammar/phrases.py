"""What the parts of a noun phrase make together, in the notation of ``docs/forms.md``."""

from __future__ import annotations

from dataclasses import dataclass, replace

from voxml.terms import Form, Quantity, Term

from .machine import Refused

ONE = Term("one")
YOU = Term("you")
_WHOLE = frozenset({"all", "both", "every", "each", "any", "no", "either", "neither", "most"})
_AHEAD = {"forward": Term("in_front_of", (YOU,)), "back": Term("behind", (YOU,))}


@dataclass(frozen=True, slots=True)
class Nominal:
    """A noun with what stands around it, before a determiner is put to it."""

    noun: Form
    plural: bool = False
    adjectives: tuple[Term, ...] = ()
    orderings: tuple[Form, ...] = ()
    modifiers: tuple[Form, ...] = ()

    def described(self) -> Form:
        """The noun inside its adjectives."""
        form = self.noun
        for adjective in reversed(self.adjectives):
            form = Term(adjective.pred, (form,))
        return form


@dataclass(frozen=True, slots=True)
class Pre:
    """Something before the noun: an adjective, an ordinal or superlative, a count."""

    form: Form
    is_ordering: bool


@dataclass(frozen=True, slots=True)
class Such:
    """An adjective behind the noun: "the box that is red" is the red box."""

    quality: Term


@dataclass(frozen=True, slots=True)
class Extreme:
    """A superlative behind the noun: "the door (that is) closest to you"."""

    ordering: Form
    modifiers: tuple[Form, ...] = ()


Post = Form | Such | Extreme


def nominal(noun: Form, pres: tuple[Pre, ...] = (), posts: tuple[Post, ...] = ()) -> Nominal:
    """A noun with what was said before and after it."""
    plural = isinstance(noun, Term) and noun.pred == "plural"
    bare = noun.args[0] if isinstance(noun, Term) and plural else noun
    adjectives = tuple(pre.form for pre in pres if not pre.is_ordering and isinstance(pre.form, Term))
    adjectives += tuple(post.quality for post in posts if isinstance(post, Such))
    extremes = tuple(post for post in posts if isinstance(post, Extreme))
    orderings = tuple(pre.form for pre in pres if pre.is_ordering) + tuple(each.ordering for each in extremes)
    modifiers = tuple(post for post in posts if not isinstance(post, Such | Extreme))
    modifiers += tuple(modifier for each in extremes for modifier in each.modifiers)
    return Nominal(bare, plural, adjectives, orderings, modifiers)


def headless(pres: tuple[Pre, ...], posts: tuple[Post, ...] = ()) -> Nominal:
    """ "the first", "the nearest on the left", "two of the blocks": a noun is understood.

    "the red" is not English for a thing.
    """
    if isinstance(pres[-1].form, Quantity) and posts and _is_of(posts[0]):
        return nominal(Term("plural", (ONE,)), pres, posts)
    match posts:
        case (Term("number", (Quantity() as count,)), *rest):  # "the other two"
            return headless((*pres, Pre(count, True)), tuple(rest))
    if not any(pre.is_ordering and isinstance(pre.form, Term) for pre in pres):
        raise Refused("a noun")
    if pres[-1].is_ordering and not all(pre.is_ordering for pre in pres):  # "left first" is no noun phrase
        raise Refused("a noun")
    return nominal(ONE, pres, posts)


def places(posts: tuple[Post, ...]) -> tuple[Form, ...]:
    """Modifiers without a noun: each must say where, since a quality needs something to be the quality of."""
    found = tuple(post for post in posts if not isinstance(post, Such | Extreme))
    if len(found) < len(posts):
        raise Refused("a thing or place")
    return found


def phrase(determiner: Form, what: Nominal) -> Form:
    """A noun phrase: orderings inside the determiner, modifiers inside the innermost of them."""
    assert isinstance(determiner, Term)
    core = what.described()
    if what.plural and determiner.pred not in _WHOLE:
        core = Term("plural", (core,))
    chain = flat_chain(what.modifiers)
    for ordering in reversed(what.orderings):
        inner = (core, *chain)
        core = Term("count", (ordering, *inner)) if isinstance(ordering, Quantity) else Term(pred_of(ordering), inner)
        chain = ()
    return Term(determiner.pred, (core, *chain))


def flat_chain(modifiers: tuple[Form, ...]) -> tuple[Form, ...]:
    """Modifiers of a landmark are put into the chain behind it: which of the two they belong to, the world settles."""
    chain: list[Form] = []
    for modifier in modifiers:
        chain.append(modifier)
        match modifier:
            case Term(pred, (Term(determiner, (core, *inner)),)) if inner and determiner in ("the", "a"):
                chain[-1:] = [Term(pred, (Term(determiner, (core,)),)), *inner]
    return tuple(chain)


def bare_phrase(what: Nominal) -> Form:
    """Without a determiner: "go to table" means the one there is, "find doors" some, "one of the doors" any."""
    if what.noun == ONE and not what.plural and what.modifiers and _is_of(what.modifiers[0]):
        return phrase(Term("a"), what)
    return phrase(Term("some" if what.plural else "the"), what)


def _is_of(post: Post) -> bool:
    return isinstance(post, Term) and post.pred == "of"


def compound(modifier: Form, head: Form) -> Form:
    """ "conference table": the first noun narrows the second as an adjective does."""
    if not isinstance(modifier, Term) or not isinstance(head, Term):
        raise Refused("a noun")
    if ONE in (modifier, head):
        raise Refused("a noun")
    narrowing = modifier.args[0] if modifier.pred == "plural" else modifier
    if head.pred == "plural":
        return Term("plural", (Term(pred_of(narrowing), head.args),))
    return Term(pred_of(narrowing), (head,))


def relation(relation_form: Form, place: Form) -> Term:
    """A relation with its landmark; "between a and b" takes the two apart."""
    pred = pred_of(relation_form)
    if pred == "between" and isinstance(place, Term) and place.pred == "and":
        return Term(pred, place.args)
    return Term(pred, (place,))


def relation_of_two(relation_form: Form, one: Form, mark: Form, other: Form) -> Term:
    """ "between the door and the window": a place that takes two landmarks; any other takes one."""
    if pred_of(relation_form) != "between":
        raise Refused("one landmark")
    return Term("between", (one, other))


def on_side(side: Form) -> Term:
    """ "on your left", as a modifier."""
    return Term("on", (side,))


def ahead(axis: Form) -> Term:
    """ "the door ahead", "the one behind" as seen by the robot."""
    return _AHEAD[pred_of(axis)]


def without_last(form: Form) -> tuple[Form, Form]:
    """A phrase without the last modifier of its chain, and that modifier."""
    match form:
        case Term(pred, (core, *chain, last)):
            return Term(pred, (core, *chain)), last
        case Term(pred, (Term() as inner,)):
            rest, last = without_last(inner)
            return Term(pred, (rest,)), last
        case _:
            raise Refused("what about it")


def parted(form: Form, preds: frozenset[str]) -> tuple[Form, Term] | None:
    """A phrase without its first modifier of these relations (of any, where there are none), and that modifier.

    What stands behind the modifier goes with its landmark: which of the two it belongs to, the world settles.
    """
    match form:
        case Term(pred, (core, *chain)) if chain:
            for at, modifier in enumerate(chain):
                if isinstance(modifier, Term) and len(modifier.args) == 1 and (not preds or modifier.pred in preds):
                    landmark = _with_modifiers(modifier.args[0], tuple(chain[at + 1 :]))
                    return Term(pred, (core, *chain[:at])), Term(modifier.pred, (landmark,))
        case Term(pred, (Term() as inner,)):
            found = parted(inner, preds)
            return None if found is None else (Term(pred, (found[0],)), found[1])
    return None


def _with_modifiers(form: Form, modifiers: tuple[Form, ...]) -> Form:
    return Term(form.pred, (*form.args, *modifiers)) if isinstance(form, Term) and modifiers else form


def ordered(what: Nominal, ordering: Form) -> Nominal:
    """A noun with one more ordinal or superlative."""
    return replace(what, orderings=(ordering, *what.orderings))


def pred_of(form: Form) -> str:
    """The predicate of a term. Raises Refused for what has none."""
    if not isinstance(form, Term):
        raise Refused("a word")
    return form.pred
