"""A block of the stream, from its arrival to its end (thesis 7.3.4)."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum

from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.bml.names import ANTICIPATORS
from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.feedback.feedback_manager import Place
from reactive_realizer.feedback.xml import as_told
from reactive_realizer.pegboard.peg_key import BlockKey, PegKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, BMLBlockPeg, LatestPeg, OffsetPeg, TimeCell
from reactive_realizer.planunit.plan_unit import PlanUnit, SyncPoint
from reactive_realizer.scheduler.mentions import mentions_of
from reactive_realizer.scheduler.problem import Order, Origin, Point, Tie


class BlockState(Enum):
    """Where a block stands; the words are those of BMLA's status."""

    IN_PREP = "IN_PREP"
    PENDING = "PENDING"
    """Planned, and not to start before it is activated (BMLA preplan)."""
    LURKING = "LURKING"
    IN_EXEC = "IN_EXEC"
    SUBSIDING = "SUBSIDING"
    DONE = "DONE"
    INTERRUPTED = "INTERRUPTED"
    REVOKED = "REVOKED"
    FAILED = "FAILED"

    @property
    def plays(self) -> bool:
        """Whether the block has started and not ended."""
        return self in (BlockState.IN_EXEC, BlockState.SUBSIDING)

    @property
    def ended(self) -> bool:
        """Whether nothing of the block is ahead."""
        return self in (BlockState.DONE, BlockState.INTERRUPTED, BlockState.REVOKED, BlockState.FAILED)


@dataclass(frozen=True, slots=True, eq=False)
class Wait:
    """A block does not start before another one is over.

    Attributes:
        target: the other one.
        chunk: whether it is enough that the other subsides (thesis 12.1.3).
        implied: whether the target stands for all that it waits for itself, as the last one of an APPEND does.
    """

    target: "BMLBlock"
    chunk: bool = False
    implied: bool = False

    @property
    def peg(self) -> TimeCell:
        """When the wait is predicted to be over."""
        return self.target.relax if self.chunk else self.target.end

    @property
    def over(self) -> bool:
        """Whether it is; what was predicted does not matter."""
        state = self.target.state
        return state.ended or (self.chunk and state is BlockState.SUBSIDING) or self.target.lasting


