"""Constraints that cannot be kept, and blocks that are solved in the background."""

import pytest

from reactive_realizer.testing.assertions import assert_linked, assert_time
from reactive_realizer.testing.pilot import RealizerPilot

from .living_time import GO, HIT, LOST, after, before, moves, nod, synchronize, texts, wait

# --- required, limits of what can be


@pytest.mark.parametrize("kind", ["tie", "order", "behavior"])
async def test_a_required_constraint_that_cannot_be_met_fails_its_block_without_a_trace(
    pilot: RealizerPilot, kind: str
) -> None:
    parts = {
        "tie": wait("w", 1, start="0") + f"<required>{synchronize('w:end', '3')}</required>",
        "order": wait("w", 1, start="0") + f"<required>{after('2', 'w:start')}{before('1', 'w:start')}</required>",
        "behavior": f"<required>{nod('n', start='1', end='1')}</required>",
    }
    pilot.block("b", wait("other", 1) + parts[kind])
    await pilot.advance(4)
    if kind == "tie":  # what is not required makes room
        assert pilot.feedback.warnings == [("b:w", "IMPOSSIBLE_TO_SCHEDULE")]
        assert_time(pilot.feedback, "b:w:start", 2.0)
        return
    assert pilot.feedback.progress == ["b:end"]
    assert pilot.feedback.status("b") == "FAILED"


async def test_a_required_constraint_that_is_violated_while_playing_is_reported_like_others(
    pilot: RealizerPilot,
) -> None:
    pilot.predict("t", "hit", 1.0)
    pilot.block("b", wait("w", 1, start="0.5") + f"<required>{after(HIT, 'w:end')}</required>")
    await moves(pilot, 0.7, ("hit", 2.0), 2)
    assert [LOST in said for said in texts(pilot)] == [True]
    assert pilot.feedback.status("b") == "DONE"


async def test_other_behaviors_stretch_before_a_wait_exceeds_its_maximum(pilot: RealizerPilot) -> None:
    pilot.block(
        "b", nod("n", start="0") + '<wait id="w" max-wait="1" start="n:end"/>' + nod("m", start="w:end", end="3.4")
    )
    pilot.block("c", '<wait id="w" max-wait="1" start="0" end="3"/>')  # what its sync points say goes first
    await pilot.advance(9)
    assert_time(pilot.feedback, "b:w:end", pilot.feedback.time("b:w:start") + 1)
    assert_time(pilot.feedback, "b:m:end", 3.4)
    assert_time(pilot.feedback, "c:w:end", 3.0)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert (warning.id, warning.text.partition(": ")[2]) == (
        "c:w",
        "w from start to end is to last at most 1.00 s, lasts 3.00 s",
    )


async def test_a_self_contradictory_constraint_is_reported(pilot: RealizerPilot) -> None:
    pilot.block("b", wait("w", 1) + before("w:end", "w:end+1"))
    await pilot.advance(2)
    assert [
        "w:end+1 before w:end can never be satisfied and is dropped: it is off by 1.00 s" in said
        for said in texts(pilot)
    ] == [True]


# --- off the loop


async def test_a_block_solved_in_the_background_is_solved_again_if_outer_times_moved(pilot: RealizerPilot) -> None:
    chain = "".join(wait(f"w{i}", 0.05, start=f"w{i - 1}:end") for i in range(1, 60))
    pilot.predict("t", "hit", 9.0)
    pilot.block("big", wait("w0", 0.05, start=GO) + chain + nod("n", start="w59:end", end=HIT))
    pilot.predict("t", "go", 1.0)
    await pilot.tick()
    for time in (5.0, 4.2):
        pilot.predict("t", "hit", time)
        await pilot.tick()
    await pilot.advance(6)
    assert_time(pilot.feedback, "big:w0:start", 1.0)
    assert_time(pilot.feedback, "big:n:end", 4.2)
    assert_linked(pilot.feedback, "big:n:start", "big:w59:end")
    assert pilot.feedback.warnings == []


async def test_a_block_solved_in_the_background_is_committed_even_if_outer_times_keep_moving(
    pilot: RealizerPilot,
) -> None:
    chain = "".join(wait(f"w{i}", 0.05, start=f"w{i - 1}:end") for i in range(1, 60))
    pilot.block("big", wait("w0", 0.05) + chain + nod("n", end=HIT))
    for i in range(100):
        pilot.predict("t", "hit", 4.0 + i / 100)
        await pilot.tick()
    assert 0.0 < pilot.feedback.time("big:start") < 0.1
    await pilot.advance(5)
    assert_time(pilot.feedback, "big:n:end", 4.99)
