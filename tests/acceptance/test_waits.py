"""Waits for an event, or for a time from outside, and not longer than their limit."""

from collections.abc import AsyncIterator

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.names import OWN
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

SPEECH = '<speech id="s"><text>one two three</text></speech>'
WAIT = '<wait id="w" event="go" {}/>'
AFTER = '<head id="n" lexeme="NOD" start="w:end+0.1"/>'


@pytest.fixture(params=["convex", "embr", "smartbody"])
async def pilot(request: pytest.FixtureRequest) -> AsyncIterator[RealizerPilot]:
    async with open_pilot(SceneOptions(voice="text", strategy=request.param, verify=True)) as pilot:
        yield pilot


def ended(pilot: RealizerPilot, wait: str = "b:w") -> str | None:
    """What ended a wait."""
    message = next(each for each in pilot.feedback.of("syncPointProgress") if each.id == f"{wait}:end")
    return message.element.get(f"{{{OWN}}}ended")


async def emit(pilot: RealizerPilot, id_: str = "a", event: str = "go") -> None:
    pilot.block(id_, f'<bmla:emit id="e" event="{event}"/>')
    await pilot.tick()


async def test_a_wait_ends_with_its_event_and_behaviors_follow(pilot: RealizerPilot) -> None:
    pilot.block("b", SPEECH + WAIT.format('start="s:end" max-wait="2"') + AFTER)
    await pilot.advance(1.5)
    await emit(pilot)
    await pilot.advance(3)
    assert pilot.feedback.time("b:w:start") == pilot.feedback.time("b:s:end") < 1.5
    assert pilot.feedback.time("b:w:end") == 1.5
    assert pilot.feedback.time("b:n:start") == pytest.approx(1.6)
    assert ended(pilot) == "event"
    assert pilot.feedback.status("b") == "DONE"
    assert pilot.feedback.warnings == []


async def test_a_wait_ends_at_its_limit_without_its_event(pilot: RealizerPilot) -> None:
    pilot.block("b", SPEECH + WAIT.format('start="s:end" max-wait="2"') + AFTER)
    await pilot.tick()
    end = pilot.feedback.predicted("b:s:end") + 2
    assert pilot.feedback.predicted("b:w:end") == pytest.approx(end)
    assert pilot.feedback.predicted("b:n:start") == pytest.approx(end + 0.1)
    await pilot.advance(5)
    assert pilot.feedback.time("b:w:end") == pytest.approx(end)
    assert pilot.feedback.time("b:n:start") == pytest.approx(end + 0.1)
    assert ended(pilot) == "max-wait"
    await emit(pilot)
    assert pilot.feedback.warnings == []


async def test_an_event_that_came_before_the_wait_starts_but_after_its_block_arrived_ends_it_at_once(
    pilot: RealizerPilot,
) -> None:
    pilot.block("b", SPEECH + WAIT.format('start="s:end+1" max-wait="5"') + AFTER)
    await pilot.advance(0.2)
    await emit(pilot)
    await pilot.advance(4)
    assert pilot.feedback.time("b:w:end") == pilot.feedback.time("b:w:start") > 1
    assert ended(pilot) == "event"
    assert pilot.feedback.status("b") == "DONE"
    assert pilot.feedback.warnings == []


async def test_an_event_before_the_block_arrived_does_not_count(pilot: RealizerPilot) -> None:
    await emit(pilot)
    pilot.block("b", WAIT.format(""))
    await pilot.advance(1)
    assert not pilot.feedback.reached("b:w:end")
    await emit(pilot)
    assert pilot.feedback.time("b:w:end") == pytest.approx(1.01)


async def test_a_wait_without_a_limit_waits_for_its_event(pilot: RealizerPilot) -> None:
    pilot.block("b", WAIT.format("") + AFTER)
    pilot.block("c", SPEECH, composition="APPEND")
    await pilot.advance(20)
    assert pilot.feedback.progress == ["b:start", "b:w:start"]
    assert pilot.realizer.scheduler.stuck(pilot.now)
    pilot.realizer.scheduler.warn_stuck()
    pilot.realizer.feedback.flush(pilot.now)
    first, second = (each.text for each in pilot.feedback.of("warningFeedback"))
    assert "it is still waiting for anticipators:events:go" in first
    assert "it is still waiting for b:end" in second


