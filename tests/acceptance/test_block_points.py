"""Sync points of blocks that points of their behaviors define (thesis 12.1.3, examples 33 and 35)."""

import pytest

from reactive_realizer.testing.assertions import assert_linked
from reactive_realizer.testing.pilot import RealizerPilot

from .living_time import texts

EXAMPLE_35 = """
  <speech id="speech1"><text>one <sync id="sync1"/>two three</text></speech>
  <gesture id="g1" lexeme="BEAT" stroke="speech1:sync1"/>
"""
NOD = '<head id="n" lexeme="NOD" start="{}"/>'


@pytest.fixture
def pilot(any_strategy: RealizerPilot) -> RealizerPilot:
    return any_strategy


async def test_example_35_the_stroke_of_a_block_is_that_of_its_behavior(pilot: RealizerPilot) -> None:
    pilot.block("bml1", EXAMPLE_35, stroke="g1:stroke", ready="g1:ready")
    pilot.block("bml2", NOD.format("bml1:stroke+0.2") + '<wait id="w" start="bml1:bml:ready" duration="1"/>')
    await pilot.advance(4)
    assert_linked(pilot.feedback, "bml2:n:start", "bml1:g1:stroke", 0.2)
    assert_linked(pilot.feedback, "bml2:w:start", "bml1:g1:ready")
    assert pilot.feedback.warnings == []


async def test_points_of_a_block_are_reported_as_its_progress(pilot: RealizerPilot) -> None:
    pilot.block("bml1", EXAMPLE_35, stroke="g1:stroke", ready="g1:ready")
    await pilot.advance(4)
    told = pilot.feedback
    assert told.time("bml1:stroke") == told.time("bml1:g1:stroke")
    assert told.time("bml1:ready") == told.time("bml1:g1:ready")
    assert told.status("bml1", "stroke") == "IN_EXEC"
    assert told.progress.index("bml1:stroke") > told.progress.index("bml1:g1:stroke")
    assert [each.id for each in told.of("blockProgress")] == [
        f"bml1:{sync}" for sync in ("start", "ready", "stroke", "relax", "end")
    ]


async def test_points_of_a_block_move_with_those_of_its_behavior(pilot: RealizerPilot) -> None:
    pilot.predict("t", "hit", 2.0)
    pilot.block("a", '<gesture id="g" lexeme="BEAT" stroke="anticipators:t:hit"/>', stroke="g:stroke")
    pilot.block("b", NOD.format("a:stroke"))
    await pilot.advance(0.5)
    pilot.predict("t", "hit", 2.5)
    await pilot.advance(3)
    assert pilot.feedback.time("b:n:start") == pilot.feedback.time("a:stroke") == 2.5


async def test_without_a_definition_a_block_is_ready_with_its_first_behavior(pilot: RealizerPilot) -> None:
    pilot.block(
        "a",
        '<gaze id="look" target="bluebox" start="1"/><gesture id="g" lexeme="BEAT"/>' + '<wait id="w" duration="3"/>',
    )
    pilot.block("b", NOD.format("a:ready"))
    await pilot.advance(3)
    assert_linked(pilot.feedback, "b:n:start", "a:g:ready")
    assert not pilot.feedback.reached("a:ready")
    assert pilot.feedback.warnings == []


async def test_example_33_a_block_starts_at_the_relax_of_another(pilot: RealizerPilot) -> None:
    pilot.block("bml1", EXAMPLE_35)
    pilot.block("bml2", '<wait id="w" duration="0.1"/>', start="bml1:relax")
    await pilot.advance(4)
    assert_linked(pilot.feedback, "bml2:start", "bml1:relax")
    assert pilot.feedback.time("bml1:relax") < pilot.feedback.time("bml1:end")
    assert pilot.feedback.warnings == []


