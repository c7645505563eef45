"""A speech begins when its first part is made; the rest is made while it sounds."""

from collections.abc import AsyncIterator
from itertools import pairwise

import pytest
import pytest_asyncio
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.names import BML, BMLT, OWN
from reactive_realizer.embodiment.audio import AudioMove, AudioStart, AudioStop
from reactive_realizer.engines.speech.text_voice import TextVoice
from reactive_realizer.realizer.inputs import TickInputs
from reactive_realizer.realizer.session import replay
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .streaming_voice import FakeStreamingVoice

TEXT = 'One two, three <sync id="m"/>four, five six.'
SPEECH = f'<speech id="s" xmlns:rr="{OWN}" rr:words="true"><text>{TEXT}</text></speech>'
# As estimated, and as made, s: one 0, two 0.24 | three 0.68, four 1.04, 1.22 | five 1.54, 1.97, six 1.84, 2.42.
FIRST = 0.68
SECOND = 1.97
DURATION = 2.69


@pytest.fixture
def voice(monkeypatch: pytest.MonkeyPatch) -> FakeStreamingVoice:
    return installed(monkeypatch)


def installed(monkeypatch: pytest.MonkeyPatch) -> FakeStreamingVoice:
    """A new voice, in place of the text voice."""
    voice = FakeStreamingVoice()
    monkeypatch.setattr(TextVoice, "synthesize", staticmethod(voice.synthesize))
    return voice


@pytest_asyncio.fixture
async def pilot(voice: FakeStreamingVoice) -> AsyncIterator[RealizerPilot]:
    """A pilot whose time goes on while clauses are made."""
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        pilot.patient = False
        yield pilot


async def begin(pilot: RealizerPilot, behaviors: str = "", speech: str = SPEECH) -> float:
    """Have a speech begin; its start."""
    pilot.block("b", speech + behaviors)
    while not pilot.feedback.reached("b:s:start"):
        await pilot.tick()
    return pilot.feedback.time("b:s:start")


def planned(pilot: RealizerPilot, start: float) -> dict[str, float]:
    """The times of points, s after a start."""
    pegs = {str(each.key).split("/")[-1]: each.time for each in pilot.realizer.board.snapshot()}
    return {key: round(time - start, 6) for key, time in pegs.items() if time is not None}


def clips(pilot: RealizerPilot) -> list[float]:
    """The starts of the sounds, as announced last."""
    starts = {each.clip.id: each.start for each in pilot.sounds if isinstance(each, AudioStart)}
    starts |= {each.id: each.start for each in pilot.sounds if isinstance(each, AudioMove)}
    return [start for start in starts.values() if start is not None]


async def test_points_ahead_move_when_more_is_made_and_what_is_tied_to_them_follows(
    pilot: RealizerPilot, voice: FakeStreamingVoice
) -> None:
    voice.hold(1)
    start = await begin(
        pilot,
        '<gesture id="beat" lexeme="BEAT" stroke="s:m"/><head id="nod" lexeme="NOD" stroke="s:word4+0.1"/>'
        '<wait id="after" start="s:end+0.2" duration="0.3"/><head id="own" lexeme="SHAKE" start="0.1" end="0.9"/>',
    )
    pilot.block("next", '<wait id="w" duration="0.1"/>', composition="APPEND")
    await pilot.advance(0.2)
    before = planned(pilot, start)
    assert [before[f"b:s:{sync}"] for sync in ("word1", "word2", "m", "word5", "end")] == [0.24, 0.68, 1.04, 1.84, 2.02]
    voice.let(2)
    await pilot.advance(0.1)
    after = planned(pilot, start)
    assert [after[f"b:s:{sync}"] for sync in ("word1", "word2", "m", "word5", "end")] == [0.24, 0.68, 1.22, 2.27, 2.45]
    voice.let()
    await pilot.advance(0.1)
    after = planned(pilot, start)
    assert after["b:s:end"] == DURATION
    assert after["b:beat:stroke"] == after["b:s:m"] == 1.22
    assert after["b:nod:stroke"] == SECOND + 0.1
    preparation = before["b:nod:stroke"] - before["b:nod:start"]
    assert after["b:nod:stroke"] - after["b:nod:start"] == pytest.approx(preparation), "it had not begun"
    assert after["b:after:start"] == DURATION + 0.2
    assert after["next:w:start"] == after["b:end"] == DURATION + 0.5
    assert [after[f"b:own:{sync}"] for sync in ("start", "end")] == [0.1, 0.9]
    assert pilot.feedback.predicted("b:s:end") == pytest.approx(start + DURATION)
    await pilot.advance(4)
    for key in ("b:s:word2", "b:s:m", "b:s:end", "b:beat:stroke", "b:nod:stroke", "b:after:start", "next:w:start"):
        assert pilot.feedback.time(key) - start == pytest.approx(after[key], abs=1e-6)
    assert pilot.feedback.warnings == []
    assert clips(pilot) == pytest.approx([start, start + FIRST, start + SECOND])


