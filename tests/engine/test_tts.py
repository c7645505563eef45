"""The words of a spoken text."""

import pytest

from reactive_realizer.engine.tts import word_spans


def words(text: str) -> list[str]:
    return [text[first:last] for first, last in word_spans(text)]


def test_words_are_separated_by_spaces_and_have_no_punctuation_around_them() -> None:
    assert words('He said: "Come (now), please!"') == ["He", "said", "Come", "now", "please"]


@pytest.mark.parametrize(
    "word", ["well-known", "don't", "1,984.50", "bob@x.org", "https://x.org/a", "naïve", "$5", "&"]
)
def test_numbers_addresses_and_compounds_are_one_word(word: str) -> None:
    assert words(f"a {word}, b") == ["a", word, "b"]


def test_a_dash_separates_words() -> None:
    assert words("wait\u2014what \u2013 now") == ["wait", "what", "now"]


@pytest.mark.parametrize("text", ["", "  ", "...", "?! \u2014 ,"])
def test_punctuation_alone_is_not_a_word(text: str) -> None:
    assert words(text) == []
