"""The contract of text-to-speech systems (thesis 8.10): a pytest class to inherit from; needs pytest."""

import asyncio
from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import ClassVar

import pytest

from reactive_realizer.bml.markup import Markup, MarkupKind
from reactive_realizer.clock.units import RESOLUTION
from reactive_realizer.engine.tts import MarkupTTSBinding, TTSBinding, Utterance, VoiceCapabilities, completed
from reactive_realizer.errors import RealizerError

_SENTENCE = "Please put the red box on the green table, Dr. Smith."
_NO_WORDS = ["", " ", "?", "... \u2014 !"]
_LONG = "hello world " * 100
_TEXTS = (
    _SENTENCE,
    "Yes",
    "of a the to",
    "Well,   well;\tnow \n then. Go!",
    "I. 'tis U.S.A. 12:30 +3 *",
    "Is 5 < 6 & 7 > 6? <b>Yes</b> &amp; <sync id='m'/> no.",
    'In 1984 "they" (all 23 of them) paid $5.20 to bob@x.org \u2014 e.g. Dr. U.S.A. \u6f22\u5b57 \U0001f600!',
    "Gr\u00fc\u00dfe, \u00e7a va? \u041f\u0440\u0438\u0432\u0435\u0442.",
)

_MARKUP = {
    MarkupKind.EMPHASIS: "strong",
    MarkupKind.SUB: "four",
    MarkupKind.SAY_AS: "characters",
    MarkupKind.PHONEME: "tu\u02d0",
    MarkupKind.VOICE: "nobody's",
    MarkupKind.LANGUAGE: "en-us",
}
"""Texts of markup that a voice may follow."""


class Speaker:
    """A started text-to-speech system with its event loop."""

    def __init__(self, tts: TTSBinding, runner: asyncio.Runner) -> None:
        self._tts = tts
        self._runner = runner

    def voices(self) -> tuple[str, ...]:
        """The names of its voices."""
        return self._runner.run(self._tts.voices())

    def capabilities(self) -> VoiceCapabilities:
        """What it can do."""
        return self._runner.run(self._tts.capabilities())

    def left_out(self, text: str, markup: Markup) -> bool:
        """Whether it cannot follow some markup of a text."""
        if not isinstance(self._tts, MarkupTTSBinding):
            return True
        spoken = self._tts.synthesize_markup(text, (), None, (markup,))
        return markup in self._runner.run(completed(spoken)).left_out

    def say(self, text: str, *marks: tuple[str, int], voice: str | None = None) -> Utterance:
        """The utterance of a text with marks, each a name and an index into the text."""
        return self._runner.run(self._say(text, marks, voice))

    def say_concurrently(self, *texts: str) -> list[Utterance]:
        """The utterances of several texts, requested at the same time."""
        return self._runner.run(self._say_concurrently(texts))

    def cancel(self, text: str) -> None:
        """Requests a text, and cancels the request."""
        self._runner.run(self._cancel(text))

    def parts(self, text: str, *marks: tuple[str, int]) -> list[Utterance]:
        """The utterance of a text each time that more of it is made; the last one is complete."""
        return self._runner.run(self._parts(text, marks, None))

    async def _say(self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None) -> Utterance:
        return (await self._parts(text, marks, voice))[-1]

    async def _parts(self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None) -> list[Utterance]:
        spoken = self._tts.synthesize(text, marks, voice)
        return [spoken] if isinstance(spoken, Utterance) else [each async for each in spoken]

    async def _say_concurrently(self, texts: tuple[str, ...]) -> list[Utterance]:
        return await asyncio.gather(*(self._say(text, (), None) for text in texts))

    async def _cancel(self, text: str) -> None:
        speaking = asyncio.ensure_future(self._say(text, (), None))
        await asyncio.sleep(0)
        speaking.cancel()
        await asyncio.gather(speaking, return_exceptions=True)


