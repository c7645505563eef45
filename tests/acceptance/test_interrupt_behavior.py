"""The behaviors `interrupt` and `activate` (thesis 6.6.1, 6.6.3, 6.6.4; BMLA)."""

from typing import Any

import pytest

from reactive_realizer.clock.ticker import Tick, tick_time
from reactive_realizer.testing.pilot import RealizerPilot

NAMESPACES = 'xmlns:bmla="http://www.asap-project.org/bmla" xmlns:bmlt="http://hmi.ewi.utwente.nl/bmlt"'
TALK = '<speech id="s"><text>one two three <sync id="m"/>four five six</text></speech>'
BEAT = '<gesture id="g" lexeme="BEAT" start="0.2"/>'
OWN = "{urn:reactive-realizer:1}"


def send(pilot: RealizerPilot, id_: str, inside: str = "", attributes: str = "") -> None:
    head = f'xmlns="http://www.bml-initiative.org/bml/bml-1.0" {NAMESPACES}'
    pilot.perform(f'<bml {head} id="{id_}" {attributes}>{inside}</bml>')


def line(pilot: RealizerPilot, point: str) -> Any:
    return next(line for line in pilot.feedback.messages if line.id == point)


@pytest.mark.parametrize("prefix", ["bmla", "bmlt"])
async def test_a_block_is_interrupted_at_the_start_of_the_interrupt(pilot: RealizerPilot, prefix: str) -> None:
    send(pilot, "talk", TALK + BEAT)
    send(pilot, "stop", f'<{prefix}:interrupt id="i" target="talk" start="0.505"/>')
    await pilot.advance(3)
    assert pilot.feedback.time("talk:end") == pilot.feedback.time("talk:s:end") == pytest.approx(0.505)
    assert pilot.feedback.time("talk:g:relax") == pilot.feedback.time("talk:g:end") == pytest.approx(0.505)
    assert not pilot.feedback.reached("talk:s:m")
    assert pilot.feedback.status("talk") == "INTERRUPTED"
    assert pilot.feedback.status("stop") == "DONE"


async def test_a_behavior_that_comes_after_a_cut_point_keeps_its_time(pilot: RealizerPilot) -> None:
    after = '<constraint><after ref="q:end"><sync ref="p:start"/></after></constraint>'
    send(pilot, "b", '<gesture id="p" lexeme="OFFER"/><pointing id="q" target="bluebox"/>' + after)
    await pilot.advance(1)
    planned = pilot.feedback.predicted("b:p:start")
    send(pilot, "stop", '<bmla:interrupt id="i" target="b" start="0.5" exclude="p" speech="word"/>')
    await pilot.advance(4)
    assert pilot.feedback.time("b:q:end") == pytest.approx(1.5)
    assert pilot.feedback.time("b:p:start") == planned
    assert pilot.feedback.warnings == []


async def test_excluded_behaviors_continue_and_their_block_ends_as_done(pilot: RealizerPilot) -> None:
    send(pilot, "talk", TALK + BEAT)
    send(pilot, "stop", '<bmla:interrupt id="i" target="talk" start="0.5" exclude="g"/>')
    await pilot.advance(4)
    assert pilot.feedback.time("talk:s:end") == 0.5
    assert pilot.feedback.time("talk:g:end") > 1
    assert pilot.feedback.time("talk:end") == pilot.feedback.time("talk:g:end")
    assert pilot.feedback.status("talk") == "DONE"


async def test_only_included_behaviors_are_interrupted(pilot: RealizerPilot) -> None:
    send(pilot, "talk", TALK + BEAT)
    send(pilot, "stop", '<bmla:interrupt id="i" target="talk" start="0.5" include="g"/>')
    await pilot.advance(4)
    assert pilot.feedback.time("talk:g:end") == 0.5
    assert pilot.feedback.reached("talk:s:m")


async def test_a_speech_can_be_interrupted_at_its_own_mark_which_is_reported(pilot: RealizerPilot) -> None:
    send(pilot, "talk", TALK)
    send(pilot, "stop", '<bmla:interrupt id="i" target="talk" start="talk:s:m"/>')
    await pilot.advance(3)
    assert pilot.feedback.time("talk:s:end") == pilot.feedback.time("talk:s:m") == pilot.feedback.time("stop:i:start")
    assert line(pilot, "talk:s:end").element.get(f"{OWN}text") == "three"


