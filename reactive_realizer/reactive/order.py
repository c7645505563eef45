"""What must come before what: ranks, and the refusal of cycles."""

from collections.abc import Collection, Iterable
from typing import TYPE_CHECKING, Any

from reactive_realizer.reactive.errors import PropagationCycleError

if TYPE_CHECKING:
    from reactive_realizer.reactive.cell import Cell, Derived


def raise_rank(cell: "Derived[Any]", rank: int) -> None:
    """Have a cell, and all that depends on it, come after what has a lower rank.

    Ranks only grow: a rank higher than needed costs nothing, lowering one would cost a walk.
    """
    waiting = [(cell, rank)]
    while waiting:
        cell, rank = waiting.pop()
        if rank > cell.rank:
            cell.graph.rerank(cell, rank)
            waiting.extend((dependent, rank + 1) for dependent in cell.dependents)


def refuse_cycle(cells: Collection["Cell[Any]"], dependencies: Iterable["Cell[Any]"]) -> None:
    """Refuse to let some cells depend on others that depend on one of them.

    Raises:
        PropagationCycleError: with the path from the cell back to itself.
    """
    lowest = min((cell.rank for cell in cells), default=0)
    below: dict[Cell[Any], Cell[Any] | None] = dict.fromkeys(dependencies)
    waiting = list(below)
    while waiting:
        cell = waiting.pop()
        if cell in cells:
            raise PropagationCycleError(_path(cell, below))
        # What is ranked no higher than all of them depends on none of them.
        for source in cell.dependencies if cell.rank > lowest else ():
            if source not in below:
                below[source] = cell
                waiting.append(source)


def _path(cell: "Cell[Any]", below: dict["Cell[Any]", "Cell[Any] | None"]) -> tuple[str, ...]:
    names = [cell.name]
    step = below[cell]
    while step is not None:
        names.append(step.name)
        step = below[step]
    return (*names, cell.name)
