"""Ties to the strokes of behaviors that have several."""

import pytest

from reactive_realizer.testing.pilot import RealizerPilot


@pytest.mark.parametrize(
    "content",
    [
        '<head id="h" lexeme="NOD" repetition="3" stroke="2"/>',
        '<head id="h" lexeme="NOD" repetition="3"/>'
        '<constraint><synchronize><sync ref="h:stroke"/><sync ref="2"/></synchronize></constraint>',
        '<head id="h" lexeme="NOD" repetition="3" start="1"/><wait id="w" start="h:stroke" duration="0.1"/>',
    ],
)
async def test_the_stroke_of_a_repeated_head_movement_is_its_first(pilot: RealizerPilot, content: str) -> None:
    pilot.block("b", content)
    await pilot.advance(6)
    assert pilot.feedback.warnings == []
    first = pilot.feedback.time("b:h:stroke:1")
    assert first < pilot.feedback.time("b:h:stroke:2") < pilot.feedback.time("b:h:stroke:3")
    assert first == pytest.approx(pilot.feedback.time("b:w:start") if "wait" in content else 2.0)


async def test_another_block_may_refer_to_the_stroke_of_a_repeated_head_movement(pilot: RealizerPilot) -> None:
    pilot.block("b", '<head id="h" lexeme="NOD" repetition="3" start="1"/>')
    pilot.block("c", '<gesture id="g" lexeme="BEAT" stroke="b:h:stroke"/>')
    await pilot.advance(6)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("c:g:stroke") == pytest.approx(pilot.feedback.time("b:h:stroke:1"))
