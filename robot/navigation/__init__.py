"""From goals to wheel commands: costmap, planning, following, turning and recovery."""

from .costmap import Costmap, build_costmap
from .goals import Drive, Goal, Phase, Reach, Reason, Rotate, State
from .navigator import Navigator
from .planner import Plan, plan

__all__ = [
    "Costmap",
    "Drive",
    "Goal",
    "Navigator",
    "Phase",
    "Plan",
    "Reach",
    "Reason",
    "Rotate",
    "State",
    "build_costmap",
    "plan",
]
