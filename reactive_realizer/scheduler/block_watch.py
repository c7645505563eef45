"""Observes blocks: which of them have moved, and from which times."""

from collections.abc import Callable, Iterable, Mapping
from collections.abc import Set as AbstractSet
from typing import Any

from reactive_realizer.pegboard.peg_follower import PegFollower
from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.reactive.graph import Cell, Change
from reactive_realizer.scheduler.bml_block import BMLBlock


class BlockMoves:
    """The blocks of which something has moved since `take`, in order of arrival."""

    def __init__(self, hand_out: Callable[[], None]) -> None:
        self._hand_out = hand_out
        self._blocks: set[BMLBlock] = set()
        self._old: dict[Cell[Any], Any] = {}

    def add(self, blocks: AbstractSet[BMLBlock], old: Mapping[Cell[Any], Any]) -> None:
        """Add blocks of which something has moved, and the values that their pegs had before."""
        self._blocks |= blocks
        self._old = {**old, **self._old}

    def take(self) -> tuple[list[BMLBlock], Mapping[Cell[Any], Any]]:
        """The blocks that are alive, and the values that the pegs had before they moved."""
        self._hand_out()
        if not self._blocks:
            return [], {}
        blocks, old = self._blocks, self._old
        self._blocks, self._old = set(), {}
        return in_order(block for block in blocks if not block.state.ended), old


class _BlockFollower(PegFollower):
    """Follows the pegs of a block, and logs their moves, which takes the least time when a thousand of them move."""

    __slots__ = ("_log", "block")

    def __init__(self, block: BMLBlock, log: list[tuple[BMLBlock, Change]]) -> None:
        super().__init__()
        self.block = block
        self._log = log

    def notify(self, change: Change) -> None:
        """Note that a peg of the block has moved."""
        self._log.append((self.block, change))


class BlockWatch:
    """Observes the pegs of the blocks that are alive, and those of others that their constraints name."""

    def __init__(self) -> None:
        self._followers: dict[BMLBlock, _BlockFollower] = {}
        self._moves: list[BlockMoves] = []
        self._log: list[tuple[BMLBlock, Change]] = []

    def moves(self) -> BlockMoves:
        """The moves from now on."""
        self._hand_out()
        moves = BlockMoves(self._hand_out)
        self._moves.append(moves)
        return moves

    def _hand_out(self) -> None:
        if not self._log:
            return
        blocks = {block for block, _ in self._log}
        old = {change[0]: change[1] for _, change in reversed(self._log)}  # of several moves, the first one counts
        self._log.clear()
        for moves in self._moves:
            moves.add(blocks, old)

    def follow(self, block: BMLBlock) -> None:
        """Follow the present pegs of a block."""
        if block not in self._followers:
            self._followers[block] = _BlockFollower(block, self._log)
        self._followers[block].follow(block.pegs)

    def forget(self, block: BMLBlock) -> None:
        """Follow a block no more."""
        follower = self._followers.pop(block, None)
        if follower is not None:
            follower.follow(())

    def following(self, pegs: Iterable[TimeCell]) -> list[BMLBlock]:
        """The blocks that have any of some pegs, or whose constraints name one."""
        followers = {each for peg in pegs for each in peg.observers if type(each) is _BlockFollower}
        return in_order(each.block for each in followers)


def in_order(blocks: Iterable[BMLBlock]) -> list[BMLBlock]:
    """Blocks in order of arrival."""
    return sorted(blocks, key=lambda block: block.arrival)
