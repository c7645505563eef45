"""The rate and the pitch of a speech change while it sounds, from the next word on, and everything follows."""

from collections.abc import AsyncIterator
from itertools import pairwise
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.names import OWN
from reactive_realizer.embodiment.audio import AudioStart
from reactive_realizer.engines.speech.text_voice import TextVoice
from reactive_realizer.realizer.inputs import TickInputs
from reactive_realizer.realizer.session import replay
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .parameter_changes import change
from .sounding_voice import PITCH, SoundingVoice, onsets, recorded

# As spoken, s: one 0, two 0.28, three 0.78 | four 1.06, five 1.34, six 1.62, end 1.9.
TEXT = '<text>one two, <sync id="m"/>three four five six.</text>'
SPEECH = f'<speech id="s" xmlns:rr="{OWN}" rr:words="true" {{}}>{TEXT}</speech>'
SPOKEN = [0.0, 0.28, 0.78, 1.06, 1.34, 1.62]
NEAR = 0.02
"""How far from its sync point a word may sound, s."""


@pytest.fixture
async def pilot(monkeypatch: pytest.MonkeyPatch) -> AsyncIterator[RealizerPilot]:
    monkeypatch.setattr(TextVoice, "synthesize", staticmethod(SoundingVoice().synthesize))
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        yield pilot


def changed(parameter: str, value: float, start: str = "0", **trajectory: str) -> str:
    said = {"type": "instant", **trajectory}
    return change(parameter, f'start="{start}"', parameter=parameter, targetValue=value, **said)


def words(pilot: RealizerPilot) -> list[float]:
    """The times of the words in feedback, s after the start of the speech."""
    start = pilot.feedback.time("b:s:start")
    return [pilot.feedback.time(f"b:s:word{k}") - start for k in range(6)]


def heard(pilot: RealizerPilot, path: Path) -> list[float]:
    """When the words are heard, s after the start of the speech."""
    start = pilot.feedback.time("b:s:start")
    return [each - start for each in onsets(pilot.sounds, pilot.now, path / "heard.wav")]


