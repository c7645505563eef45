"""Blocks: composition, start times, ids and references."""

import pytest

from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.pegboard.peg_key import PegKey
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.testing.pilot import RealizerPilot

WAIT = '<wait id="w" duration="{}"/>'
HIT = "anticipators:test:hit"


async def test_a_merged_block_starts_at_once_beside_playing_blocks(pilot: RealizerPilot) -> None:
    pilot.block("one", WAIT.format(1))
    await pilot.advance(0.3)
    pilot.block("two", WAIT.format(0.1))
    await pilot.advance(1)
    told = pilot.feedback
    assert (told.time("two:start"), told.time("two:end")) == pytest.approx((0.3, 0.4))
    assert told.time("one:end") == 1.0


async def test_an_appended_block_waits_for_all_earlier_blocks_and_for_no_later_one(pilot: RealizerPilot) -> None:
    pilot.block("short", WAIT.format(0.2))
    pilot.block("long", WAIT.format(0.5))
    pilot.block("last", WAIT.format(0.1), composition="APPEND")
    pilot.block("later", WAIT.format(3))
    await pilot.advance(4)
    assert pilot.feedback.time("last:start") == 0.5


async def test_an_appended_block_without_predecessors_starts_at_once(pilot: RealizerPilot) -> None:
    pilot.block("b", composition="APPEND")
    await pilot.tick()
    assert pilot.feedback.progress == ["b:start", "b:end"]


async def test_a_chain_of_appended_blocks_has_exact_times(pilot: RealizerPilot) -> None:
    for number in range(50):
        pilot.block(f"b{number}", WAIT.format(0.0123), composition="APPEND")
    await pilot.advance(0.7)
    assert pilot.feedback.time("b49:end") == pytest.approx(50 * 0.0123)
    starts = [pilot.feedback.time(f"b{n}:start") for n in range(1, 50)]
    assert starts == [pilot.feedback.time(f"b{n}:end") for n in range(49)]


async def test_blocks_that_need_more_than_100_rounds_of_a_tick_fail(pilot: RealizerPilot) -> None:
    pilot.block("beside", f'<head id="h" lexeme="NOD" end="{HIT}"/>')
    await pilot.tick()
    for number in range(300):
        pilot.block(f"b{number}", composition="APPEND" if number else "MERGE")
    await pilot.advance(0.1)
    pilot.predict("test", "hit", 0.2)
    await pilot.advance(0.2)
    told = pilot.feedback
    failed = [f"b{n}" for n in range(300) if told.status(f"b{n}") == "FAILED"]
    assert len(failed) == 1
    assert told.warnings == [(failed[0], "EXECUTION_FAILURE")]
    assert told.status("b299") == told.status("beside") == "DONE"


async def test_a_block_waits_for_an_unknown_point_and_appended_blocks_wait_with_it(
    pilot: RealizerPilot,
) -> None:
    pilot.block("b", f'<head id="h" lexeme="NOD" end="{HIT}"/>')
    pilot.block("next", composition="APPEND")
    await pilot.advance(1)
    assert pilot.feedback.progress == ["b:start"]
    pilot.predict("test", "hit", 2.0)
    await pilot.advance(1.5)
    assert pilot.feedback.time("next:start") == pilot.feedback.time("b:end") == 2.0


async def test_an_id_may_be_used_again_once_its_block_has_ended(pilot: RealizerPilot) -> None:
    pilot.block("b", WAIT.format(0.1))
    await pilot.advance(0.5)
    pilot.block("b", WAIT.format(0.2))
    await pilot.advance(0.5)
    assert pilot.feedback.progress == ["b:start", "b:w:start", "b:w:end", "b:end"] * 2
    assert pilot.feedback.warnings == []


async def test_a_block_with_the_id_of_a_live_block_is_refused(pilot: RealizerPilot) -> None:
    pilot.block("b", WAIT.format(0.3))
    await pilot.advance(0.1)
    pilot.block("b", WAIT.format(5))
    await pilot.advance(1)
    assert pilot.feedback.warnings == [("b", "PARSING_FAILURE")]
    assert pilot.feedback.time("b:end") == 0.3


