"""Pegs that move while the body moves."""

from collections.abc import AsyncIterator

import numpy as np
import pytest

from reactive_realizer.reactive.graph import Commit
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

HIT = '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND" stroke="anticipators:test:hit"/>'


@pytest.fixture
async def pilot() -> AsyncIterator[RealizerPilot]:
    async with open_pilot() as pilot:
        pilot.watch()
        yield pilot


def steps(path: np.ndarray) -> np.ndarray:
    """How far a joint moved from each frame to the next, m."""
    distances: np.ndarray = np.linalg.norm(np.diff(path, axis=0), axis=1)
    return distances


async def test_the_stroke_follows_a_prediction_that_moves_while_the_arm_moves(pilot: RealizerPilot) -> None:
    pilot.predict("test", "hit", 1.5)
    pilot.block("b", HIT)
    pilot.block("next", '<head id="h" lexeme="NOD"/>', composition="APPEND")
    await pilot.tick()
    told = pilot.feedback
    length = told.predicted("b:end") - 1.5
    preparation = 1.5 - told.predicted("b:g:start")
    await pilot.advance(1.5 - preparation / 2)
    assert told.reached("b:g:start")
    assert not told.reached("b:g:ready")

    for moved in (1.8, 1.6):
        said = len(told.predictions("b"))
        pilot.predict("test", "hit", moved)
        await pilot.tick()
        assert len(told.predictions("b")) == said + 1
        assert told.predicted("b:g:stroke") == pytest.approx(moved)
        assert told.predicted("b:end") == told.predicted("next:start") == pytest.approx(moved + length)
        await pilot.advance(0.1)

    await pilot.advance(4)
    assert told.time("b:g:stroke") == pytest.approx(1.6)
    assert told.time("b:end") == told.time("next:start") == pytest.approx(1.6 + length)
    assert told.warnings == []
    path = pilot.path("r_wrist")
    assert np.ptp(path, axis=0).max() > 0.15, "the arm did not move"
    assert steps(path).max() < 0.05


async def test_a_behavior_waits_for_a_point_without_a_prediction(pilot: RealizerPilot) -> None:
    pilot.block("b", HIT)
    await pilot.advance(2)
    assert pilot.feedback.progress == ["b:start"]
    pilot.predict("test", "hit", 3.0)
    await pilot.advance(4)
    assert pilot.feedback.time("b:g:stroke") == 3.0
    assert pilot.feedback.status("b") == "DONE"


async def test_a_prediction_in_the_past_means_now(pilot: RealizerPilot) -> None:
    pilot.block("b", '<head id="h" lexeme="NOD" start="anticipators:test:go"/>')
    await pilot.advance(1)
    pilot.predict("test", "go", 0.2)
    await pilot.tick()
    assert pilot.feedback.time("b:h:start") == 1.0


async def test_a_repeated_prediction_changes_nothing(pilot: RealizerPilot) -> None:
    pilot.predict("test", "hit", 2.0)
    pilot.block("b", HIT)
    await pilot.advance(0.2)
    commits: list[Commit] = []
    said = len(pilot.feedback.messages)
    pilot.realizer.board.graph.listen(commits.append)
    pilot.predict("test", "hit", 2.0)
    await pilot.tick()
    assert commits == []
    assert len(pilot.feedback.messages) == said


async def test_a_reached_point_keeps_its_time_and_later_points_move(pilot: RealizerPilot) -> None:
    pilot.predict("test", "stop", 1.0)
    pilot.block(
        "b", '<gesture id="g" lexeme="BEAT" start="anticipators:test:stop-0.5" end="anticipators:test:stop+1"/>'
    )
    await pilot.advance(0.7)
    pilot.predict("test", "stop", 1.4)
    await pilot.advance(3)
    assert pilot.feedback.time("b:g:start") == 0.5
    assert pilot.feedback.time("b:g:end") == pytest.approx(2.4)


async def test_strokes_follow_the_tempo_of_the_metronome(pilot: RealizerPilot) -> None:
    pilot.block(
        "b",
        """
        <gesture id="one" lexeme="BEAT" mode="RIGHT_HAND" stroke="anticipators:metronome:tick2"/>
        <head id="nod" lexeme="NOD" stroke="anticipators:metronome:tick4"/>
        """,
    )
    await pilot.advance(2.5)
    pilot.event("metronome", "tempo", 120)
    await pilot.advance(2)
    assert pilot.feedback.time("b:one:stroke") == 2.0
    assert pilot.feedback.time("b:nod:stroke") == pytest.approx(3.0)


