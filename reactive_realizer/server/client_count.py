"""How many are connected."""

from collections.abc import Iterator
from contextlib import contextmanager

from reactive_realizer.errors import error


class ClientCount:
    """Counts clients and lets no more in than a limit.

    Attributes:
        number: of those connected now.
    """

    def __init__(self, limit: int) -> None:
        self.number = 0
        self._limit = limit

    @contextmanager
    def one(self) -> Iterator[None]:
        """Somebody is connected as long as the context lasts.

        Raises:
            RealizerError: "too-many-clients".
        """
        if self.number >= self._limit:
            raise error("too-many-clients", limit=self._limit)
        self.number += 1
        try:
            yield
        finally:
            self.number -= 1
