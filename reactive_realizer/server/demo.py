"""The demo: a performance for the first page that opens, and again for whoever asks."""

from collections.abc import Callable

from reactive_realizer.clock.ticker import tick_time
from reactive_realizer.errors import error
from reactive_realizer.realizer.inputs import BmlText, Event
from reactive_realizer.server.live import Live

_LEAD_IN = 150
"""Ticks from asking to the beginning: a page that has just opened shows its avatars by then."""

_METRONOME = "metronome"
"""Who beats in a performance; it counts from the beginning."""


class Demo:
    """Plays the performance of a live scene, if it has one.

    Args:
        live: the scene.
        stop: ends whatever plays.
    """

    def __init__(self, live: Live, stop: Callable[[], object]) -> None:
        self._live = live
        self._stop = stop
        self._seen = False

    def page_opened(self) -> None:
        """With the first page it begins."""
        if not self._seen and self._live.performance is not None:
            self.perform()
        self._seen = True

    def perform(self) -> None:
        """Play it from its beginning, whatever plays now.

        Raises:
            RealizerError: "no-demo".
        """
        if self._live.performance is None:
            raise error("no-demo")
        self._stop()
        # Ticks after the stop, its ids are free again, should it be playing already.
        begin = tick_time(self._live.tick + _LEAD_IN)
        if _METRONOME in self._live.realizer.anticipators:
            self._live.realizer.put(Event(_METRONOME, "start"), begin)
        self._live.realizer.put(BmlText(self._live.performance), begin)
