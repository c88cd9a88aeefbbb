"""The language model: a spaCy text classifier that says which program an utterance without a reading asks for.

Its files are weights (msgpack), and labels, words and a threshold (JSON). The network is built here, whatever is in the
files, so that reading them runs nothing that they bring along. spaCy is imported where it is first needed.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from grammar.guessing import NONE
from voxml.errors import KirbyError

EXTRA = "language"
_NEEDED = ("spacy", "platformdirs", "filelock")
NETWORK = {
    "@architectures": "spacy.TextCatBOW.v3",
    "exclusive_classes": True,
    "ngram_size": 2,
    "no_output_layer": False,
    "length": 2**14,
}
"""A bag of words and pairs: what it has not seen weighs nothing, so it is unsure of what is new to it."""

UNKNOWN = "<unknown>"
"""What the model sees in place of a word that it never learned."""

_VERSION = 1
_DESCRIPTION = "model.json"
_WEIGHTS = "weights"


class ModelError(KirbyError):
    """A language model that cannot be used; ``str()`` says what to do."""


@dataclass(frozen=True, slots=True)
class Classes:
    """What a model knows besides its weights: its labels and words, and how sure it must be (a probability)."""

    labels: tuple[str, ...]
    words: frozenset[str]
    threshold: float


class LanguageModel:
    """A trained classifier, as a `grammar.Proposer`."""

    def __init__(self, pipe: Any, classes: Classes) -> None:
        self.pipe = pipe
        self.classes = classes

    def __call__(self, words: tuple[str, ...]) -> str | None:
        """The likeliest program, if the model is sure enough that it is one."""
        label, confidence = self.likeliest(words)
        return None if label == NONE or confidence < self.classes.threshold else label

    def likeliest(self, words: tuple[str, ...]) -> tuple[str, float]:
        """The likeliest label, with its probability."""
        scores = self.pipe.predict([document(self.pipe.vocab, words, self.classes.words)])[0]
        best = int(scores.argmax())
        return self.classes.labels[best], float(scores[best])

    def save(self, folder: Path) -> None:
        """Write the model into a folder, which is made.

        Raises:
            ModelError: the folder cannot be written.
        """
        description = {
            "version": _VERSION,
            "threshold": self.classes.threshold,
            "labels": self.classes.labels,
            "words": sorted(self.classes.words),
        }
        try:
            folder.mkdir(parents=True, exist_ok=True)
            (folder / _WEIGHTS).write_bytes(self.pipe.model.to_bytes())
            (folder / _DESCRIPTION).write_text(json.dumps(description, indent=1), encoding="utf-8")
        except OSError as error:
            raise ModelError(f"the folder {folder} cannot be written ({error.strerror}): give another") from None

    @classmethod
    def load(cls, folder: Path) -> LanguageModel:
        """Read the model that `save` wrote.

        Raises:
            ModelError: spaCy is not installed, or there is no such model there.
        """
        check_extra()
        classes = _classes(folder)
        _, pipe = blank(classes.labels)
        try:
            pipe.model.from_bytes((folder / _WEIGHTS).read_bytes())
            model = cls(pipe, classes)
            model.likeliest(())
        except Exception as error:  # noqa: BLE001 - bytes that are no weights fail in as many ways as there are bytes
            raise _broken(folder, str(error)) from None
        return model


class StoredModel:
    """A model that is read when it is first asked, as a `grammar.Proposer`."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    @cached_property
    def _model(self) -> LanguageModel:
        return LanguageModel.load(self._folder)

    def __call__(self, words: tuple[str, ...]) -> str | None:
        """As `LanguageModel`. Raises ModelError as `LanguageModel.load` does."""
        return self._model(words)


def model_folder() -> Path:
    """Where ``kirby train language`` keeps its model: in the folder for what outlives a talk."""
    from robot.state_folder import default_state_folder

    return default_state_folder() / "language"


def trained_here() -> StoredModel | None:
    """The model that was trained on this machine; None where there is none, or no spaCy to read it."""
    if _missing() or not (model_folder() / _DESCRIPTION).exists():
        return None
    return StoredModel(model_folder())


def check_extra() -> None:
    """Raises ModelError where a package that a language model needs is not installed; none of them is imported."""
    if _missing():
        raise ModelError(f"a language model needs {', '.join(_missing())}: pip install 'kirby-dialogue[{EXTRA}]'")


def _missing() -> list[str]:
    return [name for name in _NEEDED if find_spec(name) is None]


def document(vocab: Any, words: tuple[str, ...], known: frozenset[str]) -> Any:
    """A spaCy document of the words between marks of beginning and end; those that are not known are all alike."""
    from spacy.tokens import Doc

    return Doc(vocab, words=["<begin>", *(word if word in known else UNKNOWN for word in words), "<end>"])


def blank(labels: Sequence[str]) -> tuple[Any, Any]:
    """A spaCy pipeline with an untrained classifier of these labels, and the classifier."""
    import spacy

    nlp = spacy.blank("en")
    pipe: Any = nlp.add_pipe("textcat", config={"model": NETWORK})
    for label in labels:
        pipe.add_label(label)
    return nlp, pipe


def _classes(folder: Path) -> Classes:
    try:
        data = json.loads((folder / _DESCRIPTION).read_text(encoding="utf-8"))
        classes = Classes(tuple(map(str, data["labels"])), frozenset(map(str, data["words"])), float(data["threshold"]))
    except FileNotFoundError:
        raise ModelError(f"there is no language model in {folder}: kirby train language makes one") from None
    except (OSError, ValueError, KeyError, TypeError, RecursionError) as error:
        raise _broken(folder, str(error)) from None
    if data.get("version") != _VERSION:
        raise _broken(folder, f"version {data.get('version')}, not {_VERSION}")
    return classes


def _broken(folder: Path, reason: str) -> ModelError:
    return ModelError(f"the language model in {folder} cannot be read ({reason}): kirby train language makes it anew")
