"""How true the map is after a patrol in each world, and how merging segments grows with their number.

A patrol drives the robot through each world, noise on. Meanwhile the scene's own geometry tells what stretches of wall
the laser has swept. Of those, the share that some mapped wall lies along within 5 cm, on the right side; of the mapped
length, the share with no true surface within 5 cm; and how many mapped walls there are for each true one. Merging is
timed on random walls of the same density, against a greedy loop over all pairs that uses the same test and the same
rule, and against a thriftier one that does not start all over after each merge.
"""

from __future__ import annotations

import math
import random
import time
from collections.abc import Callable, Sequence
from functools import partial
from itertools import pairwise

import numpy as np
import shapely

from robot.geometry import Point, Pose, Segment
from robot.mapping.walls import Wall, merge, merge_segments, mismatch_m

from ._drive import WITH_CAMERA, WORLDS, driver, progress, world
from ._truth import SAMPLE_M, Faces, Seen, solid_of

NEAR_M = 0.05
ALIGNED_RAD = math.radians(20)
TRUE_WALL_M = 0.3  # a face of which less was seen does not count as a wall seen
SIZES = (50, 200, 800, 3200)
NAIVE_MAX = 800
PIECES = 8  # segments that make up each wall


def run(
    worlds: Sequence[str] = WORLDS, patrol_s: float = 600.0, sizes: Sequence[int] = SIZES
) -> dict[str, float | str]:
    """Figures of each world and of merging; lengths in metres, times in milliseconds."""
    figures: dict[str, float | str] = {}
    for name in worlds:
        figures |= {f"{name}_{key}": value for key, value in patrol(name, patrol_s).items()}
    for key, best in (("coverage", min), ("false_share", max), ("segments_per_wall", max)):
        figures[f"worst_{key}"] = best(float(figures[f"{name}_{key}"]) for name in worlds)
    return figures | merging(sizes)


# ------------------------------------------------------------------ the map against the truth
def patrol(name: str, seconds: float) -> dict[str, float]:
    """What the map is worth after a patrol of at most ``seconds`` of the robot's time."""
    scene = world(name)
    faces = Faces.of(scene)
    seen = Seen(faces)
    with driver(scene, camera=name in WITH_CAMERA) as drive:
        seen.look(drive.body.truth())
        trip = drive.send("patrol", seconds, seen.look)
        segments = drive.robot.mapper.segments()
        contacts = len(drive.body.contacts())
    in_view_m, covered_m = coverage(faces, seen, segments)
    figures = {
        "driven_m": round(trip.driven_m, 1),
        "wall_in_view_m": round(in_view_m, 1),
        "coverage": round(covered_m / in_view_m, 4),
        "false_share": round(false_share(shapely.boundary(solid_of(scene)), segments), 4),
        "segments_per_wall": round(segments_per_wall(faces, seen, segments), 3),
        "contacts": float(contacts),
    }
    progress(f"{name}: {figures}")
    return figures


def coverage(faces: Faces, seen: Seen, segments: Sequence[Segment]) -> tuple[float, float]:
    """Metres of wall that were in view, and of those, metres that a segment lies along."""
    in_view_m = covered_m = 0.0
    for face in np.flatnonzero(faces.is_wall).tolist():
        places = faces.samples(face)[seen.swept[face]]
        step_m = float(faces.lengths_m[face]) / len(seen.swept[face])
        along = [s for s in segments if _aligned(s, float(faces.directions_rad[face]))]
        mapped = shapely.MultiLineString([_ends(segment) for segment in along])
        in_view_m += step_m * len(places)
        if len(places) and along:
            covered_m += step_m * int((shapely.distance(shapely.points(places), mapped) <= NEAR_M).sum())
    return in_view_m, covered_m


def false_share(surfaces: shapely.Geometry, segments: Sequence[Segment]) -> float:
    """The share of the mapped length that has no true surface near it."""
    shapely.prepare(surfaces)
    places = [
        place
        for segment in segments
        for place in np.linspace(*_ends(segment), max(2, math.ceil(segment.length_m / SAMPLE_M)))
    ]
    if not places:
        return 1.0
    return float((shapely.distance(shapely.points(np.array(places)), surfaces) > NEAR_M).mean())


