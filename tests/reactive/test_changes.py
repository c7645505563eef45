"""`changes()` yields the latest value and ends when the cell is disposed of."""

import asyncio
from collections.abc import AsyncIterator
from typing import Any

import pytest

from reactive_realizer.reactive.cell import Source

from .conftest import Trace

NOTHING_MORE = object()


def coming(iterator: AsyncIterator[object]) -> asyncio.Future[object]:
    return asyncio.ensure_future(anext(iterator, NOTHING_MORE))


@pytest.fixture
def top(trace: Trace) -> Source[Any]:
    return trace.source("top", 1)


async def test_changes_gives_each_value_to_a_waiting_reader(trace: Trace, top: Source[Any]) -> None:
    changes = top.changes()
    for value in (2, 3):
        waiting = coming(changes)
        await asyncio.sleep(0)
        assert not waiting.done()
        trace.write(top, value)
        assert await waiting == value


async def test_a_slow_reader_gets_only_the_latest_value(trace: Trace, top: Source[Any]) -> None:
    changes = top.changes()
    for value in (2, 3, 4):
        trace.write(top, value)
    assert await anext(changes) == 4
    waiting = coming(changes)
    await asyncio.sleep(0)
    assert not waiting.done()
    waiting.cancel()


async def test_the_present_value_is_no_change(trace: Trace, top: Source[Any]) -> None:
    trace.write(top, 2)
    changes = top.changes()
    trace.write(top, 3)
    trace.write(top, 2)
    waiting = coming(changes)
    await asyncio.sleep(0)
    assert not waiting.done()
    waiting.cancel()


async def test_changes_ends_when_the_cell_is_disposed_of(trace: Trace, top: Source[Any]) -> None:
    waiting = coming(top.changes())
    await asyncio.sleep(0)
    top.dispose()
    assert await waiting is NOTHING_MORE


async def test_the_last_value_before_the_disposal_is_given(trace: Trace, top: Source[Any]) -> None:
    changes = top.changes()
    trace.write(top, 2)
    top.dispose()
    assert [value async for value in changes] == [2]


async def test_two_readers_get_all_values_each(trace: Trace, top: Source[Any]) -> None:
    waiting = [coming(top.changes()), coming(top.changes())]
    await asyncio.sleep(0)
    trace.write(top, 2)
    assert await asyncio.gather(*waiting) == [2, 2]


async def test_a_failure_is_given_like_a_value_and_nan_once(trace: Trace, top: Source[Any]) -> None:
    changes = trace.derived("quotient", top, formula=lambda value: 1 // value).changes()
    trace.write(top, 0)
    assert (await anext(changes)).cell == "quotient"
    numbers = trace.source("numbers", 0.0)
    changes = numbers.changes()
    trace.write(numbers, float("nan"))
    await anext(changes)
    waiting = coming(changes)
    await asyncio.sleep(0)
    assert not waiting.done()
    waiting.cancel()


async def test_a_reader_that_stops_leaves_no_observer_and_no_task(trace: Trace, top: Source[Any]) -> None:
    changes = top.changes()
    waiting = coming(changes)
    await asyncio.sleep(0)
    waiting.cancel()
    with pytest.raises(asyncio.CancelledError):
        await waiting
    assert top.observers == {}
    leaving = top.changes()
    trace.write(top, 2)
    async for _ in leaving:
        break
    assert top.observers == {}
    assert asyncio.all_tasks() == {asyncio.current_task()}
