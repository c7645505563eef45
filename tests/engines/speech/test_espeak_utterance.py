"""The SSML for espeak-ng, and the utterance made of its reply; the replies are made by hand."""

from collections.abc import Sequence

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from lxml import etree

from reactive_realizer.engine.tts import Utterance
from reactive_realizer.engines.speech.espeak_ssml import ssml_document
from reactive_realizer.engines.speech.espeak_utterance import as_utterance, pronounced_words
from reactive_realizer.engines.speech.worker_messages import WorkerMessage

RATE = 1000


def utterance(
    text: str,
    words: Sequence[tuple[int, int]] = (),
    marks: Sequence[tuple[str, int]] = (),
    reported: Sequence[tuple[str, int]] = (),
    phonemes: Sequence[tuple[int, str]] = (),
    duration: int = 2000,
) -> Utterance:
    """Words are reported at (time in ms, character of the text), phonemes as (time in ms, symbol)."""
    document = ssml_document(text, tuple(place for _, place in marks))
    positions = [(time, document.origins.index(character) + 1, 0) for time, character in words]
    header = {"sample_rate": RATE, "words": positions, "marks": reported, "phonemes": phonemes}
    return as_utterance(WorkerMessage(header, bytes(2 * duration)), text, tuple(marks), document)


def starts(spoken: Utterance) -> list[tuple[str, float]]:
    return [(word.text, word.start) for word in spoken.words]


def test_the_duration_is_the_duration_of_the_audio() -> None:
    assert utterance("a", duration=1234).duration == 1.234


def test_words_have_the_reported_times() -> None:
    assert starts(utterance("red box", [(100, 0), (400, 4)])) == [("red", 0.1), ("box", 0.4)]


def test_a_number_that_is_spoken_as_several_words_has_the_time_of_the_first() -> None:
    assert starts(utterance("in 1984 again", [(0, 0), (200, 3), (500, 4), (700, 4), (900, 8)])) == [
        ("in", 0.0),
        ("1984", 0.2),
        ("again", 0.9),
    ]


def test_a_word_reported_at_its_opening_quotation_mark_is_found() -> None:
    assert starts(utterance('so "good" it', [(0, 0), (300, 3), (600, 10)])) == [("so", 0.0), ("good", 0.3), ("it", 0.6)]


def test_a_word_that_is_not_reported_has_an_interpolated_time() -> None:
    assert starts(utterance("of a b", [(0, 0), (500, 5)])) == [("of", 0.0), ("a", pytest.approx(0.3)), ("b", 0.5)]


def test_a_last_word_that_is_not_reported_starts_before_the_sound_ends() -> None:
    spoken = utterance("think of", [(0, 0)], phonemes=[(0, "θ"), (600, "ə"), (800, ""), (1900, "")])
    assert 0.0 < spoken.words[1].start < 0.8


def test_the_times_of_words_never_decrease() -> None:
    assert starts(utterance("a b c", [(0, 0), (500, 2), (400, 4)])) == [("a", 0.0), ("b", 0.5), ("c", 0.5)]


def test_marks_have_the_reported_times_and_their_own_names() -> None:
    spoken = utterance("red box", [(0, 0), (400, 4)], [("x'\"<", 4), ("end", 7)], [("m1", 900), ("m0", 400)])
    assert dict(spoken.marks) == {"x'\"<": 0.4, "end": 0.9}


def test_a_mark_that_is_not_reported_has_the_time_of_the_next_word_or_of_the_end() -> None:
    spoken = utterance("red box", [(0, 0), (400, 4)], [("a", 4), ("b", 7)])
    assert dict(spoken.marks) == {"a": 0.4, "b": 2.0}


def test_the_times_of_marks_are_in_the_order_of_the_text() -> None:
    spoken = utterance("a b c", [(0, 0), (200, 2), (400, 4)], [("late", 4), ("early", 2)], [("m1", 500)])
    assert list(spoken.marks.items()) == [("early", 0.5), ("late", 0.5)]


def test_a_phoneme_lasts_until_the_next_one_or_the_end() -> None:
    spoken = utterance("a", phonemes=[(100, "ə"), (250, "n"), (400, "")], duration=1000)
    assert [(p.symbol, p.start, round(p.duration, 9)) for p in spoken.phonemes] == [
        ("ə", 0.1, 0.15),
        ("n", 0.25, 0.15),
        ("", 0.4, 0.6),
    ]


# --- SSML


TEXTS = st.text(st.characters(exclude_categories=["Cs", "Cc"]), max_size=30)


def test_marks_are_numbered_and_at_their_indices() -> None:
    assert ssml_document("ab", (2, 0)).ssml == '<speak><mark name="m1"/>ab<mark name="m0"/></speak>'


def test_marks_at_one_index_keep_their_order() -> None:
    assert ssml_document("a", (0, 0)).ssml == '<speak><mark name="m0"/><mark name="m1"/>a</speak>'


def test_a_position_in_the_ssml_counts_from_1_and_maps_to_an_index_of_the_text() -> None:
    document = ssml_document("a & b", (4,))
    assert document.origin(document.ssml.index("b") + 1) == 4
    assert document.origin(document.ssml.index("amp;") + 1) == 2


def test_a_tag_maps_to_the_character_after_it_and_positions_outside_map_to_the_ends() -> None:
    document = ssml_document("a b", (2,))
    assert document.origin(document.ssml.index("<mark") + 1) == 2
    assert (document.origin(0), document.origin(1000)) == (0, 3)


@settings(derandomize=True)
@given(text=TEXTS, data=st.data())
def test_the_ssml_is_well_formed_and_has_the_same_text(text: str, data: st.DataObject) -> None:
    marks = tuple(data.draw(st.lists(st.integers(0, len(text)), max_size=4)))
    document = ssml_document(text, marks)
    root = etree.fromstring(document.ssml)
    assert "".join(map(str, root.itertext())) == text
    names = [mark.get("name", "") for mark in root]
    assert sorted(names) == sorted(f"m{n}" for n in range(len(marks)))
    for name in names:
        before = root.xpath("//mark[@name=$name]/preceding::text()", name=name)
        assert isinstance(before, list)
        assert "".join(map(str, before)) == text[: marks[int(name[1:])]]


@settings(derandomize=True)
@given(TEXTS)
def test_every_character_of_the_text_has_a_position_in_the_ssml(text: str) -> None:
    origins = ssml_document(text, ()).origins
    assert sorted(set(origins)) == list(range(len(text) + 1))


def test_the_sounds_of_a_word_are_those_until_the_next_one_and_a_number_has_those_of_all_its_words() -> None:
    text = '"Me", 21 of us *'
    document = ssml_document(text, ())
    words = [(document.origins.index(character) + 1, first) for character, first in [(0, 0), (6, 3), (7, 5), (12, 6)]]
    phonemes = [(time, symbol) for time, symbol in enumerate(["m", "i", "", "tw", "ɛ", "w", "ʌ", "s", ""])]
    reply = WorkerMessage({"words": [(0, *word) for word in words], "phonemes": phonemes})
    assert [(text[word.first : word.last], word.sounds) for word in pronounced_words(reply, text, document)] == [
        ("Me", ("m", "i")),
        ("21", ("tw", "ɛ", "w")),
        ("of", ()),
        ("us", ("ʌ", "s")),
        ("*", ()),
    ]
