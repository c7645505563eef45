"""Which blocks a change of times is about."""

from collections.abc import Collection
from typing import Any

from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.reactive.cell import Cell
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BMLBlock


def concerned(blocks: Blocks, board: PegBoard, moved: Collection[Cell[Any]]) -> list[BMLBlock]:
    """The blocks alive that have a peg that moved, or name one of another block or an anticipator in a constraint."""
    if not moved:
        return []
    owners = {board.owner(cell) for cell in moved}
    return [block for block in blocks.alive if block.key in owners or not block.outside.isdisjoint(moved)]
