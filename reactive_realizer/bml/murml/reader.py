"""Reads murml-descriptions: movements of hands one after another or together, mirrored ones, and key frames."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Final, TypeVar

from reactive_realizer.bml.faults import UnknownElement
from reactive_realizer.bml.motion_faults import BeyondLimit, GivenTwice
from reactive_realizer.bml.murml.description import (
    STRAIGHT,
    Bend,
    Mark,
    Mirror,
    MurmlDescription,
    Scope,
    Shift,
    Slot,
    SlotValue,
    Track,
)
from reactive_realizer.bml.murml.faults import (
    MissingMurmlValue,
    MurmlNotRealized,
    NothingToPlay,
    UnknownSymbol,
)
from reactive_realizer.bml.murml.frames import read_keyframing
from reactive_realizer.bml.murml.symbols import SYMBOLS, degree_of, direction_of, number_of, value_of
from reactive_realizer.bml.names import Location
from reactive_realizer.bml.trees import Tree, name_of
from reactive_realizer.errors import Fault, RealizerError, quoted
from reactive_realizer.limits import Limits

T = TypeVar("T")

_DYNAMIC, _STATIC, _KEYFRAMING, _ELEMENT = "dynamic", "static", "keyframing", "dynamicElement"
_HOLDERS: Final = ("parallel", "sequence", "symmetrical")
_MOVEMENTS: Final = (*_HOLDERS, _DYNAMIC, _STATIC)
_OTHER_SLOTS: Final = ("GazeDirection", "Neck")
_TYPES: Final = ("linear", "curve", "via", "chop")
_CURVES: Final = {"RightC": (-1.0, False), "LeftC": (1.0, False), "RightS": (-1.0, True), "LeftS": (1.0, True)}
_USUAL_CURVE, _USUAL_EXTENT = "RightS", 0.2
"""Shape and extent of a curve without them, as in AsapRealizer."""

_VIA: Final = "via"
_PLACES: Final = ("start", _VIA, "end")
"""The types of values that are reached one after another."""
_VALUES: Final = (*_PLACES, "direction", "distance", "normal", "shape", "extent", "roundness", "skewedness")
"""All types of values."""


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
class _Part:
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

    def kept(self, length: float) -> "_Part":
        """A pose that is kept for a length."""
        tracks = (
            replace(each, marks=(*each.marks, replace(each.marks[-1], position=length, bend=None, id=None)))
            for each in self.tracks
        )
        return _Part(tuple(tracks), length)


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
        self.notes: list[Fault] = []
        self._locate = locate
        self._scope = scope
        self._limits = limits
        self._left_out: set[str] = set()

    def read(self, tree: Tree) -> MurmlDescription:
        """What a `murml-description` means.

        Raises:
            RealizerError: "murml-empty" or the one fault of what it contains: nothing can be played.
        """
        self._scope = self._scope_of(tree, self._scope)
        for dynamic in self._children(tree, _MOVEMENTS):
            for keyframing in dynamic.iterchildren(f"{{*}}{_KEYFRAMING}"):
                return MurmlDescription(keyframing=read_keyframing(keyframing, self._locate, self.notes, self._limits))
        tracks = self._limited(_merged(self._parallel(tree).tracks))
        if tracks:
            return MurmlDescription(tracks=tracks)
        raise RealizerError(
            self.notes[0] if len(self.notes) == 1 else self._at(tree, NothingToPlay(element=name_of(tree)))
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

    def _part(self, tree: Tree, scope: Scope | None) -> _Part:
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

    def _parallel(self, tree: Tree, scope: Scope | None = None) -> _Part:
        children = self._children(tree, _MOVEMENTS)
        parts = [self._part(child, scope) for child in children]
        self._note_doubles(children, parts)
        length = max((part.length for part in parts), default=0.0)
        tracks: list[Track] = []
        for part in parts:
            whole = part.kept(length) if part.length < length and part.length == 0.0 else part
            tracks += whole.placed(0.0, length / whole.length if whole.length else 1.0)
        return _Part(tuple(tracks), length)

    def _note_doubles(self, children: Iterable[Tree], parts: Iterable[_Part]) -> None:
        """Note the first slot that each of some parts has of one hand, although an earlier one has it at that time."""
        taken: set[tuple[Slot, Scope]] = set()
        for child, part in zip(children, parts, strict=True):
            own = [(track.slot, track.scope) for track in part.tracks]
            doubled = next((each for each in own if each in taken), None)
            if doubled is not None:
                what = "{} of {}".format(*doubled)
                self._note(child, GivenTwice(what=what, counting="where both have a value, this one"))
            taken.update(own)

    def _sequence(self, tree: Tree, scope: Scope | None) -> _Part:
        """Its parts one after another, with a movement from each to the next unless that goes on where it ends."""
        tracks: list[Track] = []
        ends: dict[tuple[Slot, Scope], SlotValue] = {}
        length = 0.0
        for child in self._children(tree, _MOVEMENTS):
            part = self._part(child, scope)
            if not part.tracks:
                continue
            goes_on = bool(tracks) and _goes_on(ends, part.tracks)
            ends |= {(track.slot, track.scope): track.marks[-1].value for track in part.tracks}
            begin = length if goes_on or not tracks else length + 1.0
            placed = part.placed(begin, 1.0)
            if goes_on:
                placed = tuple(replace(each, marks=each.marks[1:]) for each in placed if len(each.marks) > 1)
            tracks += placed
            length = begin + part.length
        return _Part(tuple(tracks), length)

    def _symmetrical(self, tree: Tree) -> _Part:
        dominant = self._scope_of(tree, self._scope, "dominant")
        symmetry = tree.get("symmetry", "SymMS")
        if symmetry not in SYMMETRIES:
            self._note(tree, UnknownSymbol(slot="symmetry", symbol=quoted(symmetry), known=tuple(SYMMETRIES)))
            symmetry = "SymMS"
        part = self._parallel(tree, dominant)
        other = (_mirrored(track, SYMMETRIES[symmetry]) for track in part.tracks)
        return _Part((*part.tracks, *other), part.length)

    def _static(self, tree: Tree, scope: Scope | None) -> _Part:
        slot = self._slot(tree)
        if slot is None:
            return _Part()
        scope = scope or self._scope_of(tree, self._scope)
        try:
            value = self._value(tree, slot, scope, "value")
        except RealizerError as refused:
            self.notes.append(refused.fault)
            return _Part()
        return _Part((Track(slot, scope, (Mark(0.0, value, self._locate(tree)),)),))

    def _dynamic(self, tree: Tree, scope: Scope | None) -> _Part:
        if next(tree.iterchildren(f"{{*}}{_KEYFRAMING}"), None) is not None:
            self._leave_out(tree, "key frames beside movements", "they stand alone in a description")
            return _Part()
        slot = self._slot(tree)
        if slot is None:
            return _Part()
        marks: list[Mark] = []
        arm = scope or self._scope_of(tree, self._scope)
        for element in self._children(tree, (_ELEMENT,)):
            own = scope or self._scope_of(element, arm)
            arm = own if not marks else arm
            try:
                marks += self._movement(element, slot, arm, marks)
            except RealizerError as refused:
                self.notes.append(refused.fault)
        if not marks:
            return _Part()
        return _Part((Track(slot, arm, tuple(marks)),), marks[-1].position)

    # --- movements

    def _movement(self, tree: Tree, slot: Slot, scope: Scope, before: Sequence[Mark]) -> list[Mark]:
        """The marks of a dynamicElement after those before it.

        Raises:
            RealizerError: it needs a value, or one is bad.
        """
        values: dict[str, Tree] = {}
        for child in self._children(tree, ("value",)):
            kind = child.get("type", "")
            if kind in values and kind != _VIA:
                self._note(child, GivenTwice(what=f"the value '{quoted(kind)}'", counting=_counting(kind)))
            values[kind] = child
        for kind in values.keys() - set(_VALUES):
            self._note(values[kind], UnknownSymbol(slot="type of value", symbol=quoted(kind), known=_VALUES))
        stops = [child for child in self._children(tree, ("value",)) if child.get("type") in _PLACES]
        marks = [self._mark(child, slot, scope) for child in stops]
        if before and marks and stops[0].get("type") == "start" and marks[0].value == before[-1].value:
            marks.pop(0)
        way = self._way(tree, slot, values)
        if way is not None:
            marks.append(way)
        if not marks:
            raise RealizerError(
                self._at(tree, MissingMurmlValue(slot=slot, values="values of the types start and end"))
            )
        if not before and isinstance(marks[0].value, Shift):
            raise RealizerError(self._at(tree, MissingMurmlValue(slot=slot, values="a value of the type start")))
        first = before[-1].position + 1.0 if before else 0.0
        bend = self._bend(tree, values) if slot is Slot.HAND_LOCATION else None
        bent = marks[-1] if len(marks) > 1 or before else None
        return [
            replace(mark, position=first + number, bend=bend if mark is bent else None)
            for number, mark in enumerate(marks)
        ]

    def _mark(self, tree: Tree, slot: Slot, scope: Scope) -> Mark:
        return Mark(0.0, self._value(tree, slot, scope, "name"), self._locate(tree), id=tree.get("id") or None)

    def _way(self, tree: Tree, slot: Slot, values: dict[str, Tree]) -> Mark | None:
        """The end of a movement that is given by a direction and a distance; None for another one."""
        if slot is not Slot.HAND_LOCATION or "end" in values or "direction" not in values:
            return None
        direction = values["direction"]
        heading = self._located(direction, lambda: direction_of(slot, direction.get("name", "")))
        far = SYMBOLS.ways["DistNorm"]
        if "distance" in values:
            distance = values["distance"]
            far = self._located(distance, lambda: number_of("distance", distance.get("name", ""), SYMBOLS.ways))
        return Mark(0.0, Shift(heading, far), self._locate(direction), id=direction.get("id") or None)

    def _bend(self, tree: Tree, values: dict[str, Tree]) -> Bend | None:
        """The curve of a movement; None for a straight one."""
        kind = tree.get("type", "linear").lower()
        if kind not in _TYPES:
            self._note(tree, UnknownSymbol(slot=f"type of {_ELEMENT}", symbol=quoted(kind), known=_TYPES))
        if kind != "curve":
            return None
        if "normal" not in values:
            missing = MissingMurmlValue(slot="type curve", values="a value of the type normal; it is straight now")
            self._note(tree, missing)
            return None
        normal = values["normal"]
        axis = self._located(normal, lambda: direction_of("normal", normal.get("name", "")))
        extent, shape = _USUAL_EXTENT, _USUAL_CURVE
        if "extent" in values:
            written = values["extent"]
            extent = self._located(written, lambda: number_of("extent", written.get("name", ""), SYMBOLS.extents))
        if "shape" in values:
            shape = values["shape"].get("name", "")
            if shape not in _CURVES:
                known = tuple(_CURVES)
                raise RealizerError(
                    self._at(values["shape"], UnknownSymbol(slot="shape", symbol=quoted(shape), known=known))
                )
        side, double = _CURVES[shape]
        roundness = self._degree(values, "roundness", SYMBOLS.roundnesses)
        return Bend(axis, side * extent, double, roundness, self._degree(values, "skewedness", SYMBOLS.skewednesses))

    def _degree(self, values: Mapping[str, Tree], name: str, symbols: Mapping[str, float]) -> float:
        """The roundness or skewedness of a curve; 0 if it has none."""
        written = values.get(name)
        if written is None:
            return 0.0
        return self._located(written, lambda: degree_of(name, written.get("name", ""), symbols))

    # --- attributes

    def _slot(self, tree: Tree) -> Slot | None:
        """The slot of a movement; None, with a note, for one that is not realized."""
        written = tree.get("slot", "")
        if written in tuple(Slot):
            return Slot(written)
        if written in _OTHER_SLOTS:
            self._leave_out(tree, written, "use the behavior of BML: gaze, head")
        else:
            self._note(tree, UnknownSymbol(slot=f"slot of {name_of(tree)}", symbol=quoted(written), known=tuple(Slot)))
        return None

    def _scope_of(self, tree: Tree, usual: Scope, attribute: str = "scope") -> Scope:
        """The arm of a movement, by default that of the one around it."""
        written = tree.get(attribute)
        if written is not None and written.lower() in tuple(Scope):
            return Scope(written.lower())
        if written is not None and not (attribute == "scope" and name_of(tree) not in (_STATIC, _DYNAMIC, _ELEMENT)):
            self._note(tree, UnknownSymbol(slot=attribute, symbol=quoted(written), known=tuple(Scope)))
        return usual

    def _value(self, tree: Tree, slot: Slot, scope: Scope, attribute: str) -> SlotValue:
        """The value of a slot in an attribute.

        Raises:
            RealizerError: it is missing or bad.
        """
        text = tree.get(attribute)
        if text is None:
            raise RealizerError(self._at(tree, MissingMurmlValue(slot=slot, values=f"the attribute {attribute}")))
        if slot is Slot.HAND_SHAPE and "(" in text:
            self._leave_out(tree, "a modified hand shape", "it has the shape of its first symbol")
        return self._located(tree, lambda: value_of(slot, scope, text))

    # --- faults

    def _children(self, tree: Tree, names: tuple[str, ...]) -> list[Tree]:
        """The children with these names; others are named in one note for each element."""
        unknown = [child for child in tree if name_of(child) not in names]
        if unknown:
            fault = UnknownElement(elements=tuple(map(name_of, unknown)), parent=name_of(tree), known=names)
            place = self._locate(unknown[0])
            located = fault.located(place.line, place.column)
            if located not in self.notes:
                self.notes.append(located)
        return [child for child in tree if name_of(child) in names]

    def _located(self, tree: Tree, read: Callable[[], T]) -> T:
        """The result of a function; its fault gets the place of an element."""
        try:
            return read()
        except RealizerError as refused:
            raise RealizerError(self._at(tree, refused.fault)) from None

    def _leave_out(self, tree: Tree, feature: str, reason: str) -> None:
        if feature not in self._left_out:
            self._left_out.add(feature)
            self._note(tree, MurmlNotRealized(feature=feature, reason=reason))

    def _note(self, tree: Tree, fault: Fault) -> None:
        self.notes.append(self._at(tree, fault))

    def _at(self, tree: Tree, fault: Fault) -> Fault:
        place = self._locate(tree)
        return fault.located(place.line, place.column)


def _counting(kind: str) -> str:
    """Which of two values of a type counts: places are reached one after another."""
    return "each of them" if kind in _PLACES else "this one"


def _goes_on(ends: Mapping[tuple[Slot, Scope], SlotValue], after: Iterable[Track]) -> bool:
    """Return whether every track begins with the last value of the track before it in its slot."""
    return all(ends.get((track.slot, track.scope)) == track.marks[0].value for track in after)


def _mirrored(track: Track, mirror: Mirror) -> Track:
    """The track of the other hand."""
    scope = Scope.LEFT if track.scope is Scope.RIGHT else Scope.RIGHT
    marks = (
        replace(mark, value=mark.value.mirrored(mirror), bend=mark.bend and mark.bend.mirrored(mirror), id=None)
        for mark in track.marks
    )
    return Track(track.slot, scope, tuple(marks))


def _merged(tracks: Iterable[Track]) -> tuple[Track, ...]:
    """Tracks with those of one slot of an arm as one; of two values at one position, the later one counts."""
    marks: dict[tuple[Slot, Scope], dict[float, Mark]] = {}
    for track in tracks:
        marks.setdefault((track.slot, track.scope), {}).update((mark.position, mark) for mark in track.marks)
    return tuple(
        Track(slot, scope, tuple(found[position] for position in sorted(found)))
        for (slot, scope), found in marks.items()
    )
