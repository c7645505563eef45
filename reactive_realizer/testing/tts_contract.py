"""What every text-to-speech system has to keep to (thesis 8.10), as a pytest class to inherit from; needs pytest."""

import asyncio
from collections.abc import Iterator
from itertools import pairwise

import pytest

from reactive_realizer.clock.units import RESOLUTION
from reactive_realizer.engine.tts import TTSBinding, Utterance
from reactive_realizer.errors import RealizerError

_SENTENCE = "Please put the red box on the green table, Dr. Smith."
_NO_WORDS = ["", " ", "?", "... \u2014 !"]
_TEXTS = [
    _SENTENCE,
    "Yes",
    "of a the to",
    "Well,   well;\tnow \n then. Go!",
    "I. 'tis U.S.A. 12:30 +3 *",
    "Is 5 < 6 & 7 > 6? <b>Yes</b> &amp; <sync id='m'/> no.",
    'In 1984 "they" (all 23 of them) paid $5.20 to bob@x.org \u2014 e.g. Dr. U.S.A. \u6f22\u5b57 \U0001f600!',
    "Gr\u00fc\u00dfe, \u00e7a va? \u041f\u0440\u0438\u0432\u0435\u0442.",
    "hello world " * 100,
]


class Speaker:
    """A text-to-speech system that was started, and the loop that it works in."""

    def __init__(self, tts: TTSBinding, runner: asyncio.Runner) -> None:
        self._tts = tts
        self._runner = runner

    def voices(self) -> tuple[str, ...]:
        """The names that it knows."""
        return self._runner.run(self._tts.voices())

    def say(self, text: str, *marks: tuple[str, int], voice: str | None = None) -> Utterance:
        """A text with marks, each a name and the index of the character that it stands before."""
        return self._runner.run(self._say(text, marks, voice))

    def say_at_once(self, *texts: str) -> list[Utterance]:
        """Several texts, none of which waits for another."""
        return self._runner.run(self._say_at_once(texts))

    def call_off(self, text: str) -> None:
        """Ask for a text, and give it up before it is there."""
        self._runner.run(self._call_off(text))

    async def _say(self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None) -> Utterance:
        spoken = self._tts.synthesize(text, marks, voice)
        return spoken if isinstance(spoken, Utterance) else await spoken

    async def _say_at_once(self, texts: tuple[str, ...]) -> list[Utterance]:
        return await asyncio.gather(*(self._say(text, (), None) for text in texts))

    async def _call_off(self, text: str) -> None:
        speaking = asyncio.ensure_future(self._say(text, (), None))
        await asyncio.sleep(0)
        speaking.cancel()
        await asyncio.gather(speaking, return_exceptions=True)