async def test_max_wait_limits_a_wait_for_a_prediction(pilot: RealizerPilot) -> None:
    pilot.block("b", '<wait id="w" end="anticipators:user:stop+0.5" max-wait="3"/>' + AFTER)
    await pilot.advance(1)
    assert pilot.feedback.predicted("b:w:end") == 3
    pilot.predict("user", "stop", 2.0)
    await pilot.advance(0.1)
    assert pilot.feedback.predicted("b:w:end") == 2.5
    pilot.predict("user", "stop", 9.0)
    await pilot.advance(0.1)
    assert pilot.feedback.predicted("b:w:end") == 3
    await pilot.advance(3)
    assert pilot.feedback.time("b:w:end") == 3
    assert ended(pilot) == "max-wait"
    pilot.predict("user", "stop", 5.0)
    pilot.block("c", '<wait id="w" start="0.2" end="anticipators:user:stop" max-wait="3"/>')
    await pilot.advance(2)
    assert pilot.feedback.time("c:w:end") == 5
    assert ended(pilot, "c:w") == "end"
    assert pilot.feedback.warnings == []


async def test_max_wait_limits_a_wait_for_a_point_of_another_block(pilot: RealizerPilot) -> None:
    pilot.block("a", '<head id="n" lexeme="NOD" start="1"/>', **{"bmla:preplan": "true"})
    pilot.block("b", '<wait id="w" end="a:n:start" max-wait="2"/>' + AFTER)
    await pilot.advance(0.5)
    assert pilot.feedback.predicted("b:w:end") == 2
    pilot.block("go", '<bmla:activate id="x" target="a"/>')
    await pilot.advance(3)
    assert pilot.feedback.time("b:w:end") == pilot.feedback.time("a:n:start") == 1.5
    assert ended(pilot) == "end"


async def test_behaviors_at_the_end_of_an_interrupted_wait_follow_at_once(pilot: RealizerPilot) -> None:
    pilot.block("b", WAIT.format('max-wait="9"') + AFTER)
    pilot.block("c", '<bmla:interrupt id="i" target="b" include="w" start="1"/>')
    await pilot.advance(3)
    assert pilot.feedback.time("b:w:end") == 1
    assert pilot.feedback.time("b:n:start") == pytest.approx(1.1)
    assert ended(pilot) is None
    assert pilot.feedback.warnings == []


async def test_a_wait_whose_start_depends_on_its_end_is_dropped_with_what_depends_on_it(pilot: RealizerPilot) -> None:
    nod = '<head id="n" lexeme="NOD" start="w:end"/>'
    pilot.block("b", '<wait id="w" event="go" start="t:end"/><wait id="t" duration="1" start="n:end"/>' + nod + SPEECH)
    await pilot.advance(2)
    assert sorted(pilot.feedback.warnings) == [(f"b:{each}", "IMPOSSIBLE_TO_SCHEDULE") for each in ("n", "t", "w")]
    assert "its start depends on its own end" in pilot.feedback.of("warningFeedback")[0].text
    assert pilot.feedback.reached("b:s:end")
    assert pilot.feedback.status("b") == "DONE"


@pytest.mark.parametrize("kind", ["synchronize", "after"])
async def test_a_block_cannot_start_with_the_end_of_its_own_wait(pilot: RealizerPilot, kind: str) -> None:
    tie = {
        "synchronize": '<synchronize><sync ref="0.3"/><sync ref="w:end"/></synchronize>',
        "after": '<after ref="w:end"><sync ref="0.3"/></after>',
    }
    pilot.block("b", f'<wait id="w" event="done" max-wait="0.8"/><constraint>{tie[kind]}</constraint>')
    await pilot.advance(1)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert warning.text.endswith("w:end depends on the block 'b' itself")
    assert pilot.feedback.time("b:start") == 0
    assert pilot.feedback.time("b:end") == 0.8


