"""Speech whose sound a client sends as it is generated."""

from collections.abc import AsyncIterator, Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import pytest_asyncio
from numpy.typing import NDArray

from reactive_realizer.assembly.assets import Assets
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.binding.viseme_binding import VisemeBinding
from reactive_realizer.bml.names import OWN
from reactive_realizer.embodiment.audio import AudioMove, AudioStart, AudioStop
from reactive_realizer.engine.tts import Utterance, completed
from reactive_realizer.engines.speech.espeak_voice import EspeakVoice
from reactive_realizer.engines.speech.lip_sync.track import LipSyncTrack
from reactive_realizer.engines.speech.streamed import stream_aligner
from reactive_realizer.realizer.inputs import TickInputs
from reactive_realizer.realizer.session import replay
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

RATE = 16_000
TEXT = 'One two, <sync id="m"/>three four.'
LIMIT = 20.0


def speech(text: str = TEXT, stream: str = '<rr:stream name="x" rate="16000"/>') -> str:
    """A speech with words as sync points, whose description is a stream."""
    description = f'<description priority="1" type="audio/x-stream">{stream}</description>'
    return f'<speech id="s" xmlns:rr="{OWN}" rr:words="true"><text>{text}</text>{description}</speech>'


def voice(seconds: float, level: float = 0.3) -> bytes:
    """Sound like a voice that says a vowel."""
    times = np.arange(round(seconds * RATE)) / RATE
    tones = np.sum([np.cos(2 * np.pi * 150 * k * times + k * k) for k in range(1, 12)], axis=0)
    samples = (tones / 6 * level * 32767).astype("<i2")
    return bytes(samples.tobytes())


def hiss(seconds: float, level: float = 0.3) -> bytes:
    """The burst of a t, whose energy is at 4 to 6 kHz."""
    times = np.arange(round(seconds * RATE)) / RATE
    tones = np.sum([np.cos(2 * np.pi * 150 * k * times + k * k) for k in range(27, 41)], axis=0)
    return bytes((tones / 14 * level * 32767).astype("<i2").tobytes())


def silence(seconds: float) -> bytes:
    return bytes(2 * round(seconds * RATE))


@pytest_asyncio.fixture
async def pilot(monkeypatch: pytest.MonkeyPatch) -> AsyncIterator[RealizerPilot]:
    """A pilot without an aligner."""
    monkeypatch.setattr(stream_aligner, "find_spec", lambda _: None)
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        pilot.watch()
        yield pilot


async def send(pilot: RealizerPilot, audio: bytes, chunk: float = 0.1, every: float = 0.1) -> None:
    """Sends sound in chunks (s), one in each of some intervals (s), and ends the stream."""
    size = 2 * round(chunk * RATE)
    for first in range(0, len(audio), size):
        pilot.stream("x", audio[first : first + size], end=first + size >= len(audio))
        await pilot.advance(every)


def warnings(pilot: RealizerPilot) -> list[str]:
    return [each.text for each in pilot.feedback.of("warningFeedback")]


def offsets(pilot: RealizerPilot, *syncs: str) -> list[float]:
    """The times of points of the speech, s from its start."""
    return [round(pilot.feedback.time(f"b:s:{sync}") - pilot.feedback.time("b:s:start"), 6) for sync in syncs]


def heard(pilot: RealizerPilot) -> bytes:
    """The samples of all sounds, joined in the order of their starts, with the silence between them."""
    clips = {each.clip.id: each.clip.sound for each in pilot.sounds if isinstance(each, AudioStart)}
    starts = {each.clip.id: each.start for each in pilot.sounds if isinstance(each, AudioStart)}
    starts |= {each.id: each.start for each in pilot.sounds if isinstance(each, AudioMove)}
    joined = b""
    begin = min(start for start in starts.values() if start is not None)
    for id_, start in starts.items():
        assert start is not None
        joined += silence(start - begin - len(joined) / 2 / RATE) + clips[id_].wav[44:]
    return joined


