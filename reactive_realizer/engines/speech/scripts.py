"""The scripts of a text that a voice does not read: it spells or skips their letters."""

import tomllib
import unicodedata
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files
from typing import Final

_NAMES: Final = {"CJK": "Chinese"}


def unread_scripts(text: str, language: str) -> tuple[str, ...]:
    """The scripts of letters that a voice of a language does not read, in the order of the text.

    Args:
        text: plain.
        language: as a tag in lower case, such as ``en-us``, of which only the first part counts.
    """
    scripts = _scripts()
    unread = {script for each in scripts.values() for script in each} - {*scripts.get(language.partition("-")[0], ())}
    names = (unicodedata.name(letter, "").partition(" ")[0] for letter in dict.fromkeys(text) if letter.isalpha())
    return tuple(dict.fromkeys(_NAMES.get(name, name.capitalize()) for name in names if name in unread))


@cache
def _scripts() -> Mapping[str, Sequence[str]]:
    return tomllib.loads((files("reactive_realizer") / "assets/voices/scripts.toml").read_text("utf-8"))
