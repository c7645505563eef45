"""Speeches: spoken by a voice, recorded, or streamed."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Final

from reactive_realizer.bml.attribute_types import Duration, Id, Integer
from reactive_realizer.bml.attributes import attribute
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.markup import Markup
from reactive_realizer.bml.names import BMLIS, BMLT, OWN

WORDS: Final = (OWN, "words")
"""The attribute of a speech that makes every word a sync point."""

VOICE: Final = (BMLT, "voice")
"""The attribute of a speech that names a voice other than that of its character."""

RIGID: Final = (OWN, "rigid")
"""The attribute of a speech that is never stretched."""

LIVELINESS: Final = (OWN, "liveliness")
"""The attribute of a speech that says how lively the character is while it speaks."""

FILLER: Final = (BMLIS, "generatefiller")
"""The attribute of a speech after which the character holds the floor with fillers."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Mark:
    """An inline sync point of a speech.

    Attributes:
        id: name of the sync point.
        time: from the start of the recording of the speech, s; None if it is not stated.
        char_index: index of the character that it precedes; the length of the text for a mark at the end.
    """

    id: str = field(metadata=attribute(Id()))
    time: float | None = field(default=None, metadata=attribute(Duration()))
    char_index: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Speech(Behavior):
    """Speaks a text.

    Attributes:
        text: the text, runs of white space reduced to single spaces.
        marks: inline sync points, in the order of the text.
        markup: how the parts of the text are spoken, outer parts first; only a description in SSML has any.
    """

    CHILDREN = ("text",)
    SYNC_POINTS = ("start", "end")

    text: str
    marks: tuple[Mark, ...] = ()
    markup: tuple[Markup, ...] = ()

    @property
    def sync_points(self) -> tuple[str, ...]:
        """Start, the marks, end."""
        return ("start", *(mark.id for mark in self.marks), "end")

    @property
    def open_points(self) -> bool:
        """Return whether sync points may be added later: the words, which only the voice counts, or marks in SSML."""
        return WORDS in self.extensions or any(each.behavior is not None for each in self.descriptions)


@dataclass(frozen=True, slots=True, kw_only=True)
class MarkTime:
    """The time of an inline sync point in a recording, s from its start."""

    id: str = field(metadata=attribute(Id()))
    time: float = field(metadata=attribute(Duration()))


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordedSpeech(Speech):
    """A speech whose sound is in a file: what a description of a `Speech` as audio means (thesis 6.2.5, example 5).

    Attributes:
        file_name: name of the file among the assets.
        mark_times: times of marks, as far as the description states them.
    """

    file_name: str
    mark_times: tuple[MarkTime, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class SoundStream:
    """A stream of sound that a client sends as it is generated.

    Attributes:
        name: under which it is sent.
        rate: of its samples, Hz.
    """

    name: str = field(metadata=attribute(Id()))
    rate: int = field(metadata=attribute(Integer(16_000, 48_000)))


@dataclass(frozen=True, slots=True, kw_only=True)
class StreamedSpeech(Speech):
    """A speech whose sound a client streams, from a description of a `Speech`.

    Attributes:
        stream: its sound.
    """

    stream: SoundStream


def streams_of(behaviors: Iterable[Behavior]) -> Iterator[SoundStream]:
    """The streams that descriptions of some behaviors name."""
    for form in (each.behavior for behavior in behaviors for each in behavior.descriptions):
        if isinstance(form, StreamedSpeech):
            yield form.stream
