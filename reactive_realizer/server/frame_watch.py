"""Subscribers of what is made of the frames of each tick."""

from collections.abc import Callable, Mapping
from typing import Generic, TypeVar

from reactive_realizer.embodiment.frame import Frame
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.server.subscribers import Subscribers

T = TypeVar("T")


class FrameWatch(Generic[T]):
    """Has frames composed and something made of them while it has subscribers, and not otherwise.

    Args:
        realizer: that composes the frames.
        make: is called with the frames of each tick.
    """

    def __init__(self, realizer: Realizer, make: Callable[[Mapping[str, Frame]], None]) -> None:
        self._realizer = realizer
        self._make = make
        self._subscribers: Subscribers[T] = Subscribers()
        self._look_away: Callable[[], None] | None = None

    def subscribe(self, listener: Callable[[T], None]) -> Callable[[], None]:
        """Calls a listener with what is published. The returned function ends that."""
        leave = self._subscribers.subscribe(listener)
        if self._look_away is None:
            self._look_away = self._realizer.watch(self._make)

        def leave_and_look_away() -> None:
            leave()
            if not self._subscribers and self._look_away is not None:
                self._look_away()
                self._look_away = None

        return leave_and_look_away

    def publish(self, item: T) -> None:
        """Calls every listener."""
        self._subscribers.publish(item)