class BMLBlock:
    """A block alive, and its pegs.

    Attributes:
        key: its name.
        description: what was asked for.
        mentions: the other blocks that stand in that.
        arrival: number of arrival over all characters.
        noticed: time of the tick in which it started; its peg may lie before that.
        predicted: the points of anticipators that it names, by anticipator and sync id, as they were meant when it
            arrived: by the time it is planned one may have come, and its name mean the next time.
        activation: when a preplanned block was activated, None before; None for others.
        start: its peg; pinned when it starts.
        relax: when it subsides: the latest relax of its behaviors, or end of those that have none.
        end: the latest end of its behaviors; those that persist have none, and count with their last known point.
        waits: for other blocks.
        holds: pegs that its constraints say it does not start before.
        units: its behaviors that are planned and not dropped, in document order.
        cancelled: ids of behaviors that were interrupted before the block started.
        dropped: ids of behaviors that were planned and could not be played.
        kept: the constraints of its plan.
        outside: the pegs of other blocks and of anticipators that these name.
        failing: whether something required of it was lost: it is to end FAILED.
        settled: those of them that nothing is expected of any more: said to be missed, or met and past.
    """

    def __init__(
        self,
        board: PegBoard,
        key: BlockKey,
        description: BehaviorBlock,
        arrival: int,
        arrived: GlobalTime,
        waits: Iterable[Wait],
    ) -> None:
        self.key = key
        self.description = description
        self.mentions = mentions_of(description)
        self.arrival = arrival
        self.waits = tuple(waits)
        self.holds: tuple[TimeCell, ...] = ()
        self.noticed: Time = None
        self.state = BlockState.IN_PREP
        self.units: list[PlanUnit] = []
        self.cancelled: set[str] = set()
        self.dropped: set[str] = set()
        self.kept: tuple[Tie | Order, ...] = ()
        self.outside: frozenset[TimeCell] = frozenset()
        self.settled: set[Tie | Order] = set()
        self.failing = False
        name = key.block
        self.activation = AnticipatorPeg(board.graph, f"{name}:activation", None) if description.preplan else None
        self.start = BMLBlockPeg(board.graph, f"{name}:start", arrived, self._awaited())
        self.relax = LatestPeg(board.graph, f"{name}:relax", arrived, (self.start,))
        self.end = LatestPeg(board.graph, f"{name}:end", arrived, (self.start,))
        for sync, peg in (("start", self.start), ("relax", self.relax), ("end", self.end)):
            board.add(PegKey(*key, None, sync), peg)
        self.predicted = _predicted(board, description)
        # The board forgets the names of points that nothing hangs on.
        board.add_unnamed(key, [OffsetPeg(board.graph, peg.name, peg, 0.0) for peg in self.predicted.values()])

    def planned(
        self, now: GlobalTime, units: Sequence[PlanUnit], kept: Sequence[Tie | Order], holds: Sequence[TimeCell]
    ) -> None:
        """Within a transaction: the block is ready to start, now or when what it waits for is over."""
        self.holds = tuple(holds)
        self.replanned(now, units, kept)
        self.start.wait_for(now, self._awaited())
        self.state = BlockState.PENDING if self.asleep else BlockState.LURKING

    def replanned(self, floor: GlobalTime, units: Sequence[PlanUnit], kept: Sequence[Tie | Order]) -> None:
        """Within a transaction: it has other behaviors or other pegs; it ends not before ``floor``."""
        self.units, self.kept = list(units), tuple(kept)
        self.outside = _outside(self.kept)
        self.end_again(floor)

    def follow(self, replaced: Mapping[TimeCell, TimeCell]) -> None:
        """Others have new pegs for points that its constraints name."""
        self.kept = tuple(each.renamed(replaced) for each in self.kept)
        self.outside = _outside(self.kept)
        self.settled = {each.renamed(replaced) for each in self.settled}

    @property
    def asleep(self) -> bool:
        """Whether it is preplanned and was not activated."""
        return self.activation is not None and self.activation.value is None

    def activate(self, time: GlobalTime) -> None:
        """Within a transaction: start at a time, if nothing else is waited for."""
        if self.activation is not None:
            self.activation.set(time)
        if self.state is BlockState.PENDING:
            self.state = BlockState.LURKING

    def wait_also(self, wait: Wait) -> None:
        """Within a transaction: something was put before it."""
        self.waits += (wait,)
        self.start.wait_for(self.start.floor, self._awaited())

    def wait_instead(self, ended: "BMLBlock") -> None:
        """Within a transaction: wait for what an ended target stood for."""
        others = (wait for wait in self.waits if wait.target is not ended)
        self.waits = (*others, *(wait for wait in ended.waits if not wait.over))
        self.start.wait_for(self.start.floor, self._awaited())

    def end_again(self, floor: GlobalTime) -> None:
        """Within a transaction: the end follows the behaviors that are left, and is not before ``floor``."""
        self.relax.wait_for(floor, (self.start, *(_subsiding(unit).peg for unit in self.units)))
        self.end.wait_for(floor, (self.start, *(unit.last_known.peg for unit in self.units)))

    @property
    def lasting(self) -> bool:
        """Whether nothing is left of it but behaviors that persist: nobody waits for these."""
        live = self.live_units if self.state.plays else ()
        return bool(live) and all(unit.lasting for unit in live)

    @property
    def waits_for(self) -> list[Wait]:
        """What it waits for and is not over."""
        return [wait for wait in self.waits if not wait.over]

    @property
    def may_start(self) -> bool:
        """Whether it is planned and waits for nothing but its time."""
        # The last one is most likely to be still there: of a long queue each block looks at one.
        return self.state is BlockState.LURKING and all(wait.over for wait in reversed(self.waits))

    @property
    def live_units(self) -> list[PlanUnit]:
        """The behaviors of which something is ahead."""
        return [unit for unit in self.units if unit.live]

    def subsides(self) -> bool:
        """Whether nothing but ways back to rest is, or in a late tick was, ahead of it."""
        relax, end = self.relax.value, self.end.value
        early = relax is not None and (end is None or not is_due(end, relax))
        return early and all(_subsiding(unit).fired is not None for unit in self.units)

    def place(self, time: GlobalTime, behavior: float, sync: int = 0) -> Place:
        """Where its feedback of a time stands in a tick; behavior -1 is the block's start, infinity its end.

        A block that is revoked before its predicted start counts as one that started when it ended. Times that are told
        as one are one here too: what differs by rounding must not come before its cause.
        """
        start = time if self.start.value is None else min(self.start.value, time)
        return Place(as_told(time), as_told(start), self.arrival, behavior, sync)

    def _awaited(self) -> tuple[TimeCell, ...]:
        activation = [self.activation] if self.activation is not None else []
        return (*activation, *(wait.peg for wait in self.waits), *self.holds)


def _predicted(board: PegBoard, description: BehaviorBlock) -> dict[tuple[str, str], AnticipatorPeg]:
    names = ((ref.behavior, ref.sync) for ref in description.refs if ref.block == ANTICIPATORS)
    return {
        (whose, sync): board.predicted(whose, sync) for whose, sync in names if whose is not None and sync is not None
    }


def _subsiding(unit: PlanUnit) -> SyncPoint:
    """Its relax, or its end if it has none; of one that persists, its last point before these."""
    relax = next((point for point in unit.points if point.id == "relax"), unit.points[-1])
    return unit.last_known if unit.timing.persistent and relax.fired is None else relax


def _outside(constraints: Iterable[Tie | Order]) -> frozenset[TimeCell]:
    return frozenset(node for each in constraints for node in each.nodes if not isinstance(node, Point | Origin))