async def test_an_interrupted_speech_may_finish_its_word(pilot: RealizerPilot) -> None:
    send(pilot, "talk", TALK)
    send(pilot, "stop", '<bmla:interrupt id="i" target="talk" start="0.5" speech="word"/>')
    await pilot.advance(3)
    end = pilot.feedback.time("talk:s:end")
    assert 0.5 < end < pilot.feedback.time("talk:s:start") + 1.5
    told = line(pilot, "talk:s:end").element
    assert (told.get(f"{OWN}text"), told.get(f"{OWN}heard")) == ("three", str(len("one two three")))
    assert pilot.feedback.status("talk") == "INTERRUPTED"
    assert pilot.feedback.predicted("talk:s:end") == pytest.approx(end)


async def test_other_behaviors_end_at_once_while_a_speech_finishes_its_word(pilot: RealizerPilot) -> None:
    send(pilot, "talk", TALK + BEAT)
    send(pilot, "stop", '<bmla:interrupt id="i" target="talk" start="0.5" speech="word"/>')
    await pilot.advance(3)
    assert (
        pilot.feedback.time("talk:g:end") == 0.5 < pilot.feedback.time("talk:s:end") == pilot.feedback.time("talk:end")
    )


async def test_points_that_a_speech_will_not_reach_are_not_predicted_while_it_finishes_its_clause(
    pilot: RealizerPilot,
) -> None:
    text = 'one two, three <sync id="m"/>four, five <sync id="n"/>six'
    send(pilot, "talk", f'<speech id="s"><text>{text}</text></speech><head id="nod" lexeme="NOD" end="s:end"/>')
    send(pilot, "stop", '<bmla:interrupt id="i" target="talk" include="s" start="1" speech="clause"/>')
    await pilot.advance(1.1)
    (speech,) = (each for each in pilot.feedback.predictions("talk")[-1].element if each.get("id") == "talk:s")
    assert [each.get("id") for each in speech.iter("{*}sync") if each.get(f"{OWN}time")] == ["m"]
    await pilot.advance(2)
    assert pilot.feedback.time("talk:s:m") < pilot.feedback.time("talk:s:end") < 2
    (warning,) = pilot.feedback.of("warningFeedback")
    assert warning.text.endswith("talk:s:end was interrupted; this behavior keeps the last predicted time")


async def test_a_behavior_tied_to_an_interrupted_point_keeps_its_time_with_a_warning(pilot: RealizerPilot) -> None:
    send(pilot, "talk", TALK + '<head id="n" lexeme="NOD" start="s:m"/>')
    await pilot.tick()
    expected = pilot.feedback.predicted("talk:n:start")
    send(pilot, "stop", '<bmla:interrupt id="i" target="talk" include="s"/>')
    await pilot.advance(3)
    assert pilot.feedback.time("talk:n:start") == pytest.approx(expected)
    assert pilot.feedback.warnings == [("talk:n", "IMPOSSIBLE_TO_SCHEDULE")]


async def test_a_waiting_block_can_be_revoked_as_a_whole_or_in_part(pilot: RealizerPilot) -> None:
    send(pilot, "first", '<wait id="w" duration="1"/>')
    send(pilot, "part", TALK + BEAT, 'composition="APPEND"')
    send(pilot, "whole", TALK, 'bmla:preplan="true"')
    send(
        pilot,
        "stop",
        '<bmla:interrupt id="i" target="part" include="s"/><bmla:interrupt id="j" target="whole"/>',
    )
    await pilot.advance(5)
    assert pilot.feedback.status("whole") == "REVOKED"
    assert pilot.feedback.status("part") == "DONE"
    assert pilot.feedback.reached("part:g:start")
    assert not pilot.feedback.reached("part:s:start")


async def test_an_interrupt_of_its_own_block_does_not_interrupt_itself(pilot: RealizerPilot) -> None:
    send(pilot, "own", TALK + '<bmla:interrupt id="i" target="own" start="0.5"/>')
    await pilot.advance(3)
    assert pilot.feedback.time("own:s:end") == pilot.feedback.time("own:i:end") == 0.5
    assert pilot.feedback.warnings == []


@pytest.mark.parametrize("prefix", ["bmla", "bmlt"])
async def test_an_activated_block_starts_exactly_at_the_time_of_the_activate(pilot: RealizerPilot, prefix: str) -> None:
    send(pilot, "ready", TALK, 'bmla:preplan="true"')
    await pilot.tick()
    send(pilot, "go", f'<head id="n" lexeme="NOD"/><{prefix}:activate id="a" target="ready" start="n:stroke"/>')
    await pilot.advance(4)
    assert pilot.feedback.time("ready:start") == pilot.feedback.time("go:n:stroke")
    assert pilot.feedback.messages[-1].id == "ready:end"


