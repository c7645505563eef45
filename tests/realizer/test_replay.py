"""Slow work comes at the ticks at which it came the first time, and with what came of it then."""

import asyncio
from collections.abc import AsyncIterator

import pytest

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.errors import Fault, RealizerError, error
from reactive_realizer.realizer.entered import Delivery, Entered
from reactive_realizer.realizer.inputs import BmlText
from reactive_realizer.realizer.replay import replay
from reactive_realizer.realizer.workshop import TaskWorkshop
from reactive_realizer.testing.pilot import block, open_pilot

NOW = GlobalTime(0.5)


@pytest.fixture
async def workshop() -> AsyncIterator[TaskWorkshop]:
    async with asyncio.TaskGroup() as group:
        workshop = TaskWorkshop(group)
        yield workshop
        workshop.close()


async def work(result: object) -> object:
    if isinstance(result, Exception):
        raise result
    return result


async def requested(workshop: TaskWorkshop, *results: object) -> list[object]:
    """Work that is done, and what is handed over of it."""
    handed: list[object] = []
    for result in results:
        workshop.request("work", work(result), lambda result, now: handed.append(result))
    await workshop.settle()
    return handed


async def test_what_is_ready_is_numbered_in_order_of_request_and_says_what_failed(workshop) -> None:
    await requested(workshop, "one", error("no-asset", name="two"), ValueError("three"))
    failures = [None, Fault("no-asset", {"name": "two"}), Fault("work-failed", {"reason": "three"})]
    assert workshop.ready() == tuple(Delivery(number, fault) for number, fault in enumerate(failures, 1))


async def test_only_what_is_named_is_handed_over(workshop) -> None:
    handed = await requested(workshop, "one", "two", "three")
    workshop.deliver([Delivery(2)], NOW)
    assert handed == ["two"]
    workshop.deliver(workshop.ready(), NOW)
    assert handed == ["two", "one", "three"]
    assert not workshop.busy


async def test_work_that_failed_then_fails_again_although_it_succeeds_now(workshop) -> None:
    handed = await requested(workshop, "fine")
    workshop.deliver([Delivery(1, Fault("voice-failed", {"reason": "it was killed"}))], NOW)
    (failure,) = handed
    assert isinstance(failure, RealizerError)
    assert failure.fault.code == "voice-failed"


async def test_work_that_was_never_asked_for_is_an_error_and_nothing_is_handed_over(workshop) -> None:
    handed = await requested(workshop, "one")
    with pytest.raises(RealizerError, match=r"at 0\.5 s .* work 2"):
        workshop.deliver([Delivery(1), Delivery(2)], NOW)
    assert handed == []


async def test_ticks_that_were_left_out_are_left_out_again() -> None:
    numbers = [0, 3, 4, 57, 130]
    session = [Entered(number) for number in numbers]
    session[1] = Entered(3, (BmlText(block("b", '<wait id="w" duration="0.3"/>')),))
    async with open_pilot() as pilot:
        again: list[Entered] = []
        pilot.realizer.record(again.append)
        await replay(pilot.realizer, session)
        assert again == session
        assert pilot.feedback.time("b:end") == pytest.approx(0.33)
        assert pilot.feedback.lines[-1].time == 0.57
