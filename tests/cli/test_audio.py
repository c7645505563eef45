"""The sound of `realize`: where each sound lies in the file, and how loud it is."""

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import soundfile

from reactive_realizer.__main__ import main
from reactive_realizer.testing.pilot import block

RATE = 48_000


class Session:
    """Runs ``realize`` with assets in a folder; the sound that it writes, (N, C), and the times of its feedback, s."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.times: dict[str, float] = {}

    def add(self, name: str, samples: np.ndarray, rate: int = RATE) -> None:
        soundfile.write(self.folder / name, samples, rate)

    def realize(self, *behaviors: str, voice: str = "text", human: str = "", until: str = "600") -> np.ndarray:
        for index, each in enumerate(behaviors):
            (self.folder / f"{index}.xml").write_text(each if each.startswith("<bml ") else block(f"b{index}", each))
        (self.folder / "human.toml").write_text(human or "[character.alice]")
        out, feedback = self.folder / "out.wav", self.folder / "feedback.jsonl"
        inputs = [str(self.folder / f"{index}.xml") for index in range(len(behaviors))]
        scene = ["--assets", str(self.folder), "--human", str(self.folder / "human.toml"), "--voice", voice]
        outputs = ["--audio", str(out), "--feedback", str(feedback)]
        assert main(["realize", *inputs, *scene, *outputs, "--until", until]) == 0
        told = feedback.read_text()
        points = re.findall(r'<syncPointProgress [^>]*?id=\\"(\S+?)\\"[^>]*? globalTime=\\"([^"]*)\\"', told)
        self.times = {point: float(time) for point, time in points}
        assert "warningFeedback" not in told
        samples: np.ndarray
        samples, rate = soundfile.read(out, always_2d=True)
        assert rate == RATE
        return samples


@pytest.fixture
def session(tmp_path: Path) -> Session:
    return Session(tmp_path)


def click() -> np.ndarray:
    """Half a second that begins with one loud sample."""
    return np.concatenate([[0.5], np.zeros(RATE // 2 - 1)])


def steady(seconds: float = 1.0, rate: int = RATE) -> np.ndarray:
    """A constant level of 0.25, so that every sample shows the gain."""
    return np.full(round(seconds * rate), 0.25)


def play(id_: str, file: str, ties: str = "") -> str:
    return f'<bmlt:audiofile id="{id_}" filename="{file}" {ties}/>'


def volume(target: str, value: float, ties: str) -> str:
    change = f'<bmla:trajectory type="instant" targetValue="{value}"/>'
    return f'<bmla:parametervaluechange target="{target}" paramId="volume" {ties}>{change}</bmla:parametervaluechange>'


def test_every_sound_begins_at_the_sample_of_its_start(session: Session) -> None:
    session.add("click.wav", click())
    samples = session.realize(
        play("one", "click.wav", 'start="0.1234"')
        + play("two", "click.wav", 'start="nod:stroke"')
        + '<head id="nod" lexeme="NOD" start="0.777"/>',
        block("b1", play("three", "click.wav"), composition="APPEND"),
    )
    starts = [session.times[point] for point in ("b0:one:start", "b0:two:start", "b1:three:start")]
    assert np.flatnonzero(samples[:, 0]).tolist() == [round(time * RATE) for time in starts]
    assert len(samples) == pytest.approx((starts[-1] + 0.5) * RATE, abs=RATE / 50)


def test_another_rate_is_resampled_without_a_shift(session: Session) -> None:
    time = np.arange(8000) / 8000
    bump = 0.5 * np.exp(-(((time - 0.5) / 0.01) ** 2))
    session.add("bump.wav", bump, 8000)
    samples = session.realize(play("s", "bump.wav", 'start="0.2"'))
    centre = np.average(np.arange(len(samples)), weights=samples[:, 0] ** 2)
    assert centre == pytest.approx((session.times["b0:s:start"] + 0.5) * RATE, abs=1)


def test_an_interrupted_sound_is_silent_after_its_fade_of_20_milliseconds(session: Session) -> None:
    session.add("steady.wav", steady())
    samples = session.realize(
        play("s", "steady.wav"), block("b1", '<bmla:interrupt target="b0" start="0.4"/><wait duration="1" id="w"/>')
    )[:, 0]
    cut = round(session.times["b0:s:end"] * RATE)
    assert session.times["b0:s:end"] == pytest.approx(0.4, abs=0.02)
    assert samples[cut - 1] == pytest.approx(0.25, abs=1e-3)
    assert np.all(np.diff(samples[cut : cut + 960]) <= 0)
    assert 0 < samples[cut + 950] < 0.0025
    assert not samples[cut + 961 :].any()


def test_a_sound_that_is_revoked_before_its_start_is_not_heard(session: Session) -> None:
    session.add("steady.wav", steady())
    samples = session.realize(
        play("s", "steady.wav", 'start="1"') + '<wait id="w" duration="2"/>',
        block("b1", '<bmla:interrupt target="b0" include="s" start="0.4"/>'),
    )
    assert not samples.any()


def test_a_change_of_volume_settles_with_a_time_constant_of_20_milliseconds(session: Session) -> None:
    session.add("steady.wav", steady())
    samples = session.realize(play("s", "steady.wav") + volume("s", 100, 'start="s:start+0.3" end="s:start+0.3"'))[:, 0]
    start = round(session.times["b0:s:start"] * RATE)
    changed = start + round(0.3 * RATE)
    assert samples[start : changed - 1] == pytest.approx(0.25, abs=1e-3)
    after = np.arange(RATE // 2)
    wanted = 0.5 - 0.25 * np.exp(-after / (0.02 * RATE))
    assert samples[changed : changed + len(after)] == pytest.approx(wanted, abs=1e-3)


def test_the_sounds_of_all_characters_are_added_and_limited(session: Session) -> None:
    session.add("steady.wav", steady())
    session.add("loud.wav", np.full(RATE, 0.9))
    samples = session.realize(
        block("b0", play("s", "steady.wav", 'start="0"') + play("t", "steady.wav", 'start="0.5"'), characterId="ann"),
        block("b1", play("s", "loud.wav", 'start="1.2"'), characterId="bert"),
        human="[character.ann]\n[character.bert]",
    )[:, 0]
    first = session.times["b0:s:start"]
    level = [samples[round((first + seconds) * RATE)] for seconds in (0.25, 0.75, 1.1, 1.3, 1.8)]
    assert level == pytest.approx([0.25, 0.5, 0.25, 1.0, 0.9], abs=1e-3)


def test_one_sound_in_stereo_makes_the_file_stereo(session: Session) -> None:
    session.add("mono.wav", steady())
    session.add("stereo.wav", np.stack([steady(), -steady()], axis=1))
    samples = session.realize(play("m", "mono.wav", 'start="0"') + play("s", "stereo.wav", 'start="1.5"'))
    assert samples[RATE // 2] == pytest.approx([0.25, 0.25], abs=1e-3)
    assert samples[2 * RATE] == pytest.approx([0.25, -0.25], abs=1e-3)


def test_a_session_without_sounds_gives_silence_of_its_duration(session: Session) -> None:
    samples = session.realize('<speech id="s"><text>Silent.</text></speech><wait id="w" duration="0.7"/>')
    assert samples.shape == (pytest.approx(0.7 * RATE, abs=RATE / 50), 1)
    assert not samples.any()


def test_a_sound_beyond_the_end_of_the_session_is_cut_there(session: Session) -> None:
    session.add("long.wav", steady(12))
    samples = session.realize(play("s", "long.wav"), until="11")
    assert len(samples) == 11 * RATE
    assert samples[-1, 0] == pytest.approx(0.25, abs=1e-3)


@pytest.mark.speech
def test_speech_is_heard_at_the_times_of_its_feedback(session: Session) -> None:
    text = '<text>Papa <sync id="pause"/><sync id="b"/>bakes. <sync id="c"/>Tomorrow too.</text>'
    samples = session.realize(
        f'<speech id="s" start="0.5">{text}</speech>',
        block("b1", '<speech id="t"><text>Good.</text></speech>', composition="APPEND"),
        voice="espeak",
    )[:, 0]
    loud = np.abs(samples) > 0.02
    first, last = np.flatnonzero(loud)[[0, -1]] / RATE
    assert session.times["b0:s:start"] <= first <= session.times["b0:s:start"] + 0.08
    assert last <= session.times["b1:t:end"]
    silences = np.flatnonzero(np.diff(np.flatnonzero(loud)) > 0.15 * RATE)
    resumed = np.flatnonzero(loud)[silences + 1] / RATE
    assert np.min(np.abs(resumed - session.times["b0:s:c"])) < 0.08
    assert np.min(np.abs(resumed - session.times["b1:t:start"])) < 0.08


def test_a_folder_that_does_not_exist_is_an_error(bml: Callable[..., str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["realize", bml(block("b")), "--audio", "nowhere/out.wav"]) == 2
    assert "no such folder: nowhere" in capsys.readouterr().err
