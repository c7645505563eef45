"""In a replay, results of background work arrive at the same ticks as in the recording, with the same outcome."""

import asyncio
from collections.abc import AsyncIterator

import pytest

from reactive_realizer.binding.faults import NoAsset
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.speech_streams import SpeechStreams
from reactive_realizer.engines.speech.speech_worker import VoiceFailed
from reactive_realizer.errors import RealizerError
from reactive_realizer.limits import Limits
from reactive_realizer.realizer.background_tasks import BackgroundTasks
from reactive_realizer.realizer.inputs import BmlText, Delivery, TickInputs
from reactive_realizer.realizer.session import replay
from reactive_realizer.scheduler.faults import WorkFailed
from reactive_realizer.testing.pilot import block, open_pilot

NOW = GlobalTime(0.5)


@pytest.fixture
async def background() -> AsyncIterator[BackgroundTasks]:
    async with asyncio.TaskGroup() as group:
        background = BackgroundTasks(group, SpeechStreams(Limits()))
        yield background
        background.close()


async def work(result: object) -> object:
    if isinstance(result, Exception):
        raise result
    return result


async def requested(background: BackgroundTasks, *results: object) -> list[object]:
    """Request work and wait until it is done; the results that are delivered."""
    handed: list[object] = []
    for result in results:
        background.request("work", work(result), lambda result, now: handed.append(result))
    await background.settle()
    return handed


async def test_ready_results_are_numbered_in_order_of_request_and_name_failures(background: BackgroundTasks) -> None:
    await requested(background, "one", RealizerError(NoAsset(name="two")), ValueError("three"))
    failures = [None, NoAsset(name="two"), WorkFailed(reason="three")]
    assert background.ready() == tuple(Delivery(number, fault) for number, fault in enumerate(failures, 1))


async def test_only_named_results_are_delivered(background: BackgroundTasks) -> None:
    handed = await requested(background, "one", "two", "three")
    background.deliver([Delivery(2)], NOW)
    assert handed == ["two"]
    background.deliver(background.ready(), NOW)
    assert handed == ["two", "one", "three"]
    assert not background.busy


async def test_work_that_failed_in_the_recording_fails_again_although_it_succeeds_now(
    background: BackgroundTasks,
) -> None:
    handed = await requested(background, "fine")
    background.deliver([Delivery(1, VoiceFailed(reason="it was killed"))], NOW)
    (failure,) = handed
    assert isinstance(failure, RealizerError)
    assert failure.fault.code == "voice-failed"


async def test_a_result_that_was_never_requested_is_an_error_and_nothing_is_delivered(
    background: BackgroundTasks,
) -> None:
    handed = await requested(background, "one")
    with pytest.raises(RealizerError, match=r"at 0\.5 s.* work item 2"):
        background.deliver([Delivery(1), Delivery(2)], NOW)
    assert handed == []


async def test_ticks_that_were_left_out_are_left_out_again() -> None:
    numbers = [0, 3, 4, 57, 130]
    session = [TickInputs(number) for number in numbers]
    session[1] = TickInputs(3, (BmlText(block("b", '<wait id="w" duration="0.3"/>')),))
    async with open_pilot() as pilot:
        again: list[TickInputs] = []
        pilot.realizer.record(again.append)
        await replay(pilot.realizer, session)
        assert again == session
        assert pilot.feedback.time("b:end") == pytest.approx(0.33)
        assert pilot.feedback.messages[-1].time == 0.57
