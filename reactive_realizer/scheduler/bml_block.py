"""A block of the stream: its pegs, its behaviors and its predecessors (thesis 7.3.4)."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.bml.names import ANTICIPATORS
from reactive_realizer.clock.units import GlobalTime, Time, has_passed, is_due
from reactive_realizer.pegboard.block_pegs import BMLBlockPeg, LatestPeg
from reactive_realizer.pegboard.peg_key import BlockKey, PegKey
from reactive_realizer.pegboard.peg_view import unknown_sources
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, OffsetPeg, TimeCell
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.sync_point import SyncPoint
from reactive_realizer.planunit.wait_unit import WaitUnit
from reactive_realizer.scheduler.block_state import BlockEvent, BlockState, BlockTransition, transition
from reactive_realizer.scheduler.lanes import ACCOMPANIST, Lane
from reactive_realizer.scheduler.late_ties import Bounds
from reactive_realizer.scheduler.named_blocks import named_blocks
from reactive_realizer.scheduler.problem import Origin, Point, Precedence, Tie


@dataclass(frozen=True, slots=True, eq=False)
class Predecessor:
    """Another block that has to be over before a block starts.

    Attributes:
        block: the other block.
        chunk: whether it is enough that the other one subsides (thesis 12.1.3).
        implied: whether it stands for all its own predecessors too, as the last block does for an APPEND.
    """

    block: "BMLBlock"
    chunk: bool = False
    implied: bool = False

    @property
    def peg(self) -> TimeCell:
        """When it is predicted to be over."""
        return self.block.relax if self.chunk else self.block.end

    @property
    def over(self) -> bool:
        """Whether it is over; predictions do not count."""
        state = self.block.state
        return state.ended or (self.chunk and state is BlockState.SUBSIDING) or self.block.only_persists


class Meant(NamedTuple):
    """The time from which events count for a block, s, global, and how it came to be meant, in words."""

    time: GlobalTime
    how: str


class BMLBlock:
    """A block that is alive, and its pegs; only `BlockLifecycle` writes it, and `Planning` when it is to start.

    Attributes:
        key: its name.
        description: the BML that was sent.
        named_blocks: the other blocks that the description names.
        arrival: number of arrival over all characters.
        client: that sent it; empty if it is of the session itself.
        accompanied: the block that it accompanies, None for other blocks.
        gives_way: whether it is of the realizer itself or accompanies another one: its behaviors give way to those of
            other blocks, and nothing waits for it.
        accompaniments: the live blocks that accompany it, in order of arrival.
        started_at: time of the tick in which it started, None before; its peg may lie before that.
        predicted: the points of anticipators that it names, by anticipator and sync id: the first occurrences since it
            was ``meant``, which may have passed when it is planned or starts.
        activation: the time at which a preplanned block was activated, None before; None for other blocks.
        start: its peg; pinned when it starts.
        relax: the time at which it subsides: the latest relax of its behaviors, or end of those without a relax.
        end: the latest end of its behaviors; persistent ones count with their last known point.
        predecessors: the blocks that it starts after.
        successors: the blocks that have it as a predecessor, and whether they wait for its end; without those that give
            way.
        yielding_successors: likewise, those that give way.
        holds: pegs before which its constraints do not let it start.
        units: its behaviors that are planned and not dropped, in document order.
        cancelled: ids of behaviors that were interrupted before the block started.
        dropped: ids of behaviors that were planned and could not be played.
        planned_times: of the points of its plan, s after its start; None for unknown ones.
        kept: the constraints of its plan.
        outside: the pegs of other blocks and of anticipators that these name.
        bounds: those that they set on the ties of the plan to them.
        beyond_limits: ids of behaviors of which a warning has said that they do not keep the limits of their authors.
        settled: the constraints that are not checked any more: they were missed, or are met and past.
        failing: whether something required was lost, so that the block is to end FAILED.
    """

    def __init__(
        self,
        board: PegBoard,
        key: BlockKey,
        description: BehaviorBlock,
        arrival: int,
        arrived: GlobalTime,
        predecessors: Iterable[Predecessor],
        client: str,
        accompanied: "BMLBlock | None" = None,
    ) -> None:
        self.key = key
        self.description = description
        self.named_blocks = named_blocks(description)
        self.arrival = arrival
        self.client = client
        self.accompanied = accompanied
        self.gives_way = accompanied is not None or client == ACCOMPANIST
        self.accompaniments: dict[BMLBlock, None] = {}
        if accompanied is not None:
            accompanied.accompaniments[self] = None
        self.predecessors: tuple[Predecessor, ...] = ()
        self.successors: dict[BMLBlock, bool] = {}
        self.yielding_successors: dict[BMLBlock, bool] = {}
        self._link(predecessors)
        self.holds: tuple[TimeCell, ...] = ()
        self.started_at: Time = None
        self.units: list[PlanUnit] = []
        self.cancelled: set[str] = set()
        self.dropped: set[str] = set()
        self.planned_times: Mapping[Point, float | None] = {}
        self.kept: tuple[Tie | Precedence, ...] = ()
        self.outside: frozenset[TimeCell] = frozenset()
        self.bounds: Mapping[TimeCell, Bounds] = {}
        self.beyond_limits: set[str] = set()
        self.settled: set[Tie | Precedence] = set()
        self.failing = False
        self._state = BlockState.IN_PREP
        name = key.block
        self._arrived = arrived
        self.activation = AnticipatorPeg(board.graph, f"{name}:activation", None) if description.preplan else None
        self.start = BMLBlockPeg(board.graph, f"{name}:start", arrived, self._awaited())
        self.relax = LatestPeg(board.graph, f"{name}:relax", arrived, (self.start,))
        self.end = LatestPeg(board.graph, f"{name}:end", arrived, (self.start,))
        for sync in ("start", "relax", "end"):
            board.add(PegKey(*key, None, sync), self.peg(sync))
        self.predicted: dict[tuple[str, str], AnticipatorPeg] = {}
        points = ((ref.behavior, ref.sync) for ref in description.refs if ref.block == ANTICIPATORS)
        for anticipator, point in dict.fromkeys(points):
            if anticipator is not None and point is not None:
                self._name(board, anticipator, point, board.first_since(anticipator, point, arrived, at_it=False))

    @property
    def lane(self) -> Lane:
        """Its client and its character."""
        return Lane(self.client, self.key.character)

    # --- state

    @property
    def state(self) -> BlockState:
        """Its state; only `take` changes it."""
        return self._state

    def take(self, event: BlockEvent) -> BlockTransition:
        """Go to the state to which an event leads; the row of the table.

        Raises:
            IllegalTransitionError: the event cannot happen in the present state.
        """
        row = transition(self._state, event)
        self._state = row.target
        return row

    @property
    def awaits_activation(self) -> bool:
        """Whether it is preplanned and was not activated."""
        return self.activation is not None and self.activation.value is None

    @property
    def meant(self) -> Meant | None:
        """From when on events count for it; None while it waits for its activation."""
        if self.activation is None:
            return Meant(self._arrived, "arrived")
        time = self.activation.value
        return None if time is None else Meant(time, "was activated")

    @property
    def may_start(self) -> bool:
        """Whether it is planned and waits only for its time."""
        # The last predecessor is the most likely to be alive: each block of a long queue checks only one.
        return self.state is BlockState.LURKING and all(each.over for each in reversed(self.predecessors))

    @property
    def only_persists(self) -> bool:
        """Whether only persistent behaviors are left; no block waits for these."""
        live = self.live_units if self.state.plays else ()
        return bool(live) and all(unit.only_persists for unit in live)

    def subsides(self) -> bool:
        """Whether only returns to rest are left, or were left before its end in a late tick."""
        relax, end = self.relax.value, self.end.value
        early = relax is not None and (end is None or not is_due(end, relax))
        return early and all(_subsiding(unit).fired for unit in self.units)

    # --- times

    @property
    def pegs(self) -> Iterator[TimeCell]:
        """The pegs of its points, those from outside that its constraints name, and those that hold its start."""
        yield from (self.start, self.relax, self.end)
        for unit in self.units:
            yield from (point.peg for point in unit.points)
        yield from self.outside
        yield from self.holds

    def peg(self, sync: str) -> LatestPeg:
        """The peg of its own ``start``, ``relax`` or ``end``."""
        return {"start": self.start, "relax": self.relax, "end": self.end}[sync]

    @property
    def earliest_point(self) -> Time:
        """The earliest known time of its points; None if none is known."""
        times = [point.peg.value for unit in self.units for point in unit.points]
        return min([time for time in times if time is not None], default=None)

    @property
    def times_ahead(self) -> list[GlobalTime]:
        """The known times of its future points; of a block that has not started, only the start, if it may start."""
        if self.state.plays:
            times = [point.peg.value for unit in self.live_units for point in unit.ahead()]
        else:
            times = [self.start.value] if self.may_start else []
        return [time for time in times if time is not None]

    def can_progress(self, now: GlobalTime) -> bool:
        """Whether it is being prepared, may start, or has a known time ahead."""
        if not self.state.plays:
            return self.state is BlockState.IN_PREP or bool(self.times_ahead)
        return any(not is_due(time, now) for time in self.times_ahead)

    @property
    def awaited(self) -> list[str]:
        """Names of the ends, activations and predictions that it waits for, each once."""
        pegs = [point.peg for unit in self.live_units for point in unit.ahead()]
        ends = [each.peg.name for each in self.predecessors if not each.over]
        return list(dict.fromkeys([*ends, *unknown_sources([self.start, *pegs])]))

    @property
    def live_units(self) -> list[PlanUnit]:
        """The behaviors that are neither done nor dropped."""
        return [unit for unit in self.units if unit.live]

    # --- writing, within a transaction

    def expect(self, floor: GlobalTime) -> None:
        """Have the start of a block that is being planned not come before a time, at which its plan will be there."""
        self.start.wait_for(floor, self._awaited())

    def release_start(self, holds: Collection[TimeCell], now: GlobalTime) -> None:
        """Do not wait any more for some of the pegs that hold the start; a block that has not started starts later."""
        self.holds = tuple(hold for hold in self.holds if hold not in holds)
        self.start.wait_for(max(self.start.floor, now), self._awaited())

    def set_plan(
        self,
        floor: GlobalTime,
        units: Sequence[PlanUnit],
        times: Mapping[Point, float | None],
        kept: Sequence[Tie | Precedence],
        bounds: Mapping[TimeCell, Bounds],
        holds: Sequence[TimeCell],
    ) -> None:
        """Have the behaviors of a plan; start after everything that it waits for, and end not before ``floor``.

        A block that plays keeps its start.
        """
        self.holds = tuple(holds)
        self.planned_times = times
        self.units, self.kept = list(units), tuple(kept)
        self.outside, self.bounds = _outside(self.kept), bounds
        self.update_end(floor)
        if not self.state.plays:
            self.start.wait_for(floor, self._awaited())

    def renew_predicted(self, board: PegBoard) -> Mapping[TimeCell, TimeCell]:
        """Name the next occurrences of the points that passed before it was meant; the new pegs by the old ones."""
        meant = self.meant
        if meant is None:
            return {}
        renewed = dict[TimeCell, AnticipatorPeg]()
        for (anticipator, sync), old in list(self.predicted.items()):
            if has_passed(old.value, meant.time):
                renewed[old] = board.first_since(anticipator, sync, meant.time, at_it=True)
                self._name(board, anticipator, sync, renewed[old])
        return renewed

    def rename_pegs(self, replaced: Mapping[TimeCell, TimeCell]) -> None:
        """Have constraints and waits name the new pegs of other blocks."""
        for unit in self.units:
            if isinstance(unit, WaitUnit):
                unit.rename(replaced)
        self.kept = tuple(each.renamed(replaced) for each in self.kept)
        self.outside = _outside(self.kept)
        self.bounds = {replaced.get(cell, cell): each for cell, each in self.bounds.items()}
        self.settled = {each.renamed(replaced) for each in self.settled}

    def set_predecessors(self, predecessors: Iterable[Predecessor]) -> None:
        """Wait for other blocks."""
        self._link(predecessors)
        self.start.wait_for(self.start.floor, self._awaited())

    def leave(self) -> None:
        """Leave the predecessors of an ended block to those that come after it, and the block that it accompanies."""
        if self.accompanied is not None:
            self.accompanied.accompaniments.pop(self, None)
        for other in sorted((*self.successors, *self.yielding_successors), key=lambda block: block.arrival):
            other.take_over_predecessors(self)
        self._link(())

    def take_over_predecessors(self, ended: "BMLBlock") -> None:
        """Wait for the blocks that an ended block still waited for, if that stood for them too."""
        left = [each for each in ended.predecessors if not each.over]
        if left and any(each.implied and each.block is ended for each in self.predecessors):
            self.set_predecessors((*(each for each in self.predecessors if each.block is not ended), *left))

    def update_end(self, floor: GlobalTime | None = None) -> None:
        """Have ``relax`` and ``end`` follow the behaviors that are left, and not come before ``floor``."""
        floor = self.end.floor if floor is None else floor
        self.relax.wait_for(floor, (self.start, *(_subsiding(unit).peg for unit in self.units)))
        self.end.wait_for(floor, (self.start, *(unit.last_known.peg for unit in self.units)))

    def _link(self, predecessors: Iterable[Predecessor]) -> None:
        for each in self.predecessors:
            self._among_successors_of(each.block).pop(self, None)
        self.predecessors = tuple(predecessors)
        for each in self.predecessors:
            successors = self._among_successors_of(each.block)
            successors[self] = not each.chunk or successors.get(self, False)

    def _among_successors_of(self, other: "BMLBlock") -> "dict[BMLBlock, bool]":
        return other.yielding_successors if self.gives_way else other.successors

    def _name(self, board: PegBoard, anticipator: str, sync: str, peg: AnticipatorPeg) -> None:
        """Name an occurrence of a point."""
        self.predicted[anticipator, sync] = peg
        # The board forgets the names of points without dependents.
        board.add_unnamed(self.key, [OffsetPeg(board.graph, peg.name, peg, 0.0)])

    def _awaited(self) -> tuple[TimeCell, ...]:
        activation = [self.activation] if self.activation is not None else []
        return (*activation, *(each.peg for each in self.predecessors), *self.holds)


def _subsiding(unit: PlanUnit) -> SyncPoint:
    """Its relax, or its end if it has none; for a persistent one, the last known point."""
    relax = next((point for point in unit.points if point.id == "relax"), unit.points[-1])
    return unit.last_known if unit.timing.persistent and not relax.fired else relax


def _outside(constraints: Iterable[Tie | Precedence]) -> frozenset[TimeCell]:
    return frozenset(node for each in constraints for node in each.nodes if not isinstance(node, Point | Origin))