async def test_points_that_are_temporarily_out_of_order_cause_no_loss(pilot: RealizerPilot) -> None:
    pilot.predict("test", "hit", 1.0)
    pilot.predict("test", "end", 2.0)
    pilot.block("b", '<head id="n" lexeme="NOD" start="anticipators:test:hit" end="anticipators:test:end"/>')
    await pilot.advance(0.2)
    pilot.predict("test", "end", 0.8)
    await pilot.advance(0.1)
    pilot.predict("test", "end", 1.7)
    await pilot.advance(2)
    assert (pilot.feedback.time("b:n:start"), pilot.feedback.time("b:n:end")) == (1.0, 1.7)
    assert pilot.feedback.warnings == []


async def test_a_behavior_whose_start_moves_after_its_end_is_dropped_with_a_warning(pilot: RealizerPilot) -> None:
    pilot.predict("test", "hit", 1.0)
    pilot.predict("test", "end", 2.0)
    pilot.block("b", '<head id="n" lexeme="NOD" start="anticipators:test:hit" end="anticipators:test:end"/>')
    await pilot.advance(0.2)
    pilot.predict("test", "end", 0.8)
    await pilot.advance(2)
    assert pilot.feedback.warnings == [("b:n", "IMPOSSIBLE_TO_SCHEDULE")]
    assert pilot.feedback.status("b") == "DONE"


async def test_ties_to_an_overtaken_point_move_with_it_in_its_own_block_and_in_others(
    pilot: RealizerPilot,
) -> None:
    pilot.predict("test", "hit", 1.0)
    pilot.predict("test", "end", 2.0)
    nod = '<head id="n" lexeme="NOD" start="0" stroke="anticipators:test:hit" end="anticipators:test:end"/>'
    pilot.block("a", nod + '<wait id="own" start="n:stroke" duration="5"/>')
    pilot.block("b", '<wait id="other" start="a:n:stroke+0.5" duration="5"/>')
    await pilot.advance(0.5)
    pilot.predict("test", "hit", 3.0)
    await pilot.tick()
    told = pilot.feedback
    stroke = told.predicted("a:n:stroke")
    assert stroke == told.predicted("a:own:start") == pytest.approx(1.95, abs=0.01)
    assert told.predicted("b:other:start") == stroke + 0.5
    await pilot.advance(0.1)
    pilot.predict("test", "end", 4.0)
    await pilot.tick()
    assert told.predicted("a:n:stroke") == told.predicted("a:own:start") == 3.0
    assert told.predicted("b:other:start") == 3.5
    await pilot.advance(5)
    assert told.time("a:n:stroke") == told.time("a:own:start") == 3.0
    assert told.time("b:other:start") == 3.5


async def test_a_commit_never_has_a_playing_point_in_the_past_or_after_its_successor(pilot: RealizerPilot) -> None:
    pilot.predict("test", "hit", 4.0)
    pilot.predict("test", "end", 6.0)
    gesture = '<gesture id="g" lexeme="BEAT" stroke="anticipators:test:hit" end="anticipators:test:end"/>'
    pilot.block("a", gesture + '<head id="n" lexeme="NOD" start="g:ready" end="g:relax"/>')
    await pilot.tick()
    board, (block,) = pilot.realizer.board, pilot.realizer.scheduler.blocks.alive
    seen: list[tuple[bool, bool]] = []

    def check(commit: Commit) -> None:
        for unit in block.live_units:
            times = [point.peg.value or 0.0 for point in unit.ahead()]
            seen.append((min(times) >= board.previous, not unit.begun or times == sorted(times)))

    board.graph.listen(check)
    for sync, time in [("hit", 1.0), ("end", 0.8), ("hit", 3.0), ("end", 5.0), ("hit", 0.2), ("end", 0.3)]:
        await pilot.advance(0.1)
        pilot.predict("test", sync, time)
    await pilot.advance(4)
    assert set(seen) == {(True, True)}
    assert pilot.feedback.status("a") == "DONE"