async def test_a_speech_waits_for_a_clause_that_is_not_there_and_no_word_is_told_before_it_sounds(
    pilot: RealizerPilot, voice: FakeStreamingVoice
) -> None:
    voice.hold(1)
    start = await begin(pilot, '<head id="nod" lexeme="NOD" stroke="s:m"/><wait id="own" duration="1.5"/>')
    while pilot.now < start + 1.2:
        await pilot.tick()
        assert not pilot.feedback.reached("b:s:word2")
        assert planned(pilot, 0.0)["b:s:word2"] >= pilot.now - 0.01
    asked = pilot.now
    voice.let()
    await pilot.advance(4)
    third = pilot.feedback.time("b:s:word2")
    assert asked + 0.05 <= third < asked + 0.1
    assert pilot.feedback.time("b:nod:stroke") == pytest.approx(third + 1.22 - FIRST)
    assert pilot.feedback.time("b:s:end") == pytest.approx(third + DURATION - FIRST)
    assert pilot.feedback.time("b:own:end") == start + 1.5
    assert clips(pilot) == pytest.approx([start, third, third + SECOND - FIRST])
    assert pilot.feedback.warnings == []


async def test_what_is_tied_to_words_before_a_pause_keeps_its_time_and_what_is_tied_to_words_after_it_waits(
    pilot: RealizerPilot, voice: FakeStreamingVoice
) -> None:
    voice.hold(1)
    start = await begin(
        pilot,
        '<faceLexeme id="brows" lexeme="RAISE_BROWS" end="s:word1+1"/><head id="nod" lexeme="NOD" stroke="s:m"/>'
        '<gaze id="away" target="camera" start="nod:stroke+0.4"/>',
    )
    pilot.block("mine", f'<faceLexeme id="smile" lexeme="SMILE" start="b:s:word1+1" end="b:s:m+1" xmlns:rr="{OWN}"/>')
    while pilot.now < start + 1.0:
        await pilot.tick()
    voice.let()
    await pilot.advance(6)
    told = pilot.feedback
    assert told.time("b:s:word2") > start + 1.0
    assert told.time("b:brows:end") == told.time("mine:smile:start") == pytest.approx(told.time("b:s:word1") + 1.0)
    assert told.time("b:nod:stroke") == told.time("b:s:m")
    assert told.time("mine:smile:end") == pytest.approx(told.time("b:s:m") + 1.0)
    assert told.time("b:away:start") == pytest.approx(told.time("b:nod:stroke") + 0.4)
    assert told.warnings == []


async def test_what_follows_a_gesture_waits_with_it_for_the_word_of_its_stroke(
    pilot: RealizerPilot, voice: FakeStreamingVoice
) -> None:
    voice.hold(1)
    start = await begin(
        pilot,
        '<gesture id="beat" lexeme="BEAT" stroke="s:m"/><wait id="soon" start="beat:relax+0.1" duration="0.2"/>'
        '<wait id="after" start="beat:end" duration="0.5"/>',
    )
    before = planned(pilot, start)
    while pilot.now < start + 1.2:
        await pilot.tick()
    voice.let()
    await pilot.advance(6)
    told = pilot.feedback
    later = told.time("b:s:m") - start - before["b:s:m"]
    assert later > 0.7
    assert told.time("b:beat:start") - start == pytest.approx(before["b:beat:start"]), "the gesture had begun"
    for key in ("b:beat:stroke", "b:beat:relax", "b:beat:end", "b:soon:start", "b:after:start", "b:after:end"):
        assert told.time(key) - start == pytest.approx(before[key] + later), key


@settings(max_examples=20, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(st.integers(0, 150), min_size=2, max_size=2), st.integers(0, 20))
async def test_every_clause_sounds_when_its_words_are_told_whenever_it_is_made(
    monkeypatch: pytest.MonkeyPatch, ticks: list[int], skipped: int
) -> None:
    with monkeypatch.context() as patch:
        voice = installed(patch)
        async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
            pilot.patient = False
            voice.hold(1)
            await begin(pilot)
            made: list[float] = []
            for clauses, count in enumerate(ticks, 2):
                for _ in range(count):
                    await pilot.tick()
                pilot.skip(skipped)
                made.append(pilot.now)
                voice.let(clauses)
            await pilot.advance(6)
            words = [pilot.feedback.time(f"b:s:word{index}") for index in range(6)]
            assert [words[0], words[2], words[4]] == pytest.approx(clips(pilot), abs=1e-6)
            assert all(one < other for one, other in pairwise(words))
            assert words[2] >= made[0]
            assert words[4] >= made[1]
            assert words[3] - words[2] == pytest.approx(0.54)
            assert words[5] - words[4] == pytest.approx(0.45)
            assert pilot.feedback.warnings == []
            assert pilot.feedback.status("b") == "DONE"


