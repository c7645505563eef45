"""Prediction feedback: reported when it is requested, and again when a reported time has moved."""

from collections.abc import Iterable, Iterator, Mapping

from reactive_realizer.clock.units import BlockTime, GlobalTime, Time
from reactive_realizer.feedback.feedback_manager import FeedbackManager
from reactive_realizer.feedback.messages import BehaviorPrediction, PredictionFeedback
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.reactive.graph import Commit
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.problem import Point

_NOTICEABLE = 1e-3
"""Seconds by which a reported time must have moved to be reported again."""

_Times = Mapping[str, Mapping[str, Time]]
"""Of the points of each behavior; those of the block have no behavior."""


class Predictions:
    """Reports ``predictionFeedback``, at most once a block a tick, at the end of the tick: so it is the latest."""

    def __init__(self, feedback: FeedbackManager, board: PegBoard) -> None:
        self._feedback = feedback
        self._board = board
        self._moved: set[BlockKey | None] = set()
        self._published: dict[BMLBlock, _Times] = {}
        self._requested: set[BMLBlock] = set()
        board.graph.listen(self._note)

    def request(self, block: BMLBlock) -> None:
        """Have this tick report the prediction of a block, even if no time has moved."""
        self._requested.add(block)

    def publish(self, blocks: Iterable[BMLBlock], now: GlobalTime) -> None:
        """Report the predictions that were requested, and those of blocks of which a time has moved."""
        moved, self._moved = self._moved, set()
        for block in blocks if moved or self._requested else ():
            if block.key in moved or block in self._requested:
                self._publish(block, now)

    def close(self, block: BMLBlock, now: GlobalTime) -> None:
        """Forget a block that ends; what is still requested is reported, if the block plays."""
        if block in self._requested and block.state.plays:
            self._publish(block, now)
        self._requested.discard(block)
        self._published.pop(block, None)

    def _publish(self, block: BMLBlock, now: GlobalTime) -> None:
        times = _times(block)
        if block in self._requested or _moved(self._published.get(block, {}), times):
            self._requested.discard(block)
            self._published[block] = times
            self._feedback.add(_prediction(block, now))

    def _note(self, commit: Commit) -> None:
        self._moved.update(self._board.owner(change.cell) for change in commit.changes)


def _times(block: BMLBlock) -> _Times:
    own = {"start": block.start.value, "end": block.end.value}
    return {"": own} | {unit.behavior.id: {point.id: point.peg.value for point in unit.points} for unit in block.units}


def _moved(old: _Times, new: _Times) -> bool:
    behaviors = old.keys() | new.keys()
    return old != new and any(_any_moved(old.get(name, {}), new.get(name, {})) for name in behaviors)


def _any_moved(old: Mapping[str, Time], new: Mapping[str, Time]) -> bool:
    return not old.keys() >= new.keys() or any(_differ(time, new.get(sync)) for sync, time in old.items())


def _differ(old: Time, new: Time) -> bool:
    if old is None or new is None:
        return old is not new
    return abs(old - new) > _NOTICEABLE


def _prediction(block: BMLBlock, now: GlobalTime) -> PredictionFeedback:
    """All that is known of a block; where its start is not, as it was planned, as if it came now."""
    start = now if block.start.value is None else block.start.value
    times = {unit: dict(_known_times(block, unit, start)) for unit in block.units}
    end = block.end.value
    if end is None:
        end = max([start, *(time for known in times.values() for time in known.values())])
    behaviors = tuple(BehaviorPrediction(unit.behavior, _local(known, start)) for unit, known in times.items())
    status = block.state.value
    return PredictionFeedback(block.key.character, block.key.block, start, end, status, behaviors)


def _known_times(block: BMLBlock, unit: PlanUnit, start: GlobalTime) -> Iterator[tuple[str, GlobalTime]]:
    for point in unit.points:
        time = point.peg.value
        if time is None and block.start.value is None:
            planned = block.planned_times.get(Point(unit.behavior.id, point.id))
            time = None if planned is None else GlobalTime(start + planned)
        if time is not None:
            yield point.id, time


def _local(times: Mapping[str, GlobalTime], start: GlobalTime) -> dict[str, BlockTime]:
    return {sync: BlockTime(time - start) for sync, time in times.items()}
