"""Plans are verified while they are played (`--verify`): each violation is a warning, once."""

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.pegboard.time_peg import OffsetPeg
from reactive_realizer.realizer.inputs import TickInputs
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

WAIT = '<wait id="w" duration="1" start="2"/>'


async def broken(pilot: RealizerPilot, lengths: tuple[float, ...] = (3.0,)) -> None:
    """Makes a wait longer than its constraints allow, once a tick, behind the scheduler's back."""
    pilot.block("b", WAIT)
    await pilot.advance(0.1)
    assert pilot.feedback.warnings == []
    left = list(lengths)

    def meddle(_: TickInputs) -> None:
        if left:
            lengthen(pilot.realizer, left.pop(0))

    pilot.realizer.record(meddle)
    for _ in lengths:
        await pilot.tick()


def lengthen(realizer: Realizer, length: float) -> None:
    (block,) = realizer.scheduler.blocks.alive
    start, end = block.units[0].points
    with realizer.board.graph.transaction("meddling"):
        end.peg = OffsetPeg(realizer.board.graph, "longer", start.peg, length)
        realizer.board.replace(block.units[0].key("end"), end.peg)


def put_off(realizer: Realizer) -> None:
    (block,) = realizer.scheduler.blocks.alive
    start = block.units[0].points[0]
    with realizer.board.graph.transaction("meddling"):
        start.peg = OffsetPeg(realizer.board.graph, "later", block.start, 2.5)
        realizer.board.replace(block.units[0].key("start"), start.peg)


def said(pilot: RealizerPilot) -> list[str]:
    """The warnings that have an equation number of the thesis."""
    texts = [line.text for line in pilot.feedback.of("warningFeedback")]
    return [text for text in texts if "; thesis " in text]


async def test_an_equation_that_does_not_hold_is_a_warning_of_its_block(caplog: pytest.LogCaptureFixture) -> None:
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        await broken(pilot)
    assert pilot.feedback.warnings == [("b", "IMPOSSIBLE_TO_SCHEDULE")]
    (warning,) = pilot.feedback.of("warningFeedback")
    assert "'1.00 s from w:start to its end' is missed by 2.00 s (w:start, w:end; thesis 7.1.4)" in warning.text
    assert [record.levelname for record in caplog.records if record.name.endswith("verifier")] == ["ERROR"]


async def test_a_violation_is_reported_once_however_often_the_plan_moves() -> None:
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        await broken(pilot, lengths=(3.0, 4.0, 5.0))
        assert len(pilot.feedback.warnings) == 1


async def test_a_new_block_of_the_same_name_is_verified_again() -> None:
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        await broken(pilot)
        pilot.block("next", composition="REPLACE")
        await pilot.advance(0.1)
        pilot.feedback.messages.clear()
        await broken(pilot)
        assert len(pilot.feedback.warnings) == 1


async def test_a_constraint_that_is_missed_although_nothing_moved_is_a_violation() -> None:
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        pilot.block("b", WAIT)
        await pilot.advance(0.1)
        pilot.realizer.record(lambda _: put_off(pilot.realizer))
        await pilot.tick()
        assert said(pilot) == ["'w:start = 2' is missed by 0.50 s (w:start, block start; thesis 7.8)"]


async def test_a_constraint_that_a_time_from_outside_breaks_is_no_violation() -> None:
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        pilot.predict("partner", "one", 1.0)
        pilot.predict("partner", "two", 3.0)
        before = '<constraint><before ref="anticipators:partner:two"><sync ref="w:end"/></before></constraint>'
        pilot.block("b", f'<wait id="w" duration="1" start="anticipators:partner:one"/>{before}')
        await pilot.advance(0.1)
        pilot.predict("partner", "two", 1.5)
        await pilot.advance(4)
        assert pilot.feedback.warnings == [("b", "IMPOSSIBLE_TO_SCHEDULE")]
        assert said(pilot) == []


async def test_a_tie_that_a_time_from_outside_breaks_before_its_block_starts_is_no_violation() -> None:
    """Not even if the times from outside are the same in the tick in which the block starts."""
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        pilot.predict("partner", "two", 0.5)
        pilot.block("a", '<wait id="v" duration="1"/><bmla:emit id="e" event="asked" start="v:end"/>')
        after = '<constraint><after ref="anticipators:partner:two"><sync ref="w:start"/></after></constraint>'
        block = f'<wait id="w" duration="1" start="anticipators:events:asked"/>{after}'
        pilot.block("b", block, composition="APPEND")
        await pilot.advance(0.1)
        pilot.predict("partner", "two", 3.0)
        await pilot.advance(5)
        (warning,) = pilot.feedback.of("warningFeedback")
        assert "w:start = anticipators:events:asked no longer holds: it is off by 2.00 s" in warning.text


async def test_a_start_at_a_time_that_is_corrected_a_little_after_it_has_come_is_no_violation() -> None:
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        pilot.predict("partner", "go", 1.0)
        begun = (
            '<constraint><synchronize><sync ref="0"/><sync ref="anticipators:partner:go"/></synchronize></constraint>'
        )
        pilot.block("b", f'<wait id="w" duration="1" start="1"/><wait id="v" duration="1" start="2"/>{begun}')
        await pilot.advance(1.02)
        pilot.predict("partner", "go", 1.08)
        await pilot.advance(0.5)
        pilot.block("i", '<bmla:interrupt id="i" target="b" include="v"/>')
        await pilot.advance(4)
        assert said(pilot) == []


async def test_a_constraint_that_breaks_because_a_body_needs_more_time_when_it_begins_is_no_violation() -> None:
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        pilot.predict("partner", "hit", 3.0)
        pilot.predict("partner", "done", 5.0)
        times = 'stroke="anticipators:partner:hit" end="anticipators:partner:done"'
        pilot.block("b", f'<head id="h" lexeme="NOD" {times}/>')
        await pilot.advance(0.5)
        pilot.predict("partner", "done", 3.01)
        await pilot.advance(4)
        assert pilot.feedback.warnings == [("b:h", "IMPOSSIBLE_TO_SCHEDULE")]
        assert said(pilot) == []


async def test_plans_are_not_verified_by_default() -> None:
    async with open_pilot() as pilot:
        await broken(pilot)
        assert pilot.feedback.warnings == []


@pytest.mark.parametrize("strategy", ["smartbody", "embr", "convex"])
async def test_a_plan_that_follows_moving_times_has_no_violation(strategy: str) -> None:
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
