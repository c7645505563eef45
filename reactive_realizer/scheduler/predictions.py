"""What is predicted of each block, and whether it is worth saying again."""

from collections.abc import Mapping

from reactive_realizer.clock.units import BlockTime, GlobalTime, Time
from reactive_realizer.feedback.feedback_manager import FeedbackManager
from reactive_realizer.feedback.messages import BehaviorPrediction, PredictionFeedback
from reactive_realizer.pegboard.supposing import Supposed
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.bml_block import BMLBlock

_WORTH_SAYING = 1e-3
"""Seconds by which a published time must have moved."""

_Times = Mapping[str, Mapping[str, Time]]
"""Of the points of each behavior; those of the block have no behavior."""


class Predictions:
    """Publishes predictionFeedback: when it is owed, and when a published time has moved; at most once a block a tick.

    A tick first does all it has to do and then says what is predicted, so that the one prediction is the latest.
    """

    def __init__(self, feedback: FeedbackManager) -> None:
        self._feedback = feedback
        self._published: dict[BMLBlock, _Times] = {}
        self._owed: set[BMLBlock] = set()

    def owe(self, block: BMLBlock) -> None:
        """Have this tick say what is predicted of a block, moved or not."""
        self._owed.add(block)

    def publish(self, block: BMLBlock, now: GlobalTime) -> None:
        """Say what is predicted if that is owed or is not what was said last."""
        times = _times(block)
        if block in self._owed or _moved(self._published.get(block, {}), times):
            self._owed.discard(block)
            self._published[block] = times
            self._feedback.say(_prediction(block, now))

    def close(self, block: BMLBlock, now: GlobalTime) -> None:
        """The block ends: say what is still owed, if it has played at all, and forget it."""
        if block in self._owed and block.state.plays:
            self.publish(block, now)
        self._owed.discard(block)
        self._published.pop(block, None)


def _times(block: BMLBlock) -> _Times:
    own = {"start": block.start.value, "end": block.end.value}
    return {"": own} | {unit.behavior.id: unit.times() for unit in block.units}


def _moved(old: _Times, new: _Times) -> bool:
    behaviors = old.keys() | new.keys()
    return old != new and any(_any_moved(old.get(name, {}), new.get(name, {})) for name in behaviors)


def _any_moved(old: Mapping[str, Time], new: Mapping[str, Time]) -> bool:
    return not old.keys() >= new.keys() or any(_differ(time, new.get(sync)) for sync, time in old.items())


def _differ(old: Time, new: Time) -> bool:
    if old is None or new is None:
        return old is not new
    return abs(old - new) > _WORTH_SAYING


def _prediction(block: BMLBlock, now: GlobalTime) -> PredictionFeedback:
    """All that is known of a block; where its start is not, as if it came now."""
    start = now if block.start.value is None else block.start.value
    supposed = Supposed({block.start: start})
    times = {unit: _ahead(unit, supposed) for unit in block.units}
    end = supposed(block.end)
    if end is None:
        end = max([start, *(time for known in times.values() for time in known.values())])
    behaviors = tuple(BehaviorPrediction(unit.behavior, _local(known, start)) for unit, known in times.items())
    status = block.state.value
    return PredictionFeedback(block.key.character, block.key.block, start, end, status, behaviors)


def _ahead(unit: PlanUnit, supposed: Supposed) -> dict[str, GlobalTime]:
    times = unit.times() if unit.begun else {point.id: supposed(point.peg) for point in unit.points}
    return {sync: time for sync, time in times.items() if time is not None}


def _local(times: Mapping[str, GlobalTime], start: GlobalTime) -> dict[str, BlockTime]:
    return {sync: BlockTime(time - start) for sync, time in times.items()}
