"""What a voxeme looks like: its shape from the VoxML head, its colour from its attributes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from enum import Enum

Colour = tuple[int, int, int]  # red, green, blue, 0 to 255


class Shape(Enum):
    """The heads of VoxML objects (Pustejovsky and Krishnaswamy 2016); the value is the head's text."""

    CYLINDROID = "cylindroid"
    ELLIPSOID = "ellipsoid"
    RECTANGULAR_PRISM = "rectangular_prism"
    TOROID = "toroid"
    PYRAMIDOID = "pyramidoid"
    SHEET = "sheet"


# Mild rather than pure, so that labels and shading stay readable on them.
COLOURS: Mapping[str, Colour] = {
    "black": (52, 54, 60),
    "blue": (56, 112, 214),
    "brown": (139, 96, 62),
    "cyan": (64, 190, 205),
    "gray": (140, 146, 152),
    "green": (66, 160, 90),
    "magenta": (205, 70, 160),
    "orange": (238, 140, 52),
    "pink": (238, 150, 180),
    "purple": (132, 84, 190),
    "red": (212, 66, 60),
    "white": (240, 240, 236),
    "yellow": (240, 200, 66),
}
# What no colour was said of: materials, then the tone of cardboard.
_MATERIALS: Mapping[str, Colour] = {
    "wooden": (170, 126, 82),
    "metal": (150, 156, 164),
    "plastic": (120, 170, 190),
    "glassy": (186, 214, 222),
}
UNPAINTED: Colour = (196, 176, 148)
WALL: Colour = (206, 208, 212)
ROBOT: Colour = (58, 62, 70)
TRAIL: Colour = (86, 140, 214)
PATH: Colour = (46, 170, 120)
POINTED: Colour = (150, 60, 200)  # the paper's purple circle
REFERENT: Colour = (255, 184, 28)
UNEXPLORED: Colour = (112, 120, 132)
EXPLORED: Colour = (236, 236, 230)


def colour_of(attributes: Iterable[str]) -> Colour:
    """The first colour among the attributes, else that of a material, else unpainted."""
    known = tuple(attributes)
    for table in (COLOURS, _MATERIALS):
        for attribute in known:
            if attribute in table:
                return table[attribute]
    return UNPAINTED


def shape_of(head: str | None) -> Shape:
    """The shape that a VoxML head names; a prism for what has none, or one that the published lexicons do not use."""
    try:
        return Shape(head)
    except ValueError:
        return Shape.RECTANGULAR_PRISM
