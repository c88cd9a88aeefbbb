"""What a scene consists of, in virtual-world coordinates. Every node has an id that stays with it while it is seen."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

from .appearance import Colour, Shape
from .coordinates import VirtualPoint


@dataclass(frozen=True, slots=True)
class Wall:
    """A cuboid standing on the floor; ``size_m`` is along its own X (its length), Y and Z."""

    id: str
    centre: VirtualPoint
    rotation_rad: float
    size_m: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Thing:
    """A fiducial, or what it stands for. Looks along its own Z; ``size_m`` is along its own X, Y and Z.

    ``entity`` is the world model's id, by which it is pointed at.
    """

    id: str
    entity: str
    shape: Shape
    centre: VirtualPoint
    rotation_rad: float
    size_m: tuple[float, float, float]
    colour: Colour
    label: str
    highlighted: bool = False


@dataclass(frozen=True, slots=True)
class Avatar:
    """The robot, on the floor, looking along its own Z."""

    id: str
    position: VirtualPoint
    rotation_rad: float


@dataclass(frozen=True, slots=True)
class Disc:
    """A circle on the floor: a place that was pointed at or is meant."""

    id: str
    centre: VirtualPoint
    radius_m: float
    colour: Colour
    label: str = ""


@dataclass(frozen=True, slots=True)
class Arrow:
    """A direction on the floor."""

    id: str
    start: VirtualPoint
    end: VirtualPoint
    colour: Colour


@dataclass(frozen=True, slots=True)
class Line:
    """A line of two or more points just above the floor: the trail, the planned path."""

    id: str
    points: tuple[VirtualPoint, ...]
    colour: Colour


@dataclass(frozen=True, slots=True)
class Floor:
    """The ground that the robot has seen, as rectangles (x from, z from, x to, z to); the rest is dimmed."""

    id: str
    rectangles_m: tuple[tuple[float, float, float, float], ...]


Node = Wall | Thing | Avatar | Disc | Arrow | Line | Floor


@dataclass(frozen=True)
class Scene:
    """Everything there is to see, in a fixed order, with unique ids."""

    nodes: tuple[Node, ...] = ()

    @cached_property
    def by_id(self) -> dict[str, Node]:
        """Nodes by id, in the order of the scene."""
        return {node.id: node for node in self.nodes}


# ------------------------------------------------------------------ what changed
@dataclass(frozen=True, slots=True)
class Put:
    """A node that was not there."""

    node: Node


@dataclass(frozen=True, slots=True)
class Change:
    """A node of the same id and kind that looks or lies otherwise now."""

    before: Node
    after: Node


@dataclass(frozen=True, slots=True)
class Drop:
    """A node that is gone."""

    id: str


Update = Put | Change | Drop


def diff(old: Scene, new: Scene) -> tuple[Update, ...]:
    """The fewest updates that make ``old`` look like ``new``: what is the same is not touched, so nothing flickers."""
    if old is new:
        return ()
    before, after = old.by_id, new.by_id
    updates: list[Update] = [Drop(known_id) for known_id in before if known_id not in after]
    for node_id, node in after.items():
        known = before.get(node_id)
        if known is None:
            updates.append(Put(node))
        elif type(known) is not type(node):
            updates += (Drop(node_id), Put(node))
        elif known is not node and known != node:
            updates.append(Change(known, node))
    return tuple(updates)


def patched(scene: Scene, updates: Iterable[Update]) -> Scene:
    """The scene after the updates: the inverse of :func:`diff`, up to the order of nodes."""
    nodes = dict(scene.by_id)
    for update in updates:
        match update:
            case Put(node) | Change(_, node):
                nodes[node.id] = node
            case Drop(gone):
                del nodes[gone]
    return Scene(tuple(nodes.values()))
