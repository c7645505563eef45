"""Interruption by `REPLACE`: what plays ends at the exact time, with feedback."""

from collections.abc import AsyncIterator
from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

HIT = "anticipators:test:hit"
GESTURE = '<gesture id="g" lexeme="BEAT" start="0" end="4"/>'


async def replace(pilot: RealizerPilot) -> None:
    pilot.block("new", composition="REPLACE")
    await pilot.tick()


def points(pilot: RealizerPilot, behavior: str) -> list[tuple[str, float]]:
    """Its sync points with their times, in order of report."""
    lines = (line for line in pilot.feedback.of("syncPointProgress") if line.id.startswith(f"{behavior}:"))
    return [(line.id.removeprefix(f"{behavior}:"), line.global_time) for line in lines]


async def test_future_points_are_cut_except_relax_and_end_which_happen_now(pilot: RealizerPilot) -> None:
    pilot.block("b", GESTURE)
    await pilot.advance(0.5)
    before = points(pilot, "b:g")
    await replace(pilot)
    await pilot.advance(5)
    assert points(pilot, "b:g") == [*before, ("relax", 0.5), ("end", 0.5)]
    assert pilot.feedback.status("b") == "INTERRUPTED"
    assert pilot.feedback.warnings == []


async def test_a_behavior_past_its_relax_only_gets_its_end(pilot: RealizerPilot) -> None:
    pilot.block("b", '<gesture id="g" lexeme="BEAT" start="0" relax="0.7" end="4"/>')
    await pilot.advance(1)
    assert points(pilot, "b:g")[-1] == ("relax", 0.7)
    await replace(pilot)
    assert points(pilot, "b:g")[-2:] == [("relax", 0.7), ("end", 1.0)]


async def test_points_that_are_due_come_first_with_their_own_times(pilot: RealizerPilot) -> None:
    pilot.block("b", '<wait id="w" duration="0.995"/><wait id="v" duration="3"/>')
    await pilot.advance(1)
    await replace(pilot)
    assert pilot.feedback.time("b:w:end") == 0.995
    assert pilot.feedback.time("b:v:end") == pilot.feedback.time("b:end") == 1.0


async def test_a_block_whose_last_point_is_due_is_done_and_not_interrupted(pilot: RealizerPilot) -> None:
    pilot.block("b", '<wait id="w" duration="0.995"/>')
    await pilot.advance(1)
    await replace(pilot)
    assert pilot.feedback.status("b") == "DONE"
    assert pilot.feedback.time("b:end") == 0.995


async def test_a_behavior_whose_start_is_due_starts_and_ends_at_once(pilot: RealizerPilot) -> None:
    pilot.block("b", '<wait id="w" start="0.995" duration="1"/>')
    await pilot.advance(1)
    await replace(pilot)
    assert points(pilot, "b:w") == [("start", 0.995), ("end", 1.0)]


async def test_a_behavior_whose_points_lost_their_order_is_removed_when_it_is_cut_at_its_start(
    pilot: RealizerPilot,
) -> None:
    events = "anticipators:events"
    pilot.block("b", f'<pointing id="p" target="bluebox" ready="{events}:early-0.3" start="{events}:late"/>')
    pilot.block("i", f'<bmla:interrupt id="i" target="b" start="{events}:late"/>')
    await pilot.advance(1)
    pilot.event("events", "early")
    await pilot.advance(3)
    pilot.event("events", "late")
    await pilot.advance(1)
    assert points(pilot, "b:p") == []


async def test_behaviors_that_have_not_started_are_removed_without_feedback(pilot: RealizerPilot) -> None:
    pilot.block("b", f'<head id="later" lexeme="NOD" start="3"/><head id="never" lexeme="NOD" start="{HIT}"/>')
    await pilot.advance(1)
    await replace(pilot)
    await pilot.advance(4)
    assert pilot.feedback.progress == ["b:start", "b:end", "new:start", "new:end"]
    assert pilot.feedback.status("b") == "INTERRUPTED"
    assert pilot.feedback.warnings == []


async def test_replaced_blocks_end_in_order_of_arrival_before_the_new_block_starts(pilot: RealizerPilot) -> None:
    pilot.block("one", GESTURE)
    pilot.block("two", composition="APPEND")
    pilot.block("three", f'<head id="h" lexeme="NOD" start="{HIT}"/>')
    pilot.block("four", composition="APPEND")
    await pilot.advance(0.5)
    said = len(pilot.feedback.progress)
    pilot.block("new", '<wait id="w" duration="1"/>', composition="REPLACE")
    await pilot.tick()
    told = pilot.feedback
    ends = [id_ for id_ in told.progress[said:] if id_.count(":") == 1]
    assert ends[-1] == "new:start"
    assert sorted(ends[:-1]) == ["four:end", "one:end", "three:end", "two:end"]
    states = {block: told.status(block) for block in ("one", "two", "three", "four")}
    assert states == {"one": "INTERRUPTED", "two": "REVOKED", "three": "INTERRUPTED", "four": "REVOKED"}


