"""What the robot knows of its surroundings: an occupancy grid, persistent walls, and where it stands among them."""

from .grid import OccupancyGrid
from .mapper import Mapper
from .walls import WallMap, merge_segments

__all__ = ["Mapper", "OccupancyGrid", "WallMap", "merge_segments"]
