"""Runs corpora against the dialogue engine, and tells what came instead of what was expected."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

from dialogue.events import (
    Dispatch,
    Event,
    Gesture,
    GestureKind,
    Output,
    PointedObject,
    PointedPlace,
    Pointing,
    RobotFeedback,
    Say,
    Tick,
    Utterance,
    WorldUpdate,
)
from dialogue.manager import DialogueManager
from dialogue.session import Session
from dialogue.understanding import understand
from grammar import parse
from grounding import World
from robot.geometry import Point, Pose
from robot.messages import FeedbackCode, Fiducial, Fiducials, Odom, encode_command, feedback
from voxml.scene import Scene, SceneError, find_scene
from voxml.vocabulary import Lexicon, load_lexicon

from .cases import (
    Case,
    CorpusError,
    DialogueCase,
    KnownFailure,
    Setting,
    TurnCase,
    load_corpus,
    load_known_failures,
    numbers,
)

FOLDER = Path(__file__).parent
KNOWN_FAILURES = "known_failures.yaml"


@dataclass(frozen=True, slots=True)
class Difference:
    """At ``step`` one thing was expected and another came."""

    step: str
    expected: object
    got: object


@dataclass(frozen=True, slots=True)
class Result:
    """What came of one case. ``known`` is why it is expected to fail, if it is."""

    source: str
    text: str
    differences: tuple[Difference, ...]
    known: KnownFailure | None = None

    @property
    def ok(self) -> bool:
        """Passed; or failed as it is known to, at that step first (what comes after it follows from it)."""
        if self.known is None:
            return not self.differences
        return bool(self.differences) and self.differences[0].step.startswith(self.known.step)


@dataclass(frozen=True, slots=True)
class Report:
    """What came of a run, in the order of the corpora. ``stale`` are known failures of cases that do not exist."""

    results: tuple[Result, ...]
    stale: tuple[KnownFailure, ...] = ()

    @property
    def ok(self) -> bool:
        return not self.stale and all(result.ok for result in self.results)

    def failures(self) -> tuple[Result, ...]:
        """Everything that did not come out as it should, known failures that pass among them."""
        return tuple(result for result in self.results if not result.ok)


def default_corpora() -> tuple[Path, ...]:
    """Kirby's own, those in folders too; worlds are none."""
    found = (path for path in sorted(FOLDER.rglob("*.yaml")) if "worlds" not in path.relative_to(FOLDER).parts)
    return tuple(path for path in found if path.name != KNOWN_FAILURES)


def run(paths: Iterable[Path] = (), lexicon: Lexicon | None = None) -> Report:
    """Run the corpora of these files, or Kirby's own, with the ``known_failures.yaml`` beside or just above them.

    Raises:
        CorpusError: a file cannot be used.
    """
    chosen = tuple(paths) or default_corpora()
    words = lexicon or load_lexicon()
    results: list[Result] = []
    stale: list[KnownFailure] = []
    for root in dict.fromkeys(map(_root, chosen)):
        known = {(k.source, k.text): k for k in load_known_failures(root / KNOWN_FAILURES)}
        here = {path.relative_to(root).as_posix(): path for path in chosen if _root(path) == root}
        for source, path in here.items():
            for case in load_corpus(path, source):
                differences = _run_case(case, path.parent, words)
                results.append(Result(source, case.text, differences, known.pop((source, case.text), None)))
        stale += [left for left in known.values() if left.source in here]
    return Report(tuple(results), tuple(stale))


def _root(path: Path) -> Path:
    """The folder whose list of known failures a corpus answers to."""
    folders = (path.parent, path.parent.parent)
    return next((folder for folder in folders if (folder / KNOWN_FAILURES).exists()), path.parent)


def _run_case(case: Case | DialogueCase, folder: Path, lexicon: Lexicon) -> tuple[Difference, ...]:
    world = _world(case.setting, folder, case.source)
    if isinstance(case, Case):
        return tuple(_case_differences(case, world, lexicon))
    return tuple(_dialogue_differences(case, world, _scene(case.setting.world, folder, case.source), lexicon))


# ------------------------------------------------------------------ single utterances
def _case_differences(case: Case, world: World | None, lexicon: Lexicon) -> Iterable[Difference]:
    record = understand(case.text, world, lexicon, lambda text: parse(text, lexicon))
    expected = {"status": case.status, "act": case.act, "form": case.form}
    for name, value in expected.items():
        if value is not None and record[name] != value:
            yield Difference(name, value, record[name])
    commands = None if record["commands"] is None else tuple(record["commands"])
    if commands != case.commands:
        yield Difference("commands", case.commands, commands)
    if case.replies is not None:
        outputs = _manager(world, lexicon).handle(Utterance(case.text, 0.0))
        if _said(outputs) != case.replies:
            yield Difference("reply", case.replies, _said(outputs))


