"""Reads murml-descriptions: movements of hands one after another or together, mirrored ones, and key frames."""

from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Final

from reactive_realizer.bml.motion_faults import BeyondLimit, GivenTwice
from reactive_realizer.bml.murml.description import Mark, MurmlDescription, Scope, Slot, SlotValue, Track
from reactive_realizer.bml.murml.faults import NothingToPlay, UnknownSymbol
from reactive_realizer.bml.murml.frames import read_keyframing
from reactive_realizer.bml.murml.movements import ELEMENT, MovementReader
from reactive_realizer.bml.murml.parts import SYMMETRIES, Part, goes_on, merged, mirrored
from reactive_realizer.bml.murml.source import MurmlSource
from reactive_realizer.bml.names import Location
from reactive_realizer.bml.trees import Tree, name_of
from reactive_realizer.errors import RealizerError, quoted
from reactive_realizer.limits import Limits

_DYNAMIC, _STATIC, _KEYFRAMING = "dynamic", "static", "keyframing"
_HOLDERS: Final = ("parallel", "sequence", "symmetrical")
_MOVEMENTS: Final = (*_HOLDERS, _DYNAMIC, _STATIC)
_OTHER_SLOTS: Final = ("GazeDirection", "Neck")


class MurmlReader:
    """Reads one description.

    Attributes:
        notes: faults of what is left out, with their places.
    """

    def __init__(self, locate: Callable[[Tree], Location], scope: Scope, limits: Limits) -> None:
        """Prepare to read.

        Args:
            locate: returns the place of an element.
            scope: the arm of movements that name none.
            limits: on the numbers of movements and of values of frames.
        """
        self._source = MurmlSource(locate)
        self.notes = self._source.notes
        self._movements = MovementReader(self._source)
        self._scope = scope
        self._limits = limits

    def read(self, tree: Tree) -> MurmlDescription:
        """What a `murml-description` means.

        Raises:
            RealizerError: "murml-empty" or the one fault of what it contains: nothing can be played.
        """
        self._scope = self._scope_of(tree, self._scope)
        for dynamic in self._source.children(tree, _MOVEMENTS):
            for keyframing in dynamic.iterchildren(f"{{*}}{_KEYFRAMING}"):
                return MurmlDescription(
                    keyframing=read_keyframing(keyframing, self._source.locate, self.notes, self._limits)
                )
        tracks = self._limited(merged(self._parallel(tree).tracks))
        if tracks:
            return MurmlDescription(tracks=tracks)
        raise RealizerError(
            self.notes[0] if len(self.notes) == 1 else self._source.at(tree, NothingToPlay(element=name_of(tree)))
        )

    def _limited(self, tracks: tuple[Track, ...]) -> tuple[Track, ...]:
        """Tracks without the movements beyond the limit, with a note."""
        most = self._limits.movements_per_gesture
        positions = sorted({mark.position for track in tracks for mark in track.marks})
        if len(positions) <= most:
            return tracks
        beyond = [mark for track in tracks for mark in track.marks if mark.position >= positions[most]]
        place = min(beyond, key=lambda mark: mark.position).location
        fault = BeyondLimit(element="value", limit=most, things="movements", key="movements_per_gesture")
        self.notes.append(fault.located(place.line, place.column))
        kept = (
            replace(track, marks=tuple(mark for mark in track.marks if mark.position < positions[most]))
            for track in tracks
        )
        return tuple(track for track in kept if track.marks)

    # --- structure

    def _part(self, tree: Tree, scope: Scope | None) -> Part:
        """The part in an element.

        Args:
            tree: of one of the movements.
            scope: the dominant arm of a symmetry, otherwise None.
        """
        match name_of(tree):
            case "parallel":
                return self._parallel(tree, scope)
            case "sequence":
                return self._sequence(tree, scope)
            case "symmetrical":
                return self._symmetrical(tree)
            case "static":
                return self._static(tree, scope)
            case _:
                return self._dynamic(tree, scope)

    def _parallel(self, tree: Tree, scope: Scope | None = None) -> Part:
        children = self._source.children(tree, _MOVEMENTS)
        parts = [self._part(child, scope) for child in children]
        self._note_doubles(children, parts)
        length = max((part.length for part in parts), default=0.0)
        tracks: list[Track] = []
        for part in parts:
            whole = part.kept(length) if part.length < length and part.length == 0.0 else part
            tracks += whole.placed(0.0, length / whole.length if whole.length else 1.0)
        return Part(tuple(tracks), length)

    def _note_doubles(self, children: Iterable[Tree], parts: Iterable[Part]) -> None:
        """Note the first slot that each of some parts has of one hand, although an earlier one has it at that time."""
        taken: set[tuple[Slot, Scope]] = set()
        for child, part in zip(children, parts, strict=True):
            own = [(track.slot, track.scope) for track in part.tracks]
            doubled = next((each for each in own if each in taken), None)
            if doubled is not None:
                what = "{} of {}".format(*doubled)
                self._source.note(child, GivenTwice(what=what, counting="where both have a value, this one"))
            taken.update(own)

    def _sequence(self, tree: Tree, scope: Scope | None) -> Part:
        """Its parts one after another, with a movement from each to the next unless that goes on where it ends."""
        tracks: list[Track] = []
        ends: dict[tuple[Slot, Scope], SlotValue] = {}
        length = 0.0
        for child in self._source.children(tree, _MOVEMENTS):
            part = self._part(child, scope)
            if not part.tracks:
                continue
            continues = bool(tracks) and goes_on(ends, part.tracks)
            ends |= {(track.slot, track.scope): track.marks[-1].value for track in part.tracks}
            begin = length if continues or not tracks else length + 1.0
            placed = part.placed(begin, 1.0)
            if continues:
                placed = tuple(replace(each, marks=each.marks[1:]) for each in placed if len(each.marks) > 1)
            tracks += placed
            length = begin + part.length
        return Part(tuple(tracks), length)

    def _symmetrical(self, tree: Tree) -> Part:
        dominant = self._scope_of(tree, self._scope, "dominant")
        symmetry = tree.get("symmetry", "SymMS")
        if symmetry not in SYMMETRIES:
            self._source.note(tree, UnknownSymbol(slot="symmetry", symbol=quoted(symmetry), known=tuple(SYMMETRIES)))
            symmetry = "SymMS"
        part = self._parallel(tree, dominant)
        other = (mirrored(track, SYMMETRIES[symmetry]) for track in part.tracks)
        return Part((*part.tracks, *other), part.length)

    def _static(self, tree: Tree, scope: Scope | None) -> Part:
        slot = self._slot(tree)
        if slot is None:
            return Part()
        scope = scope or self._scope_of(tree, self._scope)
        try:
            value = self._movements.value(tree, slot, scope, "value")
        except RealizerError as refused:
            self.notes.append(refused.fault)
            return Part()
        return Part((Track(slot, scope, (Mark(0.0, value, self._source.locate(tree)),)),))

    def _dynamic(self, tree: Tree, scope: Scope | None) -> Part:
        if next(tree.iterchildren(f"{{*}}{_KEYFRAMING}"), None) is not None:
            self._source.leave_out(tree, "key frames beside movements", "they stand alone in a description")
            return Part()
        slot = self._slot(tree)
        if slot is None:
            return Part()
        marks: list[Mark] = []
        arm = scope or self._scope_of(tree, self._scope)
        for element in self._source.children(tree, (ELEMENT,)):
            own = scope or self._scope_of(element, arm)
            arm = own if not marks else arm
            try:
                marks += self._movements.marks(element, slot, arm, marks)
            except RealizerError as refused:
                self.notes.append(refused.fault)
        if not marks:
            return Part()
        return Part((Track(slot, arm, tuple(marks)),), marks[-1].position)

    # --- attributes

    def _slot(self, tree: Tree) -> Slot | None:
        """The slot of a movement; None, with a note, for one that is not realized."""
        written = tree.get("slot", "")
        if written in tuple(Slot):
            return Slot(written)
        if written in _OTHER_SLOTS:
            self._source.leave_out(tree, written, "use the behavior of BML: gaze, head")
        else:
            self._source.note(
                tree, UnknownSymbol(slot=f"slot of {name_of(tree)}", symbol=quoted(written), known=tuple(Slot))
            )
        return None

    def _scope_of(self, tree: Tree, usual: Scope, attribute: str = "scope") -> Scope:
        """The arm of a movement, by default that of the one around it."""
        written = tree.get(attribute)
        if written is not None and written.lower() in tuple(Scope):
            return Scope(written.lower())
        if written is not None and not (attribute == "scope" and name_of(tree) not in (_STATIC, _DYNAMIC, ELEMENT)):
            self._source.note(tree, UnknownSymbol(slot=attribute, symbol=quoted(written), known=tuple(Scope)))
        return usual
