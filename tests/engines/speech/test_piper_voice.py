"""Piper voices, which are files of the user. Most tests write a tiny one; the last one needs a real one."""

import asyncio
import os
import signal
from collections import deque
from collections.abc import AsyncIterator, Iterator
from itertools import pairwise
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest
from onnx import TensorProto
from onnx.helper import make_graph, make_model, make_node, make_tensor_value_info

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.markup import Markup, MarkupKind
from reactive_realizer.engine.tts import TTSBinding, Utterance, completed
from reactive_realizer.engines.speech.neural.network import UnusableNetwork
from reactive_realizer.engines.speech.piper.model import PiperModel
from reactive_realizer.engines.speech.piper.voice import PLACE, PiperVoice, alphabet
from reactive_realizer.engines.speech.piper.voice_file import voice_files
from reactive_realizer.errors import RealizerError
from reactive_realizer.testing.pilot import open_pilot
from reactive_realizer.testing.tts_contract import Speaker, TTSContract

from .piper_files import IDS, RATE, tiny_network, write_voice

LONG = "Please take the first street on the left, and walk until you see the station. It is near."


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("piper")
    write_voice(folder)
    write_voice(folder, "two", ("ann", "bob"))
    return folder


@pytest.fixture(scope="module")
def started(folder: Path) -> Iterator[Speaker]:
    """Voices that have started, which takes seconds."""
    with asyncio.Runner() as runner, pytest.MonkeyPatch.context() as patch:
        patch.setenv(PLACE, str(folder))
        voice = PiperVoice()
        runner.run(voice.start())
        yield Speaker(voice, runner)
        runner.run(voice.close())


@pytest.fixture
async def voice(folder: Path, monkeypatch: pytest.MonkeyPatch) -> AsyncIterator[PiperVoice]:
    monkeypatch.setenv(PLACE, str(folder))
    voice = PiperVoice()
    await voice.start()
    yield voice
    await voice.close()


@pytest.mark.piper
class TestPiperVoice(TTSContract):
    long_text: ClassVar = "hello world " * 20

    def tts(self) -> TTSBinding:
        return PiperVoice()

    @pytest.fixture
    def speaker(self, started: Speaker) -> Speaker:
        """The one that all tests share."""
        return started

    def test_voices_have_the_names_of_their_files_and_speakers_and_the_first_is_the_default(
        self, speaker: Speaker
    ) -> None:
        assert speaker.voices() == ("tones", "two+ann", "two+bob")
        assert speaker.say("Yes.") == speaker.say("Yes.", voice="tones")
        ann, bob = (np.frombuffer(speaker.say("Yes.", voice=f"two+{each}").audio, "<i2") for each in ("ann", "bob"))
        assert bob.max() == pytest.approx(ann.max() / 2, rel=0.01)

    def test_words_sound_where_they_are_said_to_be(self, speaker: Speaker) -> None:
        spoken = speaker.say("Go, we may see. Now.")
        level = loudness(spoken)
        for word in spoken.words[1:]:
            heard = round((word.start + 0.045) / 0.01)  # a tiny network has no lag
            assert max(level[heard : heard + 8]) > 0.5, word
        pauses = [each for each in spoken.phonemes[:-1] if not each.symbol]
        assert len(pauses) == 2
        assert all(level[round((each.start + each.duration / 2 + 0.045) / 0.01)] < 0.02 for each in pauses)
        assert pauses[1].duration > pauses[0].duration + 0.1, "a sentence ends with a longer pause than a clause"
        assert all(one.start < next_.start for one, next_ in pairwise(spoken.words))
        assert spoken.sample_rate == RATE

    def test_a_speech_begins_long_before_all_of_it_is_made_and_its_parts_are_those_of_the_whole(
        self, speaker: Speaker, folder: Path
    ) -> None:
        first, *_, last = speaker.parts(LONG)
        assert first.made < 1.5 < 4.0 < last.duration
        model = PiperModel(*voice_files(folder / "tones.onnx"))
        predicted = model.predict([IDS[each][0] for each in "\u0261\u028a d m \u0254 n"] * 9, "tones", 1.0)
        whole, step = model.speak(predicted, 0, sum(predicted.durations)), 7
        frames = range(0, sum(predicted.durations), step)
        assert whole == b"".join(model.speak(predicted, each, each + step) for each in frames)


