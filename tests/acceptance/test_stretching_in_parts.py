"""Speech is stretched also while it is being made: it meets its points, and waits for sound that is not there."""

from collections.abc import AsyncIterator
from itertools import pairwise
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.names import OWN
from reactive_realizer.embodiment.audio import AudioStart
from reactive_realizer.engines.speech.text_voice import TextVoice
from reactive_realizer.realizer.inputs import TickInputs
from reactive_realizer.realizer.session import replay
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .parameter_changes import change
from .sounding_voice import GrowingVoice, onsets

# As spoken, s: one 0, two 0.28, three 0.78 | four 1.06, five 1.34, six 1.62, end 1.9.
TEXT = '<text>one two, <sync id="m"/>three four five six.</text>'
SPOKEN = [0.0, 0.28, 0.78, 1.06, 1.34, 1.62]
SIDES = '<sync ref="s:word4"/><sync ref="anticipators:partner:hit"/>'
HIT = f'<constraint id="c"><synchronize>{SIDES}</synchronize></constraint>'
NEAR = 0.02
"""How far from its sync point a word may sound, s."""


@pytest.fixture
def voice(monkeypatch: pytest.MonkeyPatch) -> GrowingVoice:
    return installed(monkeypatch, GrowingVoice(0.7, 1.3))


def installed(monkeypatch: pytest.MonkeyPatch, voice: GrowingVoice) -> GrowingVoice:
    monkeypatch.setattr(TextVoice, "synthesize", staticmethod(voice.stream))
    return voice


@pytest.fixture(params=["convex", "embr", "smartbody"])
async def pilot(request: pytest.FixtureRequest, voice: GrowingVoice) -> AsyncIterator[RealizerPilot]:
    async with open_pilot(SceneOptions(voice="text", strategy=request.param, verify=True)) as pilot:
        pilot.patient = False
        yield pilot


def speech(attributes: str = "") -> str:
    return f'<speech id="s" xmlns:rr="{OWN}" rr:words="true" {attributes}>{TEXT}</speech>'


async def begin(pilot: RealizerPilot, behaviors: str) -> float:
    """Have a speech begin; its start."""
    pilot.block("b", behaviors)
    while not pilot.feedback.reached("b:s:start"):
        await pilot.tick()
    return pilot.feedback.time("b:s:start")


def words(pilot: RealizerPilot) -> list[float]:
    """The times of the words in feedback, s."""
    return [pilot.feedback.time(f"b:s:word{k}") for k in range(6)]


def heard(pilot: RealizerPilot, path: Path) -> list[float]:
    return onsets(pilot.sounds, pilot.now, path / "heard.wav")


@pytest.mark.parametrize("end", [2.1, 1.75])
async def test_it_meets_its_end_although_it_is_longer_than_expected(
    pilot: RealizerPilot, voice: GrowingVoice, tmp_path: Path, end: float
) -> None:
    voice.hold()
    start = await begin(pilot, speech(f'start="0" end="{end}"'))
    await pilot.advance(0.2)
    voice.let(2)
    await pilot.advance(0.3)
    voice.let()
    await pilot.advance(4.0)
    assert pilot.feedback.time("b:s:end") == pytest.approx(start + end)
    assert heard(pilot, tmp_path) == pytest.approx(words(pilot), abs=NEAR)
    assert pilot.feedback.warnings == []


async def test_it_meets_a_prediction_that_moves_while_it_is_made(
    pilot: RealizerPilot, voice: GrowingVoice, tmp_path: Path
) -> None:
    voice.hold()
    pilot.predict("partner", "hit", 1.4)
    start = await begin(pilot, speech('start="0"') + HIT)
    await pilot.advance(0.2)
    pilot.predict("partner", "hit", 1.6)
    await pilot.advance(0.2)
    voice.let()
    await pilot.advance(3.0)
    assert pilot.feedback.time("b:s:word4") == 1.6
    assert pilot.feedback.time("b:s:end") > start + 1.6 + 0.5
    assert heard(pilot, tmp_path) == pytest.approx(words(pilot), abs=NEAR)
    assert pilot.feedback.warnings == []


async def test_it_waits_for_sound_that_is_not_there_and_hurries_then(
    pilot: RealizerPilot, voice: GrowingVoice, tmp_path: Path
) -> None:
    voice.hold()
    tied = '<head id="nod" lexeme="NOD" stroke="s:word3"/>'
    start = await begin(pilot, speech('start="0" end="2.4"') + tied)
    while pilot.now < start + 1.4:
        await pilot.tick()
        assert not pilot.feedback.reached("b:s:word3")
    asked = pilot.now
    voice.let()
    await pilot.advance(3.0)
    told = words(pilot)
    assert asked + 0.05 < told[3] < asked + 0.4
    assert pilot.feedback.time("b:nod:stroke") == pytest.approx(told[3])
    assert heard(pilot, tmp_path) == pytest.approx(told, abs=NEAR)
    assert pilot.feedback.time("b:s:end") == pytest.approx(start + 2.4, abs=0.1)


