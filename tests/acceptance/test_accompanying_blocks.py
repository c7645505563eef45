"""Blocks that accompany others: their behaviors give way, and change nothing for what was asked for."""

from reactive_realizer.bml.names import OWN
from reactive_realizer.testing.pilot import RealizerPilot, block, open_pilot

TALK = f'<speech id="s" xmlns:rr="{OWN}" rr:words="true"><text>one two three four five six seven</text></speech>'


def accompany(pilot: RealizerPilot, behaviors: str, id_: str = "mine", accompanied: str = "talk") -> None:
    pilot.perform(block(id_, behaviors, **{"xmlns:rr": OWN, "rr:accompanies": accompanied}))


async def test_its_behaviors_play_with_the_words() -> None:
    async with open_pilot() as pilot:
        pilot.block("talk", TALK)
        accompany(pilot, '<head id="nod" lexeme="NOD" stroke="talk:s:word3+0.1"/>')
        await pilot.advance(3)
        assert pilot.feedback.time("mine:nod:stroke") == pilot.feedback.time("talk:s:word3") + 0.1
        assert pilot.feedback.status("mine") == "DONE"


async def test_a_behavior_that_was_asked_for_ends_one_on_the_same_part_as_if_it_were_done() -> None:
    async with open_pilot() as pilot:
        pilot.block("talk", f'{TALK}<head id="asked" lexeme="NOD" start="s:word3"/>')
        accompany(pilot, '<head id="tilt" lexeme="TILT" start="talk:s:word1" end="talk:s:word6"/>')
        await pilot.advance(3)
        assert pilot.feedback.time("mine:tilt:end") == pilot.feedback.time("talk:asked:start")
        assert (pilot.feedback.warnings, pilot.feedback.status("mine")) == ([], "DONE")


async def test_it_does_not_begin_while_one_that_was_asked_for_moves_the_same_part_of_the_body() -> None:
    async with open_pilot() as pilot:
        pilot.block("talk", f'{TALK}<gesture id="asked" lexeme="BEAT" start="0" end="s:end"/>')
        accompany(
            pilot,
            '<gesture id="beat" lexeme="OFFER" stroke="talk:s:word4"/>'
            '<head id="nod" lexeme="NOD" stroke="talk:s:word4"/>',
        )
        await pilot.advance(4)
        assert not pilot.feedback.reached("mine:beat:start")
        assert pilot.feedback.reached("mine:nod:end")
        assert pilot.feedback.warnings == []


async def test_a_nod_goes_with_a_gaze_that_was_asked_for_but_another_gaze_does_not() -> None:
    async with open_pilot() as pilot:
        pilot.block("talk", f'{TALK}<gaze id="look" target="viewer" start="0" end="s:end"/>')
        accompany(
            pilot,
            '<head id="nod" lexeme="NOD" stroke="talk:s:word3"/>'
            '<gaze id="away" target="bluebox" influence="EYES" start="talk:s:word3" end="talk:s:word5"/>',
        )
        await pilot.advance(4)
        assert pilot.feedback.reached("mine:nod:end")
        assert not pilot.feedback.reached("mine:away:start")


async def test_a_block_that_is_appended_does_not_wait_for_it() -> None:
    async with open_pilot() as pilot:
        pilot.block("talk", TALK)
        accompany(pilot, '<head id="tilt" lexeme="TILT" start="talk:s:word6" end="talk:s:end+2"/>')
        await pilot.advance(0.5)
        pilot.block("next", '<head id="nod" lexeme="NOD"/>', composition="APPEND")
        await pilot.advance(5)
        assert pilot.feedback.time("next:start") == pilot.feedback.time("talk:end")


