"""The sounds of recorded speech, as other systems name them (assets/visemes/phones.toml)."""

import tomllib
import unicodedata
from collections.abc import Mapping
from importlib.resources import files
from typing import Final

_TABLES: Final[Mapping[str, Mapping[str, str]]] = tomllib.loads(
    (files("reactive_realizer") / "assets/visemes/phones.toml").read_text("utf-8")
)

CMU: Final = _TABLES["cmu"]
"""The symbol of the International Phonetic Alphabet for each phone of the CMU Pronouncing Dictionary."""
SMARTBODY: Final = _TABLES["smartbody"]
"""A symbol of the International Phonetic Alphabet with the mouth shape of each viseme of SmartBody."""
_LETTERS: Final = _TABLES["letters"]


def spelled(word: str) -> tuple[str, ...]:
    """A rough pronunciation of a word that no dictionary has, letter by letter; none of a word in another script."""
    plain = unicodedata.normalize("NFKD", word.casefold())
    return tuple(name for letter in plain for name in _LETTERS.get(letter, "").split())
