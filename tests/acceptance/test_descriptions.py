"""Alternative forms of a behavior (BML 1.0: description): which one plays, and which are reported."""

import pytest

from reactive_realizer.testing.pilot import open_pilot

GESTURE = '<gesture id="g" lexeme="BEAT" start="0">{}</gesture>'
DESCRIPTION = '<description priority="{}" type="application/bmlt">{}</description>'
NAMELESS = '<bmlt:procanimation name="nothere"/>'
KEYLESS = (
    '<bmlt:keyframe><SkeletonInterpolator parts="r_wrist">0 1 0 0 0 1 1 0 0 0</SkeletonInterpolator></bmlt:keyframe>'
)
NOD = '<bmlt:procanimation name="nod"/>'


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (NAMELESS, "no asset named 'nothere.xml'"),
        (KEYLESS, "g, line 1, <SkeletonInterpolator>: the attribute encoding is missing"),
    ],
)
async def test_a_description_that_cannot_be_played_is_reported_once_and_the_core_behavior_plays(
    content: str, reason: str
) -> None:
    async with open_pilot() as pilot:
        pilot.block("b", GESTURE.format(DESCRIPTION.format(2, content)))
        await pilot.advance(3)
        assert pilot.feedback.warnings == [("b:g", "CANNOT_CREATE_BEHAVIOR")]
        assert reason in pilot.feedback.of("warningFeedback")[0].text
        assert "b:g:strokeEnd" in pilot.feedback.progress
        assert "b:g:end" in pilot.feedback.progress


async def test_descriptions_after_the_one_that_plays_are_not_tried() -> None:
    async with open_pilot() as pilot:
        pilot.block("b", GESTURE.format(DESCRIPTION.format(1, NAMELESS) + DESCRIPTION.format(2, NOD)))
        await pilot.advance(3)
        assert pilot.feedback.warnings == []
        assert "b:g:end" in pilot.feedback.progress


async def test_descriptions_in_unknown_languages_are_skipped() -> None:
    async with open_pilot() as pilot:
        pilot.block("b", GESTURE.format(DESCRIPTION.format(1, '<x:dance xmlns:x="urn:x"/>')))
        await pilot.advance(3)
        assert pilot.feedback.warnings == []
        assert "b:g:end" in pilot.feedback.progress
