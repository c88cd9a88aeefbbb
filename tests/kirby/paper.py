"""Every utterance quoted in the paper, and its scenario, as dialogues in pybullet: what was said, sent, done and told.

Each dialogue is a function over a `Rehearsal`, which says its lines and keeps the transcript; the section of the paper
stands in its title. ``docs/write_paper_dialogues.py`` writes the transcripts down.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import pytest
from stage import Stage

from dialogue.events import (
    Dispatch,
    Gesture,
    GestureKind,
    MoveCamera,
    Output,
    PointedObject,
    PointedPlace,
    Pointing,
    Say,
    Utterance,
)
from kirby.conversation import Happening
from robot.geometry import Point, Pose
from robot.messages import encode_command

HELP = "user input is required: keep going OR go back. Shall I keep going?"


@dataclass
class Rehearsal:
    """A dialogue on the stage, with what happened in lines of text."""

    stage: Stage
    transcript: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.stage.conversation.watch(self._note)

    # -------------------------------------------------------------- what people and the robot do
    def say(self, text: str) -> list[str]:
        """Say it, and let the robot do what comes of it; what Kirby said meanwhile."""
        said = self.stage.say(text)
        self._note_pose()
        return said

    def begin(self, text: str, distance_m: float) -> None:
        """Say it, and let the robot drive only so far."""
        began = self.at.point
        self.stage.begin(text)
        self.stage.drive(lambda: self.at.point.distance_to(began) >= distance_m)

    def gesture(self, kind: GestureKind | str) -> None:
        self.stage.gesture(kind)
        self._note_pose()

    def point(self, at: Point | int) -> None:
        self.stage.point(at)

    @property
    def at(self) -> Pose:
        """Where the robot truly is."""
        return self.stage.body.truth()

    def is_at(self, x_m: float, y_m: float, yaw_deg: float | None = None, within_m: float = 0.15) -> None:
        """Check where the robot truly is."""
        assert self.at.point.distance_to(Point(x_m, y_m)) <= within_m, self.at
        if yaw_deg is not None:
            assert math.cos(self.at.yaw_rad - math.radians(yaw_deg)) >= math.cos(math.radians(5)), self.at

    def is_before(self, fiducial: int) -> None:
        """Check that the robot truly stands before a marker."""
        assert self.at.point.distance_to(self.stage.marker(fiducial).point) <= 0.45, self.at

    # -------------------------------------------------------------- what is written down
    def _note(self, happening: Happening, outputs: tuple[Output, ...]) -> None:
        match happening:
            case Utterance(text):
                self.transcript += ["", f"You: {text}"]
            case Pointing(PointedPlace(place)):
                self.transcript += ["", f"You point at ({place.x_m:g}, {place.y_m:g})"]
            case Pointing(PointedObject(id)):
                self.transcript += ["", f"You point at fiducial {id}"]
            case Gesture(kind):
                self.transcript += ["", f"You: [{kind.value if isinstance(kind, GestureKind) else kind}]"]
        for output in outputs:
            match output:
                case Dispatch(commands):
                    self.transcript += [f"    > {encode_command(command)}" for command in commands]
                case Say(text):
                    self.transcript.append(f"Kirby: {text}")
                case MoveCamera(move):
                    self.transcript.append(f"    (the camera: {move.value})")

    def _note_pose(self) -> None:
        at = self.at
        x_m, y_m, yaw_deg = round(at.x_m, 1) + 0.0, round(at.y_m, 1) + 0.0, 5 * round(math.degrees(at.yaw_rad) / 5)
        self.transcript.append(f"    (at {x_m:g}, {y_m:g}, facing {yaw_deg} degrees)")


# ------------------------------------------------------------------ the dialogues
def movements(kirby: Rehearsal) -> None:
    """Go forward, go to, turn left, turn right, several in a row."""
    kirby.say("go forward")
    kirby.is_at(1.0, 0.0, 0.0)
    kirby.say("turn left")
    kirby.is_at(1.0, 0.0, 90.0)
    kirby.say("turn right")
    kirby.is_at(1.0, 0.0, 0.0)
    kirby.say("go to 0.2 0.4")
    kirby.is_at(0.2, 0.4)
    kirby.say("go forward 0.5")
    kirby.is_at(0.7, 0.4)
    kirby.say("turn left 45, turn right 30 and then go forward half a meter")
    kirby.is_at(0.7 + 0.5 * math.cos(math.radians(15)), 0.4 + 0.5 * math.sin(math.radians(15)), 15.0)


def flow_of_control(kirby: Rehearsal) -> None:
    """Stop, continue, cancel, cancel all, go back."""
    kirby.begin("go to 1.5 0", 0.5)
    assert "paused current goal" in kirby.say("stop")
    assert kirby.at.x_m < 1.2
    assert "restarting current goal" in kirby.say("continue")
    kirby.is_at(1.5, 0.0)
    kirby.stage.begin("turn left")
    kirby.begin("go forward one meter", 0.3)
    assert "canceled goal" in kirby.say("cancel")
    kirby.is_at(1.5, 0.4, 90.0)
    kirby.begin("go back one meter and turn right", 0.3)
    assert "canceled all goals" in kirby.say("cancel all")
    kirby.is_at(1.5, 0.0, 90.0, within_m=0.25)
    began = kirby.at
    kirby.begin("go forward 1.5, turn around and take a picture", 0.4)
    assert "returned to previous location" in kirby.say("go back")
    kirby.is_at(began.x_m, began.y_m)


def patrol(kirby: Rehearsal) -> None:
    """Patrol with its defaults, and with sides, radius and increment of one's own, until told to stop."""
    kirby.begin("patrol", 0.8)
    assert "stopped patrolling" in kirby.say("stop patrolling")
    kirby.say("go to 0.5 0")
    kirby.stage.begin("patrol with 6 sides, radius 0.4 meters and increment 0.2 meters")
    kirby.stage.drive(lambda: (current := kirby.stage.robot.queue.current) is not None and current.loop == 1)
    assert {"planning loop 1", "completed loop 1"} <= {line.text for line in kirby.stage.lines}
    assert "stopped patrolling" in kirby.say("stop the patrol")
    assert kirby.stage.conversation.agent.state == "idle"