def end_of(pilot: RealizerPilot) -> dict[str, str]:
    """What was heard, as the end of the speech reports it."""
    (end,) = (line.element for line in pilot.feedback.of("syncPointProgress") if line.id == "b:s:end")
    return {str(name).rpartition("}")[2]: str(value) for name, value in end.attrib.items()}


# --- what is heard and seen


async def test_the_sound_is_spoken_as_it_was_sent_wherever_it_was_cut(pilot: RealizerPilot) -> None:
    sound = voice(0.7) + silence(0.3) + voice(1.0)
    pilot.block("b", speech() + '<wait id="after" start="s:end" duration="0.1"/>')
    for first in range(0, len(sound), 3333):  # in the middle of samples
        pilot.stream("x", sound[first : first + 3333], end=first + 3333 >= len(sound))
        await pilot.advance(0.05)
    await pilot.advance(4)
    assert heard(pilot) == sound
    assert offsets(pilot, "end") == [2.0]
    assert pilot.feedback.time("b:after:start") == pilot.feedback.time("b:s:end")
    assert pilot.feedback.status("b") == "DONE"


async def test_the_speech_begins_when_a_little_has_arrived_and_goes_on_while_the_rest_does(
    pilot: RealizerPilot,
) -> None:
    pilot.block("b", speech())
    await pilot.advance(0.3)
    assert not pilot.feedback.reached("b:start")
    await send(pilot, voice(3.0))
    assert pilot.feedback.time("b:s:start") < 0.3 + 0.7
    await pilot.advance(4)
    assert heard(pilot) == voice(3.0), "nothing was waited for"


async def test_words_have_the_times_that_the_client_gives(pilot: RealizerPilot) -> None:
    pilot.block("b", speech() + '<gesture id="g" lexeme="BEAT" stroke="s:m"/>')
    pilot.stream("x", voice(0.8), ("One", 0.1), ("two", 0.45), (",", 0.7))
    await pilot.advance(0.2)
    pilot.stream("x", voice(1.2), ("Three", 1.1), ("four.", 1.5), end=True)
    await pilot.advance(4)
    assert offsets(pilot, "word0", "word1", "word2", "word3", "m", "end") == [0.1, 0.45, 1.1, 1.5, 1.1, 2.0]
    assert pilot.feedback.time("b:g:stroke") == pilot.feedback.time("b:s:m")
    assert warnings(pilot) == []


@pytest.mark.parametrize(
    ("given", "reason"),
    [
        ([("Two", 0.1)], "from 'Two' on: the text has 'one' there"),
        ([("One", 0.5), ("two", 0.1)], "from 'two' on: 0.1 s is before the word that precedes it"),
        (
            [(word, 0.1) for word in ["One", "two", "three", "four", "five"]],
            "from 'five' on: the text has no more words",
        ),
    ],
    ids=["another word", "no order", "too many"],
)
async def test_times_that_do_not_fit_the_text_are_ignored_which_is_told(
    pilot: RealizerPilot, given: list[tuple[str, float]], reason: str
) -> None:
    pilot.block("b", speech())
    pilot.stream("x", voice(2.0), *given, end=True)
    await pilot.advance(4)
    assert reason in warnings(pilot)[0]
    assert pilot.feedback.status("b") == "DONE"


async def test_without_the_aligner_words_are_spread_over_the_time_that_is_speech(
    pilot: RealizerPilot,
) -> None:
    pilot.block("b", speech("aaaa bbbb cccc dddd"))
    pilot.stream("x", silence(0.2) + voice(1.0) + silence(1.0) + voice(1.0) + silence(0.5), end=True)
    await pilot.advance(6)
    assert offsets(pilot, *(f"word{k}" for k in range(4))) == pytest.approx([0.2, 0.7, 2.2, 2.7], abs=0.04)
    (warning,) = warnings(pilot)
    assert "pip install 'reactive-realizer[align]'" in warning


