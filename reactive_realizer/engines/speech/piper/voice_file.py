"""The files of a Piper voice: a network (``NAME.onnx``), and what belongs to it (``NAME.onnx.json``)."""

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import jsonschema

from reactive_realizer.engines.speech.neural.network import UnusableNetwork

START, PAD, END = "^", "_", "$"
"""The characters whose ids stand before a sentence, after each of its characters, and after the sentence."""

_POSITIVE: Final = {"type": "number", "exclusiveMinimum": 0}
_ID: Final = {"type": "array", "prefixItems": [{"type": "integer", "minimum": 0}], "minItems": 1, "items": False}
_SCHEMA: Final = {
    "type": "object",
    "properties": {
        "audio": {
            "type": "object",
            "properties": {"sample_rate": {"type": "integer", "minimum": 8000, "maximum": 48_000}},
            "required": ["sample_rate"],
        },
        "espeak": {"type": "object", "properties": {"voice": {"type": "string"}}, "required": ["voice"]},
        "phoneme_type": {"enum": ["espeak"]},
        "phoneme_id_map": {"type": "object", "additionalProperties": _ID, "required": [START, PAD, END]},
        "inference": {"type": "object", "properties": {"length_scale": _POSITIVE}},
        "num_speakers": {"type": "integer", "minimum": 1},
        "speaker_id_map": {"type": "object", "additionalProperties": {"type": "integer", "minimum": 0}},
    },
    "required": ["audio", "espeak", "phoneme_id_map"],
}


@dataclass(frozen=True, slots=True)
class VoiceFile:
    """A Piper voice, without its network.

    Attributes:
        path: of the network.
        rate: sample rate, Hz.
        language: the voice of espeak-ng that tells how words are pronounced.
        ids: the number of each character.
        speakers: the number of each voice by its name: that of the file, and behind a plus that of the speaker if the
            network has several. None if it has one.
        slowness: the factor of all durations at the usual rate.
    """

    path: Path
    rate: int
    language: str
    ids: Mapping[str, int]
    speakers: Mapping[str, int | None]
    slowness: float


def voice_files(place: Path) -> Iterator[VoiceFile]:
    """The voices in a folder, in the order of their names, or the one of an ``.onnx`` file.

    Raises:
        UnusableNetwork: there is none, or a JSON file is missing or wrong; the message names it.
    """
    if not place.exists():
        raise UnusableNetwork(f"{place} does not exist")
    networks = sorted(place.glob("*.onnx")) if place.is_dir() else [place]
    if not networks:
        raise UnusableNetwork(f"{place} contains no .onnx file")
    yield from map(_read, networks)


def _read(path: Path) -> VoiceFile:
    beside = path.with_name(f"{path.name}.json")
    try:
        table: dict[str, Any] = json.loads(beside.read_text("utf-8"))
        jsonschema.validate(table, _SCHEMA)
    except OSError as problem:
        raise UnusableNetwork(f"{beside}: {problem.strerror}") from problem
    except jsonschema.ValidationError as problem:
        raise UnusableNetwork(f"{beside}: {problem.json_path}: {problem.message}") from problem
    except (ValueError, RecursionError) as problem:
        raise UnusableNetwork(f"{beside} is not JSON: {problem}") from problem
    ids = {character: numbers[0] for character, numbers in table["phoneme_id_map"].items()}
    slowness = table.get("inference", {}).get("length_scale", 1.0)
    language = table["espeak"]["voice"].lower()
    return VoiceFile(path, table["audio"]["sample_rate"], language, ids, _speakers(path.stem, table), slowness)


def _speakers(name: str, table: Mapping[str, Any]) -> Mapping[str, int | None]:
    count = table.get("num_speakers", 1)
    if count == 1:
        return {name: None}
    numbers = table.get("speaker_id_map") or {str(number): number for number in range(count)}
    return {f"{name}+{speaker}": number for speaker, number in sorted(numbers.items(), key=lambda each: each[1])}
