"""What moves with what: walks along the edges between pegs."""

from collections.abc import Iterable

from reactive_realizer.pegboard.time_peg import LatestPeg, TimeCell


def followers_of(peg: TimeCell) -> set[TimeCell]:
    """The pegs that move with a peg; starts and ends of blocks, and what hangs on those alone, are not among them."""
    followers: set[TimeCell] = set()
    waiting = [peg]
    while waiting:
        for cell in waiting.pop().dependents:
            if cell not in followers and not isinstance(cell, LatestPeg):
                followers.add(cell)
                waiting.append(cell)
    return followers


def hangs_on(peg: TimeCell, other: TimeCell) -> bool:
    """Whether a peg moves with another one."""
    seen = {other}
    waiting = [other]
    while waiting:
        cell = waiting.pop()
        if cell is peg:
            return True
        new = [each for each in cell.dependents if each not in seen and each.rank <= peg.rank]
        seen.update(new)
        waiting += new
    return False


def unknown_sources(pegs: Iterable[TimeCell]) -> list[str]:
    """Names of the unknown points, outside of any formula, that some pegs hang on."""
    seen: dict[TimeCell, None] = dict.fromkeys(pegs)
    waiting = list(seen)
    while waiting:
        for cell in waiting.pop().dependencies:
            if cell not in seen:
                seen[cell] = None
                waiting.append(cell)
    return [cell.name for cell in seen if cell.value is None and not cell.dependencies]