async def test_a_block_whose_behaviors_were_all_dropped_still_starts_and_ends(pilot: RealizerPilot) -> None:
    pilot.block("b", '<gesture id="g" lexeme="NO-SUCH"/><faceLexeme id="h" lexeme="RAISE_BROWS" start="3" end="3"/>')
    await pilot.tick()
    assert pilot.feedback.progress == ["b:start", "b:end"]
    assert pilot.feedback.warnings == [("b:g", "CANNOT_CREATE_BEHAVIOR"), ("b:h", "IMPOSSIBLE_TO_SCHEDULE")]


async def test_the_log_has_one_info_line_for_each_block(pilot: RealizerPilot, caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level("INFO"):
        pilot.block("one", WAIT.format(0.1))
        pilot.block("two", composition="APPEND")
        await pilot.advance(0.5)
    assert [record.getMessage() for record in caplog.records if record.levelname == "INFO"] == [
        "alice/one DONE at 0.10 s, 1 behaviors",
        "alice/two DONE at 0.10 s, 0 behaviors",
    ]


# --- points of other blocks


async def test_a_behavior_follows_a_point_of_another_block(pilot: RealizerPilot) -> None:
    pilot.predict("test", "hit", 1.0)
    pilot.block("one", f'<head id="h" lexeme="NOD" end="{HIT}"/>')
    pilot.block("two", '<head id="h" lexeme="NOD" start="one:h:end+0.5"/>')
    await pilot.advance(0.2)
    pilot.predict("test", "hit", 1.4)
    await pilot.advance(4)
    assert pilot.feedback.time("two:h:start") == pytest.approx(pilot.feedback.time("one:h:end") + 0.5)
    assert pilot.feedback.time("one:h:end") == 1.4


async def test_a_time_may_be_an_offset_from_the_start_of_another_block(pilot: RealizerPilot) -> None:
    pilot.block("one", WAIT.format(2))
    await pilot.advance(0.5)
    pilot.block("two", '<head id="h" lexeme="NOD" start="one:1.5"/>')
    await pilot.advance(4)
    assert pilot.feedback.time("two:h:start") == 1.5


async def test_a_block_that_has_ended_cannot_be_referenced(pilot: RealizerPilot) -> None:
    pilot.block("one", WAIT.format(0.1))
    await pilot.advance(0.5)
    pilot.block("two", '<head id="h" lexeme="NOD" start="one:w:end"/><head id="i" lexeme="NOD"/>')
    await pilot.advance(3)
    assert pilot.feedback.warnings == [("two:h", "IMPOSSIBLE_TO_SCHEDULE")]
    assert pilot.feedback.reached("two:i:end")


async def test_absolute_times_are_relative_to_the_start_of_the_block(pilot: RealizerPilot) -> None:
    pilot.block("one", WAIT.format(0.7))
    pilot.block("two", '<head id="h" lexeme="NOD" start="0.5" end="1"/>', composition="APPEND")
    await pilot.advance(3)
    end = next(line for line in pilot.feedback.messages if line.id == "two:h:end").element
    assert (end.get("time"), end.get("globalTime")) == ("1", "1.7")


# --- a plan is committed whole or not at all

LAST_FAILS = """
    <speech id="say"><text>Never heard.</text></speech>
    <gesture id="g" lexeme="BEAT" stroke="anticipators:new:hit"/>
    <head id="h" lexeme="NOD" start="other:w:end"/>
    <required>{}</required>
"""


@pytest.mark.parametrize(
    ("last", "warning"),
    [
        ('<gesture id="last" lexeme="NO-SUCH"/>', "CANNOT_CREATE_BEHAVIOR"),
        ('<gaze id="last" target="nowhere"/>', "NO_SUCH_TARGET"),
        ('<locomotion id="last" target="bluebox" manner="FLY"/>', "CANNOT_CREATE_BEHAVIOR"),
        ('<head id="last" lexeme="NOD" start="3" end="2"/>', "IMPOSSIBLE_TO_SCHEDULE"),
        ('<head id="last" lexeme="NOD" start="nobody:end"/>', "IMPOSSIBLE_TO_SCHEDULE"),
        ('<head id="last" lexeme="NOD" start="-2"/>', "IMPOSSIBLE_TO_SCHEDULE"),
        ('<head id="last" lexeme="NOD" amount="7"/>', "PARSING_FAILURE"),
    ],
)
async def test_a_block_that_fails_at_its_last_required_behavior_leaves_nothing_behind(
    pilot: RealizerPilot, last: str, warning: str
) -> None:
    pilot.block("other", WAIT.format(1))
    await pilot.advance(0.1)
    board = pilot.realizer.board
    before, plans, said = board.snapshot(), plans_of(pilot), len(pilot.feedback.messages)
    dependents = {view.key: dependents_of(board, view.key) for view in before}
    pilot.block("b", LAST_FAILS.format(last))
    await pilot.tick()
    assert pilot.feedback.warnings == [("b:last", warning)]
    assert [line.id for line in pilot.feedback.messages[said:]] == ["b:last", "b:end"]
    assert pilot.feedback.status("b") == "FAILED"
    assert board.snapshot() == before
    assert plans_of(pilot) == plans
    assert {view.key: dependents_of(board, view.key) for view in before} == dependents
    await pilot.advance(3)
    assert pilot.feedback.progress[-2:] == ["other:w:end", "other:end"]


def dependents_of(board: PegBoard, key: PegKey) -> int:
    peg = board.get(key)
    assert peg is not None
    return len(peg.dependents)


def plans_of(pilot: RealizerPilot) -> list[tuple[PlanUnit, ...]]:
    engines = [engine for character in pilot.realizer.characters.values() for engine in character.engines]
    return [engine.player.units for engine in engines if isinstance(engine, DefaultEngine)]


async def test_contradictory_required_ties_fail_the_block(pilot: RealizerPilot) -> None:
    pilot.block(
        "b",
        """
        <head id="h" lexeme="NOD"/>
        <required>
          <constraint><synchronize><sync ref="h:start"/><sync ref="1"/></synchronize></constraint>
          <constraint><synchronize><sync ref="h:start"/><sync ref="2"/></synchronize></constraint>
        </required>
        """,
    )
    await pilot.tick()
    assert pilot.feedback.status("b") == "FAILED"
    assert pilot.feedback.warnings == [("b", "IMPOSSIBLE_TO_SCHEDULE")]


async def test_a_required_tie_is_kept_and_a_contradictory_one_is_dropped(pilot: RealizerPilot) -> None:
    pilot.block(
        "b",
        """
        <head id="h" lexeme="NOD" start="1"/>
        <required>
          <constraint><synchronize><sync ref="h:start"/><sync ref="2"/></synchronize></constraint>
        </required>
        """,
    )
    await pilot.advance(4)
    assert pilot.feedback.warnings == [("b:h", "IMPOSSIBLE_TO_SCHEDULE")]
    assert pilot.feedback.time("b:h:start") == 2.0
    assert pilot.feedback.status("b") == "DONE"


async def test_a_block_appended_to_a_failed_block_still_waits_for_the_blocks_before_it(
    pilot: RealizerPilot,
) -> None:
    pilot.block("long", '<wait id="w" duration="1"/>')
    pilot.block("bad", '<required><gesture id="g" lexeme="NO-SUCH"/></required>', composition="APPEND")
    pilot.block("next", '<wait id="w" duration="0.2"/>', composition="APPEND")
    await pilot.advance(2)
    assert pilot.feedback.status("bad") == "FAILED"
    assert pilot.feedback.time("next:start") == pilot.feedback.time("long:end") == 1.0


async def test_a_queue_plays_in_order_without_a_gap(pilot: RealizerPilot) -> None:
    for number in range(30):
        pilot.block(f"b{number}", '<wait id="w" duration="0.05"/>', composition="APPEND")
    await pilot.advance(2)
    starts = [pilot.feedback.time(f"b{number}:start") for number in range(30)]
    assert starts == pytest.approx([0.05 * number for number in range(30)])
