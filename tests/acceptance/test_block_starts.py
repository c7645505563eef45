"""Blocks whose start is constrained (thesis, example 34)."""

from typing import Any

import pytest

from reactive_realizer.testing.assertions import assert_linked, assert_order, assert_time
from reactive_realizer.testing.pilot import RealizerPilot

from .living_time import GO, HIT, after, before, moves, nod, synchronize, texts, wait


@pytest.mark.parametrize("tie", [before("d:start", "a:end", "b:end"), after("b:end", "d:start")])
async def test_example_34_a_block_starts_after_the_points_of_its_constraints(pilot: RealizerPilot, tie: Any) -> None:
    pilot.block("a", wait("w", 1))
    pilot.block("b", nod("n", end=HIT))
    pilot.predict("t", "hit", 2.0)
    pilot.block("d", f"<required>{tie}</required>" + wait("w", 0.5), composition="MERGE")
    await moves(pilot, 0.5, ("hit", 1.7), 3)
    assert_linked(pilot.feedback, "d:start", "b:end")
    assert_time(pilot.feedback, "d:start", 1.7)
    assert_order(pilot.feedback, "a:end", "d:start")
    assert pilot.feedback.warnings == []


async def test_a_block_may_start_at_a_point_of_another_block_or_of_an_anticipator(pilot: RealizerPilot) -> None:
    pilot.block("a", wait("w", 1))
    pilot.block("b", wait("w", 0.5) + synchronize("b:start", "a:w:end+0.5"))
    pilot.block("c", wait("w", 0.5) + after(HIT, "c:start"))
    await pilot.advance(1)
    assert not pilot.feedback.reached("c:start")
    await moves(pilot, ("hit", 2.0), 2)
    assert_linked(pilot.feedback, "b:start", "a:w:end", 0.5)
    assert_time(pilot.feedback, "c:start", 2.0)
    assert pilot.feedback.warnings == []


async def test_a_block_whose_start_depends_on_itself_is_refused(pilot: RealizerPilot) -> None:
    pilot.predict("t", "go", 1.0)
    pilot.block("z", wait("w", 0.5, start=GO))
    pilot.block("a", wait("w", 1), composition="APPEND")
    pilot.block("d", wait("w", 0.5, start="a:w:end"))
    await pilot.advance(0.2)
    pilot.block("x", **{"bmla:appendAfter": "d", "bmla:prependBefore": "a"})
    await pilot.advance(4)
    (said,) = texts(pilot)
    assert "'x' should come before 'a' but also waits for it" in said
    assert pilot.feedback.status("d") == "DONE"


async def test_a_block_that_has_ended_leaves_no_dependents_on_its_constraints(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 100.0)
    pilot.block("keep", wait("w", 1, start=HIT))
    await pilot.tick()
    hanging = len(pilot.realizer.board.predicted("t", "hit").dependents)
    for constraint in (before(HIT, "n:end"), after(f"{HIT}-100", "n:end"), after(f"{HIT}-100", "b:start")):
        pilot.block("b", nod("n") + constraint)
        await pilot.advance(1)
    assert [line.id for line in pilot.feedback.of("blockProgress")].count("b:end") == 3
    assert len(pilot.realizer.board.predicted("t", "hit").dependents) == hanging


@pytest.mark.parametrize("outside", ["unknown", "known"])
async def test_a_block_does_not_wait_for_a_point_that_will_never_come(pilot: RealizerPilot, outside: str) -> None:
    pilot.block("a", nod("n", start=HIT if outside == "unknown" else "1"))
    pilot.block("b", nod("n"), start="a:n:stroke")
    await pilot.advance(0.5)
    pilot.block("stop", '<bmla:interrupt id="i" target="a"/>')
    await pilot.advance(3)
    assert pilot.feedback.status("b") == "DONE"
    if outside == "unknown":
        assert_time(pilot.feedback, "b:start", 0.5)
        assert texts(pilot) == ["line 1, column 1: it does not wait for a:n:stroke any more, which will never come"]
    else:
        assert pilot.feedback.time("b:start") > 1.0
        assert pilot.feedback.warnings == []


async def test_a_block_waits_for_a_point_that_moves_when_the_block_of_that_point_starts(pilot: RealizerPilot) -> None:
    pilot.block("a", '<bmla:emit id="e" event="asked"/>')
    pilot.block(
        "b",
        """
        <wait id="w" event="asked" max-wait="1.2" start="a:e:start-1"/><head id="h" lexeme="NOD"/>
        <constraint><synchronize><sync ref="h:end"/><sync ref="w:start+1"/></synchronize></constraint>
        """,
    )
    pilot.block("c", '<wait id="w" duration="0.1"/>', start="b:h:end")
    await pilot.advance(2)
    assert pilot.feedback.time("c:start") == pilot.feedback.time("b:h:end") == 1.0
    assert next(line.time for line in pilot.feedback.messages if line.id == "c:start") == 1.0


@pytest.mark.parametrize("attribute", [True, False])
async def test_a_block_whose_start_is_predicted_into_the_past_starts_now(pilot: RealizerPilot, attribute: bool) -> None:
    if attribute:
        pilot.block("b", nod("n"), start=f"{HIT}-1")
    else:
        pilot.block("b", nod("n") + before("0", f"{HIT}-1"))
    await moves(pilot, 3, ("hit", 3.0), 2)
    assert texts(pilot) == []
    assert_time(pilot.feedback, "b:start", 3.0)
    assert_linked(pilot.feedback, "b:n:end", "b:start", 0.7)


async def test_a_block_that_waits_for_a_point_is_shown_when_that_is_predicted_into_the_past(
    pilot: RealizerPilot,
) -> None:
    pilot.watch()
    pilot.block("b", '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND"/>' + before("0", f"{HIT}-2"))
    await moves(pilot, 3, ("hit", 3.0), 3)
    assert_time(pilot.feedback, "b:start", 3.0)
    assert pilot.feedback.time("b:g:end") > 4.0
    wrist = pilot.path("r_wrist")
    assert abs(wrist[150] - wrist[140]).max() < 0.01
    assert abs(wrist[190] - wrist[150]).max() > 0.1  # it is at its stroke at 3.8 s


async def test_a_block_before_a_point_that_is_predicted_into_the_past_is_shown(pilot: RealizerPilot) -> None:
    pilot.watch()
    pilot.predict("t", "hit", 9.0)
    pilot.block("a", '<wait id="w" duration="3"/>')
    pilot.block("b", '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND"/>' + before(HIT, "g:end"), composition="APPEND")
    await moves(pilot, 1, ("hit", 0.5), 5)
    assert_time(pilot.feedback, "b:g:start", 3.0)
    assert pilot.feedback.time("b:g:end") > 4.0
    wrist = pilot.path("r_wrist")
    assert abs(wrist[190] - wrist[150]).max() > 0.1
    (text,) = texts(pilot)
    assert "g:end before anticipators:t:hit" in text