async def test_an_interruption_stops_all_its_sounds_and_cancels_what_is_not_made(
    pilot: RealizerPilot, voice: FakeStreamingVoice
) -> None:
    voice.hold(2)
    start = await begin(pilot)
    await pilot.advance(0.3)
    pilot.block("stop", '<bmla:interrupt id="i" target="b"/>')
    await pilot.advance(0.1)
    stops = [each for each in pilot.sounds if isinstance(each, AudioStop)]
    assert [each.id for each in stops] == ["alice-speech-1", "alice-speech-2"]
    assert all(each.time == pilot.feedback.time("b:s:end") and each.fade <= 0.02 for each in stops)
    assert voice.canceled == ["One two, three four, five six."]
    voice.let()
    await pilot.advance(3)
    assert len(clips(pilot)) == 2
    assert pilot.feedback.status("b") == "INTERRUPTED"
    assert pilot.feedback.time("b:s:end") < start + 0.4


async def test_after_the_next_word_ends_where_nothing_more_is_made(
    pilot: RealizerPilot, voice: FakeStreamingVoice
) -> None:
    voice.hold(1)
    start = await begin(pilot)
    await pilot.advance(0.4)
    pilot.block("stop", '<bmla:interrupt id="i" target="b" speech="word"/>')
    await pilot.advance(0.5)
    assert pilot.feedback.time("b:s:end") == pytest.approx(start + FIRST)
    (end,) = (line.element for line in pilot.feedback.of("syncPointProgress") if line.id == "b:s:end")
    assert end.get(f"{{{OWN}}}text") == "two"


async def test_a_speech_in_parts_that_finishes_its_clause_ends_before_the_next_part(
    pilot: RealizerPilot, voice: FakeStreamingVoice
) -> None:
    start = await begin(pilot)
    pilot.block("stop", '<bmla:interrupt id="i" target="b" speech="clause"/>')
    await pilot.advance(3)
    (end,) = (line.element for line in pilot.feedback.of("syncPointProgress") if line.id == "b:s:end")
    assert end.get(f"{{{OWN}}}text") == "two"
    assert pilot.feedback.time("b:s:end") == pytest.approx(start + FIRST)


async def test_a_clause_that_fails_ends_the_speech_before_it_and_nothing_else(
    pilot: RealizerPilot, voice: FakeStreamingVoice
) -> None:
    voice.fails_at = 1
    start = await begin(pilot, '<head id="nod" lexeme="NOD" stroke="s:m"/><wait id="own" duration="1.5"/>')
    await pilot.advance(3)
    assert pilot.feedback.time("b:s:end") == pytest.approx(start + FIRST)
    (end,) = (line.element for line in pilot.feedback.of("syncPointProgress") if line.id == "b:s:end")
    assert (end.get(f"{{{OWN}}}text"), end.get(f"{{{OWN}}}heard")) == ("two", "7")
    assert not pilot.feedback.reached("b:s:m")
    assert pilot.feedback.time("b:nod:stroke") == pytest.approx(start + 1.04), "as it was predicted last"
    assert pilot.feedback.time("b:own:end") == start + 1.5
    first, second = pilot.feedback.of("warningFeedback")
    assert first.text.endswith("its preparation failed: it lost its voice")
    assert second.text.endswith("the behavior of b:s:m is dropped; this behavior keeps the last predicted time")
    assert pilot.feedback.status("b") == "DONE"


async def test_a_speech_that_fails_before_it_begins_is_dropped(pilot: RealizerPilot, voice: FakeStreamingVoice) -> None:
    voice.hold(1)
    pilot.block("b", SPEECH + '<wait id="own" duration="0.5"/>', **{"bmla:preplan": "true"})
    await pilot.advance(0.2)
    voice.fails_at = 1
    voice.let()
    await pilot.advance(0.1)
    pilot.block("go", '<bmla:activate id="a" target="b"/>')
    await pilot.advance(1)
    assert not pilot.feedback.reached("b:s:start")
    assert pilot.feedback.reached("b:own:end")
    assert pilot.feedback.warnings == [("b:s", "CANNOT_CREATE_BEHAVIOR")]


