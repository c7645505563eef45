"""Sounds from files: `bmlt:audiofile`."""

import io
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import soundfile

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.audio import AudioGain, AudioMove, AudioStart, AudioStop
from reactive_realizer.testing.assertions import assert_time
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

RATE = 8000
DURATION = 0.5


def tone(rate: int = RATE, channels: int = 1, duration: float = DURATION) -> np.ndarray:
    """Samples (N, C) of a tone."""
    time = np.arange(round(duration * rate)) / rate
    return np.repeat(0.5 * np.sin(2 * np.pi * 440 * time)[:, None], channels, axis=1)


def encoded(kind: str, rate: int = RATE, channels: int = 1, duration: float = DURATION) -> bytes:
    """A sound file in memory."""
    file = io.BytesIO()
    soundfile.write(file, tone(rate, channels, duration), rate, format=kind)
    return file.getvalue()


def half(file: bytes) -> bytes:
    """The first half of a file."""
    return file[: len(file) // 2]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """The assets: half a second of a tone in ``a.wav``."""
    assets = tmp_path / "assets"
    assets.mkdir()
    (assets / "a.wav").write_bytes(encoded("WAV"))
    return assets


def options(folder: Path, human: str = "") -> SceneOptions:
    if not human:
        return SceneOptions(voice="text", assets=(folder,), verify=True)
    file = folder / "human.toml"
    file.write_text(human)
    return SceneOptions(file, "text", (folder,), verify=True)


def sound(id_: str = "s", file: str = "a.wav", **points: str) -> str:
    ties = "".join(f' {point}="{ref}"' for point, ref in points.items())
    return f'<bmlt:audiofile id="{id_}" filename="{file}"{ties}/>'


def starts(pilot: RealizerPilot) -> list[AudioStart]:
    """The starts of sounds; the speeches of the text voice have none, only captions."""
    started = (change for change in pilot.sounds if isinstance(change, AudioStart))
    return [start for start in started if start.clip.sound.wav]


@pytest.mark.parametrize("kind", ["WAV", "OGG", "MP3", "FLAC"])
@pytest.mark.parametrize(("rate", "channels"), [(8000, 1), (44_100, 2)])
async def test_a_file_of_any_usual_format_plays_for_its_duration(
    folder: Path, kind: str, rate: int, channels: int
) -> None:
    (folder / "x.bin").write_bytes(encoded(kind, rate, channels))
    async with open_pilot(options(folder)) as pilot:
        pilot.block("b", sound(file="x.bin", start="0.2"))
        await pilot.advance(1)
        (start,) = starts(pilot)
        assert pilot.feedback.warnings == []
        assert start.start == pytest.approx(pilot.feedback.time("b:s:start"))
        assert_time(pilot.feedback, "b:s:end", pilot.feedback.time("b:s:start") + DURATION)
        samples, played = soundfile.read(io.BytesIO(start.clip.sound.wav), always_2d=True)
        assert (played, samples.shape) == (rate, (rate * DURATION, channels))
        assert np.sqrt(np.mean(samples**2)) == pytest.approx(np.sqrt(0.125), rel=0.05)


async def test_a_higher_rate_than_pages_need_is_reduced(folder: Path) -> None:
    (folder / "a.wav").write_bytes(encoded("WAV", 96_000))
    async with open_pilot(options(folder)) as pilot:
        pilot.block("b", sound())
        await pilot.advance(1)
        samples, rate = soundfile.read(io.BytesIO(starts(pilot)[0].clip.sound.wav))
        assert (rate, len(samples)) == (48_000, 24_000)


async def test_a_sound_can_be_tied_by_its_end_and_gestures_to_it(folder: Path) -> None:
    async with open_pilot(options(folder)) as pilot:
        pilot.block("b", sound(end="2") + '<gesture id="g" lexeme="BEAT" stroke="s:start"/>')
        await pilot.advance(4)
        start = pilot.feedback.time("b:start")
        assert_time(pilot.feedback, "b:s:start", start + 2 - DURATION)
        assert_time(pilot.feedback, "b:g:stroke", start + 2 - DURATION)
        assert_time(pilot.feedback, "b:s:end", start + 2)


async def test_a_sound_is_neither_stretched_nor_cut_by_constraints(folder: Path) -> None:
    async with open_pilot(options(folder)) as pilot:
        pilot.block("b", sound(start="0", end="0.3"))
        await pilot.advance(1)
        assert len(pilot.feedback.warnings) == 1
        assert_time(pilot.feedback, "b:s:end", pilot.feedback.time("b:s:start") + DURATION)


async def test_a_sound_follows_a_prediction_until_it_starts(folder: Path) -> None:
    async with open_pilot(options(folder)) as pilot:
        pilot.predict("partner", "hit", 1.0)
        pilot.block("b", sound(start="anticipators:partner:hit"))
        await pilot.advance(0.5)
        pilot.predict("partner", "hit", 1.2)
        await pilot.advance(2)
        assert_time(pilot.feedback, "b:s:start", 1.2)
        (move,) = (change for change in pilot.sounds if isinstance(change, AudioMove))
        assert (move.id, move.start) == (starts(pilot)[0].clip.id, 1.2)


async def test_characters_play_several_sounds_at_once_beside_their_speech(folder: Path) -> None:
    async with open_pilot(options(folder, "[character.ann]\n[character.bert]")) as pilot:
        pilot.block("a", sound("s") + sound("t", start="0.1") + '<speech id="u"><text>Hello.</text></speech>')
        pilot.block("b", sound("s", start="0.1"), characterId="bert")
        await pilot.advance(1)
        assert pilot.feedback.warnings == []
        assert [start.character for start in starts(pilot)] == ["ann", "ann", "bert"]
        assert len({start.clip.id for start in starts(pilot)}) == 3
        assert len({id(start.clip.sound) for start in starts(pilot)}) == 2  # one for each character that plays the file


async def test_the_volume_is_changed_while_the_sound_plays(folder: Path) -> None:
    change = '<bmla:trajectory type="instant" targetValue="25"/>'
    async with open_pilot(options(folder)) as pilot:
        pilot.block(
            "b",
            sound()
            + '<bmla:parametervaluechange id="p" target="s" paramId="volume" start="s:start+0.2" end="s:start+0.2">'
            + f"{change}</bmla:parametervaluechange>",
        )
        await pilot.advance(1)
        assert pilot.feedback.warnings == []
        (gain,) = (each for each in pilot.sounds if isinstance(each, AudioGain))
        assert gain.gain == 0.5
        assert gain.time == pytest.approx(pilot.feedback.time("b:s:start") + 0.2)


async def test_an_interrupted_sound_fades_within_30_milliseconds(folder: Path) -> None:
    async with open_pilot(options(folder)) as pilot:
        pilot.block("b", sound() + sound("t"))
        await pilot.advance(0.2)
        pilot.block("c", '<bmla:interrupt id="i" target="b" include="s"/>')
        await pilot.advance(1)
        (stop,) = (change for change in pilot.sounds if isinstance(change, AudioStop))
        assert (stop.id, stop.time, stop.fade) == (starts(pilot)[0].clip.id, pilot.feedback.time("b:s:end"), 0.02)
        assert_time(pilot.feedback, "b:t:end", pilot.feedback.time("b:t:start") + DURATION)


async def test_a_sound_that_is_heard_late_moves_its_end(folder: Path) -> None:
    async with open_pilot(options(folder)) as pilot:
        pilot.block("b", sound() + '<head id="n" lexeme="NOD" start="s:end"/>')
        await pilot.advance(0.1)
        start = pilot.feedback.time("b:s:start")
        for _ in range(2):
            pilot.heard(starts(pilot)[0].clip.id, pilot.now - start - 0.08, pilot.now)
            await pilot.advance(0.1)
        await pilot.advance(1)
        assert_time(pilot.feedback, "b:s:end", start + DURATION + 0.08)
        assert_time(pilot.feedback, "b:n:start", start + DURATION + 0.08)


BAD: dict[str, tuple[str, Callable[[], bytes] | None, str]] = {
    "a name that no file has": ("b.wav", None, "did you mean 'a.wav'?"),
    "a path out of the assets": ("../a.wav", None, "must be a relative path inside the asset folders"),
    "an absolute path": ("/etc/passwd", None, "must be a relative path inside the asset folders"),
    "no sound": ("x.wav", lambda: b"hello, world" * 100, "x.wav cannot be read as a sound: Format not recognised."),
    "an empty file": ("x.wav", lambda: b"", "x.wav cannot be read as a sound: Format not recognised."),
    "samples without a header": ("x.raw", lambda: bytes(4000), "x.raw cannot be read as a sound: it has no header"),
    "no samples": ("x.wav", lambda: encoded("WAV", duration=0), "it has no samples"),
    "a truncated WAV file": ("x.wav", lambda: half(encoded("WAV")), "x.wav is truncated: it contains 0.25 s of 0.50 s"),
    "a truncated MP3 file": ("x.mp3", lambda: half(encoded("MP3", duration=2)), "x.mp3 is truncated"),
    "a truncated FLAC file": ("x.flac", lambda: half(encoded("FLAC")), "x.flac cannot be read as a sound"),
    "too many channels": ("x.wav", lambda: encoded("WAV", channels=6), "it has 6 channels"),
    "an absurd rate": ("x.wav", lambda: encoded("WAV", rate=1000), "its sample rate of 1000 Hz is not from 4000"),
    "an absurd duration": (
        "x.flac",
        lambda: encoded("FLAC", duration=301),
        "x.flac lasts 301.00 s; at most 300.00 s are allowed",
    ),
}


@pytest.mark.parametrize("name", BAD)
async def test_what_cannot_be_played_is_refused_with_the_reason_and_the_rest_of_the_block_plays(
    folder: Path, name: str
) -> None:
    file, content, reason = BAD[name]
    if content is not None:
        (folder / file).write_bytes(content())
    async with open_pilot(options(folder)) as pilot:
        pilot.block("b", sound(file=file) + '<wait id="w" duration="0.1"/>')
        await pilot.advance(1)
        assert pilot.feedback.warnings == [("b:s", "CANNOT_CREATE_BEHAVIOR")]
        assert reason in pilot.feedback.of("warningFeedback")[0].text
        assert pilot.feedback.reached("b:w:end")
        assert starts(pilot) == []


async def test_a_file_that_was_written_into_a_pipe_is_whole(folder: Path) -> None:
    wav = encoded("WAV")
    streamed = wav[:4] + b"\xff" * 4 + wav[8:40] + b"\xff" * 4 + wav[44:]
    (folder / "a.wav").write_bytes(streamed)
    async with open_pilot(options(folder)) as pilot:
        pilot.block("b", sound())
        await pilot.advance(1)
        assert pilot.feedback.warnings == []


async def test_the_limit_on_the_duration_is_in_the_human_file(folder: Path) -> None:
    (folder / "a.wav").write_bytes(encoded("WAV", duration=1.2))
    async with open_pilot(options(folder, "[character.ann]\n[limits]\nsound_seconds = 1")) as pilot:
        pilot.block("b", sound())
        await pilot.advance(1)
        assert "at most 1.00 s are allowed" in pilot.feedback.of("warningFeedback")[0].text


async def test_asap_realizers_spelling_of_the_attribute_is_read(folder: Path) -> None:
    async with open_pilot(options(folder)) as pilot:
        pilot.block("b", '<bmlt:audiofile id="s" fileName="a.wav"/>')
        await pilot.advance(1)
        assert pilot.feedback.warnings == []
        assert len(starts(pilot)) == 1