async def test_a_gesture_has_the_same_times_wherever_it_has_left_the_hands() -> None:
    told = []
    for beat in ("", '<gesture id="beat" lexeme="OFFER" mode="RIGHT_HAND" relax="talk:s:end-0.1"/>'):
        async with open_pilot() as pilot:
            pilot.block("talk", TALK)
            accompany(pilot, beat)
            pilot.block("next", '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND"/>', **{"bmla:chunkAfter": "talk"})
            await pilot.advance(6)
            assert pilot.feedback.reached("mine:beat:relax") is bool(beat)
            told.append([pilot.feedback.time(f"next:g:{sync}") for sync in ("start", "ready", "stroke", "end")])
    assert told[0] == told[1]


async def test_it_ends_with_a_block_that_is_interrupted() -> None:
    async with open_pilot() as pilot:
        pilot.block("talk", TALK)
        accompany(
            pilot,
            '<head id="tilt" lexeme="TILT" start="talk:s:word0" end="talk:s:word6"/>'
            '<head id="nod" lexeme="NOD" stroke="talk:s:word5"/>',
        )
        await pilot.advance(0.6)
        pilot.block("stop", '<bmla:interrupt id="i" target="talk"/>')
        await pilot.advance(3)
        assert pilot.feedback.time("mine:end") == pilot.feedback.time("talk:end") == 0.6
        assert not pilot.feedback.reached("mine:nod:start")
        assert pilot.feedback.warnings == []


async def test_movements_that_have_begun_are_completed_when_its_block_is_done() -> None:
    async with open_pilot() as pilot:
        pilot.block("talk", TALK)
        accompany(
            pilot,
            '<head id="tilt" lexeme="TILT" start="talk:s:word6" end="talk:s:end+1"/>'
            '<head id="nod" lexeme="NOD" start="talk:s:end+0.5"/>',
        )
        await pilot.advance(5)
        assert pilot.feedback.time("mine:tilt:end") == pilot.feedback.time("talk:end") + 1
        assert not pilot.feedback.reached("mine:nod:start")


async def test_a_behavior_that_is_tied_to_a_speech_that_is_cut_is_removed() -> None:
    async with open_pilot() as pilot:
        pilot.block("talk", f'{TALK}<wait id="w" start="0" duration="3"/>')
        accompany(pilot, '<head id="nod" lexeme="NOD" stroke="talk:s:word6"/>')
        await pilot.advance(0.6)
        pilot.block("stop", '<bmla:interrupt id="i" target="talk" include="s"/>')
        await pilot.advance(4)
        assert not pilot.feedback.reached("mine:nod:start")
        assert (pilot.feedback.warnings, pilot.feedback.status("talk")) == ([], "DONE")


async def test_it_fails_if_nothing_is_there_to_accompany() -> None:
    async with open_pilot() as pilot:
        accompany(pilot, '<head id="nod" lexeme="NOD"/>', accompanied="talks")
        await pilot.advance(1)
        assert pilot.feedback.status("mine") == "FAILED"
        (warning,) = pilot.feedback.of("warningFeedback")
        assert "there is no live block 'talks' to accompany" in warning.text


async def test_a_mistake_in_it_is_warned_of() -> None:
    async with open_pilot() as pilot:
        pilot.block("talk", TALK)
        accompany(pilot, '<head id="nod" lexeme="NODD" stroke="talk:s:word2"/>')
        await pilot.advance(3)
        assert pilot.feedback.warnings == [("mine:nod", "CANNOT_CREATE_BEHAVIOR")]


async def test_an_expression_gives_way_to_a_facial_animation_parameter_that_was_asked_for() -> None:
    async with open_pilot() as pilot:
        pilot.block("talk", f'{TALK}<bmlt:facefap id="asked" fap="31" value="100" start="s:word3" end="s:end"/>')
        accompany(pilot, '<faceLexeme id="brows" lexeme="RAISE_BROWS" start="talk:s:word1" end="talk:s:word6"/>')
        await pilot.advance(3)
        assert pilot.feedback.time("mine:brows:end") == pilot.feedback.time("talk:asked:start")
