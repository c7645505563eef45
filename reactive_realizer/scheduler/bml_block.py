"""A block of the stream, from its arrival to its end (thesis 7.3.4)."""

from collections.abc import Sequence
from enum import Enum

from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.feedback.feedback_manager import Place
from reactive_realizer.pegboard.peg_key import BlockKey, PegKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import BMLBlockPeg, LatestPeg, Time, TimeCell
from reactive_realizer.planunit.plan_unit import PlanUnit


class BlockState(Enum):
    """Where a block stands; the words are those of BMLA's status."""

    IN_PREP = "IN_PREP"
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


class BMLBlock:
    """A block alive, and its two pegs.

    Attributes:
        key: its name.
        description: what was asked for.
        arrival: number of arrival over all characters.
        noticed: time of the tick in which it started; its peg may lie before that.
        start: its peg; pinned when it starts.
        end: the latest end of its behaviors.
        targets: the blocks it waits for; what these wait for in turn is not among them.
        units: its behaviors that are planned and not dropped, in document order.
    """

    def __init__(
        self,
        board: PegBoard,
        key: BlockKey,
        description: BehaviorBlock,
        arrival: int,
        arrived: GlobalTime,
        targets: Sequence["BMLBlock"],
    ) -> None:
        self.key = key
        self.description = description
        self.arrival = arrival
        self.targets = tuple(targets)
        self.noticed: Time = None
        self.state = BlockState.IN_PREP
        self.units: list[PlanUnit] = []
        self.start = BMLBlockPeg(board.graph, f"{key.block}:start", arrived, self._waits())
        self.end = LatestPeg(board.graph, f"{key.block}:end", arrived, (self.start,))
        board.add(PegKey(*key, None, "start"), self.start)
        board.add(PegKey(*key, None, "end"), self.end)

    def planned(self, now: GlobalTime, units: Sequence[PlanUnit]) -> None:
        """Within a transaction: the block is ready to start, now or when its targets have ended."""
        self.units = list(units)
        self.start.wait_for(now, self._waits())
        self.end_again(now)
        self.state = BlockState.LURKING

    def wait_instead(self, ended: "BMLBlock") -> None:
        """Within a transaction: wait for what an ended target waited for, in its place."""
        self.targets = (*(target for target in self.targets if target is not ended), *ended.waits_for)
        self.start.wait_for(self.start.floor, self._waits())

    def end_again(self, floor: GlobalTime) -> None:
        """Within a transaction: the end follows the behaviors that are left, and is not before ``floor``."""
        self.end.wait_for(floor, (self.start, *(unit.points[-1].peg for unit in self.units)))

    @property
    def waits_for(self) -> list["BMLBlock"]:
        """The blocks it is appended to that have not ended, whatever was predicted of their ends."""
        return [target for target in self.targets if not target.state.ended]

    @property
    def live_units(self) -> list[PlanUnit]:
        """The behaviors of which something is ahead."""
        return [unit for unit in self.units if unit.live]

    def subsides(self) -> bool:
        """Whether every behavior has ended or is past its relax."""
        return all(any(p.id == "relax" and p.fired is not None for p in unit.points) for unit in self.live_units)

    def place(self, time: GlobalTime, behavior: float, sync: int = 0) -> Place:
        """Where its feedback of a time stands in a tick; behavior -1 is the block's start, infinity its end.

        A block that is revoked before its predicted start counts as one that started when it ended.
        """
        start = self.start.value
        return Place(time, time if start is None else min(start, time), self.arrival, behavior, sync)

    def _waits(self) -> tuple[TimeCell, ...]:
        return tuple(target.end for target in self.targets)
