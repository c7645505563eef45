"""Behaviors written as elements."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Face
from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.bml.names import Location
from reactive_realizer.bml.writer import written

Block = Callable[[str], BehaviorBlock]

ELEMENTS = [
    '<gesture id="x" lexeme="BEAT" mode="LEFT_HAND" start="1" stroke="other:g:stroke-0.5"/>',
    '<speech id="x" end="4"><text>One <sync id="a"/>two<sync id="b"/> three</text></speech>',
    '<speech id="x"><text>Fish &amp; chips</text></speech>',
    '<face id="x" amount="0.8"><faceLexeme lexeme="SMILE" amount="0.2"/></face>',
    '<posture id="x"><stance type="SITTING"/><pose part="ARMS" lexeme="ARMS_CROSSED"/></posture>',
    '<gaze id="x" target="box" influence="HEAD" offsetAngle="12.5" offsetDirection="LEFT"/>',
    '<faceFacs id="x" au="4" side="LEFT"/>',
    '<wait id="x" max-wait="3"/>',
]


@pytest.mark.parametrize("element", ELEMENTS)
def test_a_behavior_that_is_written_and_read_is_the_same(block: Block, element: str) -> None:
    (behavior,) = block(element).behaviors
    (again,) = block(written(_without_sources(behavior))).behaviors
    assert _without_sources(again) == _without_sources(behavior)


def test_a_behavior_that_was_read_is_written_as_it_was(block: Block) -> None:
    (behavior,) = block('<wait id="x" duration="1.50"/>').behaviors
    assert written(behavior) == behavior.source


def _without_sources(behavior: Behavior) -> Behavior:
    plain = replace(behavior, source="", location=Location(1, 1))
    if not isinstance(plain, Face):
        return plain
    return replace(plain, parts=tuple(replace(each, source="", location=Location(1, 1)) for each in plain.parts))
