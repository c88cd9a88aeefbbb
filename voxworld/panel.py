"""The panel beside the world: what is shared by all, and each person's own corner of it."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from html import escape
from typing import Any

import viser
from numpy.typing import NDArray

from dialogue.events import CameraMove, GestureKind

from .cameras import View
from .nodes import Thing
from .talk import Condition, Errand, Remark, condition_html, conversation_html

WIDTH_PX = 380
_VIEWS = {View.BIRDS_EYE.value: CameraMove.BIRDS_EYE, View.ROBOT.value: CameraMove.ROBOT_VIEW}
_TURNS = {"turn left": CameraMove.ROTATE_LEFT, "back": CameraMove.BACK, "turn right": CameraMove.ROTATE_RIGHT}
_GESTURE_ROWS = (
    (GestureKind.THUMBS_UP, GestureKind.THUMBS_DOWN, GestureKind.OPEN_PALM),
    (GestureKind.BECKON, GestureKind.CLAW),
    (GestureKind.PUSH_LEFT, GestureKind.PUSH_RIGHT),
    (GestureKind.SERVO_LEFT, GestureKind.SERVO_BACK, GestureKind.SERVO_RIGHT),
)
_HOTKEYS: tuple[tuple[str, Any, CameraMove], ...] = (
    ("Bird's-eye view", "B", CameraMove.BIRDS_EYE),
    ("Kirby's view", "K", CameraMove.ROBOT_VIEW),
    ("Turn the camera left", "J", CameraMove.ROTATE_LEFT),
    ("Turn the camera right", "L", CameraMove.ROTATE_RIGHT),
    ("Draw the camera back", "M", CameraMove.BACK),
)
_CONDITION, _TALK, _SAY, _VIEW, _IMAGE, _ERRANDS, _THINGS, _GESTURES, _PERSON = range(9)


class SharedPanel:
    """What everybody sees alike: condition, conversation, errands, things found, gestures."""

    def __init__(
        self,
        server: viser.ViserServer,
        *,
        cancel: Callable[[int | None, str], None],
        rename: Callable[[int | None, str, str], None],
        gesture: Callable[[int | None, GestureKind], None],
    ) -> None:
        gui = self._gui = server.gui
        self._cancel, self._rename = cancel, rename
        gui.configure_theme(show_logo=False, show_share_button=False, control_width="large")
        gui.set_panel_label("Kirby")
        gui.main_panel.dock_right()
        gui.main_panel.set_width(WIDTH_PX)
        self._condition = gui.add_html(condition_html(Condition()), order=_CONDITION)
        self._talk = gui.add_html(conversation_html(()), order=_TALK)
        self._errands = gui.add_folder("To do", order=_ERRANDS)
        with self._errands:
            self._nothing: Any = gui.add_markdown("*nothing*")
        self._things = gui.add_folder("Things found", order=_THINGS, expand_by_default=False)
        self._errand_rows: list[Any] = []
        self._thing_rows: dict[str, tuple[Thing, Any, Any]] = {}
        self._add_gestures(gesture)

    def show_remarks(self, remarks: tuple[Remark, ...]) -> None:
        """The conversation so far."""
        self._talk.content = conversation_html(remarks)

    def show_condition(self, condition: Condition) -> None:
        """How robot and bridge are."""
        content = condition_html(condition)
        if content != self._condition.content:
            self._condition.content = content

    def show_errands(self, errands: tuple[Errand, ...]) -> None:
        """What is being done and what comes after it; a click cancels."""
        for row in self._errand_rows:
            row.remove()
        self._errand_rows = [self._errand_row(errand, index == 0) for index, errand in enumerate(errands)]
        self._nothing.visible = not errands

    def show_things(self, things: tuple[Thing, ...]) -> None:
        """What was found, each with its name to be edited."""
        wanted = {thing.entity: thing for thing in things}
        for entity in [entity for entity in self._thing_rows if entity not in wanted]:
            self._thing_rows.pop(entity)[1].remove()
        for entity, thing in wanted.items():
            known = self._thing_rows.get(entity)
            if known is None:
                self._thing_rows[entity] = (thing, *self._thing_row(thing))
            elif known[0].label != thing.label:
                known[2].value = thing.label
                self._thing_rows[entity] = (thing, known[1], known[2])

    def _errand_row(self, errand: Errand, first: bool) -> Any:
        with self._errands:
            button = self._gui.add_button(
                errand.text,
                icon=viser.Icon.X,
                color="blue" if first else "gray",
                hint="being done: click to cancel" if first else "waiting: click to cancel",
            )
        button.on_click(lambda event: self._cancel(event.client_id, errand.id))
        return button

    def _thing_row(self, thing: Thing) -> tuple[Any, Any]:
        with self._things:
            form = self._gui.add_form(None)
        with form:
            name = self._gui.add_text(thing.entity, thing.label, hint="Type a name and press Enter")
        form.on_submit(lambda event: self._rename(event.client_id, thing.entity, name.value))
        return form, name

    def _add_gestures(self, gesture: Callable[[int | None, GestureKind], None]) -> None:
        gui = self._gui
        with gui.add_folder("Gestures", order=_GESTURES, expand_by_default=False):
            for kinds in _GESTURE_ROWS:
                row = gui.add_button_group("", tuple(kind.value for kind in kinds))
                row.on_click(lambda event: gesture(event.client_id, GestureKind(event.target.value)))


class OwnPanel:
    """One person's corner: the text box, the camera, the robot's picture, the name."""

    def __init__(
        self,
        client: viser.ClientHandle,
        name: str,
        *,
        say: Callable[[str], None],
        camera: Callable[[CameraMove], None],
        renamed: Callable[[str], None],
    ) -> None:
        gui = client.gui
        form = gui.add_form(None, order=_SAY)
        with form:
            box = gui.add_text("Say", "", hint="Enter sends; the arrow keys bring back what was said before")
            gui.add_button("Send", icon=viser.Icon.SEND).on_click(lambda _: form.submit())
        form.on_submit(lambda _: _submit(box, say))
        views = gui.add_button_group("View", tuple(_VIEWS), order=_VIEW)
        views.on_click(lambda event: camera(_VIEWS[event.target.value]))
        turns = gui.add_button_group("Camera", tuple(_TURNS), order=_VIEW + 0.5)
        turns.on_click(lambda event: camera(_TURNS[event.target.value]))
        for label, key, move in _HOTKEYS:
            gui.add_command(label, hotkey=key).on_trigger(_ignoring(partial(camera, move)))
        self._gui = gui
        self._image: viser.GuiImageHandle | None = None
        with gui.add_folder("You", order=_PERSON, expand_by_default=False):
            self._name = gui.add_text("Name", name)
            self._name.on_update(lambda event: renamed(event.target.value))
        self._who = gui.add_html("", order=_PERSON + 1)
        self.show_name(name)

    def show_name(self, name: str) -> None:
        """Who presses Stop is read from the page by its script."""
        self._who.content = f'<span data-kirby-who="{escape(name, quote=True)}"></span>'

    def show_image(self, pixels: NDArray[Any] | None) -> None:
        """What the robot's camera sees, shape (height, width, 3); None takes the picture away."""
        if pixels is None:
            if self._image is not None:
                self._image.visible = False
        elif self._image is None:
            self._image = self._gui.add_image(pixels, label="Kirby's camera", format="jpeg", order=_IMAGE)
        else:
            self._image.image = pixels
            self._image.visible = True

    def ask(self, question: str, yes: Callable[[], None]) -> None:
        """A question with two buttons, for this person alone."""
        modal = self._gui.add_modal(question)
        with modal:
            go = self._gui.add_button("Yes, go there", color="green")
            no = self._gui.add_button("No", color="gray")

        def agreed(_: object) -> None:
            modal.close()
            yes()

        go.on_click(agreed)
        no.on_click(lambda _: modal.close())


def _ignoring(act: Callable[[], None]) -> Callable[[object], None]:
    return lambda _: act()


def _submit(box: Any, say: Callable[[str], None]) -> None:
    text = box.value.strip()
    box.value = ""
    if text:
        say(text)
