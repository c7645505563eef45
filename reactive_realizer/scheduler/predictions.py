"""Prediction feedback: reported when it is requested, and again when a reported time has moved."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.ticker import RATE
from reactive_realizer.clock.units import BlockTime, GlobalTime, Time, is_due
from reactive_realizer.feedback.feedback_manager import FeedbackManager
from reactive_realizer.feedback.messages import BehaviorPrediction, PredictionFeedback
from reactive_realizer.limits import Limits
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.block_watch import BlockWatch, in_order
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.problem import Point

_NOTICEABLE = 1e-3
"""Seconds by which a reported time must have moved to be reported again."""

_Times = dict[str, dict[str, Time]]
"""By behavior and sync id; the points of the block have no behavior."""


class Predictions:
    """Reports ``predictionFeedback`` with the times at the end of a tick (docs/semantics.md, predictions).

    A prediction that is requested is reported in its tick. One that has moved is reported at a limited rate, the latest
    one always: at most so often for a block, and only so many behaviors of all blocks together. Clients share these
    equally; the blocks of each are reported in the order in which they have begun to wait. Before progress of its block
    is reported, a prediction does not wait any more.
    """

    def __init__(self, feedback: FeedbackManager, watch: BlockWatch, limits: Limits) -> None:
        self._feedback = feedback
        self._moves = watch.moves()
        self._interval = 1.0 / limits.predictions_per_second
        self._behaviors_per_tick = limits.predicted_behaviors_per_second / RATE
        self._allowances: dict[str, float] = {}
        """By client, the behaviors that may be reported; below 0, more were reported than it may."""
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

    def report_requested(self, block: BMLBlock, now: GlobalTime) -> None:
        """Report the prediction of a block at once if it was requested, because a behavior of it is about to go."""
        if block in self._requested:
            self._publish(block, now)

    def publish(self, now: GlobalTime) -> None:
        """Report the predictions that were requested, and moved ones as far as the rates allow."""
        moved, _ = self._moves.take()
        self._waiting.update(dict.fromkeys(moved))
        progressing = self._feedback.progressing if self._waiting else frozenset()
        chosen = self._requested | {block for block in self._waiting if block.key in progressing}
        self._allow({block.client for block in (*self._waiting, *chosen)})
        for block in chosen:
            self._allowances[block.client] -= _cost(block)
        for block in [block for block in self._waiting if is_due(self._next.get(block, now), now)]:
            if block not in chosen and self._allowances[block.client] > 0.0:
                chosen.add(block)
                self._allowances[block.client] -= _cost(block)
        for block in in_order(chosen):
            self._publish(block, now)

    def _allow(self, clients: Iterable[str]) -> None:
        """Share the behaviors of a tick among the clients whose predictions wait, or were too many before."""
        owing = {client: left for client, left in self._allowances.items() if left < 0.0}
        sharing = {**dict.fromkeys(clients, 0.0), **owing}
        self._allowances = {client: left + self._behaviors_per_tick / len(sharing) for client, left in sharing.items()}

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
        times: _Times = {unit.behavior.id: _reported(unit) for unit in block.units}
        times[""] = {"start": block.start.value, "end": block.end.value}
        if block in self._requested or _moved(self._published.get(block, {}), times):
            self._requested.discard(block)
            self._published[block] = times
            self._next[block] = GlobalTime(now + self._interval)
            self._feedback.add(_prediction(block, times, now))


def _reported(unit: PlanUnit) -> dict[str, Time]:
    """The times of the points of a behavior that are reported."""
    unreported = unit.unreported
    return {point.id: point.peg.value for point in unit.coming() if point.id not in unreported}


def _cost(block: BMLBlock) -> int:
    return 1 + len(block.units)


def _moved(old: _Times, new: _Times) -> bool:
    """Whether a time has moved noticeably, or become known or unknown."""
    if old == new:
        return False
    changed = [(own, old.get(id_, {})) for id_, own in new.items() if own != old.get(id_)]
    lost: list[tuple[dict[str, Time], dict[str, Time]]] = [({}, own) for id_, own in old.items() if id_ not in new]
    return any(_differ(before, after) for after, before in (*changed, *lost))


def _differ(before: Mapping[str, Time], after: Mapping[str, Time]) -> bool:
    """Whether the times of a behavior differ noticeably."""
    pairs = [(time, after.get(sync)) for sync, time in before.items()]
    return not before.keys() >= after.keys() or any(
        one is not other if one is None or other is None else abs(one - other) > _NOTICEABLE for one, other in pairs
    )


class _Behaviors(Collection[BehaviorPrediction]):
    """The behaviors of a prediction, each made when it is read: a long prediction is written after its tick.

    Args:
        behaviors: of the block.
        times: of each behavior, by id.
        start: of the block, s.
    """

    def __init__(self, behaviors: Sequence[Behavior], times: _Times, start: GlobalTime) -> None:
        self._behaviors = behaviors
        self._times = times
        self._start = start

    def __len__(self) -> int:
        return len(self._behaviors)

    def __iter__(self) -> Iterator[BehaviorPrediction]:
        for behavior in self._behaviors:
            yield BehaviorPrediction(behavior, _known(self._times[behavior.id], self._start))

    def __contains__(self, behavior: object) -> bool:
        return any(each == behavior for each in self)


def _prediction(block: BMLBlock, times: _Times, now: GlobalTime) -> PredictionFeedback:
    """The known times of a block; if its start is unknown, the times that were planned, as if it started now."""
    start, end = block.start.value, block.end.value
    if start is None:
        start = now
        times = {id_: _planned(block, id_, own, start) for id_, own in times.items()}
    if end is None:
        known = (time for id_, own in times.items() if id_ for time in own.values() if time is not None)
        end = max([start, *known])
    behaviors = _Behaviors([unit.behavior for unit in block.units], times, start)
    return PredictionFeedback(*block.key, start, end, block.state.value, behaviors)


def _known(times: Mapping[str, Time], start: GlobalTime) -> dict[str, BlockTime]:
    """The known times of a behavior.

    A waiting block is planned again at its start, so that no point comes before that.
    """
    return {sync: BlockTime(max(time - start, 0.0)) for sync, time in times.items() if time is not None}


def _planned(block: BMLBlock, id_: str, times: Mapping[str, Time], start: GlobalTime) -> dict[str, Time]:
    """The times of a behavior, and the planned ones of points without a time."""
    planned = block.planned_times
    return {
        sync: GlobalTime(start + after)
        if time is None and (after := planned.get(Point(id_, sync))) is not None
        else time
        for sync, time in times.items()
    }
