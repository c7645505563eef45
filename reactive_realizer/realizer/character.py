"""A character as the realizer gets it."""

from collections.abc import Sequence
from dataclasses import dataclass

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.frame import Frame
from reactive_realizer.embodiment.humanoid import Humanoid
from reactive_realizer.engine.effects import Play
from reactive_realizer.engine.engine import Engine


@dataclass(frozen=True, slots=True)
class Character:
    """Who plays: a figure, and its engines in rank order."""

    id: str
    humanoid: Humanoid
    engines: tuple[Engine, ...]

    def move(self, time: GlobalTime, plays: Sequence[Play]) -> None:
        """Come to what its engines ask for at a time; then it looks (`look`)."""
        self.humanoid.move(time, [layer for play in plays for layer in play.layers])

    def look(self, plays: Sequence[Play]) -> Frame:
        """The frame of the time to which it has moved, eyes and face as its engines ask for."""
        eyes = next((play.eyes for play in plays if play.eyes is not None), None)
        return self.humanoid.look(eyes, [play.face for play in plays])
