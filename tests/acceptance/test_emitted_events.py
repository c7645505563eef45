"""Events that behaviors emit: to planners, and to other behaviors of any block."""

from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.names import BML, OWN
from reactive_realizer.planunit.timing import SHORTEST
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

TWO_CHARACTERS = Path(__file__).resolve().parents[2] / "examples/two_characters.toml"
GESTURE = '<gesture id="g" lexeme="BEAT"/>'
EMIT = '<bmla:emit id="e" event="go" start="{}"/>'
NOD = '<head id="n" lexeme="NOD" start="anticipators:events:go{}"/>'


def event(pilot: RealizerPilot, point: str) -> tuple[str | None, str]:
    """The name and the content of the event that was reported with a sync point."""
    message = next(each for each in pilot.feedback.of("syncPointProgress") if each.id == point)
    element = message.element.find(f"{{{OWN}}}event")
    assert element is not None
    return element.get("name"), "".join(map(str, element.itertext()))


async def test_a_behavior_of_another_block_starts_with_the_event(any_strategy: RealizerPilot) -> None:
    pilot = any_strategy
    pilot.block("b", NOD.format("+0.1"))
    await pilot.advance(0.5)
    pilot.block("a", GESTURE + EMIT.format("g:stroke"))
    await pilot.advance(5)
    stroke = pilot.feedback.time("a:g:stroke")
    assert pilot.feedback.time("a:e:start") == pilot.feedback.time("a:e:end") == stroke
    assert pilot.feedback.time("b:n:start") == pytest.approx(stroke + 0.1, abs=1e-6)
    assert pilot.feedback.status("b") == "DONE"
    assert pilot.feedback.warnings == []


async def test_a_behavior_that_an_event_ends_as_it_starts_ends_just_after(pilot: RealizerPilot) -> None:
    pilot.block("b", '<faceLexeme id="f" lexeme="RAISE_BROWS" end="anticipators:events:go"/>')
    pilot.block("a", EMIT.format("0") + EMIT.format("1").replace('"e"', '"again"'))
    await pilot.advance(0.1)
    assert pilot.feedback.time("b:f:start") == pilot.feedback.time("a:e:start") == 0.0
    assert pilot.feedback.time("b:f:end") == pytest.approx(SHORTEST)


async def test_planners_receive_the_name_and_the_content_as_written(pilot: RealizerPilot) -> None:
    pilot.block("a", '<bmla:emit id="e" event="go">a &lt; <x k="1">b</x> c</bmla:emit>')
    await pilot.advance(0.1)
    assert event(pilot, "a:e:start") == ("go", "a < b c")
    message = next(each for each in pilot.feedback.of("syncPointProgress") if each.id == "a:e:start")
    (child,) = message.element.iter(f"{{{BML}}}x")
    assert child.get("k") == "1"
    assert pilot.feedback.warnings == []


async def test_the_end_of_an_emit_reports_no_event(pilot: RealizerPilot) -> None:
    pilot.block("a", '<bmla:emit id="e" event="go"/>')
    await pilot.advance(0.1)
    events = [each.id for each in pilot.feedback.messages if each.element.find(f"{{{OWN}}}event") is not None]
    assert events == ["a:e:start"]


async def test_an_event_counts_for_blocks_that_arrived_before_it(pilot: RealizerPilot) -> None:
    pilot.block("early", NOD.format(""))
    await pilot.advance(0.5)
    pilot.block("first", EMIT.format("0"))
    await pilot.advance(0.5)
    pilot.block("late", NOD.format("").replace("NOD", "SHAKE"))
    await pilot.advance(1.5)
    pilot.block("second", EMIT.format("0"))
    await pilot.advance(2)
    assert pilot.feedback.time("early:n:start") == 0.5
    assert pilot.feedback.time("late:n:start") == 2.5
    assert pilot.feedback.warnings == []


async def test_an_event_is_predicted_while_one_is_planned_and_moves_with_its_emit(any_strategy: RealizerPilot) -> None:
    pilot = any_strategy
    pilot.block("b", '<gesture id="g" lexeme="BEAT" stroke="anticipators:events:go"/>')
    pilot.predict("t", "hit", 3.0)
    await pilot.advance(0.1)
    pilot.block("a", EMIT.format("anticipators:t:hit"))
    await pilot.advance(0.1)
    assert pilot.feedback.predicted("b:g:stroke") == 3
    pilot.block("early", EMIT.format("2.3"))
    await pilot.advance(0.1)
    assert pilot.feedback.predicted("b:g:stroke") == 2.5
    pilot.block("stop", '<bmla:interrupt id="i" target="early"/>')
    pilot.predict("t", "hit", 2.0)
    await pilot.advance(0.1)
    assert pilot.feedback.predicted("b:g:stroke") == 2
    await pilot.advance(3)
    assert pilot.feedback.time("a:e:start") == pilot.feedback.time("b:g:stroke") == 2
    assert pilot.feedback.time("b:g:start") < pilot.feedback.time("b:g:strokeStart") < 2
    assert pilot.feedback.warnings == []


