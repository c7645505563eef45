"""Plans checked while they are played (`--verify`): what breaks is said, once."""

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.pegboard.time_peg import OffsetPeg
from reactive_realizer.scheduler.convex.convex_strategy import ConvexStrategy
from reactive_realizer.scheduler.problem import Anchor, AtBlock, Solution
from reactive_realizer.testing.pilot import open_pilot

WAIT = '<wait id="w" duration="1" start="2"/>'


async def broken(pilot, lengths=(3.0,)) -> None:
    """Somebody who knows nothing of constraints makes a wait longer than it wants to be, once a tick."""
    pilot.block("b", WAIT)
    await pilot.advance(0.1)
    assert pilot.feedback.warnings == []
    left = list(lengths)
    pilot.realizer.record(lambda _: left and lengthen(pilot.realizer, left.pop(0)))
    for _ in lengths:
        await pilot.tick()


def lengthen(realizer, length) -> None:
    (block,) = realizer.scheduler.blocks.alive
    start, end = block.units[0].points
    with realizer.board.graph.transaction("meddling"):
        end.peg = OffsetPeg(realizer.board.graph, "longer", start.peg, length)
        realizer.board.replace(block.units[0].key("end"), end.peg)


async def test_an_equation_that_does_not_hold_is_a_warning_of_its_block(caplog) -> None:
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        await broken(pilot)
    assert pilot.feedback.warnings == [("b", "IMPOSSIBLE_TO_SCHEDULE")]
    (warning,) = pilot.feedback.of("warningFeedback")
    assert "'1 s from w:start to its end' is missed by 2 s (w:start, w:end; thesis 7.1.4)" in warning.element.text
    assert [record.levelname for record in caplog.records if record.name.endswith("verifier")] == ["ERROR"]


async def test_it_is_said_once_however_often_the_plan_moves() -> None:
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        await broken(pilot, lengths=(3.0, 4.0, 5.0))
        assert len(pilot.feedback.warnings) == 1


async def test_a_block_of_the_same_name_is_judged_anew() -> None:
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        await broken(pilot)
        pilot.block("next", composition="REPLACE")
        await pilot.advance(0.1)
        pilot.feedback.lines.clear()
        await broken(pilot)
        assert len(pilot.feedback.warnings) == 1


LIES = {
    "untied": (lambda offsets: offsets, "'n:start = w:end' is missed by 1 s (n:start, w:end; thesis 7.11)"),
    "early": (lambda offsets: [each - 0.4 for each in offsets], "w:start not before its block' is missed by 0.4 s"),
    "turned": (lambda offsets: offsets[::-1], "'w:start not after its end' is missed by 1 s"),
    "pressed": (lambda offsets: [0.0 for _ in offsets], "'w takes time' is missed by"),
}


@pytest.mark.parametrize("lie", LIES)
async def test_what_a_strategy_promises_and_does_not_keep_is_said_once(monkeypatch, lie) -> None:
    place, words = LIES[lie]

    def solve(self, problem):
        timings = {item.behavior.id: item.timing for item in problem.items}
        rows = {id_: zip(timing.points, place(timing.offsets), strict=True) for id_, timing in timings.items()}
        return Solution({id_: {sync: AtBlock(Anchor(), time) for sync, time in row} for id_, row in rows.items()}, ())

    monkeypatch.setattr(ConvexStrategy, "solve", solve)
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        pilot.block("b", '<wait id="w" duration="1"/><head id="n" lexeme="NOD" start="w:end"/>')
        await pilot.advance(3)
        told = [line.element.text for line in pilot.feedback.of("warningFeedback") if line.id == "b"]
    assert sum(words in text for text in told) == 1
    assert len(set(told)) == len(told)


async def test_nobody_looks_unless_asked_to() -> None:
    async with open_pilot() as pilot:
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