class TTSContract(ABC):
    """Tests of any voice: words and marks have times in the order of the text, and utterances are independent.

    Attributes:
        texts: what is said; a slow voice may choose fewer.
        long_text: what takes some time to say.
    """

    texts: ClassVar[Sequence[str]] = _TEXTS
    long_text: ClassVar[str] = _LONG

    @abstractmethod
    def tts(self) -> TTSBinding:
        """A new system under test, not started; inheriting classes define this."""

    @pytest.fixture
    def speaker(self) -> Iterator[Speaker]:
        """The started system, which is closed after the test."""
        tts = self.tts()
        with asyncio.Runner() as runner:
            runner.run(tts.start())
            try:
                yield Speaker(tts, runner)
            finally:
                runner.run(tts.close())

    def test_words_are_in_the_text_and_their_times_in_its_order(self, speaker: Speaker) -> None:
        for text in (*self.texts, self.long_text, *_NO_WORDS):
            utterance = speaker.say(text)
            assert utterance.text == text
            assert all(text[word.first : word.last] == word.text for word in utterance.words), text
            assert all(word.text == word.text.strip() != "" for word in utterance.words), text
            assert all(one.last <= next_.first for one, next_ in pairwise(utterance.words)), text
            _assert_in_order([word.start for word in utterance.words], utterance)

    def test_marks_at_all_indices_have_times_in_their_order(self, speaker: Speaker) -> None:
        for text in (*self.texts, *_NO_WORDS):
            places = range(min(len(text), 80) + 1)
            utterance = speaker.say(text, *((f"mark{place}", place) for place in places))
            assert utterance.marks.keys() == {f"mark{place}" for place in places}
            _assert_in_order([utterance.marks[f"mark{place}"] for place in places], utterance)

    def test_a_mark_before_a_word_has_its_time_and_one_at_the_end_is_after_the_last_word(
        self, speaker: Speaker
    ) -> None:
        marked = ("Please", "red", "table")
        marks = [(word, _SENTENCE.index(word)) for word in marked]
        utterance = speaker.say(_SENTENCE, *marks, ("end", len(_SENTENCE)))
        starts = {word.text: word.start for word in utterance.words}
        for word in marked:
            assert utterance.marks[word] == pytest.approx(starts[word], abs=0.05)
        assert utterance.marks["end"] > utterance.words[-1].start

    def test_marks_at_one_index_have_the_same_time(self, speaker: Speaker) -> None:
        utterance = speaker.say("one two", ("a", 4), ("b", 4))
        assert utterance.marks["a"] == utterance.marks["b"]

    def test_more_words_take_more_time(self, speaker: Speaker) -> None:
        utterance = speaker.say(_SENTENCE)
        assert [word.text for word in utterance.words[:6]] == ["Please", "put", "the", "red", "box", "on"]
        assert 1.0 < utterance.duration < 20.0
        assert speaker.say("Please put the red box").duration < utterance.duration

    def test_a_text_without_words_has_times_for_its_marks(self, speaker: Speaker) -> None:
        for text in _NO_WORDS:
            utterance = speaker.say(text, ("mark", len(text)))
            assert utterance.words == (), text
            assert 0.0 <= utterance.marks["mark"] <= utterance.duration, text

    def test_audio_and_phonemes_last_as_long_as_the_utterance(self, speaker: Speaker) -> None:
        for text in self.texts:
            utterance = speaker.say(text)
            assert len(utterance.audio) % 2 == 0, text
            if utterance.audio:
                assert len(utterance.audio) / 2 / utterance.sample_rate == pytest.approx(
                    utterance.duration, abs=1e-3
                ), text
            for one, next_ in pairwise(utterance.phonemes):
                assert one.start + one.duration == pytest.approx(next_.start, abs=1e-3), text
            _assert_in_order([phoneme.start for phoneme in utterance.phonemes], utterance)
            assert all(phoneme.duration >= 0.0 for phoneme in utterance.phonemes), text

    def test_it_does_what_its_capabilities_say_and_nothing_else(self, speaker: Speaker) -> None:
        capabilities = speaker.capabilities()
        spoken = speaker.say("one two")
        assert bool(spoken.audio) == capabilities.sound
        assert spoken.stretch == capabilities.stretch
        languages = capabilities.languages
        assert languages == tuple(sorted({language.lower() for language in languages}))
        known = {MarkupKind.VOICE: speaker.voices(), MarkupKind.LANGUAGE: languages}
        texts = {**_MARKUP, **{kind: names[0] for kind, names in known.items() if names}}
        for kind in MarkupKind:
            last = 4 if kind is MarkupKind.BREAK else 7
            markup = Markup(kind, 4, last, f"<{kind}>", 0.8, texts.get(kind, ""))
            assert speaker.left_out("one two three", markup) == (kind not in capabilities.markup), kind

    def test_what_is_made_stays_and_the_last_part_completes_the_utterance(self, speaker: Speaker) -> None:
        for text in (*self.texts, self.long_text, *_NO_WORDS):
            parts = speaker.parts(text, ("middle", len(text) // 2))
            assert parts[-1].complete, text
            for part, more in pairwise(parts):
                assert part.made < more.made, text
                if part.audio:
                    assert len(part.audio) / 2 / part.sample_rate == pytest.approx(part.made, abs=1e-3), text
                assert more.audio.startswith(part.audio), text
                assert [word.text for word in part.words] == [word.text for word in more.words], text
                assert _made(part, part.made) == _made(more, part.made), text
                _assert_in_order([word.start for word in part.words], part)
                assert 0.0 <= part.marks["middle"] <= part.duration, text

    def test_the_same_text_gives_the_same_utterance_after_another_one(self, speaker: Speaker) -> None:
        first = speaker.say(_SENTENCE, ("red", 15))
        speaker.say("Something else entirely.")
        assert speaker.say(_SENTENCE, ("red", 15)) == first

    def test_concurrent_requests_are_not_mixed_up(self, speaker: Speaker) -> None:
        texts = ("one", "one two three four", self.long_text, "five")
        assert speaker.say_concurrently(*texts) == [speaker.say(text) for text in texts]

    def test_canceling_a_request_does_not_affect_the_next_one(self, speaker: Speaker) -> None:
        whole = speaker.say(_SENTENCE)
        speaker.cancel(self.long_text)
        assert speaker.say(_SENTENCE) == whole

    def test_the_listed_voices_are_sorted_and_can_speak(self, speaker: Speaker) -> None:
        voices = speaker.voices()
        assert voices == tuple(sorted(set(voices)))
        for voice in {*voices[:1], *voices[-1:]}:
            assert speaker.say("one two", voice=voice).duration > 0.0

    def test_an_unknown_voice_raises_an_error_and_does_not_affect_the_next_text(self, speaker: Speaker) -> None:
        if speaker.voices():
            with pytest.raises(RealizerError, match="nobody's"):
                speaker.say("one two", voice="nobody's")
        assert speaker.say("one two").words


def _made(utterance: Utterance, until: float) -> list[float]:
    """The times of words and phonemes before a time, s."""
    times = [*(word.start for word in utterance.words), *(phoneme.start for phoneme in utterance.phonemes)]
    return [time for time in times if time < until - RESOLUTION]


def _assert_in_order(times: list[float], utterance: Utterance) -> None:
    assert times == sorted(times)
    assert all(0.0 <= time <= utterance.duration + RESOLUTION for time in times)
