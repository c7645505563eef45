"""Observes blocks: which of them have moved, and from which times."""

from collections.abc import Collection, Iterable, Mapping
from typing import Any

from reactive_realizer.pegboard.time_peg import TimeCell
from reactive_realizer.pegboard.watch import PegIndex
from reactive_realizer.reactive.graph import Cell, Change, Commit, Graph
from reactive_realizer.scheduler.bml_block import BMLBlock


class BlockMoves:
    """The blocks of which something has moved since `take`, in order of arrival."""

    def __init__(self) -> None:
        self._blocks: set[BMLBlock] = set()
        self._old: dict[Cell[Any], Any] = {}

    def note(self, blocks: Collection[BMLBlock], changes: Iterable[Change]) -> None:
        """Note that pegs of blocks have moved."""
        self._blocks.update(blocks)
        old = self._old
        for cell, before, _ in changes:
            old.setdefault(cell, before)

    def take(self) -> tuple[list[BMLBlock], Mapping[Cell[Any], Any]]:
        """The blocks that are alive, and the values that the pegs had before they moved."""
        if not self._blocks:
            return [], {}
        blocks, old = self._blocks, self._old
        self._blocks, self._old = set(), {}
        return in_order(block for block in blocks if not block.state.ended), old


class BlockWatch:
    """Follows the pegs of the blocks that are alive, and those of others that their constraints name.

    Many pegs move at once, so it listens to commits instead of observing each peg.
    """

    def __init__(self, graph: Graph) -> None:
        self._index: PegIndex[BMLBlock] = PegIndex()
        self._moves: list[BlockMoves] = []
        graph.listen(self._note)

    def moves(self) -> BlockMoves:
        """The moves from now on."""
        moves = BlockMoves()
        self._moves.append(moves)
        return moves

    def follow(self, block: BMLBlock) -> None:
        """Follow the present pegs of a block."""
        self._index.follow(block, block.pegs)

    def forget(self, block: BMLBlock) -> None:
        """Follow a block no more."""
        self._index.forget(block)

    def following(self, pegs: Iterable[TimeCell]) -> list[BMLBlock]:
        """The blocks that have any of some pegs, or whose constraints name one."""
        return in_order(self._index.following(pegs))

    def _note(self, commit: Commit) -> None:
        blocks, changes = self._index.moved(commit.changes)
        if changes:
            for moves in self._moves:
                moves.note(blocks, changes)


def in_order(blocks: Iterable[BMLBlock]) -> list[BMLBlock]:
    """Blocks in order of arrival."""
    return sorted(blocks, key=lambda block: block.arrival)
