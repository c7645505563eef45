"""Speech from sound files: descriptions of a speech as audio."""

import asyncio
import io
import json
import threading
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import soundfile

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.names import OWN
from reactive_realizer.embodiment.audio import AudioStart, AudioStop
from reactive_realizer.engine.tts import Utterance, completed
from reactive_realizer.engines.speech.espeak_voice import EspeakVoice
from reactive_realizer.engines.speech.recorded import aligner, recordings
from reactive_realizer.engines.speech.recorded.recordings import spread
from reactive_realizer.testing.assertions import assert_time
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

RATE = 8000
DURATION = 2.0
TEXT = 'My <sync id="m"/>mother is <sync id="n"/>here.'
TIMES = {
    "words": [["My", 0.2], ["mother", 0.5], ["is", 1.0], ["here", 1.2]],
    "phonemes": [["", 0], ["m", 0.2], ["a", 0.3], ["m", 0.5], ["a", 0.6], ["z", 0.8], ["e", 1.2], ["", 1.6]],
}


def recording(seconds: float = DURATION) -> np.ndarray:
    """Noise from 0.2 s to 0.4 s before the end, as a recorded voice without words."""
    samples = 0.3 * np.random.default_rng(1).standard_normal(round(seconds * RATE)).clip(-1, 1)
    samples[: round(0.2 * RATE)] = samples[-round(0.4 * RATE) :] = 0
    return samples


def speech(inside: str = '<sound><file ref="a.wav"/></sound>', text: str = TEXT, extra: str = "") -> str:
    """A speech with words as sync points, whose description is a recording."""
    description = f'<description priority="2" type="audio/x-wav">{inside}</description>'
    return f'<speech id="s" xmlns:rr="{OWN}" rr:words="true"><text>{text}</text>{description}{extra}</speech>'


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """The assets: two seconds of noise, with the times of words and sounds."""
    soundfile.write(tmp_path / "a.wav", recording(), RATE)
    (tmp_path / "a.json").write_text(json.dumps(TIMES))
    return tmp_path


@asynccontextmanager
async def played(
    folder: Path, *behaviors: str, seconds: float = 3.0, voice: str = "text"
) -> AsyncIterator[RealizerPilot]:
    """A pilot that has played a block; its frames are kept."""
    async with open_pilot(SceneOptions(voice=voice, assets=(folder,), verify=True)) as pilot:
        pilot.watch()
        pilot.block("b", "".join(behaviors))
        await pilot.advance(seconds)
        yield pilot


def offsets(pilot: RealizerPilot) -> dict[str, float]:
    """The times of the points of the speech, s from its start."""
    points = [id_ for id_ in pilot.feedback.progress if id_.startswith("b:s:")]
    return {id_[4:]: pilot.feedback.time(id_) - pilot.feedback.time("b:s:start") for id_ in points}


def warnings(pilot: RealizerPilot) -> list[str]:
    return [each.text for each in pilot.feedback.of("warningFeedback")]


def sound(pilot: RealizerPilot) -> tuple[np.ndarray, int]:
    """The samples of the only sound that was announced, and their rate."""
    (start,) = (change for change in pilot.sounds if isinstance(change, AudioStart))
    samples: np.ndarray
    samples, rate = soundfile.read(io.BytesIO(start.clip.sound.wav))
    return samples, rate


# --- with times


async def test_a_recording_speaks_the_text_at_the_times_of_the_file_beside_it(folder: Path) -> None:
    async with played(folder, speech(), '<gesture id="g" lexeme="BEAT" stroke="s:n"/>') as pilot:
        assert warnings(pilot) == []
        times = {"word0": 0.2, "word1": 0.5, "m": 0.5, "word2": 1.0, "word3": 1.2, "n": 1.2, "end": DURATION}
        assert offsets(pilot) == pytest.approx({"start": 0.0, **times})
        assert_time(pilot.feedback, "b:g:stroke", pilot.feedback.time("b:s:n"))
        samples, rate = sound(pilot)
        assert rate == RATE
        assert samples == pytest.approx(recording(), abs=1e-3)


