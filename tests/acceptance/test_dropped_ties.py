"""Ties to dropped behaviors: dependents are dropped or keep their last time, and the warning names the cause."""

from typing import Any

import pytest

from reactive_realizer.testing.pilot import RealizerPilot

from .living_time import HIT, after, nod, synchronize, texts, wait

SAMBA = '<gesture id="g" lexeme="SAMBA"/>'
HOLDS = '<gesture id="first" lexeme="BEAT" mode="RIGHT_HAND" start="0" end="2"/>'
LATER = '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND" start="0.5" stroke="{}" end="3"/>'


def told(pilot: RealizerPilot, id_: str) -> list[str]:
    """The texts of the warnings of a behavior or block."""
    return [line.text.partition(": ")[2] for line in pilot.feedback.of("warningFeedback") if line.id == id_]


# --- at planning


@pytest.mark.parametrize(
    "lost",
    [SAMBA, '<locomotion id="g" target="nowhere"/>', '<gesture id="g"/>', nod("g", start="nobody:end")],
    ids=["no such word", "no such target", "not to be read", "its own tie"],
)
async def test_all_behaviors_of_a_chain_are_dropped_and_each_warning_names_the_first_dropped_one(
    pilot: RealizerPilot, lost: Any
) -> None:
    chain = nod("n", start="g:end") + nod("m", start="n:end") + nod("o", start="m:end")
    pilot.block("b", wait("w", 1) + lost + chain)
    await pilot.advance(2)
    assert [id_ for id_, _ in pilot.feedback.warnings] == ["b:g", "b:n", "b:m", "b:o"]
    for id_, point in (("b:n", "g:end"), ("b:m", "n:end"), ("b:o", "m:end")):
        assert told(pilot, id_) == [
            f"{point} has no time because 'g' is dropped; what depends on it is dropped too",
        ]
    assert pilot.feedback.status("b") == "DONE"
    assert pilot.feedback.time("b:end") == 1.0


async def test_behaviors_that_depend_on_one_without_time_are_dropped_too(pilot: RealizerPilot) -> None:
    lost = '<wait id="g" start="1" end="0.5"/>'
    pilot.block("b", wait("w", 1) + nod("m", start="n:end") + nod("n", start="g:end") + lost)
    await pilot.advance(2)
    assert told(pilot, "b:n") == ["g:end has no time because 'g' is dropped; what depends on it is dropped too"]
    assert told(pilot, "b:m") == ["n:end has no time because 'g' is dropped; what depends on it is dropped too"]
    assert pilot.feedback.progress == ["b:start", "b:w:start", "b:w:end", "b:end"]


async def test_the_warning_of_a_dropped_constraint_names_the_dropped_behavior(pilot: RealizerPilot) -> None:
    pilot.block("b", SAMBA + nod("n", start="g:end") + nod("o") + after("n:end", "o:start"))
    await pilot.advance(2)
    assert told(pilot, "b") == ["n:end has no time because 'g' is dropped; what depends on it is dropped too"]
    assert pilot.feedback.reached("b:o:end")


async def test_a_reference_to_an_unknown_behavior_lists_the_known_ones(pilot: RealizerPilot) -> None:
    pilot.block("b", nod("n", start="nobody:stroke") + nod("m"))
    await pilot.advance(2)
    reason = "'nobody' is neither a behavior of this block nor a block that is still alive; behaviors: n, m"
    assert told(pilot, "b:n") == [f"nobody:stroke: {reason}"]


async def test_the_dropped_behavior_may_be_in_another_block(pilot: RealizerPilot) -> None:
    pilot.block("a", wait("w", 5) + SAMBA)
    pilot.block("b", nod("n", start="a:g:end") + nod("m", start="n:end"))
    await pilot.advance(2)
    for id_, point in (("b:n", "a:g:end"), ("b:m", "n:end")):
        assert told(pilot, id_) == [f"{point} has no time because 'a:g' is dropped; what depends on it is dropped too"]


async def test_ties_in_a_procedure_are_dropped_in_the_same_way(pilot: RealizerPilot) -> None:
    define = '<bmlt:defineproc xmlns:bmlt="http://hmi.ewi.utwente.nl/bmlt" xmlns="{}" id="{}">{}</bmlt:defineproc>'
    core = "http://www.bml-initiative.org/bml/bml-1.0"
    pilot.perform(define.format(core, "p", '<gesture id="g"/>' + nod("n", start="g:end")))
    pilot.perform('<bmlt:useproc xmlns:bmlt="http://hmi.ewi.utwente.nl/bmlt" procid="p" bmlid="b"/>')
    await pilot.advance(1)
    assert told(pilot, "b:n") == ["g:end has no time because 'g' is dropped; what depends on it is dropped too"]


# --- while it plays


@pytest.mark.parametrize("tied", ["by itself", "by a constraint"])
async def test_a_behavior_tied_to_one_dropped_in_a_conflict_keeps_its_time_with_one_warning(
    pilot: RealizerPilot, tied: str
) -> None:
    tie = {"by itself": nod("n", start="g:stroke"), "by a constraint": nod("n") + synchronize("g:stroke", "n:start")}
    pilot.predict("t", "hit", 1.5)
    pilot.block("b", HOLDS + LATER.format(HIT) + tie[tied] + nod("m", start="n:end"))
    await pilot.advance(0.6)
    assert told(pilot, "b:n") == ["the behavior of b:g:stroke is dropped; this behavior keeps the last predicted time"]
    pilot.predict("t", "hit", 1.9)
    await pilot.advance(5)
    assert len(told(pilot, "b:g")) == 1
    assert len(texts(pilot)) == 2, "what hangs on it in turn is tied as before"
    assert pilot.feedback.time("b:n:start") == 1.5
    assert pilot.feedback.time("b:m:start") == pilot.feedback.time("b:n:end")
    assert pilot.feedback.status("b") == "DONE"


