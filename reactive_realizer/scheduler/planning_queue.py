"""The queue of blocks to be planned: which block of a lane may be planned next."""

from collections import Counter
from collections.abc import Collection, Container
from heapq import heappop, heappush

from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.lanes import Lane
from reactive_realizer.scheduler.preparation import Preparation


class PlanningQueue:
    """Blocks by lane, in order of arrival; each after those that it names, and after its slow work.

    A block is looked at when it enters, and again only when what it waits for is there. In a circle of blocks, the one
    that entered last is first.

    Args:
        blocks: to find those that a block names.
        expected: ids of blocks that have arrived and not entered yet.
    """

    def __init__(self, blocks: Blocks, expected: Container[str]) -> None:
        self._blocks = blocks
        self._expected = expected
        self._preparations: dict[BMLBlock, Preparation] = {}
        self._ready: dict[Lane, list[tuple[int, BMLBlock]]] = {}
        self._present: dict[Lane, BMLBlock] = {}
        self._awaited: dict[BMLBlock, BMLBlock] = {}
        self._waiting: dict[BMLBlock | str, list[BMLBlock]] = {}
        self._numbers: Counter[Lane] = Counter()

    def add(self, block: BMLBlock, preparation: Preparation) -> None:
        """Add a block that has entered."""
        self.entered(block.key.block)
        self._preparations[block] = preparation
        self._numbers[block.lane] += 1
        self._examine(block)

    def entered(self, name: str) -> None:
        """Note that a block with an expected id has entered, or was refused."""
        for block in self._waiting.pop(name, ()):
            self._examine(block)

    def first(self, lane: Lane) -> BMLBlock | None:
        """The block of a lane to be planned now; it stays the first until it is put off or leaves."""
        ready = self._ready.get(lane, [])
        while lane not in self._present and ready:
            _, block = heappop(ready)
            if block in self._preparations:
                self._present[lane] = block
        return self._present.get(lane)

    def length(self, lane: Lane) -> int:
        """How many blocks of a lane may be planned."""
        return len(self._ready.get(lane, ())) + (lane in self._present)

    @property
    def lanes(self) -> Collection[Lane]:
        """The lanes that have blocks in the queue."""
        return self._numbers.keys()

    def put_off(self, block: BMLBlock) -> None:
        """Take the first block from its place, until it returns."""
        del self._present[block.lane]

    def put_back(self, block: BMLBlock) -> None:
        """Have a block that was put off be planned further."""
        if block in self._preparations:
            heappush(self._ready.setdefault(block.lane, []), (block.arrival, block))

    def leave(self, block: BMLBlock) -> None:
        """Remove a block that is planned or has ended, if it is in the queue."""
        if self._preparations.pop(block, None) is not None:
            self._numbers[block.lane] -= 1
            if not self._numbers[block.lane]:
                del self._numbers[block.lane]
                self._ready.pop(block.lane, None)
        self._awaited.pop(block, None)
        if self._present.get(block.lane) is block:
            self.put_off(block)
        for other in self._waiting.pop(block, ()):
            self._awaited.pop(other, None)
            self._examine(other)

    def _examine(self, block: BMLBlock) -> None:
        """Make a block ready, or have it wait for the next thing that it needs."""
        if block not in self._preparations:
            return
        name = next((name for name in block.named_blocks.all if name in self._expected), None)
        if name is not None:
            self._waiting.setdefault(name, []).append(block)
            return
        awaited = (other for other in self._blocks.planned_before(block) if not self._waits_for(other, block))
        other = next(awaited, None)
        if other is not None:
            self._awaited[block] = other
            self._waiting.setdefault(other, []).append(block)
        else:
            self._preparations[block].when_complete(lambda: self.put_back(block))

    def _waits_for(self, block: BMLBlock, other: BMLBlock) -> bool:
        """Whether a block waits for another one, directly or not."""
        while block in self._awaited:
            block = self._awaited[block]
            if block is other:
                return True
        return False
