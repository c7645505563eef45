"""Where targets and characters are, for clients that ask for it."""

from collections.abc import Callable, Iterable, Mapping
from math import degrees
from typing import Final

from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.embodiment.frame import Frame
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.server.frame_watch import FrameWatch
from reactive_realizer.server.protocol import encode

_INTERVAL: Final = 0.1
"""Shortest time between two messages, s."""
_Target = list[float] | dict[str, list[float]]
"""The position of a target, m; or its position and orientation, if it has one."""
_Place = tuple[list[float], float]
"""Where a character stands, m, and its heading, degrees to the left of +z."""


class WorldStream:
    """Sends the positions of targets, and the places of characters, that have changed. Without subscribers, it is idle.

    Targets that a hand carries are where that is.
    """

    def __init__(self, realizer: Realizer) -> None:
        self._realizer = realizer
        self._watch: FrameWatch[str] = FrameWatch(realizer, self._publish)
        self._targets: dict[str, _Target] = {}
        self._characters: dict[str, _Place] = {}
        self._next = realizer.time

    def subscribe(self, listener: Callable[[str], None]) -> Callable[[], None]:
        """Gives a listener the messages, the first with everything. The returned function ends that."""
        self._targets.clear()
        self._characters.clear()
        return self._watch.subscribe(listener)

    def _publish(self, frames: Mapping[str, Frame]) -> None:
        now = self._realizer.time
        if not is_due(self._next, now):
            return
        self._next = GlobalTime(now + _INTERVAL)
        world = self._realizer.world
        places = ((name, place) for name, place in world.snapshot().items() if not world.lives(name))
        targets = {name: _placed(place, world.orientation(name)) for name, place in places}
        humanoids = {id_: character.humanoid for id_, character in self._realizer.characters.items()}
        characters = {
            id_: (_rounded(figure.place.position), round(degrees(figure.place.heading), 1))
            for id_, figure in humanoids.items()
        }
        gone = dict.fromkeys(self._targets.keys() - targets.keys())
        moved = {name: place for name, place in targets.items() if self._targets.get(name) != place} | gone
        turned = {id_: place for id_, place in characters.items() if self._characters.get(id_) != place}
        self._targets, self._characters = targets, characters
        if moved or turned:
            standing = {id_: {"position": position, "heading": heading} for id_, (position, heading) in turned.items()}
            message = {"type": "targets", "time": round(now, 6), "targets": moved, "characters": standing}
            self._watch.publish(encode(message))


def _placed(place: Vec3, orientation: Quat | None) -> _Target:
    if orientation is None:
        return _rounded(place)
    return {"position": _rounded(place), "orientation": _rounded(orientation)}


def _rounded(values: Iterable[float]) -> list[float]:
    return [round(value, 4) for value in values]
