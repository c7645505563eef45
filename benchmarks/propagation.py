"""Measures the propagation of a change: through derived cells, the pegs of a block, and a chain of pegs."""

import gc
from collections.abc import Callable
from statistics import median
from time import perf_counter_ns

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.block_pegs import BMLBlockPeg
from reactive_realizer.pegboard.peg_key import PegKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, OffsetPeg, TimeCell
from reactive_realizer.reactive.cell import Derived, Source
from reactive_realizer.reactive.graph import Cell, Graph

AIMS = {
    "cell_ns.fanout.10": 1500,
    "cell_ns.fanout.1000": 1500,
    "cell_ns.fanout.100000": 3000,
    "cell_ns.chain.10": 1500,
    "cell_ns.chain.1000": 1500,
    "cell_ns.chain.100000": 3000,
    "block_move_1000_ms": 1,
    "offset_chain_us.10": 25,
}

_RUNS = {10: 2000, 1000: 200, 100_000: 9}

Write = Callable[[int], object]


def measure(largest: int = 100_000) -> dict[str, object]:
    """The medians, also those of reactivex if it is installed.

    Args:
        largest: number of cells; larger graphs have no result.
    """
    return {
        "cell_ns": {"fanout": _each(_fanout, largest), "chain": _each(_chain, largest)},
        "reactivex_ns": {"fanout": _each(_reactivex_fanout, largest), "chain": _each(_reactivex_chain, largest)},
        "block_move_1000_ms": round(_ns(_block(1000), 300) / 1e6, 3),
        "offset_chain_us": {str(length): round(_ns(_offset_chain(length), 3000) / 1e3, 2) for length in (1, 10)},
    }


def _ns(write: Write, runs: int) -> float:
    """Median time of a write, ns; each write has another value."""
    times = []
    gc.collect()
    gc.disable()
    try:
        for number in range(1, runs + 1):
            before = perf_counter_ns()
            write(number)
            times.append(perf_counter_ns() - before)
    finally:
        gc.enable()
    return median(times)


def _each(build: Callable[[int], Write | None], largest: int) -> dict[str, float | None]:
    """Time per derived cell, ns, by the number of cells."""
    return {str(size): _per_cell(build, size, runs) if size <= largest else None for size, runs in _RUNS.items()}


def _per_cell(build: Callable[[int], Write | None], size: int, runs: int) -> float | None:
    try:
        write = build(size)
        return None if write is None else round(_ns(write, runs) / size)
    except RecursionError:
        return None


def _one_more(value: int) -> int:
    return value + 1


def _write_to(source: Source[int]) -> Write:
    def write(number: int) -> None:
        with source.graph.transaction("benchmark"):
            source.set(number)

    return write


def _fanout(size: int) -> Write:
    source = Source(Graph(), "source", 0)
    for _ in range(size):
        Derived(source.graph, "cell", (source,), _one_more)
    return _write_to(source)


def _chain(size: int) -> Write:
    source = Source(Graph(), "source", 0)
    cell: Cell[int] = source
    for _ in range(size):
        cell = Derived(source.graph, "cell", (cell,), _one_more)
    return _write_to(source)


def _reactivex_fanout(size: int) -> Write | None:
    try:
        from reactivex import operators
        from reactivex.subject import BehaviorSubject
    except ImportError:
        return None
    subject = BehaviorSubject(0)
    for _ in range(size):
        subject.pipe(operators.map(_one_more)).subscribe(lambda value: None)
    write: Write = subject.on_next
    return write


def _reactivex_chain(size: int) -> Write | None:
    try:
        from reactivex import operators
        from reactivex.subject import BehaviorSubject
    except ImportError:
        return None
    subject = BehaviorSubject(0)
    subject.pipe(*[operators.map(_one_more) for _ in range(size)]).subscribe(lambda value: None)
    write: Write = subject.on_next
    return write


def _block(size: int) -> Write:
    """Moves a predicted point for which a block waits; all pegs of the block are observed, and read after the write."""
    board = PegBoard(Graph())
    hit = board.predicted("partner", "hit")
    start = BMLBlockPeg(board.graph, "b:start", GlobalTime(0.0), (hit,))
    pegs = [OffsetPeg(board.graph, f"b:h{number}:start", start, number / 100) for number in range(size)]
    for number, peg in enumerate(pegs):
        board.add(PegKey("alice", "b", f"h{number}", "start"), peg)
        peg.observe(lambda time: None)

    def write(number: int) -> None:
        with board.graph.transaction("benchmark"):
            hit.set(GlobalTime(float(number)))
        for peg in pegs:
            _ = peg.value

    return write


def _offset_chain(length: int) -> Write:
    """Moves a predicted point at the start of a chain of pegs, and reads the last one."""
    hit = AnticipatorPeg(Graph(), "hit", GlobalTime(0.0))
    peg: TimeCell = hit
    for _ in range(length):
        peg = OffsetPeg(hit.graph, "peg", peg, 0.1)

    def write(number: int) -> float | None:
        with hit.graph.transaction("benchmark"):
            hit.set(GlobalTime(float(number)))
        return peg.value

    return write
