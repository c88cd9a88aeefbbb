"""Kirby's robot: the wire contract (`messages`, `geometry`) and the machinery behind it.

`KIRBY_ROOM` tells this package from any other that is called ``robot`` on the package index.
"""

KIRBY_ROOM = "robot"