async def test_a_rigid_behavior_keeps_its_time_as_a_whole(pilot: RealizerPilot) -> None:
    """The anchor of the dropped gesture, a second after its start, still moves; the start of the wait hung on it."""
    pilot.predict("t", "hit", 1.5)
    pilot.block(
        "b", HOLDS + f'<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND" start="{HIT}-1"/>' + wait("w", 0.4, end="g:end")
    )
    await pilot.advance(0.6)
    assert [id_ for id_, _ in pilot.feedback.warnings] == ["b:g", "b:w"]
    end = pilot.feedback.predicted("b:w:end")
    pilot.predict("t", "hit", 1.7)
    await pilot.advance(5)
    assert pilot.feedback.time("b:w:end") == end
    assert pilot.feedback.time("b:w:start") == pytest.approx(end - 0.4)


@pytest.mark.parametrize("start", ["g:start", "g:stroke"])
async def test_a_wait_for_an_event_keeps_its_start_too(pilot: RealizerPilot, start: str) -> None:
    waits = f'<wait id="w" event="told" start="{start}"/>'
    pilot.block("b", HOLDS + LATER.format("1.5") + waits)
    await pilot.advance(2)
    point = start.replace("g", "b:g")
    (text,) = told(pilot, "b:w")
    assert text == f"the behavior of {point} is dropped; this behavior keeps the last predicted time"
    assert pilot.feedback.time("b:w:start") == pilot.feedback.predicted("b:w:start")
    assert not pilot.feedback.reached("b:w:end")


async def test_a_behavior_of_another_block_keeps_its_time_too(pilot: RealizerPilot) -> None:
    pilot.block("b", HOLDS + LATER.format("1.5"))
    pilot.block("c", nod("n", start="b:g:end"))
    await pilot.advance(0.6)
    assert told(pilot, "c:n") == ["the behavior of b:g:end is dropped; this behavior keeps the last predicted time"]
    await pilot.advance(5)
    assert len(texts(pilot)) == 2
    assert pilot.feedback.time("c:n:start") == 3.0


async def test_indirect_dependents_stay_tied_without_a_warning(
    pilot: RealizerPilot,
) -> None:
    pilot.predict("t", "hit", 1.5)
    pilot.block("b", HOLDS + LATER.format(HIT))
    pilot.block("c", nod("n", start="b:g:stroke") + nod("m", start="n:end"))
    await pilot.advance(5)
    assert [id_ for id_, _ in pilot.feedback.warnings] == ["b:g", "c:n"]
    assert pilot.feedback.time("c:m:start") == pilot.feedback.time("c:n:end")


async def test_dependents_of_a_behavior_that_was_over_before_its_block_started_keep_their_ties(
    pilot: RealizerPilot,
) -> None:
    pilot.predict("t", "hit", 9)
    pilot.block("a", wait("w", 3))
    pilot.block("b", nod("n", start=HIT, end=f"{HIT}+0.7") + wait("w", 9, start="n:end"), composition="APPEND")
    await pilot.advance(0.5)
    pilot.predict("t", "hit", 1)
    await pilot.advance(4)
    assert [id_ for id_, _ in pilot.feedback.warnings] == ["b:n"]
    assert pilot.feedback.reached("b:w:start")


async def test_a_behavior_that_the_dropped_one_referred_to_gets_no_warning(pilot: RealizerPilot) -> None:
    words = '<speech id="s" start="0.2"><text>Well then, <sync id="m"/>my friend.</text></speech>'
    pilot.block("b", HOLDS + words + '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND" stroke="s:m"/>')
    await pilot.advance(4)
    assert [id_ for id_, _ in pilot.feedback.warnings] == ["b:g"]
    assert pilot.feedback.reached("b:s:end")


async def test_a_later_block_cannot_refer_to_a_dropped_behavior(pilot: RealizerPilot) -> None:
    pilot.block("b", HOLDS + LATER.format("1.5"))
    await pilot.advance(1)
    pilot.block("c", nod("n", start="b:g:end"))
    await pilot.advance(4)
    assert told(pilot, "c:n") == ["b:g:end has no time because 'b:g' is dropped; what depends on it is dropped too"]


async def test_the_failure_of_a_block_is_its_only_warning(pilot: RealizerPilot) -> None:
    pilot.block("b", HOLDS + f"<required>{LATER.format('1.5')}</required>" + nod("n", start="g:end"))
    await pilot.advance(1)
    assert [id_ for id_, _ in pilot.feedback.warnings] == ["b:g"]
    assert pilot.feedback.status("b") == "FAILED"


async def test_a_point_that_keeps_its_last_time_waits_for_its_body(pilot: RealizerPilot) -> None:
    """The stroke of the gesture lets the pointing be ready before its arm can get there from where it is."""
    gesture = f'<gesture id="p" lexeme="BEAT" mode="RIGHT_HAND" end="{HIT}"/>'
    pointing = '<pointing id="q" target="bluebox" relax="p:ready" end="p:stroke+0.2"/>'
    pilot.block("b", gesture + pointing + synchronize("p:relax-1", "q:end"))
    await pilot.advance(0.03)
    pilot.predict("t", "hit", pilot.now + 0.2)
    await pilot.advance(2)
    assert [id_ for id_, _ in pilot.feedback.warnings] == ["b:p", "b:q"]
    assert pilot.feedback.time("b:q:ready") - pilot.feedback.time("b:q:start") > 0.35
    assert pilot.feedback.status("b") == "DONE"
