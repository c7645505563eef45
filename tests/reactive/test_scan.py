"""A cell that is computed from its own last value and from others."""

from typing import Any

from reactive_realizer.reactive.cell import Scan
from reactive_realizer.reactive.errors import Failure

from .conftest import Trace


def total(trace: Trace, *cells: Any) -> Scan[int]:
    """The sum of all products of the values that the cells have had."""

    def formula(last: int, *values: int) -> int:
        product = 1
        for value in values:
            product *= value
        return last + product

    return Scan(trace.graph, "total", 0, cells, formula)


def test_a_scan_accumulates_the_values_of_each_commit(trace: Trace) -> None:
    one, two = trace.source("one", 2), trace.source("two", 3)
    cell = total(trace, one, two)
    below = trace.derived("below", cell, formula=lambda value: 10 * value)
    assert (cell.value, below.value) == (6, 60)
    trace.write(one, 5)
    assert (cell.value, below.value) == (21, 210)
    trace.write(one, 5)
    assert cell.value == 21


def test_a_scan_that_failed_continues_from_its_last_value(trace: Trace) -> None:
    one: Any = trace.source("one", 2)
    below = trace.derived("below", one, formula=lambda value: 12 // value)
    cell = total(trace, below)
    trace.write(one, 0)
    assert isinstance(cell.result, Failure)
    trace.write(one, 3)
    assert cell.value == 10
    trace.write(one, "text")
    trace.write(one, 12)
    assert cell.value == 11
