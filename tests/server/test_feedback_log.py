"""The log of feedback writes long messages between ticks, and keeps the order of all of them."""

import asyncio
from itertools import count

import pytest

from reactive_realizer.bml.document import parse
from reactive_realizer.clock.units import BlockTime, GlobalTime
from reactive_realizer.errors import WarningType
from reactive_realizer.feedback.feedback_manager import Report
from reactive_realizer.feedback.messages import BehaviorPrediction, Feedback, PredictionFeedback, WarningFeedback
from reactive_realizer.limits import Limits
from reactive_realizer.server.feedback_log import FeedbackLog, LogEntry
from reactive_realizer.testing.pilot import block

TICK = GlobalTime(1.0)


def report(message: Feedback) -> Report:
    return Report(TICK, message)


def warning(text: str) -> Report:
    return report(WarningFeedback(None, "bml", WarningType.PARSING_FAILURE, text))


def prediction(behaviors: int) -> Report:
    """The prediction of a block of some waits."""
    (parsed,) = parse(block("b", "".join(f'<wait id="w{i}" duration="1"/>' for i in range(behaviors))), Limits())
    assert parsed.block is not None
    times = tuple(BehaviorPrediction(each, {"start": BlockTime(0.0)}) for each in parsed.block.behaviors)
    return report(PredictionFeedback("alice", "b", TICK, TICK, "LURKING", times))


def opened() -> tuple[FeedbackLog, list[str]]:
    """A log, and what it has published: the kinds of messages, and ``tick``."""
    log, told = FeedbackLog("session", 0.0, Limits()), list[str]()

    def take(entry: LogEntry) -> None:
        told.append("prediction" if entry.predicts else "warning")

    log.subscribers.subscribe(take)
    log.ticks.subscribe(lambda _: told.append("tick"))
    return log, told


async def turns_until(told: list[str], number: int) -> int:
    """The turns of the event loop until some messages are published."""
    for turns in range(1000):
        if len(told) >= number:
            return turns
        await asyncio.sleep(0)
    raise AssertionError(told)


async def test_short_feedback_is_published_within_its_tick() -> None:
    log, told = opened()
    for each in (warning("one"), prediction(20), warning("two")):
        log.append(each)
    log.end_tick(TICK)
    assert told == ["warning", "prediction", "warning", "tick"]


@pytest.fixture
async def slow(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every look at the clock takes a millisecond."""
    looks = count()
    monkeypatch.setattr(asyncio.get_running_loop(), "time", lambda: next(looks) / 1000)


@pytest.mark.usefixtures("slow")
async def test_a_long_prediction_is_written_in_turns_after_its_tick_and_all_messages_keep_their_order() -> None:
    log, told = opened()
    for each in (warning("one"), prediction(1000), warning("two")):
        log.append(each)
    log.end_tick(TICK)
    log.append(warning("of the next tick"))
    assert told == ["warning"]
    assert await turns_until(told, 5) > 50
    assert told == ["warning", "prediction", "warning", "tick", "warning"]


async def test_what_waits_is_written_in_one_turn_if_there_is_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(asyncio.get_running_loop(), "time", lambda: 0.0)
    log, told = opened()
    for _ in range(1000):
        log.append(warning("one of many"))
    log.end_tick(TICK)
    assert len(told) < 100
    assert await turns_until(told, 1001) <= 2


@pytest.mark.usefixtures("slow")
async def test_many_messages_of_a_tick_are_written_in_turns() -> None:
    log, told = opened()
    for number in range(1000):
        log.append(warning(str(number)))
    log.end_tick(TICK)
    assert len(told) < 100
    assert 50 < await turns_until(told, 1001) < 500
    assert [entry.seq for entry in log.after(0)] == list(range(1, 1001))


@pytest.mark.usefixtures("slow")
async def test_nothing_is_written_while_the_engines_of_the_next_tick_play() -> None:
    log, told = opened()
    log.append(prediction(1000))
    log.end_tick(TICK)
    log.begin_tick()
    with pytest.raises(AssertionError):
        await turns_until(told, 1)
    log.append(warning("of the next tick"))
    log.end_tick(TICK)
    assert await turns_until(told, 4) > 50
    assert told == ["prediction", "tick", "warning", "tick"]


async def test_a_listener_that_fails_does_not_end_the_feedback() -> None:
    log, told = opened()

    def fail(entry: LogEntry) -> None:
        raise RuntimeError

    log.subscribers.subscribe(fail)
    log.append(prediction(100))
    log.append(warning("after it"))
    log.end_tick(TICK)
    await turns_until(told, 3)
    assert told == ["prediction", "warning", "tick"]
