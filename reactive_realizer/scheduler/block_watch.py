"""Observes blocks: which of them have moved, and from which times."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from reactive_realizer.pegboard.peg_follower import PegFollower
from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.reactive.graph import Cell, Change
from reactive_realizer.scheduler.bml_block import BMLBlock


class BlockMoves:
    """The blocks of which something has moved since `take`, in order of arrival."""

    def __init__(self) -> None:
        self._blocks: set[BMLBlock] = set()
        self._old: dict[Cell[Any], Any] = {}

    def note(self, block: BMLBlock, change: Change) -> None:
        """Note that a peg of a block has moved."""
        self._blocks.add(block)
        self._old.setdefault(change[0], change[1])

    def take(self) -> tuple[list[BMLBlock], Mapping[Cell[Any], Any]]:
        """The blocks that are alive, and the values that the pegs had before they moved."""
        if not self._blocks:
            return [], {}
        blocks, old = self._blocks, self._old
        self._blocks, self._old = set(), {}
        return in_order(block for block in blocks if not block.state.ended), old


class _BlockFollower(PegFollower):
    """Follows the pegs of a block, and notes their moves."""

    __slots__ = ("_moves", "block")

    def __init__(self, block: BMLBlock, moves: Sequence[BlockMoves]) -> None:
        super().__init__()
        self.block = block
        self._moves = moves

    def notify(self, change: Change) -> None:
        """Note that a peg of the block has moved."""
        for moves in self._moves:
            moves.note(self.block, change)


class BlockWatch:
    """Observes the pegs of the blocks that are alive, and those of others that their constraints name."""

    def __init__(self) -> None:
        self._followers: dict[BMLBlock, _BlockFollower] = {}
        self._moves: list[BlockMoves] = []

    def moves(self) -> BlockMoves:
        """The moves from now on."""
        moves = BlockMoves()
        self._moves.append(moves)
        return moves

    def follow(self, block: BMLBlock) -> None:
        """Follow the present pegs of a block."""
        if block not in self._followers:
            self._followers[block] = _BlockFollower(block, self._moves)
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
