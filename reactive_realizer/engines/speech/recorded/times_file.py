"""Reads the times of a recorded speech from a file beside it: JSON (docs/audio.md), or a speech file of SmartBody."""

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any, Final

import jsonschema

from reactive_realizer.binding.asset_file import attribute, number, read_bytes, read_xml
from reactive_realizer.clock.units import RESOLUTION
from reactive_realizer.engine.tts import Phoneme
from reactive_realizer.engines.speech.recorded.phones import SMARTBODY
from reactive_realizer.engines.speech.recorded.speech_times import SpeechTimes, phoneme
from reactive_realizer.errors import CreationFault, RealizerError

_TIMED: Final = {
    "type": "array",
    "items": {"type": "array", "prefixItems": [{"type": "string"}, {"type": "number"}], "minItems": 2, "items": False},
}
_SCHEMA: Final = {"type": "object", "properties": {"words": _TIMED, "phonemes": _TIMED}, "required": ["words"]}


class BadSpeechTimes(CreationFault):
    """A file with the times of a recorded speech that cannot be used."""

    code = "bad-speech-times"
    template = "{file}: {reason}"
    file: str
    reason: str


_Timed = Sequence[tuple[str, float]]
"""Words or sounds, each with its start, s."""


def read_times(path: Path, words: Sequence[str], duration: float) -> SpeechTimes:
    """The times in a file.

    Args:
        path: of the file, ``.json`` or ``.bml``.
        words: of the text, which the file must have too.
        duration: of the recording, s.

    Raises:
        RealizerError: "bad-speech-times", "bad-asset" or "asset-too-big".
    """
    timed, phonemes = _READERS[path.suffix](path, duration)
    for name, starts in (("words", [start for _, start in timed]), ("phonemes", [each.start for each in phonemes])):
        if not all(one <= other for one, other in pairwise((0.0, *starts, duration))):
            raise _bad(path, f"the times of the {name} are not in order from 0 to {duration:.2f} s")
    if [_plain(word) for word, _ in timed] != [_plain(word) for word in words]:
        said = " ".join(word for word, _ in timed)
        raise _bad(path, f"its words are not those of the text: '{said}' instead of '{' '.join(words)}'")
    return SpeechTimes(tuple(start for _, start in timed), phonemes)


def _read_json(path: Path, duration: float) -> tuple[_Timed, tuple[Phoneme, ...]]:
    try:
        table: dict[str, Any] = json.loads(read_bytes(path), parse_int=float)
        jsonschema.validate(table, _SCHEMA)
    except jsonschema.ValidationError as problem:
        raise _bad(path, f"{problem.json_path}: {problem.message}") from problem
    except (ValueError, RecursionError) as problem:
        raise _bad(path, f"not JSON: {problem}") from problem
    sounds = [(str(symbol), float(start)) for symbol, start in table.get("phonemes", [])]
    following = pairwise([*sounds, ("", duration)])
    phonemes = tuple(Phoneme(symbol, start, end - start) for (symbol, start), (_, end) in following)
    return [(str(word), float(start)) for word, start in table["words"]], phonemes


def _read_smartbody(path: Path, duration: float) -> tuple[_Timed, tuple[Phoneme, ...]]:
    root = read_xml(path, "bml")
    syncs = [sync for sync in root.iterfind("speech/text/sync") if (sync.tail or "").strip()]
    words = [(word, number(sync, "time")) for sync in syncs for word in (sync.tail or "").split()]
    return words, tuple(_smartbody_phonemes(root.iterfind("lips"), duration))


def _smartbody_phonemes(lips: Iterator[Any], duration: float) -> Iterator[Phoneme]:
    for each in lips:
        symbol = SMARTBODY.get(attribute(each, "viseme"))
        begin, end = number(each, "start"), min(number(each, "end"), duration)
        if symbol is not None and end > begin + RESOLUTION:
            yield phoneme(symbol, begin, end)


def _plain(word: str) -> str:
    return "".join(letter for letter in word.casefold() if letter.isalnum())


def _bad(path: Path, reason: str) -> RealizerError:
    return RealizerError(BadSpeechTimes(file=path.name, reason=reason))


_READERS: Final[Mapping[str, Callable[[Path, float], tuple[_Timed, tuple[Phoneme, ...]]]]] = {
    ".json": _read_json,
    ".bml": _read_smartbody,
}
TIMES_SUFFIXES: Final = tuple(_READERS)
"""The suffixes of files with times, in the order of preference."""
