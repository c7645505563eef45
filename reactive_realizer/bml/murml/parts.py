"""Parts of a description of movements: how they are put together."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Final

from reactive_realizer.bml.murml.description import STRAIGHT, Mark, Mirror, Scope, Slot, SlotValue, Track


def _mirrors() -> Iterator[tuple[str, Mirror]]:
    """Yield the symmetries by their names, whose letters are the sagittal, the transversal and the frontal plane.

    Unless both hands do the same, they are on different sides, whatever the planes are (AsapRealizer).
    """
    yield "Sym", Mirror(STRAIGHT, STRAIGHT)
    for planes in ("S", "T", "F", "ST", "SF", "TF", "STF"):
        x, y, z = (-1.0 if name in planes else 1.0 for name in "STF")
        yield f"SymM{planes}", Mirror((-1.0, y, z), (x, y, z))


SYMMETRIES: Final = MappingProxyType(dict(_mirrors()))
"""The symmetries of two hands, by the planes in which they are mirrored."""


@dataclass(frozen=True, slots=True)
class Part:
    """A part of a description.

    Attributes:
        tracks: of hands, from position 0.
        length: number of movements one after another.
    """

    tracks: tuple[Track, ...] = ()
    length: float = 0.0

    def placed(self, begin: float, scale: float) -> tuple[Track, ...]:
        """Its tracks from a position on, stretched."""
        return tuple(
            replace(track, marks=tuple(replace(mark, position=begin + scale * mark.position) for mark in track.marks))
            for track in self.tracks
        )

    def kept(self, length: float) -> "Part":
        """A pose that is kept for a length."""
        tracks = (
            replace(each, marks=(*each.marks, replace(each.marks[-1], position=length, bend=None, id=None)))
            for each in self.tracks
        )
        return Part(tuple(tracks), length)


def goes_on(ends: Mapping[tuple[Slot, Scope], SlotValue], after: Iterable[Track]) -> bool:
    """Return whether every track begins with the last value of the track before it in its slot."""
    return all(ends.get((track.slot, track.scope)) == track.marks[0].value for track in after)


def mirrored(track: Track, mirror: Mirror) -> Track:
    """The track of the other hand."""
    scope = Scope.LEFT if track.scope is Scope.RIGHT else Scope.RIGHT
    marks = (
        replace(mark, value=mark.value.mirrored(mirror), bend=mark.bend and mark.bend.mirrored(mirror), id=None)
        for mark in track.marks
    )
    return Track(track.slot, scope, tuple(marks))


def merged(tracks: Iterable[Track]) -> tuple[Track, ...]:
    """Tracks with those of one slot of an arm as one; of two values at one position, the later one counts."""
    marks: dict[tuple[Slot, Scope], dict[float, Mark]] = {}
    for track in tracks:
        marks.setdefault((track.slot, track.scope), {}).update((mark.position, mark) for mark in track.marks)
    return tuple(
        Track(slot, scope, tuple(found[position] for position in sorted(found)))
        for (slot, scope), found in marks.items()
    )