async def test_without_a_text_the_mouth_opens_as_the_sound_is_loud_and_is_closed_in_silence(
    pilot: RealizerPilot,
) -> None:
    pilot.block("b", speech(""))
    await send(pilot, silence(0.4) + voice(0.5, 0.5) + silence(0.5) + voice(0.5, 0.15) + silence(0.5))
    await pilot.advance(3)
    assert warnings(pilot) == []
    start = pilot.feedback.time("b:s:start")
    morphs = pilot.realizer.characters["alice"].humanoid.avatar.morphs
    jaw = {frame.time - start: float(frame.weights[morphs.index("jawOpen")]) for frame in pilot.frames["alice"]}
    before, loud, pause, soft, after = (
        max(weight for time, weight in jaw.items() if first < time < last)
        for first, last in [(0.0, 0.3), (0.4, 0.9), (1.05, 1.3), (1.4, 1.9), (2.1, 3.0)]
    )
    assert max(before, pause, after) < 0.02
    assert loud > soft > 0.08
    assert end_of(pilot)["heard"] == "0"


async def test_without_a_text_the_lips_close_in_a_short_silence_before_a_burst_without_high_frequencies(
    pilot: RealizerPilot,
) -> None:
    ba, ta = silence(0.08) + voice(0.42, 0.5), silence(0.08) + hiss(0.06) + voice(0.36, 0.5)
    pilot.block("b", speech(""))
    await send(pilot, voice(0.5, 0.5) + ba + ta)
    await pilot.advance(2)
    start = pilot.feedback.time("b:s:start")
    morphs = pilot.realizer.characters["alice"].humanoid.avatar.morphs
    jaw, lips = (
        {frame.time - start: float(frame.weights[morphs.index(name)]) for frame in pilot.frames["alice"]}
        for name in ("jawOpen", "mouthPressLeft")
    )
    closed, open_ = ([time for time in jaw if begin <= time < begin + 0.08] for begin in (0.5, 1.0))
    assert min(jaw[time] for time in closed) < 0.01
    assert max(lips[time] for time in closed) > 0.4
    assert max(lips[time] for time in open_) < 0.05


@pytest.mark.speech
@pytest.mark.align
async def test_words_and_lips_are_found_in_the_sound_before_they_are_heard(spoken: Utterance) -> None:
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        pilot.watch()
        pilot.block("b", speech(spoken.text, '<rr:stream name="x" rate="22050"/>'))
        for first in range(0, len(spoken.audio), 4410):
            pilot.stream("x", spoken.audio[first : first + 4410], end=first + 4410 >= len(spoken.audio))
            await pilot.advance(0.05)  # twice as fast as it is spoken
        await pilot.advance(spoken.duration)
        assert warnings(pilot) == []
        words = offsets(pilot, *(f"word{k}" for k in range(len(spoken.words))))
        errors = np.abs(np.array(words) - [word.start for word in spoken.words])
        assert np.median(errors) < 0.03
        assert np.max(errors) < 0.12
        start = pilot.feedback.time("b:s:start")
        morphs = pilot.realizer.characters["alice"].humanoid.avatar.morphs
        jaw = {frame.time - start: float(frame.weights[morphs.index("jawOpen")]) for frame in pilot.frames["alice"]}
        for phoneme in spoken.phonemes:
            if phoneme.symbol in {"m", "p", "b"}:
                closed = min(weight for time, weight in jaw.items() if abs(time - phoneme.start) < 0.08)
                assert closed < 0.05, phoneme


