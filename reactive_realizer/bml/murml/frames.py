"""Reads the key frames of MURML."""

import re
from collections.abc import Callable
from enum import StrEnum
from typing import Final, Protocol, TypeVar

from reactive_realizer.bml.attribute_types import Boolean, Enumeration, Float
from reactive_realizer.bml.faults import BadAttribute, MissingAttribute, UnknownElement
from reactive_realizer.bml.motion_faults import BeyondLimit, GivenTwice
from reactive_realizer.bml.murml.description import Frame, Keyframing
from reactive_realizer.bml.murml.faults import BadPosture, FrameTooEarly, NothingToPlay
from reactive_realizer.bml.names import Location
from reactive_realizer.bml.trees import Tree, name_of
from reactive_realizer.errors import Fault, RealizerError, quoted
from reactive_realizer.limits import Limits

_LIMITS: Final = Limits()
_TIME: Final = Float(0.0, _LIMITS.time_seconds)
_STEEPNESS: Final = Float(0.0, 100.0)
_SHARE: Final = Float(0.0, 1.0)
_NUMBER: Final = Float(-1e6, 1e6)
_PART: Final = re.compile(r"\(([^()]*)\)|([^\s()]+)")
"""A part in parentheses, or another word; the first word of a posture names the kind of figure."""

T = TypeVar("T")
T_co = TypeVar("T_co", covariant=True)


class _ApplyMode(StrEnum):
    EXCLUSIVE = "exclusive"
    SUPERPOSE = "superpose"


class _Type(Protocol[T_co]):
    """A type of attribute (`attribute_types`)."""

    def read(self, text: str, limits: Limits) -> T_co: ...


def read_keyframing(tree: Tree, locate: Callable[[Tree], Location], notes: list[Fault], limits: Limits) -> Keyframing:
    """The key frames of an element; the times of each phase count from the end of the one before.

    Args:
        tree: of the `keyframing`.
        locate: returns the place of an element.
        notes: receives the faults of frames and attributes that are left out.
        limits: on the number of values and on times.

    Raises:
        RealizerError: it has no frame that can be read.
    """
    reader = _FrameReader(locate, notes, limits)
    frames = reader.frames(tree)
    if not frames:
        raise RealizerError(notes[0] if len(notes) == 1 else reader.at(tree, NothingToPlay(element=name_of(tree))))
    return Keyframing(
        tuple(frames),
        reader.value(tree, "easescale", _STEEPNESS, 1.0),
        reader.value(tree, "easeturningpoint", _SHARE, 0.5),
        not reader.value(tree, "dont_insert_startframe", Boolean(), False),
        reader.value(tree, "applymode", Enumeration(_ApplyMode), _ApplyMode.EXCLUSIVE) is _ApplyMode.SUPERPOSE,
    )


class _FrameReader:
    def __init__(self, locate: Callable[[Tree], Location], notes: list[Fault], limits: Limits) -> None:
        self._locate = locate
        self._notes = notes
        self._limits = limits

    def frames(self, tree: Tree) -> list[Frame]:
        """The frames of all phases, in the order of time; those that cannot be read are left out with a note."""
        frames: list[Frame] = []
        begin, left = 0.0, self._limits.goals_per_behavior
        for phase in self._children(tree, "phase"):
            for child in self._children(phase, "frame"):
                try:
                    frame = self._frame(child, begin, frames)
                except RealizerError as refused:
                    self._notes.append(refused.fault)
                    continue
                left -= len(frame.values)
                if left < 0:
                    self._notes.append(self.at(child, self._beyond()))
                    return frames
                frames.append(frame)
            begin = frames[-1].time if frames else 0.0
        return frames

    def _beyond(self) -> Fault:
        most = self._limits.goals_per_behavior
        return BeyondLimit(element="frame", limit=most, things="values of frames", key="goals_per_behavior")

    def _frame(self, tree: Tree, begin: float, before: list[Frame]) -> Frame:
        text = tree.get("ftime")
        if text is None:
            raise RealizerError(self.at(tree, MissingAttribute(element=name_of(tree), attribute="ftime")))
        time = begin + self._read(tree, "ftime", text, _TIME)
        if before and time <= before[-1].time:
            raise RealizerError(self.at(tree, FrameTooEarly(time=time, earliest=before[-1].time)))
        values: dict[str, tuple[float, ...]] = {}
        faults: list[Fault] = []
        for posture in self._children(tree, "posture"):
            self._posture(posture, values, faults)
        if not values:
            raise RealizerError(faults[0] if faults else self.at(tree, NothingToPlay(element=name_of(tree))))
        self._notes += faults
        return Frame(time, values, self._locate(tree))

    def _posture(self, tree: Tree, values: dict[str, tuple[float, ...]], faults: list[Fault]) -> None:
        """Adds the values of a posture; those that cannot be read, or are there already, are faults."""
        for number, found in enumerate(_PART.finditer("".join(map(str, tree.itertext())))):
            part = _values(found[1]) if found[1] is not None else None
            if part is not None:
                if part[0] in values:
                    faults.append(self.at(tree, GivenTwice(what=quoted(part[0]), counting="the last one")))
                values[part[0]] = part[1]
            elif number > 0 or found[1] is not None:
                faults.append(self.at(tree, BadPosture(text=quoted(found[0]))))

    # --- attributes and faults

    def value(self, tree: Tree, name: str, kind: _Type[T], default: T) -> T:
        """The value of an attribute; its default, with a note, if it cannot be read."""
        text = tree.get(name)
        try:
            return default if text is None else self._read(tree, name, text, kind)
        except RealizerError as refused:
            self._notes.append(refused.fault)
            return default

    def _read(self, tree: Tree, name: str, text: str, kind: _Type[T]) -> T:
        try:
            return kind.read(text, self._limits)
        except RealizerError as refused:
            reason = refused.fault.sentence
            bad = BadAttribute(element=name_of(tree), attribute=name, value=quoted(text), reason=reason)
            raise RealizerError(self.at(tree, bad)) from None

    def _children(self, tree: Tree, name: str) -> list[Tree]:
        unknown = [child for child in tree if name_of(child) != name]
        if unknown:
            fault = UnknownElement(elements=tuple(map(name_of, unknown)), parent=name_of(tree), known=(name,))
            self._notes.append(self.at(unknown[0], fault))
        return [child for child in tree if name_of(child) == name]

    def at(self, tree: Tree, fault: Fault) -> Fault:
        """A fault with the place of an element."""
        place = self._locate(tree)
        return fault.located(place.line, place.column)


def _values(text: str) -> tuple[str, tuple[float, ...]] | None:
    """The name and the values of a part: ``name value``, or ``name count values``. None if it has another form."""
    name, *words = text.split() or [""]
    try:
        numbers = [_NUMBER.read(word, _LIMITS) for word in words]
    except RealizerError:
        return None
    if len(numbers) == 1:
        return name, tuple(numbers)
    if len(numbers) > 1 and numbers[0] == len(numbers) - 1:
        return name, tuple(numbers[1:])
    return None
