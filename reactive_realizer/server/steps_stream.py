"""Paths and footprints of the characters, for viewers that ask for them."""

from collections.abc import Callable, Mapping
from math import degrees

from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.embodiment.frame import Frame
from reactive_realizer.embodiment.place import PlannedSteps
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.server.frame_watch import FrameWatch
from reactive_realizer.server.protocol import Message, encode

_INTERVAL = 0.1
"""Shortest time between two messages about a character, s: a running foot stands for longer."""
_SIDES = ("left", "right")


class StepsStream:
    """Sends the paths and footprints of characters while they change. Without subscribers, nothing is computed."""

    def __init__(self, realizer: Realizer) -> None:
        self._realizer = realizer
        self._watch: FrameWatch[str] = FrameWatch(realizer, self._publish)
        self._sent: dict[str, PlannedSteps] = {}
        self._next = realizer.time

    def subscribe(self, listener: Callable[[str], None]) -> Callable[[], None]:
        """Gives a listener the messages, first about all characters that walk. The returned function ends that."""
        self._sent.clear()
        return self._watch.subscribe(listener)

    def _publish(self, frames: Mapping[str, Frame]) -> None:
        now = self._realizer.time
        if not is_due(self._next, now):
            return
        self._next = GlobalTime(now + _INTERVAL)
        for id_, character in self._realizer.characters.items():
            steps = character.humanoid.planned_steps()
            if steps != self._sent.get(id_, PlannedSteps()):
                self._sent[id_] = steps
                self._watch.publish(encode(_message(id_, now, steps)))


def _message(id_: str, time: GlobalTime, steps: PlannedSteps) -> Message:
    prints = [
        {
            "side": side,
            "position": _rounded(each.place.position[0], each.place.position[2]),
            "heading": round(degrees(each.place.heading), 1),
            "made": each.made,
        }
        for side, each in zip(_SIDES, steps.prints, strict=False)
    ]
    path = [_rounded(x, z) for x, z in steps.path]
    return {"type": "steps", "time": round(time, 6), "character": id_, "path": path, "prints": prints}


def _rounded(x: float, z: float) -> list[float]:
    return [round(x, 4), round(z, 4)]
