"""BML in, feedback out: blocks, ties and order."""

from collections.abc import AsyncIterator
from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

SPEECH_AND_NOD = """
    <speech id="say"><text>Well <sync id="now"/>then, let us begin.</text></speech>
    <head id="yes" lexeme="NOD" start="say:now" end="9"/>
"""


@pytest.fixture
async def pilot() -> AsyncIterator[RealizerPilot]:
    async with open_pilot() as pilot:
        yield pilot


async def test_a_nod_between_two_absolute_times_starts_and_ends_there(pilot: RealizerPilot) -> None:
    pilot.block("b", '<head id="nod" lexeme="NOD" start="0" end="5"/>')
    await pilot.advance(6)
    assert (pilot.feedback.time("b:nod:start"), pilot.feedback.time("b:nod:end")) == (0.0, 5.0)
    assert pilot.feedback.time("b:end") == 5.0


async def test_a_nod_tied_to_a_word_starts_at_the_word(pilot: RealizerPilot) -> None:
    pilot.block("b", SPEECH_AND_NOD)
    await pilot.advance(10)
    told = pilot.feedback
    assert told.time("b:yes:start") == told.time("b:say:now") > told.time("b:say:start") > 0.0
    assert told.time("b:yes:end") == 9.0
    assert told.time("b:yes:end") - told.time("b:yes:start") < 1.0  # nothing makes it last longer than it prefers


async def test_a_synchronize_with_a_number_places_the_whole_cluster(pilot: RealizerPilot) -> None:
    pilot.block(
        "b",
        """
        <speech id="say"><text>Welcome <sync id="s"/>ladies and gentlemen!</text></speech>
        <head id="nod" lexeme="NOD" start="say:start"/>
        <constraint><synchronize><sync ref="say:s"/><sync ref="10"/></synchronize></constraint>
        """,
    )
    await pilot.advance(14)
    told = pilot.feedback
    assert told.time("b:say:s") == 10.0
    assert told.time("b:say:start") == told.time("b:nod:start") < 10.0 < told.time("b:say:end")


async def test_every_sync_point_is_reported_once_in_order_between_the_start_and_end_of_its_block(
    pilot: RealizerPilot,
) -> None:
    pilot.block("b", '<gesture id="g" lexeme="BEAT"/>')
    await pilot.advance(5)
    points = [f"b:g:{sync}" for sync in ("start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end")]
    assert [point for point in pilot.feedback.progress if point != "b:relax"] == ["b:start", *points, "b:end"]


async def test_a_block_subsides_when_all_its_behaviors_retract(pilot: RealizerPilot) -> None:
    pilot.block("b", '<gesture id="g" lexeme="BEAT"/><wait id="w" duration="0.2"/>')
    await pilot.advance(5)
    assert pilot.feedback.time("b:relax") == pilot.feedback.time("b:g:relax")
    assert pilot.feedback.progress[-4:] == ["b:g:relax", "b:relax", "b:g:end", "b:end"]
    assert pilot.feedback.status("b", "relax") == "SUBSIDING"


async def test_a_block_subsides_while_its_behaviors_retract_when_the_last_other_one_is_dropped(
    pilot: RealizerPilot,
) -> None:
    pilot.block("first", '<wait id="w" duration="9"/>')
    pilot.block("later", '<wait id="w" duration="1"/>', composition="APPEND")
    pilot.block("b", '<gesture id="g" lexeme="BEAT"/><wait id="w" duration="1" start="later:w:start"/>')
    while not pilot.feedback.reached("b:g:relax"):
        await pilot.tick()
    pilot.block("stop", **{"bmla:interrupt": "later"})
    await pilot.tick()
    stopped = pilot.feedback.time("later:end")
    await pilot.tick()
    assert pilot.feedback.time("b:relax") == stopped
    assert not pilot.feedback.reached("b:g:end")


async def test_a_block_without_a_retraction_ends_without_subsiding(pilot: RealizerPilot) -> None:
    pilot.block("b", '<wait id="w" duration="0.2"/>')
    await pilot.advance(1)
    assert pilot.feedback.progress == ["b:start", "b:w:start", "b:w:end", "b:end"]


