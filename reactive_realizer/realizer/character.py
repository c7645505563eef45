"""A character of the realizer."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from operator import attrgetter

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.frame import Frame
from reactive_realizer.embodiment.humanoid import Humanoid
from reactive_realizer.engine.effects import Output
from reactive_realizer.engine.engine import Engine


@dataclass(frozen=True, slots=True)
class Character:
    """A figure with its engines, in rank order, and the name of its voice; None for the default one."""

    id: str
    humanoid: Humanoid
    engines: tuple[Engine, ...]
    voice: str | None = None

    def move(self, time: GlobalTime, outputs: Sequence[Output]) -> list[Callable[[], None]]:
        """Move the figure to the pose that its engines give for a time.

        Returns:
            Simulations that move it further, each of which may run in a thread of its own; call `look` after that.
        """
        layers = [layer for output in outputs for layer in output.layers]
        self.humanoid.move(time, layers, [output.face for output in outputs])
        return [partial(self.humanoid.simulate, each.dynamics) for each in outputs if each.dynamics is not None]

    def look(self, outputs: Sequence[Output]) -> Frame:
        """The frame after `move`, with the eyes, the face and the pictures that its engines give."""
        eyes = next((output.eyes for output in outputs if output.eyes is not None), None)
        frame = self.humanoid.look(eyes, [output.face for output in outputs])
        pictures = [picture for output in outputs for picture in output.pictures]
        if not pictures:
            return frame
        return replace(frame, pictures=tuple(each.file for each in sorted(pictures, key=attrgetter("layer"))))