def segments_per_wall(faces: Faces, seen: Seen, segments: Sequence[Segment]) -> float:
    """Mapped segments that lie along walls, for each true wall that was seen."""
    true = [
        face
        for face in np.flatnonzero(faces.is_wall).tolist()
        if seen.swept[face].mean() * faces.lengths_m[face] >= TRUE_WALL_M
    ]
    lines = {face: shapely.LineString([faces.starts[face], faces.ends[face]]) for face in true}
    count = 0
    for segment in segments:
        middle = shapely.Point(segment.midpoint.x_m, segment.midpoint.y_m)
        count += any(
            _aligned(segment, float(faces.directions_rad[face])) and middle.distance(line) <= NEAR_M
            for face, line in lines.items()
        )
    return count / len(true)


def _aligned(segment: Segment, direction_rad: float) -> bool:
    return abs(math.remainder(segment.direction_rad - direction_rad, math.tau)) <= ALIGNED_RAD


def _ends(segment: Segment) -> tuple[tuple[float, float], tuple[float, float]]:
    return (segment.start.x_m, segment.start.y_m), (segment.end.x_m, segment.end.y_m)


# ------------------------------------------------------------------ merging
def merging(sizes: Sequence[int]) -> dict[str, float | str]:
    """Times for each number of segments, how often the naive loop's, and the exponent of the growth."""
    figures: dict[str, float | str] = {}
    times_s = []
    for size in sizes:
        segments = fragments(size, random.Random(size))
        merge_s, merged = min((_timed(merge_segments, segments) for _ in range(3)), key=lambda each: each[0])
        times_s.append(merge_s)
        figures[f"merge_{size}_ms"] = round(1e3 * merge_s, 2)
        figures[f"merge_{size}_left"] = merged
        if size <= NAIVE_MAX:
            naive_s, left = _timed(naive_merge, segments)
            figures[f"naive_{size}_ms"] = round(1e3 * naive_s, 2)
            figures[f"naive_{size}_left"] = left
            figures[f"merge_{size}_times_faster"] = round(naive_s / merge_s, 1)
            thrifty_s, _ = _timed(partial(naive_merge, thrifty=True), segments)
            figures[f"merge_{size}_times_faster_than_thrifty"] = round(thrifty_s / merge_s, 1)
        progress(f"merging {size} segments: {1e3 * merge_s:.1f} ms")
    exponents = [
        math.log(late / early) / math.log(more / fewer)
        for (fewer, early), (more, late) in pairwise(zip(sizes, times_s, strict=True))
    ]
    figures["merge_growth_exponent"] = round(exponents[-1], 2) if exponents else 1.0
    return figures


def fragments(count: int, chance: random.Random) -> list[Segment]:
    """Noisy overlapping pieces of random walls of 1 to 4 m, with the same number of walls a square metre."""
    side_m = math.sqrt(count / PIECES * 4.0)
    pieces: list[Segment] = []
    while len(pieces) < count:
        middle = Pose(chance.uniform(0, side_m), chance.uniform(0, side_m), chance.uniform(-math.pi, math.pi))
        half_m = chance.uniform(0.5, 2.0)
        for piece in range(PIECES):
            first_m = -half_m + 2 * half_m * piece / PIECES
            ends = (middle.ahead(first_m), middle.ahead(first_m + 2.2 * half_m / PIECES))
            pieces.append(Segment(*(_jittered(end.point, chance) for end in ends)))
    chance.shuffle(pieces)
    return pieces[:count]


def _jittered(place: Point, chance: random.Random) -> Point:
    return Point(place.x_m + chance.gauss(0, 0.005), place.y_m + chance.gauss(0, 0.005))


def naive_merge(segments: Sequence[Segment], thrifty: bool = False) -> tuple[Segment, ...]:
    """Greedy: all pairs are tried in turn, two that fit become one, and all starts over until no pair fits.

    ``thrifty``: only the one that has grown starts over, and all of them when none of a round has.
    """
    walls = [Wall.of(segment) for segment in segments]
    while True:
        before = len(walls)
        first = 0
        while first < len(walls):
            others = range(first + 1, len(walls))
            second = next((n for n in others if mismatch_m(walls[first], walls[n], sided=False) is not None), None)
            if second is None:
                first += 1
            else:
                walls[first] = merge(walls[first], walls.pop(second))
                first = first if thrifty else 0
        if len(walls) == before:
            return tuple(wall.segment for wall in walls)


def _timed(
    merging: Callable[[Sequence[Segment]], tuple[Segment, ...]], segments: Sequence[Segment]
) -> tuple[float, int]:
    began_s = time.perf_counter()
    merged = merging(segments)
    return time.perf_counter() - began_s, len(merged)