async def test_lips_move_with_the_sounds_of_the_recording(folder: Path) -> None:
    async with played(folder, speech()) as pilot:
        start = pilot.feedback.time("b:s:start")
        morphs = pilot.realizer.characters["alice"].humanoid.avatar.morphs
        jaw = {frame.time - start: float(frame.weights[morphs.index("jawOpen")]) for frame in pilot.frames["alice"]}
        opened = [max(weight for time, weight in jaw.items() if first < time < last) for first, last in
                  [(0.0, 0.1), (0.3, 0.5), (0.53, 0.57), (0.6, 0.7), (1.8, 2.0)]]  # fmt: skip
        silence, vowel, m, again, after = opened
        assert max(silence, m, after) < 0.05
        assert min(vowel, again) > 0.15


async def test_an_interrupted_recording_reports_what_was_heard(folder: Path) -> None:
    async with played(folder, speech(), seconds=0.8) as pilot:
        pilot.block("c", '<bmla:interrupt id="i" target="b"/>')
        await pilot.advance(0.5)
        end = next(each for each in pilot.feedback.of("syncPointProgress") if each.id == "b:s:end")
        assert end.element.get(f"{{{OWN}}}text") == "mother"
        assert [type(change) for change in pilot.sounds] == [AudioStart, AudioStop]


async def test_the_description_may_time_sync_points_itself(folder: Path) -> None:
    inside = '<sound xmlns="urn:x"><file ref="a.wav"/><sync id="n" time="1.5"/></sound>'
    async with played(folder, speech(inside)) as pilot:
        assert warnings(pilot) == []
        assert offsets(pilot)["m"] == pytest.approx(0.5)
        assert offsets(pilot)["n"] == pytest.approx(1.5)


@pytest.mark.parametrize("inside", ['<file ref="a"/>', '<bmlt:audiofile filename="a.wav"/>'])
async def test_the_file_may_be_written_as_in_smartbody_and_as_in_bmlt(folder: Path, inside: str) -> None:
    async with played(folder, speech(inside)) as pilot:
        assert warnings(pilot) == []
        assert offsets(pilot)["word3"] == pytest.approx(1.2)


SMARTBODY = """<?xml version="1.0" encoding="utf-8"?>
<bml>
  <speech id="sp1" start="0.0" ready="0.1" stroke="0.1" relax="0.2" end="0.2">
    <text><sync id="T0" time="0.3"/>my <sync id="T1" time="0.5"/><sync id="T2" time="0.5"/>mother
      <sync id="T3" time="0.9"/><sync id="T4" time="1.1"/>is <sync id="T5" time="1.2"/>
      <sync id="T6" time="1.3"/>here <sync id="T7" time="1.5"/></text>
    <description level="1" type="audio/x-wav"><file ref="a"/></description>
  </speech>
  <lips viseme="BMP" articulation="1.0" start="0.3" ready="0.3" relax="0.4" end="0.4"/>
  <lips viseme="Ah" articulation="1.0" start="0.4" ready="0.4" relax="0.5" end="0.5"/>
</bml>"""


async def test_a_speech_file_of_smartbody_has_the_times(folder: Path) -> None:
    (folder / "a.json").unlink()
    (folder / "a.bml").write_text(SMARTBODY)
    async with played(folder, speech()) as pilot:
        assert warnings(pilot) == []
        assert [offsets(pilot)[f"word{index}"] for index in range(4)] == pytest.approx([0.3, 0.5, 1.1, 1.3])


@pytest.mark.parametrize(
    ("name", "text", "last"),
    [
        ("a_no_fun", "That's no fun!", 0.46),
        ("bye", "Bye, have a nice day.", 0.77),
        ("q_are_you_better", "Hi, are you feeling better now?", 1.1),
    ],
)
async def test_smartbodys_own_speech_files_are_read(
    folder: Path, shared_cases: Path, name: str, text: str, last: float
) -> None:
    (folder / f"{name}.bml").write_bytes((shared_cases / "smartbody" / f"{name}.bml").read_bytes())
    soundfile.write(folder / f"{name}.wav", recording(), RATE)
    async with played(folder, speech(f'<file ref="{name}"/>', text)) as pilot:
        assert warnings(pilot) == []
        assert offsets(pilot)[f"word{len(text.split()) - 1}"] == pytest.approx(last)


