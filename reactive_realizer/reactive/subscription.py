"""Being told of changes, until further notice."""

from collections.abc import Callable
from typing import Any


class Subscription:
    """Undoes an `observe`; disposing twice is harmless.

    Attributes:
        tell: gets each new value.
        ended: is called when there will be no more, because the cell was disposed of.
    """

    __slots__ = ("_among", "ended", "tell")

    def __init__(
        self, among: dict["Subscription", None], tell: Callable[[Any], None], ended: Callable[[], object]
    ) -> None:
        self.tell = tell
        self.ended = ended
        self._among = among
        among[self] = None

    def dispose(self) -> None:
        """Stop being told."""
        self._among.pop(self, None)
