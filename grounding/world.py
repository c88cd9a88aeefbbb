"""The world model: what the robot has found, as a frozen value that every message of the contract makes anew."""

from __future__ import annotations

from dataclasses import dataclass, replace

from robot.geometry import ORIGIN, Point, Pose, Segment
from robot.messages import Fiducials, Map, Odom
from voxml.scene import Scene, SceneObject

from .entities import FIDUCIAL, Entities, Entity, StandsFor
from .floor_plan import ROOMS, FloorPlan, Room, floor_plan
from .map_places import map_place

FOCUS_MAX = 8
_NOTHING = Entities()


@dataclass(frozen=True, slots=True)
class World:
    """Where the robot is, the walls and things it has met, and what each fiducial stands for (seen or not yet).

    Nothing is in ``entities`` before its fiducial was seen: a world's file tells what a marker means, not where it is.
    ``focus`` are the things spoken of, by id, the latest first: what "it" and "the other one" lean on.
    """

    robot: Pose = ORIGIN
    entities: Entities = _NOTHING
    walls: tuple[Segment, ...] = ()
    catalogue: tuple[StandsFor, ...] = ()
    focus: tuple[str, ...] = ()

    @classmethod
    def unexplored(cls, scene: Scene) -> World:
        """Nothing seen yet, but every fiducial's meaning known."""
        meanings = tuple(_meaning(thing) for thing in scene.objects if thing.fiducial is not None)
        return cls(Pose(scene.start.x_m, scene.start.y_m, scene.start.yaw_rad), catalogue=meanings)

    @classmethod
    def explored(cls, scene: Scene) -> World:
        """Everything seen, as after a perfect tour that ended where the robot starts."""
        walls = tuple(Segment(Point(w.x1_m, w.y1_m), Point(w.x2_m, w.y2_m)) for w in scene.walls)
        things = Entities(tuple(_entity(thing) for thing in scene.objects))
        return replace(cls.unexplored(scene), entities=things, walls=walls)

    @property
    def floor_plan(self) -> FloorPlan | None:
        """Rooms and openings, by the walls as they are known now; None while none are."""
        return floor_plan(self.walls)

    def room_of(self, place: Entity) -> Room | None:
        """The room that a place of the map is; None for anything else."""
        plan = self.floor_plan if place.type in ROOMS else None
        return None if plan is None else plan.room_of(place)

    def get(self, id: str) -> Entity | None:
        """The thing, or the place of the map, with this id."""
        return self.entities.get(id) or map_place(id, self.walls, self.robot)

    def with_robot(self, pose: Pose) -> World:
        """The same world seen from another pose."""
        return replace(self, robot=pose)

    def with_odom(self, odom: Odom) -> World:
        """The robot has moved."""
        return self.with_robot(odom.pose)

    def with_map(self, message: Map) -> World:
        """The walls as they are known now."""
        return replace(self, walls=message.segments)

    def with_fiducials(self, message: Fiducials) -> World:
        """The fiducials seen so far, each as what it stands for. Things without a fiducial stay."""
        meanings = {meaning.fiducial_id: meaning for meaning in self.catalogue}
        seen = tuple(_perceived(f.id, f.pose, meanings.get(f.id)) for f in message.fiducials)
        unmarked = tuple(entity for entity in self.entities.items if entity.fiducial_id is None)
        items = unmarked + seen
        # The columns are worth keeping: the robot publishes its fiducials far more often than they change.
        return self if items == self.entities.items else replace(self, entities=Entities(items))

    def taught(self, meaning: StandsFor) -> World:
        """A fiducial stands for something else from now on."""
        others = tuple(known for known in self.catalogue if known.fiducial_id != meaning.fiducial_id)
        items = tuple(
            _perceived(e.id, e.pose, meaning) if e.fiducial_id == meaning.fiducial_id else e
            for e in self.entities.items
        )
        return replace(self, entities=Entities(items), catalogue=(*others, meaning))

    def with_place(self, place: Entity) -> World:
        """A place was given a name; it is one of the things that have no fiducial."""
        others = tuple(entity for entity in self.entities.items if entity.id != place.id)
        return replace(self, entities=Entities((*others, place)))

    def speaking_of(self, ids: tuple[str, ...]) -> World:
        """The same world with these things in focus, before those that were."""
        before = tuple(known for known in self.focus if known not in ids)
        return replace(self, focus=(*ids, *before)[:FOCUS_MAX])

    def only(self, ids: tuple[str, ...]) -> World:
        """The same world with no other things than these, in this order."""
        return replace(self, entities=Entities(tuple(filter(None, map(self.get, ids)))))


def _perceived(id: str, pose: Pose, meaning: StandsFor | None) -> Entity:
    if meaning is None:
        return Entity(id, FIDUCIAL, pose, fiducial_id=id)
    return Entity(id, meaning.type, pose, meaning.attributes, meaning.names, meaning.size_m, id)


def _meaning(thing: SceneObject) -> StandsFor:
    assert thing.fiducial is not None
    return StandsFor(str(thing.fiducial.id), thing.type, thing.attributes, thing.names, thing.size_m)


def _entity(thing: SceneObject) -> Entity:
    marker = thing.marker
    if marker is None:
        pose = Pose(thing.x_m, thing.y_m, thing.yaw_rad)
        return Entity(thing.id, thing.type, pose, thing.attributes, thing.names, thing.size_m)
    pose = Pose(marker.x_m, marker.y_m, marker.yaw_rad)
    return _perceived(str(thing.fiducial.id if thing.fiducial else thing.id), pose, _meaning(thing))