async def test_a_block_that_arrived_in_the_same_tick_is_revoked(pilot: RealizerPilot) -> None:
    pilot.block("old", GESTURE)
    pilot.block("new", composition="REPLACE")
    await pilot.tick()
    assert pilot.feedback.progress == ["old:end", "new:start", "new:end"]
    assert pilot.feedback.status("old") == "REVOKED"


# --- what others had tied to it


@pytest.fixture
async def two(tests_data: Path) -> AsyncIterator[RealizerPilot]:
    async with open_pilot(SceneOptions(human=tests_data / "humans" / "two.toml", voice="text")) as pilot:
        yield pilot


async def test_a_behavior_of_another_character_tied_to_a_cut_point_keeps_its_time_with_a_warning(
    two: RealizerPilot,
) -> None:
    two.block("a", GESTURE, characterId="alice")
    two.block("b", '<head id="h" lexeme="NOD" start="a:g:end" end="a:g:end+1"/>', characterId="bob")
    await two.advance(1)
    two.block("new", characterId="alice", composition="REPLACE")
    await two.tick()
    told = two.feedback
    assert told.warnings == [("b:h", "IMPOSSIBLE_TO_SCHEDULE")]
    assert "a:g:end was interrupted" in told.of("warningFeedback")[0].text
    await two.advance(5)
    assert (told.time("a:g:end"), told.time("b:h:start"), told.time("b:h:end")) == (1.0, 4.0, 5.0)
    assert told.status("b") == "DONE"


async def test_a_behavior_tied_to_a_cut_point_without_a_time_is_dropped(two: RealizerPilot) -> None:
    two.block("a", f'<head id="h" lexeme="NOD" start="{HIT}"/>', characterId="alice")
    two.block("b", '<head id="h" lexeme="NOD" start="a:h:end"/><wait id="w" duration="2"/>', characterId="bob")
    await two.advance(1)
    two.block("new", characterId="alice", composition="REPLACE")
    await two.advance(3)
    assert two.feedback.warnings == [("b:h", "IMPOSSIBLE_TO_SCHEDULE")]
    assert not two.feedback.reached("b:h:start")
    assert two.feedback.time("b:end") == 2.0


async def test_a_behavior_tied_to_a_revoked_block_is_dropped(two: RealizerPilot) -> None:
    two.block("first", GESTURE, characterId="alice")
    two.block("a", GESTURE, characterId="alice", composition="APPEND")
    two.block("b", '<head id="h" lexeme="NOD" start="a:g:stroke"/>', characterId="bob")
    await two.advance(1)
    two.block("new", characterId="alice", composition="REPLACE")
    await two.advance(3)
    assert two.feedback.warnings == [("b:h", "IMPOSSIBLE_TO_SCHEDULE")]
    assert two.feedback.status("b") == "DONE"


async def test_blocks_that_are_replaced_together_cause_no_warnings(pilot: RealizerPilot) -> None:
    pilot.block("a", GESTURE)
    pilot.block("b", '<head id="h" lexeme="NOD" start="a:g:end" end="a:g:end+1"/>')
    await pilot.advance(1)
    await replace(pilot)
    assert pilot.feedback.warnings == []


# --- two characters


async def test_replace_affects_only_its_own_character(two: RealizerPilot) -> None:
    for who in ("alice", "bob"):
        two.block("b", GESTURE, characterId=who)
    await two.advance(1)
    two.block("new", characterId="bob", composition="REPLACE")
    await two.advance(4)
    ends = [
        (line.element.get("characterId"), line.global_time) for line in two.feedback.messages if line.id == "b:g:end"
    ]
    assert ends == [("bob", 1.0), ("alice", 4.0)]


async def test_characters_may_use_equal_ids_and_an_appended_block_waits_for_its_own_character(
    two: RealizerPilot,
) -> None:
    two.block("b", '<wait id="w" duration="1"/>', characterId="alice")
    two.block("b", '<wait id="w" duration="2"/>', characterId="bob")
    two.block("next", characterId="alice", composition="APPEND")
    await two.advance(3)
    assert two.feedback.time("next:start") == 1.0
    assert two.feedback.warnings == []


async def test_a_block_without_a_character_is_for_the_first_one(two: RealizerPilot) -> None:
    two.block("b")
    await two.tick()
    assert {line.element.get("characterId") for line in two.feedback.messages} == {"alice"}


async def test_characters_do_not_share_resources(two: RealizerPilot) -> None:
    both = '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND"/><speech id="s"><text>Together now.</text></speech>'
    for who in ("alice", "bob"):
        two.block("b", both, characterId=who)
    await two.advance(5)
    assert two.feedback.warnings == []
    assert two.feedback.progress.count("b:end") == 2
