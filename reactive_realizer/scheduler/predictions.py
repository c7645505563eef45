"""Prediction feedback: reported when it is requested, and again when a reported time has moved."""

from collections.abc import Mapping

from reactive_realizer.clock.units import BlockTime, GlobalTime, Time
from reactive_realizer.feedback.feedback_manager import FeedbackManager
from reactive_realizer.feedback.messages import BehaviorPrediction, PredictionFeedback
from reactive_realizer.scheduler.block_watch import BlockWatch, in_order
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.problem import Point

_NOTICEABLE = 1e-3
"""Seconds by which a reported time must have moved to be reported again."""

_Times = Mapping[tuple[str, str], Time]
"""By behavior and sync id; the points of the block have no behavior."""


class Predictions:
    """Reports ``predictionFeedback``, at most once for each block and tick, with the times at the end of the tick."""

    def __init__(self, feedback: FeedbackManager, watch: BlockWatch) -> None:
        self._feedback = feedback
        self._moves = watch.moves()
        self._published: dict[BMLBlock, _Times] = {}
        self._requested: set[BMLBlock] = set()

    def request(self, block: BMLBlock) -> None:
        """Have this tick report the prediction of a block, even if no time has moved."""
        self._requested.add(block)

    def publish(self, now: GlobalTime) -> None:
        """Report the predictions that were requested, and those of blocks of which a time has moved."""
        moved, _ = self._moves.take()
        for block in in_order({*moved, *self._requested}):
            self._publish(block, now)

    def close(self, block: BMLBlock, now: GlobalTime) -> None:
        """Forget a block that ends; of one that plays, report what was requested or has moved in this tick before."""
        if block.state.plays:
            self._publish(block, now)
        self._requested.discard(block)
        self._published.pop(block, None)

    def _publish(self, block: BMLBlock, now: GlobalTime) -> None:
        times = {("", "start"): block.start.value, ("", "end"): block.end.value}
        times |= {(unit.behavior.id, point.id): point.peg.value for unit in block.units for point in unit.points}
        if block in self._requested or _moved(self._published.get(block, {}), times):
            self._requested.discard(block)
            self._published[block] = times
            self._feedback.add(_prediction(block, times, now))


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
