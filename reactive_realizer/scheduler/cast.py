"""Who plays: the characters and their engines."""

from collections.abc import Mapping, Sequence

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.engine.engine import Engine


class Cast:
    """The engines of each character, in their rank order.

    Args:
        engines: by character id; the first character takes what names none.
    """

    def __init__(self, engines: Mapping[str, Sequence[Engine]]) -> None:
        self._engines = {character: tuple(own) for character, own in engines.items()}

    @property
    def characters(self) -> tuple[str, ...]:
        """Their ids."""
        return tuple(self._engines)

    @property
    def engines(self) -> tuple[Engine, ...]:
        """All engines, in rank order."""
        return tuple(engine for own in self._engines.values() for engine in own)

    def engine_for(self, character: str, behavior: Behavior) -> Engine | None:
        """The first engine of a character that plays such behaviors."""
        return next((engine for engine in self._engines[character] if engine.supports(behavior)), None)