def pitch(samples: npt.NDArray[np.float64], rate: int) -> float:
    """The fundamental frequency (Hz) by autocorrelation: the median over the voiced frames of 40 ms."""
    length, found = round(0.04 * rate), []
    lags = np.arange(rate // 400, rate // 60)
    for first in range(0, len(samples) - 2 * length, length // 2):
        frame = samples[first : first + length]
        if np.sqrt(np.mean(frame**2)) < 0.02:
            continue
        alike = np.array(
            [
                frame
                @ samples[first + lag : first + lag + length]
                / (np.linalg.norm(frame) * np.linalg.norm(samples[first + lag : first + lag + length]) + 1e-9)
                for lag in lags
            ]
        )
        best = alike.max()
        if best > 0.8:
            found.append(rate / lags[np.flatnonzero(alike > 0.95 * best)[0]])
    return float(np.median(found))


@pytest.mark.parametrize("rate", [0.5, 0.8, 1.25, 2.0])
async def test_a_speech_goes_on_at_another_rate_from_the_next_word_on(
    pilot: RealizerPilot, tmp_path: Path, rate: float
) -> None:
    pilot.block("b", SPEECH.format("") + changed("rate", rate, "s:start+0.3"))
    await pilot.advance(6.0)
    assert words(pilot)[:3] == pytest.approx(SPOKEN[:3], abs=0.035)
    durations = [after - before for before, after in pairwise(words(pilot)[2:])]
    assert durations == pytest.approx([0.28 / rate] * 3, abs=0.03)
    assert heard(pilot, tmp_path) == pytest.approx(words(pilot), abs=NEAR)
    end = pilot.feedback.time("b:s:end") - pilot.feedback.time("b:s:start")
    assert end == pytest.approx(0.78 + (1.9 - 0.78) / rate, abs=0.04)
    assert pilot.feedback.warnings == []


async def test_what_is_tied_to_its_words_follows_and_is_predicted_anew(pilot: RealizerPilot) -> None:
    tied = '<gesture id="g" lexeme="BEAT" stroke="s:word5"/><head id="h" lexeme="NOD" start="s:end+0.1"/>'
    pilot.block("b", SPEECH.format("") + tied + changed("rate", 0.5, "s:start+0.3"))
    pilot.block("next", '<wait id="w" duration="0.1"/>', composition="APPEND")
    await pilot.advance(0.6)
    slow = pilot.feedback.predicted("b:s:end")
    assert slow == pytest.approx(pilot.feedback.time("b:s:start") + 0.78 + (1.9 - 0.78) / 0.5, abs=0.04)
    await pilot.advance(7.0)
    told = pilot.feedback
    assert told.time("b:s:end") == pytest.approx(slow)
    assert told.time("b:g:stroke") == told.time("b:s:word5")
    assert told.time("b:h:start") == pytest.approx(slow + 0.1)
    assert told.time("next:w:start") == told.time("b:end")
    assert told.warnings == []


async def test_a_rate_that_is_set_before_it_begins_holds_from_the_first_word_on(
    pilot: RealizerPilot, tmp_path: Path
) -> None:
    pilot.block("b", SPEECH.format('start="1.5"') + changed("rate", 0.7))
    await pilot.advance(6.0)
    assert words(pilot) == pytest.approx([each / 0.7 for each in SPOKEN], abs=1e-3)
    assert heard(pilot, tmp_path) == pytest.approx(words(pilot), abs=NEAR)
    assert len({each.clip.id for each in pilot.sounds if isinstance(each, AudioStart)}) > 1


async def test_where_constraints_stretch_it_the_rate_takes_effect_after_the_last_one(pilot: RealizerPilot) -> None:
    tie = '<constraint id="c"><synchronize><sync ref="s:word3"/><sync ref="bml:start+1.3"/></synchronize></constraint>'
    pilot.block("b", SPEECH.format('start="0"') + tie + changed("rate", 0.5))
    await pilot.advance(6.0)
    assert words(pilot)[3:] == pytest.approx([1.3, 1.3 + 0.56, 1.3 + 1.12], abs=0.01)
    assert pilot.feedback.warnings == []


@pytest.mark.parametrize("factor", [0.7, 1.0, 1.5])
async def test_its_pitch_changes_from_the_next_word_on_and_its_times_do_not(
    pilot: RealizerPilot, tmp_path: Path, factor: float
) -> None:
    pilot.block("b", SPEECH.format("") + changed("pitch", factor, "s:start+0.3"))
    await pilot.advance(3.0)
    assert words(pilot) == pytest.approx(SPOKEN)
    assert heard(pilot, tmp_path) == pytest.approx(SPOKEN, abs=NEAR)
    samples, rate = recorded(pilot.sounds, pilot.now, tmp_path / "heard.wav")
    start = pilot.feedback.time("b:s:start")
    before, after = (
        samples[round((start + begin) * rate) : round((start + end) * rate)] for begin, end in ((0, 0.5), (0.78, 1.9))
    )
    assert pitch(before, rate) == pytest.approx(PITCH, rel=0.02)
    assert pitch(after, rate) == pytest.approx(factor * PITCH, rel=0.03)


async def test_at_a_rate_and_a_pitch_of_1_it_sounds_as_the_voice_speaks_it(pilot: RealizerPilot) -> None:
    pilot.block("b", SPEECH.format("") + changed("rate", 1.0) + changed("pitch", 1.0))
    await pilot.advance(3.0)
    (clip,) = (each for each in pilot.sounds if isinstance(each, AudioStart))
    assert clip.clip.sound.duration == pytest.approx(1.9)


async def test_a_session_with_changes_of_rate_and_pitch_is_replayed_to_the_byte(pilot: RealizerPilot) -> None:
    inputs: list[TickInputs] = []
    pilot.realizer.record(inputs.append)
    changes = changed("rate", 0.6, "s:start+0.2", type="linear") + changed("pitch", 1.3, "s:start+0.5")
    pilot.block("b", SPEECH.format("") + changes)
    await pilot.advance(6.0)
    async with open_pilot(SceneOptions(voice="text")) as again:
        await replay(again.realizer, inputs)
        assert [line.text for line in again.feedback.messages] == [line.text for line in pilot.feedback.messages]
        assert again.sounds == pilot.sounds


@pytest.mark.parametrize(("parameter", "value"), [("rate", 2.5), ("pitch", 0.1)])
async def test_a_value_out_of_range_is_reported(pilot: RealizerPilot, parameter: str, value: float) -> None:
    pilot.block("b", SPEECH.format("") + changed(parameter, value))
    await pilot.advance(3.0)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert f"the {parameter} of 's' must be between 0.5 and 2" in warning.text


async def test_a_voice_without_sound_has_no_rate() -> None:
    async with open_pilot(SceneOptions(voice="text")) as pilot:
        pilot.block("b", SPEECH.format("") + changed("rate", 0.5))
        await pilot.advance(3.0)
        (warning,) = pilot.feedback.of("warningFeedback")
        assert "'s' has no parameter 'rate'" in warning.text


@pytest.mark.speech
@pytest.mark.parametrize(("rate", "factor"), [(0.75, 1.0), (1.4, 1.0), (1.0, 1.3), (1.2, 0.8)])
async def test_a_real_voice_is_as_fast_and_as_high_as_asked(tmp_path: Path, rate: float, factor: float) -> None:
    spoken: list[tuple[float, float]] = []
    text = "All of us are on our way, and we are nearly there."
    for changes in ("", changed("rate", rate) + changed("pitch", factor)):
        async with open_pilot(SceneOptions(voice="espeak", verify=True)) as pilot:
            pilot.block("b", f'<speech id="s" start="1"><text>{text}</text></speech>' + changes)
            await pilot.advance(7.0)
            samples, hertz = recorded(pilot.sounds, pilot.now, tmp_path / "heard.wav")
            sounding = np.flatnonzero(np.abs(samples) > 0.01)
            lasts = (sounding[-1] - sounding[0]) / hertz
            assert pilot.feedback.warnings == []
            told = pilot.feedback.time("b:s:end") - pilot.feedback.time("b:s:start")
            assert lasts == pytest.approx(told, abs=0.5)
            spoken.append((told, pitch(samples[::4], hertz // 4)))
    (lasts, high), (lasts_then, high_then) = spoken
    assert lasts_then == pytest.approx(lasts / rate, rel=0.01)
    assert high_then == pytest.approx(factor * high, rel=0.04)
