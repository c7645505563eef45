"""Prediction feedback: reported when it is requested, and again when a reported time has moved."""

from collections.abc import Mapping

from reactive_realizer.clock.ticker import RATE
from reactive_realizer.clock.units import BlockTime, GlobalTime, Time, is_due
from reactive_realizer.feedback.feedback_manager import FeedbackManager
from reactive_realizer.feedback.messages import BehaviorPrediction, PredictionFeedback
from reactive_realizer.limits import Limits
from reactive_realizer.scheduler.block_watch import BlockWatch, in_order
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.problem import Point

_NOTICEABLE = 1e-3
"""Seconds by which a reported time must have moved to be reported again."""

_Times = Mapping[tuple[str, str], Time]
"""By behavior and sync id; the points of the block have no behavior."""


class Predictions:
    """Reports ``predictionFeedback`` with the times at the end of a tick (docs/semantics.md, predictions).

    A prediction that is requested is reported in its tick. One that has moved is reported at a limited rate, the latest
    one always: at most so often for a block, and only so many behaviors of all blocks together, in the order in which
    the blocks have begun to wait. Before progress of its block is reported, it does not wait any more.
    """

    def __init__(self, feedback: FeedbackManager, watch: BlockWatch, limits: Limits) -> None:
        self._feedback = feedback
        self._moves = watch.moves()
        self._interval = 1.0 / limits.predictions_per_second
        self._behaviors_per_tick = limits.predicted_behaviors_per_second / RATE
        self._allowance = 0.0
        self._published: dict[BMLBlock, _Times] = {}
        self._next: dict[BMLBlock, GlobalTime] = {}
        self._waiting: dict[BMLBlock, None] = {}
        self._requested: set[BMLBlock] = set()

    @property
    def waiting(self) -> bool:
        """Whether the prediction of a block has moved, or may have, and is not reported yet."""
        return bool(self._waiting)

    def request(self, block: BMLBlock) -> None:
        """Have this tick report the prediction of a block, even if no time has moved."""
        self._requested.add(block)

    def publish(self, now: GlobalTime) -> None:
        """Report the predictions that were requested, and moved ones as far as the rates allow."""
        moved, _ = self._moves.take()
        self._waiting.update(dict.fromkeys(moved))
        progressing = self._feedback.progressing if self._waiting else frozenset()
        chosen = self._requested | {block for block in self._waiting if block.key in progressing}
        self._allowance = min(self._allowance, 0.0) + self._behaviors_per_tick - sum(map(_cost, chosen))
        for block in [block for block in self._waiting if is_due(self._next.get(block, now), now)]:
            if self._allowance <= 0.0:
                break
            if block not in chosen:
                chosen.add(block)
                self._allowance -= _cost(block)
        for block in in_order(chosen):
            self._publish(block, now)

    def close(self, block: BMLBlock, now: GlobalTime) -> None:
        """Forget a block that ends; of one that plays, report what was requested or has moved in this tick before."""
        if block.state.plays:
            self._publish(block, now)
        self._requested.discard(block)
        self._waiting.pop(block, None)
        self._published.pop(block, None)
        self._next.pop(block, None)

    def _publish(self, block: BMLBlock, now: GlobalTime) -> None:
        self._waiting.pop(block, None)
        times = {("", "start"): block.start.value, ("", "end"): block.end.value}
        times |= {(unit.behavior.id, point.id): point.peg.value for unit in block.units for point in unit.points}
        if block in self._requested or _moved(self._published.get(block, {}), times):
            self._requested.discard(block)
            self._published[block] = times
            self._next[block] = GlobalTime(now + self._interval)
            self._feedback.add(_prediction(block, times, now))


def _cost(block: BMLBlock) -> int:
    return 1 + len(block.units)


def _moved(old: _Times, new: _Times) -> bool:
    """Whether a time has moved noticeably, or become known or unknown; points that were cut do not count."""
    if old == new:
        return False
    pairs = [(time, new.get(key)) for key, time in old.items()]
    return not old.keys() >= new.keys() or any(
        one is not other if one is None or other is None else abs(one - other) > _NOTICEABLE for one, other in pairs
    )


def _prediction(block: BMLBlock, times: _Times, now: GlobalTime) -> PredictionFeedback:
    """The known times of a block; if its start is unknown, the times that were planned, as if it started now."""
    start = now if block.start.value is None else block.start.value
    if block.start.value is None:
        times = {key: _planned(block, key, start) if time is None else time for key, time in times.items()}
    known = {
        unit: {p.id: time for p in unit.points if (time := times[unit.behavior.id, p.id]) is not None}
        for unit in block.units
    }
    end = block.end.value
    if end is None:
        end = max([start, *(time for own in known.values() for time in own.values())])
    behaviors = tuple(
        # A waiting block is planned again at its start, so that no point comes before that.
        BehaviorPrediction(unit.behavior, {sync: BlockTime(max(time - start, 0.0)) for sync, time in own.items()})
        for unit, own in known.items()
    )
    return PredictionFeedback(*block.key, start, end, block.state.value, behaviors)


def _planned(block: BMLBlock, key: tuple[str, str], start: GlobalTime) -> Time:
    planned = block.planned_times.get(Point(*key))
    return None if planned is None else GlobalTime(start + planned)