async def test_an_event_is_unknown_again_if_its_only_emit_is_interrupted(pilot: RealizerPilot) -> None:
    pilot.block("b", NOD.format(""))
    pilot.block("a", EMIT.format("2"))
    pilot.block("stop", '<bmla:interrupt id="i" target="a" start="1.99"/>')
    await pilot.advance(1)
    assert pilot.feedback.predicted("b:n:start") == 2
    await pilot.advance(2)
    assert not pilot.feedback.reached("b:n:start")
    with pytest.raises(LookupError):
        pilot.feedback.predicted("b:n:start")
    assert pilot.feedback.warnings == []


async def test_an_emit_that_waits_for_its_own_event_predicts_nothing(pilot: RealizerPilot) -> None:
    pilot.block("a", NOD.format("") + EMIT.format("n:start"))
    pilot.block("b", NOD.format("").replace("NOD", "SHAKE"))
    pilot.block("c", EMIT.format("0"), composition="APPEND")
    await pilot.advance(5)
    assert len(pilot.feedback.predictions("c")) <= 3
    assert not pilot.feedback.reached("c:start")
    pilot.block("d", EMIT.format("0"))
    await pilot.advance(3)
    assert pilot.feedback.time("b:n:start") == pilot.feedback.time("a:e:start") == 5
    assert pilot.feedback.status("c") == "DONE"


async def test_an_event_that_is_interrupted_before_it_is_emitted_does_not_happen(pilot: RealizerPilot) -> None:
    pilot.block("b", NOD.format(""))
    pilot.block("a", GESTURE + EMIT.format("g:stroke"))
    await pilot.advance(0.3)
    pilot.block("stop", '<bmla:interrupt id="i" target="a"/>')
    await pilot.advance(3)
    assert not pilot.feedback.reached("b:n:start")
    pilot.block("again", EMIT.format("0"))
    await pilot.advance(0.1)
    assert pilot.feedback.time("b:n:start") == 3.3
    assert pilot.feedback.warnings == []


async def test_a_chain_of_events_takes_one_tick(pilot: RealizerPilot) -> None:
    for number in range(20):
        reference = f"anticipators:events:e{number}"
        pilot.block(f"b{number}", f'<bmla:emit id="e" event="e{number + 1}" start="{reference}"/>')
    await pilot.advance(1)
    pilot.block("a", '<bmla:emit id="e" event="e0"/>')
    await pilot.tick()
    assert pilot.feedback.time("b19:e:start") == 1.0
    assert pilot.feedback.status("b19") == "DONE"


async def test_events_reach_behaviors_of_another_character() -> None:
    async with open_pilot(SceneOptions(TWO_CHARACTERS, "text", verify=True)) as pilot:
        alice, other = pilot.realizer.characters
        assert alice != other
        pilot.block("b", NOD.format(""), characterId=other)
        pilot.block("a", EMIT.format("1"))
        await pilot.advance(1.1)
        assert pilot.feedback.time("b:n:start") == 1.0


async def test_a_client_emits_an_event_with_a_message(pilot: RealizerPilot) -> None:
    pilot.block("b", NOD.format("+0.1"))
    await pilot.advance(0.5)
    pilot.event("events", "go")
    await pilot.advance(0.5)
    pilot.block("late", NOD.format("").replace("NOD", "SHAKE"))
    await pilot.advance(1)
    assert pilot.feedback.time("b:n:start") == 0.6
    assert not pilot.feedback.reached("late:n:start")
    pilot.block("a", EMIT.format("0"))
    await pilot.advance(1)
    assert pilot.feedback.time("late:n:start") == 2
    pilot.event("events", "go")
    await pilot.advance(1)
    assert pilot.feedback.warnings == []


@pytest.mark.parametrize(
    ("emit", "code"),
    [
        ('<bmla:emit id="e"/>', "requires the attribute 'event'"),
        ('<bmla:emit id="e" event=""/>', "not the name of an event"),
        ('<bmla:emit id="e" event="a b"/>', "not the name of an event"),
        ('<bmla:emit id="e" event="a:b"/>', "not the name of an event"),
        ('<bmla:emit id="e" event="a-1"/>', "not the name of an event"),
        (f'<bmla:emit id="e" event="{"a" * 201}"/>', "not the name of an event"),
        (f'<bmla:emit id="e" event="a">{"a" * 5_001}</bmla:emit>', "more than 5000 characters"),
    ],
)
async def test_an_emit_that_cannot_be_read_is_dropped_with_a_warning(
    pilot: RealizerPilot, emit: str, code: str
) -> None:
    pilot.block("a", emit)
    await pilot.advance(0.1)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert (warning.id, warning.element.get("type")) == ("a:e", "PARSING_FAILURE")
    assert code in warning.text