async def test_two_waits_in_a_row_each_take_an_event_of_their_own(pilot: RealizerPilot) -> None:
    second = '<wait id="v" event="on" start="w:end" max-wait="1"/><head id="n" lexeme="NOD" start="v:end"/>'
    pilot.block("b", WAIT.format('max-wait="1"') + second)
    await pilot.tick()
    assert pilot.feedback.predicted("b:n:start") == 2
    await pilot.advance(0.49)
    await emit(pilot)
    assert pilot.feedback.predicted("b:n:start") == 1.5
    await pilot.advance(0.29)
    await emit(pilot, "c", "on")
    await pilot.advance(2)
    assert pilot.feedback.time("b:n:start") == pytest.approx(0.8)
    assert pilot.feedback.warnings == []


async def test_an_event_counts_for_a_preplanned_block_from_its_activation(pilot: RealizerPilot) -> None:
    pilot.block("b", WAIT.format("") + AFTER, **{"bmla:preplan": "true"})
    await pilot.advance(0.5)
    await emit(pilot)
    await pilot.advance(0.49)
    pilot.block("x", '<bmla:activate id="x" target="b"/>')
    await pilot.advance(1)
    assert pilot.feedback.time("b:w:start") == 1
    assert not pilot.feedback.reached("b:w:end")
    await emit(pilot, "c")
    await pilot.advance(2)
    assert pilot.feedback.time("b:w:end") == 2
    assert pilot.feedback.time("b:n:start") == pytest.approx(2.1)
    assert ended(pilot) == "event"
    assert pilot.feedback.warnings == []


async def test_an_event_that_comes_while_a_block_waits_for_others_is_kept(pilot: RealizerPilot) -> None:
    pilot.block("a", '<wait id="w" duration="2"/>')
    pilot.block("b", WAIT.format("") + AFTER, composition="APPEND")
    await pilot.advance(1)
    await emit(pilot, "c")
    await pilot.advance(3)
    assert pilot.feedback.time("b:w:end") == pilot.feedback.time("b:start") == 2
    assert pilot.feedback.time("b:n:start") == pytest.approx(2.1)
    assert pilot.feedback.warnings == []


@pytest.mark.parametrize(
    ("wait", "reason"),
    [
        ('<wait id="w" event="go" end="3"/>', "it cannot have 'end' too"),
        ('<wait id="w" event="go" duration="3"/>', "it cannot have 'duration' too"),
        ('<wait id="w" event="a b"/>', "not the name of an event"),
        ('<wait id="w" event="go" max-wait="-1"/>', "not between 0 and 86400"),
    ],
)
async def test_a_wait_that_cannot_be_read_is_dropped_with_a_warning(
    pilot: RealizerPilot, wait: str, reason: str
) -> None:
    pilot.block("b", wait)
    await pilot.tick()
    (warning,) = pilot.feedback.of("warningFeedback")
    assert (warning.id, warning.element.get("type")) == ("b:w", "PARSING_FAILURE")
    assert reason in warning.text


async def test_an_event_has_no_effect_on_a_wait_with_a_duration(pilot: RealizerPilot) -> None:
    pilot.block("b", '<wait id="w" duration="2" max-wait="1"/>')
    await emit(pilot)
    await pilot.advance(3)
    assert pilot.feedback.time("b:w:end") == 2
    assert ended(pilot) is None


@pytest.mark.parametrize("times", ['start="1" end="4"', 'start="s:end" end="s:end+3"'])
async def test_a_wait_whose_ties_exceed_its_limit_says_so_once(pilot: RealizerPilot, times: str) -> None:
    pilot.block("b", SPEECH + f'<wait id="w" max-wait="2" {times}/>')
    await pilot.advance(6)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert warning.text.endswith("w from start to end is to last at most 2.00 s, lasts 3.00 s")
    assert pilot.feedback.status("b") == "DONE"