async def test_a_block_may_start_at_any_point_of_another_block_or_of_an_anticipator(pilot: RealizerPilot) -> None:
    pilot.block("a", EXAMPLE_35, stroke="g1:stroke")
    pilot.block("b", NOD.format("0"), start="a:stroke+0.1")
    pilot.block("c", '<wait id="w" duration="1"/>', start="anticipators:events:go")
    await pilot.advance(3)
    assert_linked(pilot.feedback, "b:start", "a:stroke", 0.1)
    assert not pilot.feedback.reached("c:start")
    pilot.block("e", '<bmla:emit id="e" event="go"/>')
    await pilot.advance(2)
    assert pilot.feedback.time("c:start") == 3
    assert pilot.feedback.warnings == []


async def test_a_point_of_an_interrupted_block_is_not_reported(pilot: RealizerPilot) -> None:
    pilot.block("a", EXAMPLE_35, stroke="g1:stroke")
    pilot.block("stop", '<bmla:interrupt id="i" target="a" start="a:g1:start+0.05"/>')
    await pilot.advance(3)
    assert pilot.feedback.status("a") == "INTERRUPTED"
    assert not pilot.feedback.reached("a:stroke")


@pytest.mark.parametrize(
    ("name", "value", "reason"),
    [
        ("stroke", "g1:stroke+0.5", "one of its behaviors, behavior:sync, without an offset"),
        ("stroke", "1.5", "one of its behaviors, behavior:sync, without an offset"),
        ("ready", "other:g:ready", "one of its behaviors, behavior:sync, without an offset"),
        ("stroke", "g1", "not a sync reference"),
        ("stroke", "g2:stroke", "one of its behaviors, behavior:sync, without an offset"),
        ("stroke", "g2:attackPeak", "there is no behavior 'g2'"),
        ("stroke", "g1:attackPeak", "'g1' has no sync point 'attackPeak'"),
        ("start", "g1:start", "at a sync point of another block or of an anticipator"),
        ("start", "2", "at a sync point of another block or of an anticipator"),
        ("start", "nobody:stroke", "nobody"),
        ("attackPeak", "g1:stroke", "unknown attribute attackPeak of <bml>"),
    ],
)
async def test_a_point_that_cannot_be_is_ignored_with_a_warning(
    pilot: RealizerPilot, name: str, value: str, reason: str
) -> None:
    pilot.block("a", EXAMPLE_35, **{name: value})
    await pilot.advance(3)
    (said,) = texts(pilot)
    assert reason in said
    assert pilot.feedback.status("a") == "DONE"


async def test_a_reference_to_a_point_that_a_block_does_not_have_drops_its_behavior(pilot: RealizerPilot) -> None:
    pilot.block("a", EXAMPLE_35, stroke="g1:stroke")
    pilot.block("b", NOD.format("a:strokeEnd"))
    pilot.block("c", '<head id="n" lexeme="NOD"/>' + '<wait id="w" start="d:ready"/>')
    pilot.block("d", EXAMPLE_35.replace("BEAT", "NONE"), stroke="g1:stroke")
    await pilot.advance(3)
    said = [text.partition(": ")[2] for text in texts(pilot)]
    unknown = "a:strokeEnd: the block 'a' has no sync point 'strokeEnd'; it has start, ready, stroke, relax, end"
    assert unknown in "\n".join(said)
    assert pilot.feedback.reached("c:n:end")


async def test_a_block_of_which_the_only_ready_was_cut_has_none(pilot: RealizerPilot) -> None:
    pilot.block("a", '<gesture id="g" lexeme="BEAT"/><wait id="w" duration="3"/>')
    pilot.block("stop", '<bmla:interrupt id="i" target="a" include="g" start="a:g:start+0.02"/>')
    await pilot.advance(0.2)
    pilot.block("b", NOD.format("a:ready"))
    await pilot.advance(4)
    assert "a:ready has no time because 'a:ready' is dropped" in texts(pilot)[-1]
    assert pilot.feedback.status("a") == "DONE"
