"""How far joints go."""

from collections.abc import Iterable, Sequence
from itertools import pairwise

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.vector import distance


def furthest(joint: str, sides: Iterable[str], bodies: Sequence[Body]) -> float:
    """The longer of the ways of a joint of the left and of the right side, from body to body, m; 0 without any."""
    names = [name for side in sides if (name := f"{side}_{joint}") in bodies[0].skeleton]
    paths = [[body.place(name).position for body in bodies] for name in names]
    return max((sum(distance(a, b) for a, b in pairwise(path)) for path in paths), default=0.0)
