"""Sets of single words by what they can be, for rules that ask what stands beside a word."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from voxml.vocabulary import Lexicon

Words = frozenset[str]


@dataclass(frozen=True, slots=True)
class WordSets:
    """Words of one lexicon. A word of several categories is in several sets."""

    copulas: Words
    of: Words
    addresses: Words
    refusals: Words
    refusal_starts: Words  # first words of a phrase that refuses
    negations: Words
    openers: Words
    enumerators: Words
    intensifiers: Words
    benefactives: Words
    determiners: Words
    nouns: Words
    ones: Words
    verbs: Words  # and no nouns
    to_do: Words
    ways: Words
    way_nouns: Words  # "back", "front": ways to go that are also parts of things
    way_verbs: Words
    sides: Words
    places: Words  # first words of relations of place
    adjectives: Words  # first words of them
    before_nouns: Words
    before_robots: Words  # behind them "robot" is not spoken to


def word_sets(lexicon: Lexicon) -> WordSets:
    """The sets of a lexicon."""
    closed = lexicon.closed
    categories = {word: {sense.category for sense in senses} for word, senses in lexicon.single_words().items()}

    def listed(name: str) -> Words:
        return frozenset(closed.table(name))

    def of(*wanted: str) -> Words:
        return frozenset(word for word, found in categories.items() if not found.isdisjoint(wanted))

    nouns, ones = of("NOUN", "NOUNS"), of("ONE")
    determiners, sides, of_words = of("DETERMINER"), of("SIDE_ADJ"), listed("OF")
    ways = of("AXIS", "SIDE", "HEADING", "PLACE", "PATH") - nouns
    return WordSets(
        copulas=listed("BE"),
        of=of_words,
        addresses=listed("address"),
        refusals=listed("NO"),
        refusal_starts=_starts(words.words for name in ("NO", "NO_NO") for words in closed.words_of(name)),
        negations=listed("negation"),
        openers=listed("opener"),
        enumerators=listed("enumerator"),
        intensifiers=listed("intensifier"),
        benefactives=listed("benefactive"),
        determiners=determiners,
        nouns=nouns | ones,
        ones=ones,
        verbs=of("VERB") - nouns,
        to_do=of("VERB", "LIGHT"),
        ways=ways,
        way_nouns=of("AXIS") & nouns,
        way_verbs=of("AXIS") & of("VERB"),
        sides=sides,
        places=_starts(_phrases(lexicon, "LOC")) - determiners - ways - of_words,
        adjectives=_starts(_phrases(lexicon, "ADJECTIVE")),
        before_nouns=of("DETERMINER", "SIDE_ADJ", "ADJECTIVE", "ORDINAL"),
        before_robots=of("DETERMINER", "ADJECTIVE", "ORDINAL", "VERB", "PATH", "LOC", "BE") - sides,
    )


def _phrases(lexicon: Lexicon, category: str) -> Iterable[tuple[str, ...]]:
    return (sense.words for sense in lexicon.all_senses() if sense.category == category)


def _starts(phrases: Iterable[tuple[str, ...]]) -> Words:
    return frozenset(words[0] for words in phrases)
