"""What plays is ended by what replaces it, at its very time, and says so."""

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


async def test_points_ahead_are_cut_except_relax_and_end_which_come_now(pilot: RealizerPilot) -> None:
    pilot.block("b", GESTURE)
    await pilot.advance(0.5)
    before = points(pilot, "b:g")
    await replace(pilot)
    await pilot.advance(5)
    assert points(pilot, "b:g") == [*before, ("relax", 0.5), ("end", 0.5)]
    assert pilot.feedback.status("b") == "INTERRUPTED"
    assert pilot.feedback.warnings == []


async def test_past_its_relax_a_behavior_gets_its_end_alone(pilot: RealizerPilot) -> None:
    pilot.block("b", '<gesture id="g" lexeme="BEAT" start="0" relax="0.5" end="4"/>')
    await pilot.advance(1)
    assert points(pilot, "b:g")[-1] == ("relax", 0.5)
    await replace(pilot)
    assert points(pilot, "b:g")[-2:] == [("relax", 0.5), ("end", 1.0)]


async def test_points_that_are_due_come_first_with_their_own_times(pilot: RealizerPilot) -> None:
    pilot.block("b", '<wait id="w" duration="0.995"/><wait id="v" duration="3"/>')
    await pilot.advance(1)
    await replace(pilot)
    assert pilot.feedback.time("b:w:end") == 0.995
    assert pilot.feedback.time("b:v:end") == pilot.feedback.time("b:end") == 1.0


async def test_a_block_whose_last_point_is_just_due_is_done_and_not_interrupted(pilot: RealizerPilot) -> None:
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


async def test_behaviors_that_have_not_started_vanish_without_a_word(pilot: RealizerPilot) -> None:
    pilot.block("b", f'<head id="later" lexeme="NOD" start="3"/><head id="never" lexeme="NOD" start="{HIT}"/>')
    await pilot.advance(1)
    await replace(pilot)
    await pilot.advance(4)
    assert pilot.feedback.progress == ["b:start", "b:end", "new:start", "new:end"]
    assert pilot.feedback.status("b") == "INTERRUPTED"
    assert pilot.feedback.warnings == []


async def test_everything_ends_before_what_replaces_it_starts_in_order_of_arrival(pilot: RealizerPilot) -> None:
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


async def test_what_another_character_had_tied_to_a_cut_point_keeps_its_time_and_is_warned(two: RealizerPilot) -> None:
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


async def test_what_hangs_on_a_point_that_never_comes_and_has_no_time_is_dropped(two: RealizerPilot) -> None:
    two.block("a", f'<head id="h" lexeme="NOD" start="{HIT}"/>', characterId="alice")
    two.block("b", '<head id="h" lexeme="NOD" start="a:h:end"/><wait id="w" duration="2"/>', characterId="bob")
    await two.advance(1)
    two.block("new", characterId="alice", composition="REPLACE")
    await two.advance(3)
    assert two.feedback.warnings == [("b:h", "IMPOSSIBLE_TO_SCHEDULE")]
    assert not two.feedback.reached("b:h:start")
    assert two.feedback.time("b:end") == 2.0


async def test_what_hangs_on_a_block_that_is_revoked_is_dropped(two: RealizerPilot) -> None:
    two.block("first", GESTURE, characterId="alice")
    two.block("a", GESTURE, characterId="alice", composition="APPEND")
    two.block("b", '<head id="h" lexeme="NOD" start="a:g:stroke"/>', characterId="bob")
    await two.advance(1)
    two.block("new", characterId="alice", composition="REPLACE")
    await two.advance(3)
    assert two.feedback.warnings == [("b:h", "IMPOSSIBLE_TO_SCHEDULE")]
    assert two.feedback.status("b") == "DONE"


async def test_blocks_that_are_replaced_together_do_not_warn_of_each_other(pilot: RealizerPilot) -> None:
    pilot.block("a", GESTURE)
    pilot.block("b", '<head id="h" lexeme="NOD" start="a:g:end" end="a:g:end+1"/>')
    await pilot.advance(1)
    await replace(pilot)
    assert pilot.feedback.warnings == []


# --- two characters


async def test_one_character_is_replaced_and_the_other_goes_on(two: RealizerPilot) -> None:
    for who in ("alice", "bob"):
        two.block("b", GESTURE, characterId=who)
    await two.advance(1)
    two.block("new", characterId="bob", composition="REPLACE")
    await two.advance(4)
    ends = [
        (line.element.get("characterId"), line.global_time) for line in two.feedback.messages if line.id == "b:g:end"
    ]
    assert ends == [("bob", 1.0), ("alice", 4.0)]


async def test_the_same_id_may_be_alive_once_a_character_and_append_waits_for_ones_own(two: RealizerPilot) -> None:
    two.block("b", '<wait id="w" duration="1"/>', characterId="alice")
    two.block("b", '<wait id="w" duration="2"/>', characterId="bob")
    two.block("next", characterId="alice", composition="APPEND")
    await two.advance(3)
    assert two.feedback.time("next:start") == 1.0
    assert two.feedback.warnings == []


async def test_a_block_without_a_character_goes_to_the_first(two: RealizerPilot) -> None:
    two.block("b")
    await two.tick()
    assert {line.element.get("characterId") for line in two.feedback.messages} == {"alice"}


async def test_two_characters_may_use_their_right_arms_and_voices_at_once(two: RealizerPilot) -> None:
    both = '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND"/><speech id="s"><text>Together now.</text></speech>'
    for who in ("alice", "bob"):
        two.block("b", both, characterId=who)
    await two.advance(5)
    assert two.feedback.warnings == []
    assert two.feedback.progress.count("b:end") == 2