async def test_an_empty_block_starts_and_ends_in_one_tick(pilot: RealizerPilot) -> None:
    pilot.block("b")
    await pilot.tick()
    assert pilot.feedback.progress == ["b:start", "b:end"]
    assert pilot.feedback.status("b") == "DONE"


async def test_one_of_two_simultaneous_gazes_is_dropped_with_one_warning(pilot: RealizerPilot) -> None:
    gaze = '<gaze id="{}" start="1" end="4" influence="HEAD" target="bluebox"/>'
    pilot.block("b", gaze.format("left") + gaze.format("also"))
    await pilot.advance(5)
    assert pilot.feedback.warnings == [("b:left", "IMPOSSIBLE_TO_SCHEDULE")]
    assert not pilot.feedback.reached("b:left:start")
    assert pilot.feedback.time("b:also:end") == pilot.feedback.time("b:end") == 4.0


async def test_an_appended_block_starts_exactly_at_the_end_of_the_last_block(pilot: RealizerPilot) -> None:
    pilot.block("one", '<wait id="w" duration="0.1234"/>')
    pilot.block("two", '<wait id="w" duration="0.1"/>', composition="APPEND")
    pilot.block("three", '<wait id="w" duration="0.1"/>', composition="APPEND")
    await pilot.advance(0.5)
    assert pilot.feedback.time("two:start") == pilot.feedback.time("one:end") == 0.1234
    assert pilot.feedback.time("three:end") == 0.3234


async def test_replace_interrupts_playing_and_revokes_waiting_blocks_before_the_new_block_starts(
    pilot: RealizerPilot,
) -> None:
    pilot.block("old", '<speech id="say"><text>One two three four five six.</text></speech>')
    pilot.block("next", '<wait id="w" duration="1"/>', composition="APPEND")
    await pilot.advance(0.5)
    pilot.block("new", '<head id="h" lexeme="NOD"/>', composition="REPLACE")
    await pilot.advance(3)
    told = pilot.feedback
    assert (told.status("old"), told.status("next"), told.status("new")) == ("INTERRUPTED", "REVOKED", "DONE")
    assert told.time("old:say:end") == told.time("old:end") == told.time("new:start") == 0.5
    assert not told.reached("next:start")
    assert told.progress.index("old:end") < told.progress.index("new:start")


async def test_an_interrupted_speech_reports_its_last_word(pilot: RealizerPilot) -> None:
    pilot.block("old", '<speech id="say"><text>One two three four five six.</text></speech>')
    await pilot.advance(0.5)
    pilot.block("stop", composition="REPLACE")
    await pilot.tick()
    end = next(line for line in pilot.feedback.messages if line.id == "old:say:end").element
    told = {
        str(name).partition("}")[2]: value
        for name, value in end.attrib.items()
        if str(name).startswith("{urn:reactive")
    }
    assert told == {"word": "2", "text": "three", "heard": "13"}


async def test_a_required_behavior_that_fails_fails_its_block(pilot: RealizerPilot) -> None:
    before = pilot.realizer.board.snapshot()
    pilot.block(
        "b",
        """
        <speech id="say"><text>Never heard.</text></speech>
        <required><gesture id="g" lexeme="NO-SUCH-GESTURE"/></required>
        """,
    )
    await pilot.advance(1)
    assert pilot.feedback.warnings == [("b:g", "CANNOT_CREATE_BEHAVIOR")]
    assert pilot.feedback.progress == ["b:end"]
    assert pilot.feedback.status("b") == "FAILED"
    assert pilot.realizer.board.snapshot() == before


async def test_behaviors_that_no_engine_plays_are_reported_and_the_rest_plays(tmp_path: Path) -> None:
    human = tmp_path / "human.toml"
    human.write_text('[character.alice]\nengines = ["animation"]')
    async with open_pilot(SceneOptions(human, voice="text")) as pilot:
        pilot.block("b", '<face id="f"><faceLexeme lexeme="OPEN_MOUTH"/></face><head id="h" lexeme="NOD"/>')
        await pilot.advance(3)
        assert pilot.feedback.warnings == [("b:f", "BEHAVIOR_TYPE_NOT_SUPPORTED")]
        assert pilot.feedback.reached("b:h:end")