@pytest.mark.speech
@pytest.mark.align
@pytest.mark.parametrize(
    ("patience", "chunk"), [(60.0, 0.1), (0.0, 10.0)], ids=["as it arrives", "when the search is late"]
)
async def test_without_a_text_the_lips_follow_the_sounds_more_than_loudness(
    spoken: Utterance, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, patience: float, chunk: float
) -> None:
    human = tmp_path / "still.toml"
    human.write_text("[character.alice]\nidle = false\n", encoding="utf-8")
    monkeypatch.setattr(stream_aligner, "_SOON", patience)
    found = await lips_without_text(human, spoken, chunk)
    monkeypatch.setattr(stream_aligner, "find_spec", lambda _: None)
    loud = await lips_without_text(human, spoken, chunk)
    binding = VisemeBinding.read((), MOUTH, Assets())
    track = LipSyncTrack(spoken, binding)
    times = np.arange(0.1, spoken.duration - 0.1, 0.02)
    meant = np.array([[track.weights(time).get(morph, 0.0) for morph in MOUTH] for time in times])
    near, far = (float(np.abs(each(times) - meant).mean()) for each in (found, loud))
    assert near < 0.85 * far, (near, far)


MOUTH = ("jawOpen", "mouthPucker", "mouthPressLeft")


async def lips_without_text(
    human: Path, spoken: Utterance, chunk: float
) -> Callable[[NDArray[np.float64]], NDArray[np.float64]]:
    """The mouth at times of a speech that is streamed without its text, (T, 3)."""
    async with open_pilot(SceneOptions(human, voice="text", verify=True)) as pilot:
        pilot.watch()
        pilot.block("b", speech("", '<rr:stream name="x" rate="22050"/>'))
        size = 2 * round(22050 * chunk)
        for first in range(0, len(spoken.audio), size):
            pilot.stream("x", spoken.audio[first : first + size], end=first + size >= len(spoken.audio))
            await pilot.advance(chunk / 2 if chunk < 1.0 else 0.2)
        await pilot.advance(spoken.duration + 0.5)
        assert warnings(pilot) == []
        start = pilot.feedback.time("b:s:start")
        morphs = pilot.realizer.characters["alice"].humanoid.avatar.morphs
        frames = pilot.frames["alice"]
        shown = np.array([[frame.weights[morphs.index(name)] for name in MOUTH] for frame in frames])
        at = np.array([frame.time - start for frame in frames])
    return lambda times: np.array([np.interp(times, at, column) for column in shown.T]).T


@pytest.mark.speech
@pytest.mark.align
@pytest.mark.parametrize("noise", [0.0, 0.002], ids=["silence", "faint noise"])
async def test_in_a_pause_of_a_speech_without_a_text_the_mouth_is_at_rest(
    spoken: Utterance, tmp_path: Path, noise: float
) -> None:
    human = tmp_path / "still.toml"
    human.write_text("[character.alice]\nidle = false\n", encoding="utf-8")
    word = np.frombuffer(spoken.audio, "<i2")[:22050]
    pause = np.random.default_rng(1).normal(0.0, noise * 32768, 3 * 22050)
    sound = np.concatenate([pause[:22050], word, pause, word]).astype("<i2").tobytes()
    mouth = await lips_without_text(human, replace(spoken, audio=sound, duration=len(sound) / 2 / 22050), 0.1)
    assert mouth(np.arange(0.0, 0.7, 0.02)).max() < 0.03, "before it speaks"
    assert mouth(np.arange(2.3, 4.7, 0.02)).max() < 0.03, "between words"
    assert mouth(np.arange(5.0, 6.0, 0.02)).max() > 0.15, "speaking again"