class TTSContract:
    """For any system: words and marks have times in the order of the text, and one utterance has no part in another."""

    def tts(self) -> TTSBinding:
        """The system under test, not yet started; the inheriting class makes it."""
        raise NotImplementedError

    @pytest.fixture
    def speaker(self) -> Iterator[Speaker]:
        """The system, started, and closed after the test."""
        tts = self.tts()
        with asyncio.Runner() as runner:
            runner.run(tts.start())
            try:
                yield Speaker(tts, runner)
            finally:
                runner.run(tts.close())

    @pytest.mark.parametrize("text", [*_TEXTS, *_NO_WORDS])
    def test_words_stand_in_the_text_in_its_order_and_begin_in_time(self, speaker: Speaker, text: str) -> None:
        said = speaker.say(text)
        assert said.text == text
        assert all(text[word.first : word.last] == word.text for word in said.words)
        assert all(word.text == word.text.strip() != "" for word in said.words)
        assert all(one.last <= next_.first for one, next_ in pairwise(said.words))
        _assert_in_order([word.start for word in said.words], said)

    @pytest.mark.parametrize("text", [*_TEXTS, *_NO_WORDS])
    def test_a_mark_at_every_place_has_a_time_in_their_order(self, speaker: Speaker, text: str) -> None:
        places = range(min(len(text), 80) + 1)
        said = speaker.say(text, *((f"mark{place}", place) for place in places))
        assert said.marks.keys() == {f"mark{place}" for place in places}
        _assert_in_order([said.marks[f"mark{place}"] for place in places], said)

    def test_a_mark_before_a_word_comes_with_it_and_one_at_the_end_after_the_last(self, speaker: Speaker) -> None:
        marked = ("Please", "red", "table")
        marks = [(word, _SENTENCE.index(word)) for word in marked]
        said = speaker.say(_SENTENCE, *marks, ("end", len(_SENTENCE)))
        starts = {word.text: word.start for word in said.words}
        for word in marked:
            assert said.marks[word] == pytest.approx(starts[word], abs=0.05)
        assert said.marks["end"] > said.words[-1].start

    def test_several_marks_may_stand_at_one_place(self, speaker: Speaker) -> None:
        said = speaker.say("one two", ("a", 4), ("b", 4))
        assert said.marks["a"] == said.marks["b"]

    def test_words_take_time(self, speaker: Speaker) -> None:
        said = speaker.say(_SENTENCE)
        assert [word.text for word in said.words[:6]] == ["Please", "put", "the", "red", "box", "on"]
        assert 1.0 < said.duration < 20.0
        assert speaker.say("Please put the red box").duration < said.duration

    @pytest.mark.parametrize("text", _NO_WORDS)
    def test_a_text_without_a_word_has_no_words_and_its_marks_have_times(self, speaker: Speaker, text: str) -> None:
        said = speaker.say(text, ("mark", len(text)))
        assert said.words == ()
        assert 0.0 <= said.marks["mark"] <= said.duration

    @pytest.mark.parametrize("text", _TEXTS)
    def test_sound_and_sounds_last_as_long_as_the_utterance(self, speaker: Speaker, text: str) -> None:
        said = speaker.say(text)
        assert len(said.audio) % 2 == 0
        if said.audio:
            assert len(said.audio) / 2 / said.sample_rate == pytest.approx(said.duration, abs=1e-3)
        for one, next_ in pairwise(said.phonemes):
            assert one.start + one.duration == pytest.approx(next_.start, abs=1e-3)
        _assert_in_order([phoneme.start for phoneme in said.phonemes], said)
        assert all(phoneme.duration >= 0.0 for phoneme in said.phonemes)

    def test_the_same_text_is_the_same_utterance_whatever_was_said_between(self, speaker: Speaker) -> None:
        first = speaker.say(_SENTENCE, ("red", 15))
        speaker.say("Something else entirely.")
        assert speaker.say(_SENTENCE, ("red", 15)) == first

    def test_what_is_asked_for_at_once_is_not_mixed_up(self, speaker: Speaker) -> None:
        texts = ("one", "one two three four", _TEXTS[-1], "five")
        assert speaker.say_at_once(*texts) == [speaker.say(text) for text in texts]

    def test_a_speech_that_is_called_off_leaves_the_next_one_alone(self, speaker: Speaker) -> None:
        whole = speaker.say(_SENTENCE)
        speaker.call_off(_TEXTS[-1])
        assert speaker.say(_SENTENCE) == whole

    def test_the_names_of_voices_are_sorted_and_speak(self, speaker: Speaker) -> None:
        voices = speaker.voices()
        assert voices == tuple(sorted(set(voices)))
        for voice in {*voices[:1], *voices[-1:]}:
            assert speaker.say("one two", voice=voice).duration > 0.0

    def test_an_unknown_voice_is_named_in_an_error_and_the_next_text_is_spoken(self, speaker: Speaker) -> None:
        if speaker.voices():
            with pytest.raises(RealizerError, match="nobody's"):
                speaker.say("one two", voice="nobody's")
        assert speaker.say("one two").words


def _assert_in_order(times: list[float], said: Utterance) -> None:
    assert times == sorted(times)
    assert all(0.0 <= time <= said.duration + RESOLUTION for time in times)
