"""The dialogue manager: events in, outputs out, nothing else."""

from .manager import DialogueManager
from .planning import plan
from .plans import Plan, Planning, Refusal, Refused
from .session import Question, Session, Task
from .table import Activity, State

__all__ = [
    "Activity",
    "DialogueManager",
    "Plan",
    "Planning",
    "Question",
    "Refusal",
    "Refused",
    "Session",
    "State",
    "Task",
    "plan",
]
