"""The scene on viser's stage: applies what changed, and moves what moves a little at every frame.

viser's world is right-handed with z up, so it gets map coordinates: Unity's axes would show the world mirrored.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
import viser
from numpy.typing import NDArray

from .appearance import EXPLORED, PATH, POINTED, REFERENT, ROBOT, UNEXPLORED, WALL, Colour, Shape
from .bodies import unit_mesh
from .coordinates import VirtualPoint, to_map
from .motion import Placement, Vector, eased, placement_of, quaternion
from .nodes import Arrow, Avatar, Change, Disc, Drop, Floor, Line, Node, Put, Thing, Update, Wall

CHUNK = 64  # instances by which a batch grows: growing is the one thing that browsers must rebuild for
GROUND_M = 120.0
FLOOR_HEIGHT_M = 0.004


class Batch:
    """Many copies of one mesh as a single node of the stage."""

    def __init__(self, scene: viser.SceneApi, name: str, shape: Shape, colour: Colour, *, shadow: bool) -> None:
        self._scene, self._name, self._shape, self._colour, self._shadow = scene, name, shape, colour, shadow
        self._handle: viser.BatchedMeshHandle | None = None

    def show(self, placements: list[Placement]) -> None:
        """Show these and no others."""
        room = -(-max(1, len(placements)) // CHUNK) * CHUNK
        positions = np.zeros((room, 3), dtype=np.float32)
        turns = np.tile(np.array([1, 0, 0, 0], dtype=np.float32), (room, 1))
        sizes = np.full((room, 3), 1e-6, dtype=np.float32)  # what is not used is too small to see
        for row, placement in enumerate(placements):
            positions[row], turns[row] = placement.position_m, quaternion(placement.yaw_rad)
            sizes[row] = placement.size_m
        handle = self._handle
        if handle is None or len(handle.batched_positions) != room:
            self._handle = self._made(positions, turns, sizes)
            return
        handle.batched_positions, handle.batched_wxyzs, handle.batched_scales = positions, turns, sizes

    def _made(
        self, positions: NDArray[np.float32], turns: NDArray[np.float32], sizes: NDArray[np.float32]
    ) -> viser.BatchedMeshHandle:
        mesh = unit_mesh(self._shape)
        return self._scene.add_batched_meshes_simple(
            self._name,
            mesh.vertices,
            mesh.faces,
            turns,
            positions,
            batched_scales=sizes,
            batched_colors=self._colour,
            flat_shading=True,
            lod="off",
            cast_shadow=self._shadow,
        )


class Stage:
    """Not safe for threads: everything but the constructor is called from one."""

    def __init__(self, server: viser.ViserServer) -> None:
        self._server = server
        self._scene = server.scene
        self._nodes: dict[str, viser.SceneNodeHandle] = {}
        self._parts: dict[str, dict[str, Any]] = {}
        self._shown: dict[str, Placement] = {}
        self._goals: dict[str, Placement] = {}
        self._sinking: set[str] = set()
        self._walls = Batch(self._scene, "/walls", Shape.RECTANGULAR_PRISM, WALL, shadow=True)
        self._floor = Batch(self._scene, "/floor/explored", Shape.SHEET, EXPLORED, shadow=False)
        self.ground = self._lay_ground()

    @property
    def moving(self) -> bool:
        """Whether another frame is wanted."""
        return bool(self._goals)

    @property
    def robot(self) -> Placement | None:
        """Where the avatar is shown."""
        return self._shown.get("robot")

    def apply(self, updates: tuple[Update, ...]) -> None:
        """Take over what changed; what moves begins to, and gets there in the frames that follow."""
        with self._server.atomic():
            for update in updates:
                match update:
                    case Put(node):
                        self._put(node)
                    case Change(before, after):
                        self._change(before, after)
                    case Drop(gone):
                        self._drop(gone)

    def frame(self, duration_s: float) -> None:
        """Move everything that moves by what it does in ``duration_s``."""
        if not self._goals:
            return
        walls_moved = False
        with self._server.atomic():
            for name, goal in list(self._goals.items()):
                shown = eased(self._shown[name], goal, duration_s)
                self._shown[name] = shown
                if shown == goal:
                    del self._goals[name]
                if name in self._nodes:
                    self._place(name, shown)
                else:
                    walls_moved = True
            if walls_moved:
                self._show_walls()
        self._server.flush()

    # ------------------------------------------------------------------ what changed
    def _put(self, node: Node) -> None:
        match node:
            case Wall():
                goal = placement_of(node)
                self._sinking.discard(node.id)
                self._shown.setdefault(node.id, goal.flat())
                self._goals[node.id] = goal
            case Thing():
                self._put_thing(node)
            case Avatar():
                self._put_robot(node)
            case Floor():
                self._show_floor(node)
            case Disc():
                self._nodes[node.id] = self._disc(node)
            case Line():
                self._nodes[node.id] = self._line(node)
            case Arrow():
                self._nodes[node.id] = self._arrow(node)

    def _change(self, before: Node, node: Node) -> None:
        match node:
            case Wall() | Avatar():
                self._goals[node.id] = placement_of(node)
            case Thing() if isinstance(before, Thing):
                self._change_thing(before, node)
            case Floor():
                self._show_floor(node)
            case Line():
                handle: Any = self._nodes[node.id]
                handle.points = _pairs(node.points)
            case _:
                self._drop(node.id)
                self._put(node)

    def _drop(self, name: str) -> None:
        self._parts.pop(name, None)
        handle = self._nodes.pop(name, None)
        if handle is not None:
            handle.remove()
            self._goals.pop(name, None)
            self._shown.pop(name, None)
        elif name in self._shown:  # a wall sinks into the floor
            self._goals[name] = self._shown[name].flat()
            self._sinking.add(name)

    # ------------------------------------------------------------------ walls and floor
    def _show_walls(self) -> None:
        for name in [name for name in self._sinking if name not in self._goals]:
            self._sinking.discard(name)
            del self._shown[name]
        self._walls.show([shown for name, shown in self._shown.items() if name not in self._nodes])

    def _lay_ground(self) -> viser.BoxHandle:
        self._scene.set_up_direction("+z")
        self._scene.set_background_image(_sky(), format="png")
        self._scene.configure_default_lights(enabled=False)
        self._scene.configure_environment_map(None)
        self._scene.add_light_ambient("/light/sky", intensity=1.7)
        self._scene.add_light_directional("/light/sun", intensity=2.0, position=(-3.0, 2.0, 5.0))
        self._scene.add_grid(
            "/floor/grid",
            plane="xy",
            infinite_grid=True,
            cell_size=0.5,
            section_size=1.0,
            cell_color=(126, 132, 142),
            section_color=(116, 122, 132),
            cell_thickness=0.6,
            section_thickness=0.9,
            fade_distance=22.0,
            shadow_opacity=0.0,
            position=(0.0, 0.0, FLOOR_HEIGHT_M * 1.5),
        )
        return self._scene.add_box(
            "/floor/ground",
            color=UNEXPLORED,
            dimensions=(GROUND_M, GROUND_M, 0.02),
            position=(0.0, 0.0, -0.01),
            cast_shadow=False,
        )

    def _show_floor(self, floor: Floor) -> None:
        rectangles = []
        for x1_m, z1_m, x2_m, z2_m in floor.rectangles_m:
            middle = to_map(VirtualPoint((x1_m + x2_m) / 2, 0.0, (z1_m + z2_m) / 2))
            size_m = (z2_m - z1_m, x2_m - x1_m, 0.001)
            rectangles.append(Placement((middle.x_m, middle.y_m, FLOOR_HEIGHT_M), 0.0, size_m))
        self._floor.show(rectangles)

    # ------------------------------------------------------------------ the robot and things
    def _place(self, name: str, placement: Placement) -> None:
        node = self._nodes[name]
        node.position = placement.position_m
        node.wxyz = quaternion(placement.yaw_rad)

    def _put_robot(self, node: Avatar) -> None:
        placement = placement_of(node)
        self._nodes[node.id] = _turtlebot(self._scene, "/robot", placement)
        self._shown[node.id] = placement

    def _put_thing(self, thing: Thing) -> None:
        placement, mesh = placement_of(thing), unit_mesh(thing.shape)
        name = f"/things/{thing.id}"
        self._nodes[thing.id] = self._scene.add_frame(
            name, show_axes=False, position=placement.position_m, wxyz=quaternion(placement.yaw_rad)
        )
        length_m, width_m, height_m = placement.size_m
        body = self._scene.add_mesh_simple(
            f"{name}/body",
            mesh.vertices,
            mesh.faces,
            color=thing.colour,
            flat_shading=mesh.flat,
            scale=placement.size_m,
        )
        # The marker's own plate, on the front: which way the thing faces can be seen.
        side_m = min(0.10, width_m * 0.8, height_m * 0.8)
        plate = (length_m / 2, 0.0, 0.0)
        self._scene.add_box(f"{name}/plate", (24, 24, 26), (0.012, side_m, side_m), position=plate)
        halo = self._scene.add_cylinder(
            f"{name}/halo",
            radius=max(length_m, width_m) * 0.5 + 0.14,
            height=0.012,
            color=REFERENT,
            position=(0.0, 0.0, 0.012 - height_m / 2),
            visible=thing.highlighted,
            cast_shadow=False,
        )
        label = self._scene.add_label(
            f"{name}/label",
            thing.label,
            position=(0.0, 0.0, height_m / 2 + 0.10),
            anchor="bottom-center",
            font_screen_scale=0.85,
        )
        self._parts[thing.id] = {"body": body, "halo": halo, "label": label}
        self._shown[thing.id] = placement

    def _change_thing(self, before: Thing, thing: Thing) -> None:
        if (before.shape, before.size_m) != (thing.shape, thing.size_m):
            self._drop(thing.id)
            self._put_thing(thing)
            return
        parts = self._parts[thing.id]
        parts["body"].color = thing.colour
        parts["halo"].visible = thing.highlighted
        if before.label != thing.label:
            parts["label"].text = thing.label
        self._goals[thing.id] = placement_of(thing)

    # ------------------------------------------------------------------ marks and lines
    def _disc(self, disc: Disc) -> viser.SceneNodeHandle:
        place = to_map(disc.centre)
        height_m = 0.020 if disc.colour == POINTED else 0.012  # a pointed place lies on top of the place that is meant
        node = self._scene.add_cylinder(
            f"/marks/{disc.id}",
            radius=disc.radius_m,
            height=0.014,
            color=disc.colour,
            position=(place.x_m, place.y_m, height_m),
            opacity=0.85,
            cast_shadow=False,
        )
        if disc.label:
            self._scene.add_label(
                f"/marks/{disc.id}/who",
                disc.label,
                position=(0.0, -disc.radius_m - 0.05, 0.0),
                anchor="center-left",
                font_screen_scale=0.8,
            )
        return node

    def _line(self, line: Line) -> viser.SceneNodeHandle:
        width_m = 0.05 if line.colour == PATH else 0.03
        return self._scene.add_line_segments(f"/lines/{line.id}", _pairs(line.points), line.colour, thickness=width_m)

    def _arrow(self, arrow: Arrow) -> viser.SceneNodeHandle:
        ends = np.array([[_on_floor(arrow.start), _on_floor(arrow.end)]], dtype=np.float32)
        return self._scene.add_arrows(
            f"/marks/{arrow.id}", ends, arrow.colour, shaft_radius=0.03, head_radius=0.09, head_length=0.22
        )


def _sky() -> NDArray[np.uint8]:
    """A picture of a pale sky, shape (64, 64, 3)."""
    share = np.linspace(0.0, 1.0, 64)[:, None, None]
    shades = (1 - share) * np.array((176, 200, 226)) + share * np.array((236, 240, 244))
    return np.broadcast_to(shades, (64, 64, 3)).astype(np.uint8)


def _on_floor(point: VirtualPoint) -> Vector:
    place = to_map(point)
    return place.x_m, place.y_m, max(point.y_m, 0.04)


def _pairs(points: tuple[VirtualPoint, ...]) -> NDArray[np.float32]:
    """Shape (n - 1, 2, 3): each piece of the line by its two ends."""
    ends = [(point.z_m, -point.x_m, point.y_m) for point in points]
    return np.array(list(pairwise(ends)), dtype=np.float32).reshape(-1, 2, 3)


def _turtlebot(scene: viser.SceneApi, name: str, placement: Placement) -> viser.SceneNodeHandle:
    """A TurtleBot3 Waffle Pi in outline: two plates, two wheels, the laser on top, and a nose that shows its front."""
    body = scene.add_frame(name, show_axes=False, position=placement.position_m, wxyz=quaternion(placement.yaw_rad))
    box: Callable[..., Any] = scene.add_box
    box(f"{name}/lower", ROBOT, (0.27, 0.26, 0.012), position=(-0.05, 0.0, 0.04))
    box(f"{name}/middle", (84, 90, 100), (0.22, 0.20, 0.06), position=(-0.06, 0.0, 0.08))
    box(f"{name}/upper", ROBOT, (0.27, 0.26, 0.012), position=(-0.05, 0.0, 0.118))
    for side, y_m in (("left", 0.144), ("right", -0.144)):
        turned = (0.7071, 0.7071, 0.0, 0.0)
        scene.add_cylinder(f"{name}/{side}", 0.033, 0.02, (30, 30, 34), position=(0.0, y_m, 0.033), wxyz=turned)
    scene.add_cylinder(f"{name}/laser", 0.036, 0.045, (36, 38, 44), position=(-0.06, 0.0, 0.148))
    box(f"{name}/camera", (200, 60, 50), (0.02, 0.05, 0.03), position=(0.075, 0.0, 0.09))
    nose = unit_mesh(Shape.PYRAMIDOID)
    scene.add_mesh_simple(
        f"{name}/nose",
        nose.vertices,
        nose.faces,
        color=(72, 180, 120),
        flat_shading=True,
        scale=(0.02, 0.14, 0.12),
        wxyz=(0.7071, 0.0, 0.7071, 0.0),
        position=(0.10, 0.0, 0.13),
    )
    return body
