"""Plans checked while they are played (`--verify`): what breaks is said, once."""

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import open_pilot

GESTURE = '<gesture id="g" lexeme="BEAT"/>'
AFTER_HIT = '<constraint id="c"><after ref="anticipators:partner:hit"><sync ref="g:start"/></after></constraint>'


def pilot_of(**options):
    # EMBR's program starts a gesture as early as it may in the plan that it makes, but not when that plan moves.
    return open_pilot(SceneOptions(voice="text", strategy="embr", **options))


async def broken(pilot) -> None:
    pilot.predict("partner", "hit", 4.5)
    pilot.block("b", GESTURE + AFTER_HIT)
    await pilot.advance(0.5)
    assert pilot.feedback.warnings == []
    pilot.predict("partner", "hit", 1.0)
    await pilot.advance(0.1)


async def test_an_equation_that_a_prediction_breaks_is_a_warning_of_its_block(caplog) -> None:
    async with pilot_of(verify=True) as pilot:
        await broken(pilot)
    assert pilot.feedback.warnings == [("b", "IMPOSSIBLE_TO_SCHEDULE")]
    (warning,) = pilot.feedback.of("warningFeedback")
    assert "thesis 7.24" in warning.element.text
    assert "g:start" in warning.element.text
    assert [record.levelname for record in caplog.records if record.name.endswith("verifier")] == ["ERROR"]


async def test_it_is_said_once_however_often_the_plan_moves() -> None:
    async with pilot_of(verify=True) as pilot:
        await broken(pilot)
        for time in (1.1, 1.2):
            pilot.predict("partner", "hit", time)
            await pilot.advance(0.1)
        assert len(pilot.feedback.warnings) == 1


async def test_a_block_of_the_same_name_is_judged_anew() -> None:
    async with pilot_of(verify=True) as pilot:
        await broken(pilot)
        pilot.block("next", composition="REPLACE")
        await pilot.advance(0.1)
        await broken_again(pilot)
        assert len(pilot.feedback.warnings) == 2


async def broken_again(pilot) -> None:
    pilot.predict("partner", "hit", 5.4)
    pilot.block("b", GESTURE + AFTER_HIT)
    await pilot.advance(0.1)
    pilot.predict("partner", "hit", 1.0)
    await pilot.advance(0.1)


async def test_nobody_looks_unless_asked_to() -> None:
    async with pilot_of() as pilot:
        await broken(pilot)
        assert pilot.feedback.warnings == []


@pytest.mark.parametrize("strategy", ["smartbody", "embr", "convex"])
async def test_a_plan_that_follows_what_moves_breaks_nothing(strategy) -> None:
    async with open_pilot(SceneOptions(voice="text", strategy=strategy, verify=True)) as pilot:
        pilot.predict("partner", "hit", 2.0)
        pilot.block("b", '<gesture id="g" lexeme="BEAT" stroke="anticipators:partner:hit"/>')
        pilot.block("c", '<head id="n" lexeme="NOD"/>', composition="APPEND")
        for time in (2.5, 2.2, 1.9):
            await pilot.advance(0.3)
            pilot.predict("partner", "hit", time)
        await pilot.advance(6)
        assert pilot.feedback.warnings == []
        assert pilot.feedback.status("c") == "DONE"