async def test_when_the_search_for_sounds_fails_the_lips_follow_loudness(
    pilot: RealizerPilot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(stream_aligner, "find_spec", lambda _: True)
    monkeypatch.setattr(stream_aligner, "_WORKER", "reactive_realizer.errors")  # a process that ends at once
    pilot.block("b", speech(""))
    pilot.stream("x", voice(1.0), end=True)
    await pilot.advance(2)
    morphs = pilot.realizer.characters["alice"].humanoid.avatar.morphs
    assert max(frame.weights[morphs.index("jawOpen")] for frame in pilot.frames["alice"]) > 0.1
    assert warnings(pilot) == []
    assert pilot.feedback.status("b") == "DONE"


@pytest_asyncio.fixture
async def spoken() -> Utterance:
    """What another voice makes, with the times of its words and sounds."""
    voice = EspeakVoice()
    await voice.start()
    try:
        return await completed(voice.synthesize("Maybe my mother puts five apples into a big box.", (), "en-us"))
    finally:
        await voice.close()


async def test_when_the_search_for_words_fails_the_speech_goes_on_with_estimated_ones_which_is_told(
    pilot: RealizerPilot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(stream_aligner, "find_spec", lambda _: True)
    monkeypatch.setattr(stream_aligner, "_WORKER", "reactive_realizer.errors")  # a process that ends at once
    pilot.block("b", speech())
    pilot.stream("x", voice(2.0), end=True)
    await pilot.advance(4)
    (warning,) = warnings(pilot)
    assert "the times of words in the stream 'x' are estimated: the search for them failed" in warning
    assert offsets(pilot, "word1", "end") == pytest.approx([2.0 * 4 / 18, 2.0], abs=0.1)
    assert pilot.feedback.status("b") == "DONE"


# --- late, too much, too little


async def test_sound_that_comes_late_is_waited_for_and_nothing_of_it_is_lost(pilot: RealizerPilot) -> None:
    pilot.block("b", speech() + '<gesture id="g" lexeme="BEAT" stroke="s:m"/>')
    pilot.stream("x", voice(1.0), ("One", 0.0), ("two", 0.5))
    await pilot.advance(3.0)
    assert pilot.feedback.reached("b:s:word1")
    assert not pilot.feedback.reached("b:s:word2")
    pilot.stream("x", voice(1.0), ("three", 1.2), ("four", 1.6), end=True)
    await pilot.advance(3.0)
    late = pilot.feedback.time("b:s:word2")
    assert 3.2 < late < 3.3
    assert pilot.feedback.time("b:g:stroke") == late
    sound = heard(pilot)
    assert sound.startswith(voice(1.0))
    assert sound.endswith(voice(1.0))
    assert pilot.feedback.status("b") == "DONE"


async def test_a_stream_that_never_begins_is_replaced_by_the_voice(pilot: RealizerPilot) -> None:
    pilot.block("b", speech())
    await pilot.advance(LIMIT - 0.1)
    assert warnings(pilot) == []
    await pilot.advance(3)
    (warning,) = warnings(pilot)
    assert "no sound of the stream 'x' has arrived for 20 s" in warning
    assert end_of(pilot)["heard"] == "20"


async def test_a_stream_that_never_ends_ends_its_speech_after_what_was_heard(pilot: RealizerPilot) -> None:
    pilot.block("b", speech() + '<head id="own" lexeme="NOD"/>')
    pilot.stream("x", voice(1.0), ("One", 0.0), ("two", 0.5))
    await pilot.advance(LIMIT + 2)
    (warning,) = warnings(pilot)
    assert "no sound of the stream 'x' has arrived for 20 s" in warning
    assert end_of(pilot)["text"] == "two"
    assert pilot.feedback.reached("b:own:end")
    assert pilot.feedback.status("b") == "DONE"


BAD: dict[str, tuple[str, Callable[[RealizerPilot], Any], str]] = {
    "no stream": ("", lambda pilot: None, f'<description> must contain <stream xmlns="{OWN}"/>'),
    "no rate": ('<rr:stream name="x"/>', lambda pilot: None, "attribute 'rate'"),
    "a low rate": ('<rr:stream name="x" rate="8000"/>', lambda pilot: None, "not between 16000 and 48000"),
    "no sound": ('<rr:stream name="x" rate="16000"/>', lambda pilot: pilot.stream("x", end=True), "without sound"),
}


@pytest.mark.parametrize("name", BAD)
async def test_a_stream_that_cannot_be_spoken_is_replaced_by_the_voice_and_the_reason_is_told(
    pilot: RealizerPilot, name: str
) -> None:
    stream, act, reason = BAD[name]
    pilot.block("b", speech(stream=stream))
    act(pilot)
    await pilot.advance(4)
    (warning,) = warnings(pilot)
    assert reason in warning
    assert end_of(pilot)["heard"] == "20"


async def test_a_second_speech_with_the_same_stream_is_spoken_by_the_voice(pilot: RealizerPilot) -> None:
    pilot.block("b", speech())
    pilot.block("c", speech())
    await pilot.advance(0.1)
    assert "another speech uses the stream 'x'" in warnings(pilot)[0]


async def test_a_stream_that_ends_in_the_middle_of_a_sample_is_told(pilot: RealizerPilot) -> None:
    pilot.block("b", speech(""))
    pilot.stream("x", voice(1.0) + b"\0", end=True)
    await pilot.advance(3)
    (warning,) = warnings(pilot)
    assert "in the middle of a sample" in warning
    assert heard(pilot) == voice(1.0)


async def test_more_than_the_limit_is_left_out(pilot: RealizerPilot) -> None:
    pilot.block("b", speech(""))
    for _ in range(31):
        pilot.stream("x", voice(10.0))
    pilot.stream("x", end=True)
    await pilot.advance(2)
    assert pilot.feedback.predicted("b:s:end") == pytest.approx(300, abs=1)


async def test_an_interruption_stops_the_sound_and_what_follows_is_ignored(pilot: RealizerPilot) -> None:
    pilot.block("b", speech())
    pilot.stream("x", voice(3.0), ("One", 0.0), ("two", 0.5))
    await pilot.advance(1.2)
    pilot.block("stop", '<bmla:interrupt id="i" target="b"/>')
    await pilot.advance(0.2)
    assert end_of(pilot)["text"] == "two"
    assert [each.fade for each in pilot.sounds if isinstance(each, AudioStop)]
    sounds = len(pilot.sounds)
    pilot.stream("x", voice(3.0), end=True)
    await pilot.advance(1)
    assert len(pilot.sounds) == sounds
    pilot.block("c", speech(""))
    pilot.stream("x", voice(1.0), end=True)
    await pilot.advance(3)
    assert pilot.feedback.status("c") == "DONE", "the name is free again"


async def test_two_characters_speak_at_the_same_time(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stream_aligner, "find_spec", lambda _: None)
    human = tmp_path / "human.toml"
    human.write_text("[character.a]\n[character.b]\n")
    async with open_pilot(SceneOptions(human, "text")) as pilot:
        for name in "ab":
            stream = f'<rr:stream name="{name}" rate="16000"/>'
            pilot.block(name, speech("", stream), characterId=name)
        for _ in range(10):
            pilot.stream("a", voice(0.2))
            pilot.stream("b", voice(0.1))
            await pilot.advance(0.1)
        pilot.stream("a", end=True)
        pilot.stream("b", end=True)
        await pilot.advance(4)
        assert [
            round(pilot.feedback.time(f"{id_}:s:end") - pilot.feedback.time(f"{id_}:s:start"), 3) for id_ in "ab"
        ] == [
            2.0,
            1.0,
        ]


async def test_a_replay_speaks_the_same(pilot: RealizerPilot, monkeypatch: pytest.MonkeyPatch) -> None:
    session: list[TickInputs] = []
    pilot.realizer.record(session.append)
    pilot.patient = False
    pilot.block("b", speech() + '<gesture id="g" lexeme="BEAT" stroke="s:m"/>')
    await send(pilot, voice(0.5) + silence(0.3) + voice(1.5), chunk=0.13, every=0.17)
    await pilot.advance(3)
    async with open_pilot(SceneOptions(voice="text", verify=True)) as again:
        await replay(again.realizer, session)
        assert again.feedback.raw == pilot.feedback.raw
        assert again.sounds == pilot.sounds