async def test_a_speech_is_interrupted_with_a_prepared_continuation_in_the_same_tick(pilot: RealizerPilot) -> None:
    """Thesis example 16."""
    send(pilot, "talk", TALK + BEAT)
    send(pilot, "trail", '<speech id="s"><text>anyway</text></speech>', 'bmla:preplan="true"')
    send(
        pilot,
        "stop",
        '<bmla:interrupt id="i" target="talk" start="talk:s:m" exclude="g"/>'
        '<bmla:activate id="a" target="trail" start="talk:s:m"/>',
    )
    await pilot.advance(4)
    assert pilot.feedback.time("trail:s:start") == pilot.feedback.time("talk:s:end") == pilot.feedback.time("talk:s:m")
    assert pilot.feedback.status("talk") == "DONE"
    assert pilot.feedback.warnings == []


async def test_the_rest_of_a_block_is_interrupted_before_its_speech_which_continues_in_another_block(
    pilot: RealizerPilot,
) -> None:
    send(pilot, "talk", TALK + '<head id="n" lexeme="NOD" start="s:m" end="s:m+1"/>')
    send(pilot, "trail", '<speech id="s"><text>never mind</text></speech>', 'bmla:preplan="true"')
    await pilot.advance(0.2)
    send(
        pilot,
        "stop",
        '<bmla:interrupt id="i" target="talk" exclude="s"/>'
        '<bmla:interrupt id="j" target="talk" include="s" start="talk:s:m"/>'
        '<bmla:activate id="a" target="trail" start="talk:s:m"/>',
    )
    await pilot.advance(4)
    told = pilot.feedback
    assert not told.reached("talk:n:start")
    assert told.time("trail:s:start") == told.time("talk:s:end") == told.time("talk:s:m") == told.time("talk:end")
    assert told.status("trail") == "DONE"
    assert told.warnings == []


async def test_a_late_tick_interrupts_at_the_exact_time(pilot: RealizerPilot) -> None:
    send(pilot, "talk", TALK)
    send(pilot, "stop", '<bmla:interrupt id="i" target="talk" start="0.5"/>')
    await pilot.tick()
    await pilot.realizer.step(Tick(200, tick_time(0), frame=False))
    assert pilot.feedback.time("talk:s:end") == 0.5
    assert not pilot.feedback.reached("talk:s:m")


async def test_what_hangs_on_an_end_that_is_cut_with_it_does_not_come_in_the_past(pilot: RealizerPilot) -> None:
    """The nod relaxes 0.3 s before the end of the wait; both are interrupted before that."""
    nod = '<head id="n" lexeme="NOD" start="w:end-1"/><wait id="w" max-wait="2" end="anticipators:t:hit" start="0"/>'
    pilot.predict("t", "hit", 4.0)
    pilot.block("b", '<gaze id="z" target="bluebox" start="0" end="3"/>' + nod)
    await pilot.advance(1.4)
    stop = '<bmla:interrupt id="i" target="b" exclude="z" speech="word"/>'
    pilot.block("stop", stop)
    await pilot.advance(2)
    times = [pilot.feedback.time(f"b:{point}") for point in ("n:stroke", "n:end", "w:end")]
    assert times == sorted(times)
    assert pilot.feedback.time("b:n:end") == pilot.feedback.time("stop:i:start")
    reported = {message.id: message.time for message in pilot.feedback.of("syncPointProgress")}
    assert all(pilot.feedback.time(name) >= time - 0.02 for name, time in reported.items())


async def test_a_block_that_starts_later_in_the_tick_of_its_interruption_ends_when_it_starts(
    pilot: RealizerPilot,
) -> None:
    stop = '<bmla:interrupt id="i" target="late" start="w:end"/>'
    pilot.block("stop", f'<wait id="w" duration="0.995"/>{stop}')
    await pilot.advance(1)
    pilot.block("late", '<head id="n" lexeme="NOD"/>')
    await pilot.advance(1)
    assert pilot.feedback.time("stop:i:start") == 0.995
    told = [name for name in pilot.feedback.progress if name.startswith("late")]
    assert (told[0], told[-1]) == ("late:start", "late:end")
    assert pilot.feedback.time("late:start") == pilot.feedback.time("late:end") == 1.0
    assert pilot.feedback.status("late") == "INTERRUPTED"


async def test_a_speech_continues_when_behaviors_tied_to_its_words_are_interrupted(pilot: RealizerPilot) -> None:
    nods = '<head id="n" lexeme="NOD" start="s:m" end="s:m+1"/><head id="o" lexeme="NOD" start="n:end" end="n:end+1"/>'
    send(pilot, "talk", TALK + nods)
    send(pilot, "stop", '<bmla:interrupt id="i" target="talk" exclude="s"/>')
    send(pilot, "then", '<bmla:interrupt id="i" target="talk" start="talk:s:m"/>')
    await pilot.advance(4)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("then:i:start") == pilot.feedback.time("talk:s:end") == pilot.feedback.time("talk:s:m")