def loudness(spoken: Utterance) -> np.ndarray:
    """The root mean square of each 10 ms, as a share of the greatest."""
    samples, block = np.frombuffer(spoken.audio, "<i2").astype(float), spoken.sample_rate // 100
    levels = np.sqrt((samples[: len(samples) // block * block].reshape(-1, block) ** 2).mean(axis=1))
    return np.asarray(levels / levels.max())


@pytest.mark.piper
async def test_markup_is_followed_and_what_the_voice_cannot_do_is_left_out(voice: PiperVoice) -> None:
    text = "Take model A4 now"

    async def said(kind: MarkupKind, part: str, **properties: object) -> Utterance:
        first = text.index(part)
        markup = Markup(kind, first, first + len(part), f"<{kind}>", **properties)  # type: ignore[arg-type]
        return await completed(voice.synthesize_markup(text, (), None, (markup,)))

    plain = await completed(voice.synthesize(text, (), None))
    slow = await said(MarkupKind.RATE, "model A4", number=0.5)
    assert between(slow, "model", "now") == pytest.approx(2 * between(plain, "model", "now"), rel=0.15)
    silence = await said(MarkupKind.BREAK, "now", number=1.5)
    assert between(silence, "A4", "now") == pytest.approx(between(plain, "A4", "now") + 1.5, abs=0.2)
    instead = await said(MarkupKind.SUB, "A4", text="A four, the black one,")
    assert between(instead, "A4", "now") > between(plain, "A4", "now") + 0.5
    sounds = await said(MarkupKind.PHONEME, "A4", text="\u02c8\u025b\u02d0n")
    assert [each.symbol for each in sounds.phonemes if sounds.words[2].start <= each.start < sounds.words[3].start] == [
        "\u02c8\u025b\u02d0",
        "n",
    ]
    emphasis = await said(MarkupKind.EMPHASIS, "now", text="strong")
    assert [each.kind for each in emphasis.left_out] == [MarkupKind.EMPHASIS]
    assert not any(each.left_out for each in (slow, silence, instead, sounds))


def between(utterance: Utterance, first: str, last: str) -> float:
    """The time from one word to another, s."""
    starts = {word.text: word.start for word in utterance.words}
    return starts[last] - starts[first]


def test_letters_and_diacritics_are_told_apart_and_clauses_as_espeak_tells_them() -> None:
    characters = {number: character for character, (number,) in IDS.items()}
    known = alphabet({character: number for character, (number,) in IDS.items()})
    assert [characters[each] for each in known.write("\u02c8a\u0303")] == ["\u02c8", "a", "\u0303"]
    assert [characters[each] for each in known.write("\u00e3")] == ["a", "\u0303"]
    assert [characters[each] for each in known.write("\u00e7")] == ["c"]
    assert [characters[each] for each in known.punctuate(' \u2014 "', last=False)] == [" ", ";", " "]
    assert [characters[each] for each in known.punctuate(").\n", last=True)] == ["."]


@pytest.mark.piper
async def test_a_character_has_its_voice_and_one_that_does_not_exist_is_named(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    human = tmp_path / "human.toml"
    human.write_text('[character.max]\nvoice = {piper = "two+bob"}\n[character.eva]\nvoice = "two+bop"\n')
    monkeypatch.setenv(PLACE, str(folder))
    async with open_pilot(SceneOptions(human, voice="piper")) as pilot:
        pilot.block("b", '<speech id="s"><text>Yes.</text></speech>')
        pilot.block("c", '<speech id="s"><text>Yes.</text></speech>', characterId="eva")
        await pilot.advance(2)
        assert pilot.feedback.reached("b:s:end")
        assert pilot.sounds
        (warning,) = pilot.feedback.of("warningFeedback")
        assert "there is no voice 'two+bop'" in warning.text
        assert "two+bob" in warning.text


@pytest.mark.piper
async def test_killing_the_worker_fails_one_speech_and_the_next_starts_another(voice: PiperVoice) -> None:
    pending = asyncio.ensure_future(completed(voice.synthesize(LONG * 9, (), None)))
    process = voice.worker.process
    assert process
    while not process.busy:  # noqa: ASYNC110 - nothing signals a request
        await asyncio.sleep(0.001)
    os.kill(process.pid, signal.SIGKILL)
    with pytest.raises(RealizerError, match="SIGKILL"):
        await pending
    assert (await completed(voice.synthesize("Yes.", (), None))).audio
    assert voice.worker.restarts == 1


def refusal(place: Path) -> str:
    """Why the voices at a place cannot be used."""
    with pytest.raises(UnusableNetwork) as refused:
        deque(map(PiperModel, voice_files(place)))
    return str(refused.value)


def test_a_place_without_voices_is_refused(tmp_path: Path) -> None:
    assert refusal(tmp_path) == f"{tmp_path} contains no .onnx file"
    assert refusal(tmp_path / "gone.onnx") == f"{tmp_path / 'gone.onnx'} does not exist"
    write_voice(tmp_path, "mine").with_name("mine.onnx.json").unlink()
    assert "mine.onnx.json: No such file" in refusal(tmp_path)


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"phoneme_id_map": None}, "'phoneme_id_map' is a required property"),
        ({"phoneme_id_map": {"a": [3]}}, "$.phoneme_id_map: '^' is a required property"),
        ({"phoneme_id_map": {**IDS, "a": [3, 4]}}, "$.phoneme_id_map.a"),
        ({"phoneme_id_map": {**IDS, "a": [3000]}}, "its network fails"),
        ({"phoneme_type": "text"}, "$.phoneme_type: 'text' is not one of ['espeak']"),
        ({"audio": {}}, "$.audio: 'sample_rate' is a required property"),
        ({"espeak": {"voice": 3}}, "$.espeak.voice: 3 is not of type 'string'"),
        ({"num_speakers": 2}, "its network fails"),
        ({"inference": {"length_scale": 0}}, "$.inference.length_scale"),
    ],
)
def test_a_wrong_description_is_refused_with_the_place_of_the_mistake(
    tmp_path: Path, changes: dict[str, object], told: str
) -> None:
    write_voice(tmp_path, "mine", changes=changes)
    reason = refusal(tmp_path)
    assert told in reason
    assert "mine.onnx" in reason


