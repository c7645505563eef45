"""The silent voice, whose times depend on the text only."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.bml.markup import Markup, MarkupKind
from reactive_realizer.engine.tts import Utterance
from reactive_realizer.engines.speech.text_voice import TextVoice

TEXTS = st.text(st.sampled_from("ab 1.,!?-\u2014'"), max_size=60)


def spoken(text: str, **marks: int) -> Utterance:
    return TextVoice().synthesize(text, tuple(marks.items()))


def test_it_speaks_about_three_words_a_second() -> None:
    utterance = spoken("the quick brown fox jumps over the lazy dog and then goes home to sleep")
    assert 2.0 < len(utterance.words) / utterance.duration < 4.0


def test_every_word_has_its_characters_and_its_time() -> None:
    utterance = spoken("Hello, there.")
    assert [(word.text, word.first, word.last) for word in utterance.words] == [("Hello", 0, 5), ("there", 7, 12)]
    assert utterance.words[0].start == 0.0
    assert 0.0 < utterance.words[1].start < utterance.duration


def test_a_longer_word_takes_longer() -> None:
    assert spoken("extraordinary").duration > spoken("odd").duration


@pytest.mark.parametrize(("short", "long"), [("one two", "one, two"), ("one, two", "one. Two")])
def test_a_comma_adds_a_pause_and_a_period_a_longer_one(short: str, long: str) -> None:
    assert spoken(short).words[1].start < spoken(long).words[1].start


def test_punctuation_after_the_last_word_takes_no_time() -> None:
    assert spoken("one two").duration == spoken("one two ...").duration


def test_white_space_does_not_change_the_times() -> None:
    assert spoken("one two").duration == spoken("one \n   two").duration


def test_a_mark_has_the_time_of_the_next_word() -> None:
    utterance = spoken("put the red box", before=8, in_space=7)
    assert utterance.marks["before"] == utterance.marks["in_space"] == utterance.words[2].start


def test_a_mark_after_the_last_word_is_at_the_end() -> None:
    utterance = spoken("put it here.", end=12)
    assert utterance.marks["end"] == utterance.duration


def test_an_utterance_has_no_audio_and_no_phonemes() -> None:
    utterance = spoken("hello")
    assert (utterance.audio, utterance.phonemes) == (b"", ())


def marked(*markup: Markup) -> Utterance:
    return TextVoice().synthesize_markup("put the red box", (("red", 8),), None, markup)


def test_a_break_is_silence_before_the_next_word() -> None:
    pause = Markup(MarkupKind.BREAK, 8, 8, "<break>", number=0.7)
    plain, paused = marked(), marked(pause)
    assert paused.left_out == ()
    assert [after.start - before.start for before, after in zip(plain.words, paused.words, strict=True)] == (
        pytest.approx([0.0, 0.0, 0.7, 0.7])
    )
    assert paused.marks["red"] == paused.words[2].start


def test_a_break_after_the_last_word_is_silence_before_the_end() -> None:
    pause = Markup(MarkupKind.BREAK, 15, 15, "<break>", number=2.0)
    assert marked(pause).duration == pytest.approx(marked().duration + 2.0)


def test_a_break_before_the_first_word_is_kept() -> None:
    assert marked(Markup(MarkupKind.BREAK, 0, 0, "<break>", number=0.5)).words[0].start == 0.5


@pytest.mark.parametrize(("level", "factor"), [("strong", 1.4), ("moderate", 1.2), ("none", 1.0), ("reduced", 0.9)])
def test_an_emphasized_word_takes_longer(level: str, factor: float) -> None:
    said = marked(Markup(MarkupKind.EMPHASIS, 12, 15, "<emphasis>", text=level))
    assert said.duration - said.words[3].start == pytest.approx(factor * (marked().duration - marked().words[3].start))


def test_other_markup_is_left_out() -> None:
    slow = Markup(MarkupKind.RATE, 0, 3, "<prosody rate>", number=0.5)
    assert marked(slow).left_out == (slow,)
    assert marked(slow).duration == marked().duration


def test_a_text_without_words_takes_no_time() -> None:
    utterance = spoken("...", mark=1)
    assert (utterance.duration, utterance.words, utterance.marks["mark"]) == (0.0, (), 0.0)


@settings(derandomize=True)
@given(text=TEXTS, data=st.data())
def test_words_begin_in_order_and_marks_keep_the_order_of_the_text(text: str, data: st.DataObject) -> None:
    places = sorted(data.draw(st.lists(st.integers(0, len(text)), max_size=4)))
    utterance = spoken(text, **{f"mark{n}": place for n, place in enumerate(places)})
    starts = [word.start for word in utterance.words]
    assert starts == sorted(set(starts))
    assert list(utterance.marks.values()) == sorted(utterance.marks.values())
    assert all(0.0 <= time <= utterance.duration for time in [*starts, *utterance.marks.values()])


def test_the_words_begun_are_those_that_started_before_a_time() -> None:
    utterance = spoken("put the red box")
    second = utterance.words[1].start
    assert utterance.words_begun(second - 0.001) == utterance.words[:1]
    assert utterance.words_begun(second) == utterance.words[:1]
    assert utterance.words_begun(second + 0.001) == utterance.words[:2]
    assert utterance.words_begun(-1.0) == ()