# ------------------------------------------------------------------ dialogues
def _dialogue_differences(
    case: DialogueCase, world: World | None, scene: Scene | None, lexicon: Lexicon
) -> Iterable[Difference]:
    """The first turn that differs: what comes after it follows from it."""
    manager = _manager(world, lexicon)
    time_s = 0.0
    for number, turn in enumerate(case.turns, start=1):
        time_s += turn.after_s
        outputs = manager.handle(_event(turn, time_s, scene, f"{case.source}: {case.text}: turn {number}"))
        got = {"commands": _sent(outputs), "reply": _said(outputs), "state": manager.session.state.value}
        expected = {"commands": turn.commands, "reply": turn.replies, "state": turn.state}
        differences = [
            Difference(f"turn {number}: {name}", value, got[name])
            for name, value in expected.items()
            if value is not None and got[name] != value
        ]
        if differences:
            return differences
    return ()


def _manager(world: World | None, lexicon: Lexicon) -> DialogueManager:
    return DialogueManager(lexicon, lambda text: parse(text, lexicon), Session(world=world or World()))


def _sent(outputs: tuple[Output, ...]) -> tuple[str, ...]:
    return tuple(encode_command(c) for output in outputs if isinstance(output, Dispatch) for c in output.commands)


def _said(outputs: tuple[Output, ...]) -> tuple[str, ...]:
    return tuple(output.text for output in outputs if isinstance(output, Say))


# ------------------------------------------------------------------ events
def _event(turn: TurnCase, time_s: float, scene: Scene | None, at: str) -> Event:
    name, value = turn.event
    return _EVENTS[name](value, time_s, scene, at)


def _say(value: Any, time_s: float, scene: Scene | None, at: str) -> Event:
    if not isinstance(value, str):
        raise CorpusError(f"{at}: say '{value}' must be text: put it in quotes")
    return Utterance(value, time_s)


def _point(value: Any, time_s: float, scene: Scene | None, at: str) -> Event:
    if isinstance(value, list):
        return Pointing(PointedPlace(Point(*numbers(value, 2, f"{at}: point"))), time_s)
    return Pointing(PointedObject(str(value)), time_s)


def _gesture(value: Any, time_s: float, scene: Scene | None, at: str) -> Event:
    known = {kind.value: kind for kind in GestureKind}
    return Gesture(known.get(str(value), str(value)), time_s)


def _feedback(value: Any, time_s: float, scene: Scene | None, at: str) -> Event:
    row = {"code": value} if isinstance(value, str) else value
    if not isinstance(row, Mapping) or not {"code"} <= row.keys() <= {"code", "of", "at", "detail"}:
        raise CorpusError(f"{at}: feedback must have code, and may have of, at and detail")
    try:
        code = FeedbackCode(row["code"])
    except ValueError:
        raise CorpusError(f"{at}: feedback code '{row['code']}' is unknown") from None
    place = Point(*numbers(row["at"], 2, f"{at}: feedback.at")) if "at" in row else None
    of = f"k{row['of']}" if "of" in row else None
    return RobotFeedback(feedback(code, at=place, detail=str(row.get("detail", "")), id=of, time_s=time_s), time_s)


def _see(value: Any, time_s: float, scene: Scene | None, at: str) -> Event:
    things = () if scene is None else scene.objects
    markers = {str(thing.fiducial.id): thing.marker for thing in things if thing.fiducial}
    if not isinstance(value, list) or any(str(each) not in markers for each in value):
        raise CorpusError(f"{at}: see must be a list of fiducials of the world")
    seen = [(str(each), marker) for each in value if (marker := markers[str(each)]) is not None]
    fiducials = [Fiducial(name, (m.x_m, m.y_m, m.z_m), (0.0, 0.0, m.yaw_rad)) for name, m in seen]
    return WorldUpdate(time_s, fiducials=Fiducials(tuple(fiducials)))


def _tick(value: Any, time_s: float, scene: Scene | None, at: str) -> Event:
    return Tick(time_s)


def _move(value: Any, time_s: float, scene: Scene | None, at: str) -> Event:
    x_m, y_m, yaw_deg = numbers(value, 3, f"{at}: move")
    odom = Odom(0, 0, (x_m, y_m, 0.0), (0.0, 0.0, math.radians(yaw_deg)), 0.0, 0.0, time_s)
    return WorldUpdate(time_s, odom=odom)


_EVENTS: Mapping[str, Callable[[Any, float, Scene | None, str], Event]] = {
    "say": _say,
    "point": _point,
    "gesture": _gesture,
    "feedback": _feedback,
    "see": _see,
    "move": _move,
    "tick": _tick,
}


# ------------------------------------------------------------------ worlds
def _world(setting: Setting, folder: Path, source: str) -> World | None:
    scene = _scene(setting.world, folder, source)
    if scene is None:
        world = None if setting.at is None else World()
    elif setting.seen is None:
        world = World.explored(scene)
    else:
        world = World.explored(scene).only(setting.seen)
    if world is not None and setting.at is not None:
        x_m, y_m, yaw_deg = setting.at
        world = world.with_robot(Pose(x_m, y_m, math.radians(yaw_deg)))
    return world


def _scene(name: str | None, folder: Path, source: str) -> Scene | None:
    if name is None:
        return None
    try:
        return _found(str(folder / name) if name.endswith((".yaml", ".yml")) else name)
    except SceneError as error:
        raise CorpusError(f"{source}: {error}") from None


@cache
def _found(name: str) -> Scene:
    return find_scene(name, files("corpora") / "worlds")
