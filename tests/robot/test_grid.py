"""The occupancy grid: what beams along a surface may not do to it."""

from __future__ import annotations

import numpy as np
import pytest
from kinematic_body import KinematicBody, Noise, box, polygon

from robot.geometry import Point, Pose
from robot.mapping import OccupancyGrid
from robot.mapping.grid import OCCUPIED_LOG_ODDS, Window

ROOM = polygon((-1, -1), (5, -1), (5, 3), (-1, 3))


def look(grid: OccupancyGrid, walls: tuple, truth: Pose, believed: Pose, scans: int) -> None:
    """Enter ``scans`` scans taken at ``truth`` as if the robot were where it believes to be."""
    body = KinematicBody(walls, truth, noise=Noise(range_m=0.01), seed=1)
    while scans:
        scan = body.scan()
        if scan is not None:
            grid.update(believed, scan)
            scans -= 1
        body.step(0.2)


def occupied_rows(grid: OccupancyGrid, x_m: float, bottom_m: float, top_m: float) -> np.ndarray:
    """For each row of cells between the two heights, whether anything within a cell of ``x_m`` is occupied."""
    column, bottom = grid.cell_of(Point(x_m, bottom_m + 1e-6))
    _, top = grid.cell_of(Point(x_m, top_m - 1e-6))
    return (grid.cells(Window(column - 1, bottom, column + 2, top + 1)) > OCCUPIED_LOG_ODDS).any(axis=1)


@pytest.mark.parametrize("error_m", [-0.02, 0.0, 0.02])
def test_beams_that_skim_along_a_face_do_not_wear_it_away(error_m: float) -> None:
    grid, walls = OccupancyGrid(), ROOM + box(2.0, 1.2, 1.0, 1.6)
    look(grid, walls, Pose(0.5, 1.2, 0), Pose(0.5, 1.2, 0), 10)
    assert occupied_rows(grid, 1.5, 0.5, 1.9).all()
    look(grid, walls, Pose(1.48, -0.7, 1.57), Pose(1.48 + error_m, -0.7, 1.57), 100)
    assert occupied_rows(grid, 1.5, 0.5, 1.9).all()


def test_a_wall_seen_along_its_length_stays_whole_once_it_has_been_seen() -> None:
    grid, here = OccupancyGrid(), Pose(-0.6, -0.7, 0)
    look(grid, ROOM, Pose(1, 1, 0), Pose(1, 1, 0), 10)
    column, row = grid.cell_of(Point(0.0, -1.0))
    wall = Window(column, row - 1, column + 40, row + 2)
    before = (grid.cells(wall) > OCCUPIED_LOG_ODDS).any(axis=0)
    look(grid, ROOM, here, here, 100)
    assert before.mean() > 0.5
    assert (grid.cells(wall) > OCCUPIED_LOG_ODDS).any(axis=0)[before].all()


def test_what_beams_pass_on_both_sides_of_is_forgotten() -> None:
    grid, here = OccupancyGrid(), Pose(0.5, 1.2, 0)
    look(grid, ROOM + box(1.6, 1.2, 0.1, 0.1), here, here, 10)
    assert grid.at(Point(1.56, 1.2)) > OCCUPIED_LOG_ODDS
    look(grid, ROOM, here, here, 20)
    assert grid.at(Point(1.56, 1.2)) < 0.0