def messages(kirby: Rehearsal) -> None:
    """What Kirby says of a goal: begun, reached, unachievable; and of words it does not know."""
    said = kirby.say("go to 0.5 0")
    assert said[0] == "looking for path to (0.5, 0)"
    assert "successfully navigated to (0.5, 0)" in said
    assert said[-1] == "waiting for commands"
    assert "unable to complete goal" in kirby.say("go to 3 -1.6")
    assert any("I didn't understand" in line for line in kirby.say("colorless green ideas sleep furiously"))


def introduction(kirby: Rehearsal) -> None:
    """Go there; go to that wastebasket and turn around; find the blue block."""
    kirby.point(Point(1.2, 0.3))
    kirby.say("go there")
    kirby.is_at(1.2, 0.3)
    kirby.point(3)
    kirby.say("go to that wastebasket and turn around")
    kirby.is_before(3)
    assert kirby.stage.off_by_rad(kirby.stage.marker(3).point) > math.radians(165)
    kirby.say("find the blue block")
    kirby.is_before(2)


def deixis(kirby: Rehearsal) -> None:
    """First fiducial and block on the right; go to that one; turn this way; a little further; there."""
    kirby.say("go to the first fiducial on the right")
    kirby.is_before(1)
    kirby.point(2)
    kirby.say("go to that one")
    kirby.is_before(2)
    kirby.point(Point(0.0, 0.0))
    kirby.say("turn this way")
    assert kirby.stage.off_by_rad(Point(0.0, 0.0)) < math.radians(5)
    before = kirby.at
    kirby.say("go forward half a meter")
    kirby.say("a little further")
    assert kirby.at.point.distance_to(before.point) == pytest.approx(0.8, abs=0.1)
    kirby.say("face east")
    kirby.say("go to the first block on the right")
    kirby.is_before(1)