async def test_indirect_dependents_of_an_interrupted_behavior_get_a_warning(pilot: RealizerPilot) -> None:
    nods = '<head id="n" lexeme="NOD" start="s:m" end="s:m+1"/><head id="o" lexeme="NOD" start="n:end" end="n:end+1"/>'
    send(pilot, "talk", TALK + nods)
    send(pilot, "stop", '<bmla:interrupt id="i" target="talk" include="n"/>')
    await pilot.advance(4)
    assert pilot.feedback.warnings == [("talk:o", "IMPOSSIBLE_TO_SCHEDULE")]
    assert pilot.feedback.reached("talk:s:m")


async def test_a_behavior_that_was_interrupted_before_its_start_does_not_delay_its_block(pilot: RealizerPilot) -> None:
    send(pilot, "talk", TALK + '<gesture id="g" lexeme="BEAT"/><head id="late" lexeme="NOD" start="3"/>')
    send(pilot, "stop", '<bmla:interrupt id="i" target="talk" start="0.5" include="s,late"/>')
    send(pilot, "next", '<wait id="w" duration="0.1"/>', 'bmla:appendAfter="talk"')
    await pilot.advance(3)
    assert pilot.feedback.time("talk:end") == pilot.feedback.time("talk:g:end") == pilot.feedback.time("next:start")
    assert pilot.feedback.status("talk") == "DONE"


async def test_a_block_ends_with_the_word_that_its_interrupted_speech_finishes(
    pilot: RealizerPilot,
) -> None:
    send(pilot, "talk", TALK + '<head id="late" lexeme="NOD" start="3"/>')
    send(pilot, "stop", '<bmla:interrupt id="i" target="talk" start="0.5" speech="word"/>')
    await pilot.advance(4)
    assert pilot.feedback.time("talk:end") == pilot.feedback.time("talk:s:end") < 1


@pytest.mark.parametrize("speech", ["now", "word"])
async def test_dependents_of_the_end_of_an_interrupted_speech_get_warnings_in_all_blocks(
    pilot: RealizerPilot, speech: str
) -> None:
    heads = '<head id="h" lexeme="NOD" start="s:end"/><head id="k" lexeme="NOD" start="s:end+1"/>'
    send(pilot, "talk", TALK + heads + '<head id="free" lexeme="NOD" start="1"/>')
    send(pilot, "other", '<gaze id="z" target="camera" start="talk:s:end"/>')
    await pilot.tick()
    expected = {point: pilot.feedback.predicted(point) for point in ("talk:h:start", "talk:k:start", "other:z:start")}
    send(pilot, "stop", f'<bmla:interrupt id="i" target="talk" include="s" start="0.5" speech="{speech}"/>')
    await pilot.advance(5)
    assert {point: pilot.feedback.time(point) for point in expected} == pytest.approx(expected)
    assert sorted(id_ for id_, _ in pilot.feedback.warnings) == ["other:z", "talk:h", "talk:k"]


@pytest.mark.parametrize(
    "hung", ['<bmla:interrupt id="x" target="none" start="w:start"/>', '<head id="x" lexeme="NOD" start="w:start"/>']
)
async def test_a_behavior_tied_to_an_interrupted_point_without_a_time_is_dropped_with_a_warning(
    pilot: RealizerPilot, hung: str
) -> None:
    send(pilot, "talk", hung + '<wait id="w" start="anticipators:user:nods" duration="1"/>')
    send(pilot, "stop", '<bmla:interrupt id="i" target="talk" include="w"/>')
    await pilot.advance(0.5)
    assert pilot.feedback.warnings == [("talk:x", "IMPOSSIBLE_TO_SCHEDULE")]
    assert "talk:w:start" in next(line.text for line in pilot.feedback.messages if line.id == "talk:x")
    assert pilot.feedback.status("talk") in ("DONE", "INTERRUPTED")


async def test_a_block_of_which_only_what_has_relaxed_is_left_subsides_with_the_interruption(
    pilot: RealizerPilot,
) -> None:
    pilot.block(
        "b", '<gesture id="g" lexeme="BEAT" start="0"/><head id="h" lexeme="NOD" start="anticipators:t:never"/>'
    )
    relax, end = 1.166, 1.666
    pilot.block("stop", '<bmla:interrupt id="i" target="b" include="h" start="1.4"/>')
    await pilot.advance(3)
    assert pilot.feedback.time("b:g:relax") == pytest.approx(relax, abs=1e-3)
    assert pilot.feedback.time("b:relax") == 1.4
    assert pilot.feedback.time("b:end") == pytest.approx(end, abs=1e-3)
