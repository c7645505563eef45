"""The data file of fillers: words by the language of the voice, chosen by a seed."""

from itertools import pairwise
from pathlib import Path

import pytest

from reactive_realizer.assembly.assets import PACKAGE_ASSETS
from reactive_realizer.errors import RealizerError
from reactive_realizer.liveliness.fillers import read_fillers

FILE = PACKAGE_ASSETS / "liveliness" / "fillers.toml"


@pytest.mark.parametrize(
    ("voice", "language"), [("de", "de"), ("en-gb", "en"), ("FR-be", "fr"), ("am_x", "en"), (None, "en")]
)
def test_the_language_is_that_of_the_voice_or_english(voice: str | None, language: str) -> None:
    fillers = read_fillers(FILE)
    first, later = fillers.words[language]
    (word, _), *rest = fillers.choose(voice, "seed")
    assert word in first
    assert all(other in later for other, _ in rest)


def test_no_filler_is_said_twice_in_a_row_and_pauses_are_within_their_limits() -> None:
    fillers = read_fillers(FILE)
    for seed in range(50):
        chosen = fillers.choose("en", str(seed))
        words = [word for word, _ in chosen]
        assert all(one != other for one, other in pairwise(words))
        assert all(fillers.pauses[0] <= pause <= fillers.pauses[1] for _, pause in chosen)
    assert fillers.choose("en", "1") == fillers.choose("en", "1")


@pytest.mark.parametrize(
    ("good", "bad", "reason"),
    [
        ("most = 3", "most = 0", "most is 0"),
        ("wait = 0.4", "", "'wait' is missing"),
        ("[words.en]", "[words.eo]", "no words for 'en'"),
        ('first = ["uh", "um", "uhm"]', "first = []", "words.en.first is not a list of texts"),
        ("pauses = [1.1, 1.7]", "pauses = [1.1]", "pauses"),
    ],
)
def test_a_file_that_cannot_be_used_says_why(tmp_path: Path, good: str, bad: str, reason: str) -> None:
    text = FILE.read_text("utf-8")
    assert good in text
    path = tmp_path / "fillers.toml"
    path.write_text(text.replace(good, bad), "utf-8")
    with pytest.raises(RealizerError, match=reason):
        read_fillers(path)