# --- without times


async def spoken(folder: Path, text: str) -> Utterance:
    """A recording by a voice with known times, after 0.3 s of silence."""
    voice = EspeakVoice()
    await voice.start()
    try:
        utterance = await completed(voice.synthesize(text, (), "en-us"))
    finally:
        await voice.close()
    samples = np.frombuffer(utterance.audio, "<i2")
    silence = np.zeros(round(0.3 * utterance.sample_rate), "<i2")
    soundfile.write(folder / "spoken.wav", np.concatenate([silence, samples]), utterance.sample_rate)
    return utterance


@pytest.mark.speech
@pytest.mark.align
@pytest.mark.parametrize(
    "text",
    ["Hello, I am glad that you came. Shall we begin?", "Put the zorbified ice-cream on table 7, please."],
    ids=["known words", "other words"],
)
async def test_words_are_found_in_the_sound(folder: Path, text: str) -> None:
    utterance = await spoken(folder, text)
    async with played(folder, speech('<file ref="spoken"/>', text), seconds=6) as pilot:
        assert warnings(pilot) == []
        found = offsets(pilot)
        errors = [found[f"word{n}"] - 0.3 - word.start for n, word in enumerate(utterance.words)]
        assert np.median(np.abs(errors)) < 0.04
        assert np.max(np.abs(errors)) < 0.12


async def test_without_the_aligner_words_are_spread_over_what_is_heard_which_is_told_once(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(aligner, "find_spec", lambda _: None)
    (folder / "a.json").unlink()
    async with played(folder, speech(text="One two, three!")) as pilot:
        pilot.block("c", speech(text="One two, three!"))
        await pilot.advance(3)
        (warning,) = warnings(pilot)
        assert "pip install 'reactive-realizer[align]'" in warning
        character = 1.4 / len("One two three")
        starts = [offsets(pilot)[f"word{index}"] for index in range(3)]
        assert starts == pytest.approx([0.2, 0.2 + 4 * character, 0.2 + 8 * character], abs=0.01)


@pytest.mark.align
@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("\u042d\u0442\u043e \u0437\u0432\u0443\u043a.", "the text has words in another script"),
        ("word " * 200, "the text does not fit it"),
    ],
    ids=["another script", "too much text"],
)
async def test_words_that_cannot_be_found_are_spread_and_the_reason_is_told(
    folder: Path, text: str, reason: str
) -> None:
    (folder / "a.json").unlink()
    async with played(folder, speech(text=text)) as pilot:
        (warning,) = warnings(pilot)
        assert f"the times of words in a.wav are estimated: {reason}" in warning
        assert offsets(pilot)["word1"] > offsets(pilot)["word0"]


