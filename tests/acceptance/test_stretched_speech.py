"""Speech that sounds is stretched where its constraints ask for it, and its words sound at their sync points."""

from collections.abc import AsyncIterator, Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.names import OWN
from reactive_realizer.embodiment.audio import AudioStart, AudioStop
from reactive_realizer.engines.speech.text_voice import TextVoice
from reactive_realizer.realizer.inputs import TickInputs
from reactive_realizer.realizer.session import replay
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .sounding_voice import SoundingVoice, onsets, recorded

# As spoken, s: one 0, two 0.28, three 0.78 | four 1.06, five 1.34, six 1.62, end 1.9.
TEXT = '<text>one two, <sync id="m"/>three four five six.</text>'
HIT = "anticipators:partner:hit"
NEAR = 0.02
"""How far from its sync point a word may sound, s."""


@pytest.fixture(params=["convex", "embr", "smartbody"])
def strategy(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture
async def pilot(monkeypatch: pytest.MonkeyPatch, strategy: str) -> AsyncIterator[RealizerPilot]:
    monkeypatch.setattr(TextVoice, "synthesize", staticmethod(SoundingVoice().synthesize))
    async with open_pilot(SceneOptions(voice="text", strategy=strategy, verify=True)) as pilot:
        yield pilot


@pytest.fixture
def heard(pilot: RealizerPilot, tmp_path: Path) -> Callable[[], list[float]]:
    """When the words that have sounded so far began, s."""
    return lambda: onsets(pilot.sounds, pilot.now, tmp_path / "heard.wav")


def speech(attributes: str = "", *, words: bool = True) -> str:
    return f'<speech id="s" xmlns:rr="{OWN}" rr:words="{str(words).lower()}" {attributes}>{TEXT}</speech>'


def tied(sync: str, to: str, offset: float = 0.0) -> str:
    """A tie of a sync point of the speech."""
    sides = f'<sync ref="s:{sync}"/><sync ref="{to}{offset:+}"/>'
    return f'<constraint id="c-{sync}"><synchronize>{sides}</synchronize></constraint>'


def words(pilot: RealizerPilot) -> list[float]:
    """The times of the words in feedback, s."""
    return [pilot.feedback.time(f"b:s:word{k}") for k in range(6)]


def clips(pilot: RealizerPilot) -> list[AudioStart]:
    return [each for each in pilot.sounds if isinstance(each, AudioStart)]


@pytest.mark.parametrize("behaviors", [speech(), speech() + '<gesture id="g" lexeme="BEAT" stroke="s:m"/>'])
async def test_without_a_constraint_that_asks_for_it_it_is_as_the_voice_speaks_it(
    pilot: RealizerPilot, behaviors: str
) -> None:
    pilot.block("b", behaviors)
    await pilot.advance(3.0)
    (clip,) = clips(pilot)
    start = pilot.feedback.time("b:s:start")
    assert [time - start for time in words(pilot)] == pytest.approx([0, 0.28, 0.78, 1.06, 1.34, 1.62])
    assert clip.clip.sound.duration == pytest.approx(1.9)


@pytest.mark.parametrize(("start", "end"), [(0.5, 2.9), (0.5, 2.1), (0.0, 1.7)])
async def test_two_ties_stretch_it_and_its_words_sound_at_their_points(
    pilot: RealizerPilot, heard: Callable[[], list[float]], start: float, end: float
) -> None:
    pilot.block("b", speech(f'start="{start}" end="{end}"'))
    await pilot.advance(4.0)
    begin, mark, finish = (pilot.feedback.time(f"b:s:{sync}") for sync in ("start", "m", "end"))
    assert finish - begin == pytest.approx(end - start)
    assert mark - begin == pytest.approx(0.78 * (end - start) / 1.9, abs=NEAR)
    assert heard() == pytest.approx(words(pilot), abs=NEAR)
    assert pilot.feedback.warnings == []


async def test_a_pause_grows_when_words_are_as_slow_as_they_may_be(
    pilot: RealizerPilot, heard: Callable[[], list[float]]
) -> None:
    pilot.block("b", speech() + tied("start", "bml:start") + tied("word2", "bml:start", 1.7))
    await pilot.advance(5.0)
    one, two, three, *_ = heard()
    assert two - one == pytest.approx(1.3 * 0.28, abs=NEAR)
    assert three - one == pytest.approx(1.7, abs=NEAR)
    assert heard() == pytest.approx(words(pilot), abs=NEAR)


async def test_it_is_not_spoken_faster_than_the_voice_may_and_the_tie_gives_way(
    pilot: RealizerPilot, heard: Callable[[], list[float]]
) -> None:
    pilot.block("b", speech('start="0" end="1.2"'))
    await pilot.advance(3.0)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert "s:end = 1.2" in warning.text
    assert "is dropped" in warning.text
    assert heard() == pytest.approx(words(pilot), abs=NEAR)


async def test_a_rigid_speech_is_not_stretched(pilot: RealizerPilot) -> None:
    pilot.block("b", speech('start="0" end="2.2" rr:rigid="true"'))
    await pilot.advance(3.0)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert "is dropped" in warning.text
    assert pilot.feedback.time("b:s:end") - pilot.feedback.time("b:s:start") == pytest.approx(1.9)
    assert len(clips(pilot)) == 1


async def test_a_value_that_is_neither_true_nor_false_is_reported(pilot: RealizerPilot) -> None:
    pilot.block("b", speech('rr:rigid="perhaps"'))
    await pilot.advance(1.0)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert "rigid" in warning.text


async def test_a_prediction_that_moves_while_it_plays_is_met_from_the_next_word_on(
    pilot: RealizerPilot, heard: Callable[[], list[float]]
) -> None:
    pilot.predict("partner", "hit", 1.4)
    pilot.block("b", speech('start="0"') + tied("word4", HIT))
    await pilot.advance(0.2)
    before = list(clips(pilot))
    pilot.predict("partner", "hit", 1.6)
    await pilot.advance(3.0)
    assert pilot.feedback.time("b:s:word4") == 1.6
    assert heard() == pytest.approx(words(pilot), abs=NEAR)
    assert clips(pilot)[: len(before)] == before
    assert not any(isinstance(each, AudioStop) for each in pilot.sounds)
    assert pilot.feedback.warnings == []


async def test_after_the_last_tied_word_it_has_the_pace_of_the_voice(pilot: RealizerPilot) -> None:
    pilot.block("b", speech('start="0"') + tied("word4", "bml:start", 1.6))
    await pilot.advance(3.0)
    assert words(pilot)[4:] == pytest.approx([1.6, 1.88], abs=1e-3)
    assert pilot.feedback.time("b:s:end") == pytest.approx(2.16, abs=1e-3)
    assert pilot.feedback.warnings == []


async def test_a_prediction_that_comes_too_early_is_missed_with_a_warning(
    pilot: RealizerPilot, heard: Callable[[], list[float]]
) -> None:
    pilot.predict("partner", "hit", 1.4)
    pilot.block("b", speech('start="0"') + tied("word4", HIT))
    await pilot.advance(0.2)
    pilot.predict("partner", "hit", 0.8)
    await pilot.advance(3.0)
    assert any("no longer holds" in warning.text for warning in pilot.feedback.of("warningFeedback"))
    assert heard() == pytest.approx(words(pilot), abs=NEAR)


async def test_captions_have_the_times_of_the_stretched_words(pilot: RealizerPilot) -> None:
    pilot.block("b", speech('start="0.5" end="2.9"'))
    await pilot.advance(4.0)
    last = clips(pilot)[-1]
    assert last.clip.caption is not None
    assert last.start is not None
    assert [last.start + begin for begin, _, _ in last.clip.caption.words] == pytest.approx(words(pilot), abs=NEAR)


async def test_what_was_heard_of_it_is_reported_when_it_is_cut_at_a_word(
    pilot: RealizerPilot, heard: Callable[[], list[float]]
) -> None:
    pilot.block("b", speech('start="0" end="2.4"'))
    await pilot.advance(1.1)
    pilot.block("stop", '<bmla:interrupt id="i" target="b" speech="word"/>')
    await pilot.advance(2.0)
    (end,) = (each for each in pilot.feedback.of("syncPointProgress") if each.id == "b:s:end")
    assert end.global_time == pytest.approx(pilot.feedback.time("b:s:start") + 1.06 * 2.4 / 1.9, abs=NEAR)
    assert end.element.get(f"{{{OWN}}}text") == "three"
    assert max(heard()) < end.global_time


async def test_it_meets_its_points_although_its_sound_comes_late(pilot: RealizerPilot) -> None:
    pilot.block("b", speech('start="0" end="2.3"'))
    await pilot.advance(0.2)
    first = clips(pilot)[0]
    assert first.start is not None
    for _ in range(2):
        pilot.heard(first.clip.id, pilot.now - first.start - 0.1, pilot.now)
        await pilot.advance(0.05)
    await pilot.advance(3.0)
    assert pilot.feedback.time("b:s:end") - pilot.feedback.time("b:s:start") == pytest.approx(2.3)
    last = clips(pilot)[-1]
    assert last.start is not None
    assert last.start + last.clip.sound.duration == pytest.approx(pilot.feedback.time("b:s:end"), abs=0.05)


async def test_a_session_with_stretched_speech_is_replayed_to_the_byte(pilot: RealizerPilot, strategy: str) -> None:
    inputs: list[TickInputs] = []
    pilot.realizer.record(inputs.append)
    pilot.predict("partner", "hit", 1.4)
    pilot.block("b", speech('start="0"') + tied("word4", HIT))
    for time in (1.5, 1.3):
        await pilot.advance(0.3)
        pilot.predict("partner", "hit", time)
    await pilot.advance(3.0)
    async with open_pilot(SceneOptions(voice="text", strategy=strategy)) as again:
        await replay(again.realizer, inputs)
        assert [line.text for line in again.feedback.messages] == [line.text for line in pilot.feedback.messages]
        assert again.sounds == pilot.sounds


@pytest.mark.speech
@pytest.mark.parametrize("factor", [0.85, 1.2])
async def test_a_real_voice_is_stretched_and_stays_as_loud(factor: float, tmp_path: Path) -> None:
    """The sound of the speech itself, and stretched to some of its duration."""
    lasts: list[float] = []
    loud: list[float] = []
    for attributes in ("", 'start="0" end="{}"'):
        async with open_pilot(SceneOptions(voice="espeak", verify=True)) as pilot:
            pilot.block("b", speech(attributes.format(factor * lasts[0] if lasts else 0.0)))
            await pilot.advance(6.0)
            samples = recorded(pilot.sounds, pilot.now, tmp_path / "heard.wav")[0]
            assert pilot.feedback.warnings == []
            lasts.append(pilot.feedback.time("b:s:end") - pilot.feedback.time("b:s:start"))
            sounding = np.flatnonzero(np.abs(samples) > 0.01)
            assert (sounding[-1] - sounding[0]) / 48000 == pytest.approx(lasts[-1], abs=0.5)
            loud.append(float(np.sqrt(np.mean(samples[sounding[0] : sounding[-1]] ** 2))))
    assert lasts[1] == pytest.approx(factor * lasts[0])
    assert loud[1] == pytest.approx(loud[0], rel=0.1)


def tie_times() -> st.SearchStrategy[list[float]]:
    """Times of predictions of a word, the first one before it plays."""
    return st.lists(st.floats(0.7, 2.5), min_size=1, max_size=4)


@settings(max_examples=12, suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(times=tie_times(), word=st.integers(1, 5), end=st.none() | st.floats(1.0, 4.0))
async def test_whatever_the_ties_words_sound_at_their_points(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, strategy: str, times: list[float], word: int, end: float | None
) -> None:
    monkeypatch.setattr(TextVoice, "synthesize", staticmethod(SoundingVoice().synthesize))
    async with open_pilot(SceneOptions(voice="text", strategy=strategy)) as pilot:
        pilot.predict("partner", "hit", times[0])
        pilot.block("b", speech('start="0"' if end is None else f'start="0" end="{end}"') + tied(f"word{word}", HIT))
        for time in times[1:]:
            await pilot.advance(0.37)
            pilot.predict("partner", "hit", time)
        await pilot.advance(8.0)
        assert onsets(pilot.sounds, 8.0, tmp_path / "heard.wav") == pytest.approx(words(pilot), abs=NEAR + 0.005)