async def test_a_change_of_rate_takes_effect_also_on_what_is_made_later(
    pilot: RealizerPilot, voice: GrowingVoice, tmp_path: Path
) -> None:
    voice.hold()
    slow = change("p", 'start="s:start"', parameter="rate", targetValue=0.7, type="instant")
    start = await begin(pilot, speech() + '<head id="nod" lexeme="NOD" stroke="s:word5"/>' + slow)
    await pilot.advance(0.5)
    voice.let(2)
    await pilot.advance(0.5)
    voice.let()
    await pilot.advance(4.0)
    told = words(pilot)
    assert told[:2] == pytest.approx([start, start + 0.28], abs=0.02)
    assert [b - a for a, b in pairwise(told[2:])] == pytest.approx([0.28 / 0.7] * 3, abs=0.01)
    assert pilot.feedback.time("b:nod:stroke") == told[5]
    assert heard(pilot, tmp_path) == pytest.approx(told, abs=NEAR)
    assert pilot.feedback.warnings == []


async def test_a_changed_speech_waits_for_sound_too(pilot: RealizerPilot, voice: GrowingVoice, tmp_path: Path) -> None:
    voice.hold()
    fast = change("p", 'start="s:start"', parameter="rate", targetValue=1.5, type="instant")
    start = await begin(pilot, speech() + fast)
    await pilot.advance(1.5)
    assert not pilot.feedback.reached("b:s:word3")
    voice.let()
    await pilot.advance(3.0)
    told = words(pilot)
    assert told[3] > start + 1.5
    assert [b - a for a, b in pairwise(told[3:])] == pytest.approx([0.28 / 1.5] * 2, abs=0.01)
    assert heard(pilot, tmp_path) == pytest.approx(told, abs=NEAR)
    assert pilot.feedback.warnings == []


async def test_a_block_that_waits_is_planned_again_and_stretched_then(
    pilot: RealizerPilot, voice: GrowingVoice
) -> None:
    voice.hold()
    pilot.block("first", '<wait id="w" duration="1"/>')
    pilot.block("b", speech('start="0" end="2.1"'), composition="APPEND")
    await pilot.advance(0.5)
    voice.let()
    await pilot.advance(4.0)
    begun = pilot.feedback.time("b:s:start")
    assert begun == pytest.approx(1.0)
    assert pilot.feedback.time("b:s:end") == pytest.approx(begun + 2.1)
    assert [each - begun for each in words(pilot)] == pytest.approx([each * 2.1 / 1.9 for each in SPOKEN], abs=NEAR)
    assert pilot.feedback.warnings == []


async def test_it_is_cut_at_the_next_word_while_it_is_made(pilot: RealizerPilot, voice: GrowingVoice) -> None:
    voice.hold()
    start = await begin(pilot, speech('start="0" end="2.4"'))
    await pilot.advance(0.5)
    pilot.block("stop", '<bmla:interrupt id="i" target="b" speech="word"/>')
    await pilot.advance(2.0)
    assert start + 0.5 < pilot.feedback.time("b:s:end") < start + 1.3
    assert pilot.feedback.status("b") == "INTERRUPTED"


async def test_a_replay_makes_the_same_sounds(voice: GrowingVoice) -> None:
    inputs: list[TickInputs] = []
    async with open_pilot(SceneOptions(voice="text")) as pilot:
        pilot.realizer.record(inputs.append)
        pilot.patient = False
        voice.hold()
        await begin(pilot, speech('start="0" end="2.1"'))
        await pilot.advance(1.1)
        voice.let()
        await pilot.advance(4.0)
        live, sounds = [line.text for line in pilot.feedback.messages], pilot.sounds
        assert len([each for each in sounds if isinstance(each, AudioStart)]) > 3
    async with open_pilot(SceneOptions(voice="text")) as again:
        await replay(again.realizer, inputs)
        assert [line.text for line in again.feedback.messages] == live
        assert again.sounds == sounds


@settings(max_examples=15, suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(
    cuts=st.lists(st.floats(0.3, 1.8), min_size=1, max_size=3),
    waits=st.lists(st.integers(0, 100), min_size=3, max_size=3),
    end=st.floats(1.5, 3.0),
    rate=st.none() | st.floats(0.5, 2.0),
)
async def test_whenever_its_parts_are_made_words_sound_at_their_points(
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    cuts: list[float],
    waits: list[int],
    end: float,
    rate: float | None,
) -> None:
    """Words in which the sound was missing may be split, and are not looked for."""
    voice = installed(monkeypatch, GrowingVoice(*sorted(cuts)))
    async with open_pilot(SceneOptions(voice="text")) as pilot:
        pilot.patient = False
        voice.hold()
        if rate is None:
            await begin(pilot, speech(f'start="0" end="{end}"'))
        else:
            faster = change("p", 'start="0.1"', parameter="rate", targetValue=rate, type="linear")
            await begin(pilot, speech() + faster)
        for parts, ticks in enumerate(waits, 2):
            for _ in range(ticks):
                await pilot.tick()
            voice.let(parts)
        voice.let()
        await pilot.advance(8.0)
        told, sounding = words(pilot), heard(pilot, tmp_path)
        assert all(any(abs(word - onset) < NEAR + 0.005 for onset in sounding) for word in told)
        assert pilot.feedback.status("b") == "DONE"
