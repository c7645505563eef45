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

    def compose(self, time: GlobalTime, plays: Sequence[Play]) -> Frame:
        """One frame of what its engines ask for."""
        layers = [layer for play in plays for layer in play.layers]
        face: dict[str, float] = {}
        for play in plays:
            for morph, weight in play.face.items():
                face[morph] = face.get(morph, 0.0) + weight
        eyes = next((play.eyes for play in plays if play.eyes is not None), None)
        return self.humanoid.compose(time, layers, face, eyes)
