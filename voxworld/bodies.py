"""The solids that things are drawn as: one mesh of unit size for each VoxML head, centred, stretched to its thing."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
import trimesh
from numpy.typing import NDArray

from .appearance import Shape


@dataclass(frozen=True, slots=True, eq=False)
class Mesh:
    """Vertices (n, 3) within half a unit of the origin, triangles (m, 3), and whether its faces are flat."""

    vertices: NDArray[np.float32]
    faces: NDArray[np.uint32]
    flat: bool


@cache
def unit_mesh(shape: Shape) -> Mesh:
    """The mesh of extents 1 x 1 x 1 for a head; z is up."""
    match shape:
        case Shape.RECTANGULAR_PRISM | Shape.SHEET:
            solid = trimesh.creation.box()
        case Shape.CYLINDROID:
            solid = trimesh.creation.cylinder(radius=0.5, height=1.0, sections=32)
        case Shape.ELLIPSOID:
            solid = trimesh.creation.icosphere(subdivisions=3, radius=0.5)
        case Shape.TOROID:
            solid = trimesh.creation.torus(major_radius=0.35, minor_radius=0.15)
        case Shape.PYRAMIDOID:
            solid = trimesh.creation.cone(radius=0.5, height=1.0, sections=4)
    vertices = solid.vertices - solid.bounds.mean(axis=0)
    vertices = vertices / np.ptp(vertices, axis=0)
    flat = shape in (Shape.RECTANGULAR_PRISM, Shape.SHEET, Shape.PYRAMIDOID)
    return Mesh(vertices.astype(np.float32), solid.faces.astype(np.uint32), flat)