def gestures(kirby: Rehearsal) -> None:
    """Pointing, thumbs up and down, claw, push, beckon, servo; the camera; and the open palm."""
    kirby.point(Point(0.6, 0.2))
    kirby.gesture(GestureKind.THUMBS_UP)
    kirby.is_at(0.6, 0.2)
    kirby.gesture(GestureKind.SERVO_LEFT)
    kirby.is_at(0.6, 0.2, 15.0)
    kirby.gesture(GestureKind.SERVO_RIGHT)
    kirby.gesture(GestureKind.SERVO_RIGHT)
    kirby.is_at(0.6, 0.2, -15.0)
    kirby.gesture(GestureKind.BECKON)
    kirby.point(Point(0.1, 0.0))
    kirby.stage.settle()
    kirby.is_at(0.1, 0.0)
    for answer, distance_m in ((GestureKind.THUMBS_UP, 1.0), (GestureKind.THUMBS_DOWN, 0.3)):
        began = kirby.at
        kirby.begin("go forward", 0.3)
        kirby.gesture(GestureKind.OPEN_PALM)
        assert kirby.stage.conversation.agent.state == "paused"
        kirby.gesture(answer)
        assert kirby.stage.conversation.agent.state == "idle"
        assert kirby.at.point.distance_to(began.point) == pytest.approx(distance_m, abs=0.15)
    kirby.gesture(GestureKind.CLAW)
    assert "that takes a hand" in kirby.stage.lines[-1].text
    for kind in (GestureKind.PUSH_LEFT, GestureKind.PUSH_RIGHT, GestureKind.SERVO_LEFT, GestureKind.SERVO_BACK):
        stood = kirby.at
        kirby.gesture(kind)
        assert kirby.at.point.distance_to(stood.point) < 0.01


def learned_gesture(kirby: Rehearsal) -> None:
    """An L shape for "go forward 1m, turn right, then go forward 2m"."""
    kirby.say("go to 0.45 0")
    kirby.say("learn the L shape: go forward 1m, turn right, then go forward 2m")
    kirby.gesture("L shape")
    kirby.is_at(1.45, -2.0, -90.0)


def scenario(kirby: Rehearsal) -> None:
    """The scenario: a new space, five fiducials, a target out of reach, and a place near it to point at."""
    kirby.say("go forward half a meter")
    assert any(line.startswith("I know of 3 fiducials") for line in kirby.say("how many fiducials are on the right"))
    assert any(line.startswith("I know of 2 fiducials") for line in kirby.say("how many fiducials are on the left"))
    said = kirby.say("go to the first one on the right")
    assert "moved from expected path and failed to reach goal" in said
    assert said[-1] == HELP
    place = Point(1.6, -0.5)
    kirby.point(place)
    said = kirby.say("go there")
    assert any(line.startswith("successfully navigated to") for line in said)
    kirby.is_at(place.x_m, place.y_m, within_m=0.2)


def keep_going(kirby: Rehearsal) -> None:
    """One answer to "keep going OR go back": what was to come next is done from where the robot is."""
    assert kirby.say("go to the first one on the right and then turn left")[-1] == HELP
    strayed = kirby.at
    assert "restarting current goal" in kirby.say("keep going")
    kirby.is_at(strayed.x_m, strayed.y_m)
    assert kirby.at.yaw_rad != pytest.approx(strayed.yaw_rad, abs=1.0)


def go_back(kirby: Rehearsal) -> None:
    """The other answer."""
    assert kirby.say("go to the first one on the right")[-1] == HELP
    assert "returned to previous location" in kirby.say("go back")
    kirby.is_at(0.0, 0.0)


@dataclass(frozen=True)
class Scene:
    """A dialogue with the section of the paper that it is from, and the world that it takes place in."""

    title: str
    world: str
    play: Callable[[Rehearsal], None]


SCENES = (
    Scene("Introduction: go there", "figure3", introduction),
    Scene("3.1: basic movement commands", "figure3", movements),
    Scene("3.1: flow of control", "figure3", flow_of_control),
    Scene("3.1: patrol", "figure3", patrol),
    Scene("3.3.2: pointing, ordinals and a little further", "figure3", deixis),
    Scene("3.3.2: the default gestures", "figure3", gestures),
    Scene("3.3.2: a gesture learned live", "figure3", learned_gesture),
    Scene("3.3.2: what Kirby says", "figure3_blocked", messages),
    Scene("4: the scenario", "section4", scenario),
    Scene("4: keep going", "section4", keep_going),
    Scene("4: go back", "section4", go_back),
)


def section(scene: Scene, kirby: Rehearsal) -> str:
    """What was said and done, as a section of the document."""
    lines = "\n".join(kirby.transcript).strip()
    return f"## {scene.title}\n\n{scene.play.__doc__}\n\n```text\n{lines}\n```\n"
