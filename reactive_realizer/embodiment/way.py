"""Where a figure goes over the ground, and on which prints."""

from dataclasses import dataclass

from reactive_realizer.embodiment.place import Place
from reactive_realizer.embodiment.world import Ground


@dataclass(frozen=True, slots=True)
class Footprint:
    """A print of a foot on the ground.

    Attributes:
        place: the point below the ankle, and where the foot points.
        made: whether the foot stands there; otherwise it is on its way there.
    """

    place: Place
    made: bool


@dataclass(frozen=True, slots=True)
class Way:
    """What a figure on its feet is about to do.

    Attributes:
        path: the points between which it goes straight on, from where it is to its goal; none if it goes nowhere.
        prints: of its left and its right foot; none if it does not walk.
    """

    path: tuple[Ground, ...] = ()
    prints: tuple[Footprint, ...] = ()
