"""What the robot knows of its surroundings: an occupancy grid, persistent walls, and where it stands among them."""

from .grid import OccupancyGrid
from .mapper import Mapper
from .point_landmarks import SightedPoint
from .pose_filter import PoseFilter
from .walls import WallMap, merge_segments

__all__ = ["Mapper", "OccupancyGrid", "PoseFilter", "SightedPoint", "WallMap", "merge_segments"]
