"""Who is told of something."""

from collections.abc import Callable
from typing import Generic, TypeVar

T = TypeVar("T")


class Audience(Generic[T]):
    """Those who are told one kind of thing, in the order in which they came."""

    def __init__(self) -> None:
        self._listeners: dict[object, Callable[[T], None]] = {}

    def __len__(self) -> int:
        return len(self._listeners)

    def join(self, listener: Callable[[T], None]) -> Callable[[], None]:
        """Tell a listener from now on; the returned call ends that."""
        key = object()
        self._listeners[key] = listener

        def leave() -> None:
            self._listeners.pop(key, None)

        return leave

    def tell(self, news: T) -> None:
        """Tell everybody."""
        for listener in tuple(self._listeners.values()):
            listener(news)