async def test_a_block_that_waits_is_planned_again_with_what_is_made(
    pilot: RealizerPilot, voice: FakeStreamingVoice
) -> None:
    voice.hold(1)
    pilot.block("first", '<wait id="w" duration="1"/>')
    pilot.block("b", SPEECH + '<gesture id="beat" lexeme="BEAT" stroke="s:m" end="s:end"/>', composition="APPEND")
    await pilot.advance(0.3)
    assert pilot.feedback.predicted("b:s:m") == pytest.approx(2.04)
    voice.let()
    await pilot.advance(0.3)
    assert pilot.feedback.predicted("b:s:m") == pytest.approx(2.22)
    assert pilot.feedback.predicted("b:beat:end") == pytest.approx(1 + DURATION)
    await pilot.advance(4)
    assert pilot.feedback.time("b:beat:stroke") == pytest.approx(2.22)
    assert pilot.feedback.warnings == []


async def test_a_word_that_is_tied_to_a_prediction_keeps_it(pilot: RealizerPilot, voice: FakeStreamingVoice) -> None:
    voice.hold(1)
    pilot.predict("partner", "look", 3.0)
    tie = '<synchronize><sync ref="anticipators:partner:look"/><sync ref="s:m"/></synchronize>'
    pilot.block("b", f'{SPEECH}<constraint id="c">{tie}</constraint><wait id="own" duration="4"/>')
    await pilot.advance(0.3)
    assert planned(pilot, 0.0)["b:s:start"] == pytest.approx(1.96)
    voice.let()
    await pilot.advance(0.2)
    assert planned(pilot, 0.0)["b:s:start"] == pytest.approx(1.78)
    await pilot.advance(5)
    assert pilot.feedback.time("b:s:m") == pytest.approx(3.0)
    assert pilot.feedback.warnings == []


async def test_reports_on_any_of_its_sounds_move_the_speech(pilot: RealizerPilot, voice: FakeStreamingVoice) -> None:
    start = await begin(pilot)
    await pilot.advance(1.0)
    for _ in range(2):
        pilot.heard("alice-speech-2", pilot.now - (start + FIRST) - 0.15, pilot.now)
        await pilot.advance(0.1)
    after = planned(pilot, start)
    assert after["b:s:end"] == pytest.approx(DURATION + 0.15)
    assert after["b:s:m"] == pytest.approx(1.22 + 0.15)
    await pilot.advance(2)
    assert clips(pilot)[2] == pytest.approx(start + SECOND + 0.15)


async def test_the_uses_of_a_procedure_share_what_is_made(pilot: RealizerPilot, voice: FakeStreamingVoice) -> None:
    voice.hold(1)
    spaces = f'xmlns="{BML}" xmlns:bmlt="{BMLT}"'
    pilot.perform(f'<bmlt:defineproc {spaces} id="p">{SPEECH}</bmlt:defineproc>')
    for name in ("one", "two"):
        pilot.perform(f'<bmlt:useproc {spaces} procid="p" bmlid="{name}" composition="APPEND"/>')
    await pilot.advance(0.3)
    voice.let()
    await pilot.advance(7)
    for name in ("one", "two"):
        begun = pilot.feedback.time(f"{name}:s:start")
        assert pilot.feedback.time(f"{name}:s:end") == pytest.approx(begun + DURATION)
    assert len(voice.asked) == 1


async def test_what_is_complete_is_remembered(pilot: RealizerPilot, voice: FakeStreamingVoice) -> None:
    await begin(pilot)
    await pilot.advance(3)
    pilot.block("again", SPEECH)
    await pilot.tick()
    assert pilot.feedback.reached("again:s:start")
    assert planned(pilot, pilot.feedback.time("again:s:start"))["again:s:end"] == DURATION
    assert len(voice.asked) == 1


@pytest.mark.parametrize("fails_at", [None, 2])
async def test_a_replay_moves_the_same_points_at_the_same_ticks(
    voice: FakeStreamingVoice, fails_at: int | None
) -> None:
    inputs: list[TickInputs] = []
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        pilot.realizer.record(inputs.append)
        pilot.patient = False
        voice.hold(1)
        await begin(pilot, '<gesture id="beat" lexeme="BEAT" stroke="s:m"/>')
        pilot.block("next", SPEECH, composition="APPEND")
        await pilot.advance(0.91)
        voice.let(2)
        await pilot.advance(1.53)
        voice.fails_at = fails_at
        voice.let()
        await pilot.advance(6)
        live, sounds = [line.text for line in pilot.feedback.messages], pilot.sounds
    voice.fails_at = None
    async with open_pilot(SceneOptions(voice="text", verify=True)) as again:
        await replay(again.realizer, inputs)
        assert [line.text for line in again.feedback.messages] == live
        assert again.sounds == sounds
