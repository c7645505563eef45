"""Predictions for a client that wants fewer of them."""

from collections.abc import Callable
from contextlib import ExitStack

from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.server.feedback_log import BlockName, FeedbackLog, LogEntry


def follow_feedback(log: FeedbackLog, rate: float | None, send: Callable[[LogEntry], None], stack: ExitStack) -> None:
    """Send the messages of a log to a client until ``stack`` closes, with all predictions or at a rate (1/s)."""
    thinned = None if rate is None else PredictionRate(rate, send)
    stack.callback(log.subscribers.subscribe(send if thinned is None else thinned.take))
    if thinned is not None:
        stack.callback(log.ticks.subscribe(thinned.pass_due))


class PredictionRate:
    """Passes feedback to a client, and of the predictions of each block only so many, the last one always.

    A prediction that has to wait is passed when its time has come or before the next other message about its block.

    Args:
        rate: predictions per second and block; 0 for none.
        send: passes a message to the client.
    """

    def __init__(self, rate: float, send: Callable[[LogEntry], object]) -> None:
        self._interval = 1.0 / rate if rate else None
        self._send = send
        self._next: dict[BlockName, GlobalTime] = {}
        self._waiting: dict[BlockName, LogEntry] = {}

    def take(self, entry: LogEntry) -> None:
        """Take the next message."""
        if entry.block is None:
            self._send(entry)
        elif not entry.predicts:
            if (waiting := self._waiting.pop(entry.block, None)) is not None:
                self._pass(entry.block, waiting, entry.time)
            self._send(entry)
        elif self._interval is not None:
            self._waiting[entry.block] = entry
            self.pass_due(entry.time)

    def pass_due(self, now: GlobalTime) -> None:
        """Pass the predictions that need not wait any more; called after each tick."""
        for block, entry in list(self._waiting.items()):
            if is_due(self._next.get(block, now), now):
                del self._waiting[block]
                self._pass(block, entry, now)
        self._next = {block: time for block, time in self._next.items() if not is_due(time, now)}

    def _pass(self, block: BlockName, entry: LogEntry, now: GlobalTime) -> None:
        if self._interval is not None:
            self._next[block] = GlobalTime(now + self._interval)
        self._send(entry)