@pytest.mark.align
async def test_of_many_recordings_that_come_at_once_one_is_searched_at_a_time(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    started: list[asyncio.subprocess.Process | None] = []
    running: list[int] = []
    start = asyncio.create_subprocess_exec

    async def starting(*command: str, **options: Any) -> asyncio.subprocess.Process:
        running.append(sum(process is None or process.returncode is None for process in started))
        started.append(None)
        index = len(started) - 1
        started[index] = process = await start(*command, **options)
        return process

    monkeypatch.setattr(asyncio, "create_subprocess_exec", starting)
    (folder / "a.json").unlink()
    others = [speech(text=text).replace('id="s"', f'id="{id_}" start="{tie}"') for text, id_, tie in
              (("Four five six.", "t", "s:end"), ("Seven eight.", "u", "t:end"))]  # fmt: skip
    async with played(folder, speech(text="One two three."), *others, seconds=7) as pilot:
        assert running == [0, 0, 0]
        assert pilot.feedback.reached("b:u:end")


async def test_samples_are_read_mixed_and_searched_in_other_threads_so_that_ticks_go_on(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    threads: list[threading.Thread] = []

    def noting(work: Callable[..., object]) -> Callable[..., object]:
        def noted(*arguments: object) -> object:
            threads.append(threading.current_thread())
            return work(*arguments)

        return noted

    monkeypatch.setattr(recordings, "read_mono", noting(recordings.read_mono))
    monkeypatch.setattr(recordings, "spread", noting(spread))
    monkeypatch.setattr(aligner, "find_spec", lambda _: None)
    (folder / "a.json").unlink()
    async with played(folder, speech()) as pilot:
        assert pilot.feedback.reached("b:s:end")
    assert len(threads) == 2
    assert threading.main_thread() not in threads


async def test_a_recording_without_a_text_plays(folder: Path) -> None:
    async with played(folder, speech(text="")) as pilot:
        assert warnings(pilot) == []
        assert offsets(pilot) == pytest.approx({"start": 0.0, "end": DURATION})


# --- what cannot be played


BAD: dict[str, tuple[str, dict[str, str], str]] = {
    "no file": ("<sound/>", {}, '<description> must contain <file ref="..."/>'),
    "no such file": ('<file ref="b.wav"/>', {}, "no asset named 'b.wav'"),
    "a path out of the assets": ('<file ref="../a.wav"/>', {}, "must be a relative path inside the asset folders"),
    "no sound": ('<file ref="x.wav"/>', {"x.wav": "hello"}, "x.wav cannot be read as a sound"),
    "a time after the end": ('<file ref="a.wav"/><sync id="n" time="2.5"/>', {}, "a.wav lasts 2.00 s"),
    "an unknown sync point": ('<file ref="a.wav"/><sync id="x" time="1"/>', {}, "no inline sync point 'x'"),
    "a bad time": ('<file ref="a.wav"/><sync id="n" time="soon"/>', {}, "not a finite number"),
    "other words": ('<file ref="a.wav"/>', {"a.json": '{"words": [["Hi", 0]]}'}, "'Hi' instead of 'My mother is here'"),
    "no JSON": ('<file ref="a.wav"/>', {"a.json": "words"}, "a.json: not JSON"),
    "other JSON": ('<file ref="a.wav"/>', {"a.json": '{"words": [["Hi"]]}'}, "a.json: $.words[0]"),
    "a time with too many digits": (
        '<file ref="a.wav"/>',
        {"a.json": f'{{"words": [["My", 0], ["mother", 1], ["is", 1], ["here", {"9" * 4000}]]}}'},
        "the times of the words are not in order from 0 to 2.00 s",
    ),
    "no order": (
        '<file ref="a.wav"/>',
        {"a.json": '{"words": [["My", 0.2], ["mother", 0.1], ["is", 1], ["here", NaN]]}'},
        "the times of the words are not in order from 0 to 2.00 s",
    ),
}


@pytest.mark.parametrize("name", BAD)
async def test_a_recording_that_cannot_be_played_is_replaced_by_the_voice_and_the_reason_is_told_once(
    folder: Path, name: str
) -> None:
    inside, files, reason = BAD[name]
    for file, content in files.items():
        (folder / file).write_text(content)
    async with played(folder, speech(inside)) as pilot:
        (warning,) = warnings(pilot)
        assert reason in warning
        assert offsets(pilot)["word0"] == 0.0
        assert pilot.feedback.status("b") == "DONE"


async def test_the_recording_of_the_next_priority_plays_if_the_best_cannot(folder: Path) -> None:
    better = '<description priority="3" type="audio/x-wav"><file ref="better.wav"/></description>'
    async with played(folder, speech(extra=better)) as pilot:
        (warning,) = warnings(pilot)
        assert "better.wav" in warning
        assert offsets(pilot)["end"] == pytest.approx(DURATION)


@pytest.mark.speech
async def test_a_voice_that_takes_time_replaces_a_recording_too(folder: Path) -> None:
    async with played(folder, speech('<file ref="b.wav"/>'), voice="espeak") as pilot:
        assert len(warnings(pilot)) == 1
        _, rate = sound(pilot)
        assert rate == 22_050
        assert pilot.feedback.status("b") == "DONE"
