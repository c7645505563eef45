"""A character of the realizer."""

from collections.abc import Sequence
from dataclasses import dataclass

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.frame import Frame
from reactive_realizer.embodiment.humanoid import Humanoid
from reactive_realizer.engine.effects import Play
from reactive_realizer.engine.engine import Engine


@dataclass(frozen=True, slots=True)
class Character:
    """A figure with its engines, in rank order."""

    id: str
    humanoid: Humanoid
    engines: tuple[Engine, ...]

    def move(self, time: GlobalTime, plays: Sequence[Play]) -> None:
        """Move the figure to the pose that its engines give for a time; call `look` after that."""
        self.humanoid.move(time, [layer for play in plays for layer in play.layers])

    def look(self, plays: Sequence[Play]) -> Frame:
        """The frame after `move`, with the eyes and the face that its engines give."""
        eyes = next((play.eyes for play in plays if play.eyes is not None), None)
        return self.humanoid.look(eyes, [play.face for play in plays])
