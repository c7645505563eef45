"""Reads the descriptions of a speech: the same in another language (BML 1.0; thesis C.7)."""

from collections.abc import Iterable, Iterator, Mapping
from math import inf
from types import MappingProxyType
from typing import Any, Final

from reactive_realizer.bml.behavior import Description
from reactive_realizer.bml.behavior_parts import read_recording, read_stream
from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.faults import MissingElement
from reactive_realizer.bml.names import OWN
from reactive_realizer.bml.speech import Mark, RecordedSpeech, Speech, StreamedSpeech
from reactive_realizer.bml.speech_faults import MissingMarks, OtherMarkup, TimeUnused
from reactive_realizer.bml.ssml_reader import read_ssml
from reactive_realizer.bml.trees import Tree, name_of
from reactive_realizer.errors import Fault, RealizerError

_AUDIO: Final = "audio/"
"""Prefix of the types of descriptions that are sound."""
_STREAM: Final = "audio/x-stream"
_SSML: Final = "application/ssml+xml"
_OTHERS: Final[Mapping[str, str]] = MappingProxyType(
    {
        "maryxml": "MaryXML",
        "marywords": "MaryXML",
        "maryallophones": "MaryXML",
        "application/msapi+xml": "the markup of SAPI",
        "application/fluency": "the markup of Fluency",
    }
)
"""The languages that Elckerlyc and AsapRealizer give to their voices, and that none speaks here."""


def read_speech_description(
    description: Tree, type_: str, core: Mapping[str, Any], source: BlockSource, notes: list[Fault]
) -> Speech | None:
    """The speech that a description describes, in SSML, as a recording or as a stream; None if it does none of these.

    Args:
        description: its element.
        type_: its language.
        core: the fields of the speech itself.
        source: its block.
        notes: receives the faults that do not prevent reading it.

    Raises:
        RealizerError: it cannot be read, or lacks a sync point of the speech.
    """
    if (stream := read_stream(description, source, notes)) is not None:
        return StreamedSpeech(**core, stream=stream)
    if (recording := read_recording(description, core["marks"], source)) is not None:
        return RecordedSpeech(**core, **recording)
    if type_.startswith(_AUDIO):
        wanted = f'<stream xmlns="{OWN}"/>' if type_ == _STREAM else '<file ref="..."/>'
        fault = MissingElement(element=name_of(description), children=wanted)
        raise RealizerError(source.located(description, fault))
    if type_ != _SSML:
        return None
    said = read_ssml(description, source, notes)
    marks: tuple[Mark, ...] = core["marks"]
    missing = sorted({mark.id for mark in marks} - {mark.id for mark in said.marks})
    if missing:
        raise RealizerError(source.located(description, MissingMarks(marks=tuple(missing))))
    return Speech(**{**core, **said._asdict()})


def unspoken(descriptions: Mapping[Tree, Description], source: BlockSource) -> Iterator[Fault]:
    """A fault for each description that would be the best one, if its language were spoken here."""
    best = max((each.priority for each in descriptions.values() if each.behavior), default=-inf)
    for tree, each in descriptions.items():
        if each.type in _OTHERS and each.priority > best:
            yield source.located(tree, OtherMarkup(language=_OTHERS[each.type]))


def unused_times(
    tree: Tree, marks: Iterable[Mark], descriptions: Iterable[Description], source: BlockSource
) -> Iterator[Fault]:
    """A fault if marks of a speech have times in a recording, and it is not described as one."""
    timed = tuple(mark.id for mark in marks if mark.time is not None)
    if timed and not any(isinstance(each.behavior, RecordedSpeech) for each in descriptions):
        yield source.located(tree, TimeUnused(marks=timed))
