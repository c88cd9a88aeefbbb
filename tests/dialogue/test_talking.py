"""Questions, fragments, corrections and teaching: what is said, and what is sent."""

from __future__ import annotations

import pytest
from talk import BLOCKS, sent

from dialogue import DialogueManager, Session
from dialogue.ellipsis import alone, completed
from dialogue.events import Event, Gesture, Output, Say, Tick, Utterance
from dialogue.reminders import REMIND_AFTER_S
from grammar.acts import DialogueAct, Function
from grammar.forms import parse_form
from voxml.vocabulary import load_lexicon

LEXICON = load_lexicon()


def acts(text: str) -> tuple[DialogueAct, ...]:
    """``function form``."""
    function, _, form = text.partition(" ")
    return (DialogueAct(Function(function), parse_form(form), (0, len(text))),)


class Talk:
    def __init__(self) -> None:
        self.manager = DialogueManager(LEXICON, acts, Session(world=BLOCKS))
        self.time_s = 0.0

    def handle(self, event: Event) -> tuple[Output, ...]:
        return self.manager.handle(event)

    def say(self, text: str) -> tuple[list[str], list[str]]:
        """The commands that are sent, and what Kirby says."""
        self.time_s += 1.0
        outputs = self.handle(Utterance(text, self.time_s))
        return sent(outputs), [output.text for output in outputs if isinstance(output, Say)]


@pytest.mark.parametrize(
    ("last", "fragment", "form"),
    [
        ("turn(left,90deg)", "more(10)", "turn(left,10deg)"),
        ("turn(left)", "right", "turn(right)"),
        ("go(forward,2m)", "3m", "go(forward,3m)"),
        ("go(forward,2m)", "back", "go(back,2m)"),
        ("go", "other(way)", "go(back)"),
        ("seq(go(forward),turn(left))", "45deg", "turn(left,45deg)"),
        ("seq(go(forward),turn(left))", "again", "seq(go(forward),turn(left))"),
        ("go(to(the(red(block))))", "the(blue(one))", "go(to(the(blue(one))))"),
        ("face(the(red(block)))", "the(blue(one))", "face(the(blue(one)))"),
        ("go(to(the(first(block,on(right)))))", "again(left)", "go(to(the(first(block,on(left)))))"),
        ("go(to(the(door)))", "past(it)", "go(past(it))"),
        ("turn(left)", "repeat(2,again)", "repeat(2,turn(left))"),
        ("patrol", "10deg", None),
        ("turn(left)", "2m", None),
        ("turn(left)", "the(block)", None),
    ],
)
def test_fragments_are_completed_by_what_was_done_last(last: str, fragment: str, form: str | None) -> None:
    got = completed(parse_form(fragment), parse_form(last), LEXICON)
    assert (None if got is None else str(got)) == form


def test_fragments_that_say_what_to_do_by_themselves() -> None:
    got = {said: str(alone(parse_form(said), LEXICON)) for said in ("left", "north", "to(the(door))", "10deg")}
    assert got == {"left": "turn(left)", "north": "face(north)", "to(the(door))": "go(to(the(door)))", "10deg": "None"}


def test_a_routine_is_learned_done_by_name_and_by_gesture_and_forgotten() -> None:
    talk = Talk()
    assert talk.say('instruct learn("the loop",seq(go(forward,1m),turn(right)))') == ([], ["I know the loop now."])
    loop = ["go forward 1", "turn right 90"]
    assert talk.say('instruct repeat(2,perform("the loop"))')[0] == [*loop, *loop]
    assert sent(talk.handle(Gesture("the loop", 5.0))) == loop
    assert talk.say('instruct forget("the loop")')[1] == ["I have forgotten the loop."]
    assert talk.say('instruct perform("the loop")') == ([], ["I don't know the loop."])


def test_a_routine_that_would_lead_back_to_itself_ends() -> None:
    talk = Talk()
    talk.say('instruct learn("loop",seq(go(forward),perform("loop")))')
    assert len(talk.say('instruct perform("loop")')[0]) <= 1


def test_a_place_is_given_a_name_and_gone_back_to() -> None:
    talk = Talk()
    talk.say("instruct name(this(spot),the(home))")
    talk.say("instruct go(forward,2m)")
    assert talk.say("instruct go(to(the(home)))")[0] == ["go to 0 0"]


def test_a_thing_is_given_a_name() -> None:
    talk = Talk()
    assert talk.say('instruct name(the(red(block)),"bob")')[1] == ["The red block is bob from now on."]
    assert talk.say('question where("bob")')[1] == ["Bob is 2.2 meters away, ahead on the right."]


def test_what_is_said_on_arrival_waits_for_it() -> None:
    talk = Talk()
    commands, said = talk.say('instruct seq(go(forward,1m),say("here I am"))')
    assert (commands, said) == (["go forward 1"], [])
    assert talk.manager.session.agenda is not None


def test_reminders_escalate_and_let_go() -> None:
    talk = Talk()
    talk.say("instruct turn(45deg)")
    talk.handle(Tick(0.0))
    said = [o.text for s in REMIND_AFTER_S for o in talk.handle(Tick(s)) if isinstance(o, Say)]
    question = "Which way shall I turn: left or right?"
    assert said == [question, f"{question} Please say left or right.", "Never mind, then."]
    assert talk.manager.session.question is None