@pytest.mark.parametrize("text", ["", "{", "[1]", "[" * 100_000])
def test_a_description_that_is_not_json_is_refused(tmp_path: Path, text: str) -> None:
    write_voice(tmp_path, "mine").with_name("mine.onnx.json").write_text(text)
    assert "mine.onnx.json" in refusal(tmp_path)


@pytest.mark.parametrize(
    ("network", "told"),
    [
        (b"not a network", "it is not an ONNX file"),
        (b"", "its network is not one of Piper"),
        (tiny_network()[:-500], "it is not an ONNX file"),
        (tiny_network(opset=99), "support for domain ai.onnx is till opset"),
        (tiny_network(speakers=2), "its network fails"),
    ],
)
def test_an_altered_network_is_refused(tmp_path: Path, network: bytes, told: str) -> None:
    write_voice(tmp_path, "mine").write_bytes(network)
    reason = refusal(tmp_path)
    assert told in reason
    assert "mine.onnx" in reason


def test_a_network_that_is_not_of_piper_is_refused(tmp_path: Path) -> None:
    (given, made) = (make_tensor_value_info(name, TensorProto.FLOAT, (1,)) for name in ("x", "y"))
    other = make_model(make_graph([make_node("Ceil", ["x"], ["y"])], "other", [given], [made]))
    write_voice(tmp_path, "mine").write_bytes(other.SerializeToString())
    assert refusal(tmp_path) == f"{tmp_path / 'mine.onnx'}: its network is not one of Piper"


@pytest.mark.piper
@pytest.mark.parametrize(
    ("place", "told"),
    [(None, "set REACTIVE_REALIZER_PIPER to a folder"), ("bad", "no .onnx file"), ("strange", "no voice 'tlh'")],
)
async def test_voices_that_cannot_be_used_say_so_when_they_start(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, place: str | None, told: str
) -> None:
    (tmp_path / "bad").mkdir()
    (tmp_path / "strange").mkdir()
    write_voice(tmp_path / "strange", changes={"espeak": {"voice": "tlh"}})
    monkeypatch.delenv(PLACE, raising=False)
    if place is not None:
        monkeypatch.setenv(PLACE, str(tmp_path / place))
    voice = PiperVoice()
    try:
        with pytest.raises(RealizerError, match=told):
            await voice.start()
    finally:
        await voice.close()


async def test_the_error_without_the_packages_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("reactive_realizer.engines.speech.neural.neural_voice.find_spec", lambda name: None)
    with pytest.raises(RealizerError, match=r"reactive-realizer\[piper\]"):
        await PiperVoice().start()


@pytest.fixture
async def piper_voice_of_user() -> AsyncIterator[PiperVoice]:
    """A real voice, of the files that the environment names."""
    voice = PiperVoice()
    yield voice
    await voice.close()


@pytest.mark.piper
async def test_a_real_voice_speaks_with_the_times_that_are_heard(piper_voice_of_user: PiperVoice) -> None:
    spoken = await completed(piper_voice_of_user.synthesize("Stop. Papa stops.", (), None))
    level = loudness(spoken)
    for word in spoken.words:
        assert max(level[round(word.start * 100) :][:30]) > 0.3, word
    (pause,) = [each for each in spoken.phonemes[:-1] if not each.symbol]
    assert level[round((pause.start + pause.duration / 2) * 100)] < 0.02
