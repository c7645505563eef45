"""How a voice tells a face what the mouth does."""

from collections.abc import Mapping
from typing import Protocol, runtime_checkable

from reactive_realizer.clock.units import GlobalTime


@runtime_checkable
class LipSyncProvider(Protocol):
    """A timed track of the mouth, offered by a speech engine and handed to the face engine by `assembly`."""

    def mouth(self, time: GlobalTime) -> Mapping[str, float] | None:
        """Weights (0..1) of ARKit morphs at a time; empty in a pause of what is said, None while nothing is said."""
        ...
