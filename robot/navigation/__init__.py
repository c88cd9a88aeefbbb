"""From goals to wheel commands: costmap, planning, following, turning, recovery, and patrols."""

from .costmap import Costmap, build_costmap
from .goals import Drive, Goal, Phase, Reach, Reason, Rotate, State
from .navigator import Navigator
from .patrol import Mark, PatrolState, PatrolStep
from .planner import Plan, plan, reachable

__all__ = [
    "Costmap",
    "Drive",
    "Goal",
    "Mark",
    "Navigator",
    "PatrolState",
    "PatrolStep",
    "Phase",
    "Plan",
    "Reach",
    "Reason",
    "Rotate",
    "State",
    "build_costmap",
    "plan",
    "reachable",
]
