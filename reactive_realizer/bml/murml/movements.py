"""Reads the movements of a hand: the values that it passes, and the curves between them."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Final

from reactive_realizer.bml.motion_faults import GivenTwice
from reactive_realizer.bml.murml.description import Bend, Mark, Scope, Shift, Slot, SlotValue
from reactive_realizer.bml.murml.faults import MissingMurmlValue, UnknownSymbol
from reactive_realizer.bml.murml.source import MurmlSource
from reactive_realizer.bml.murml.symbols import SYMBOLS, degree_of, direction_of, number_of, value_of
from reactive_realizer.bml.trees import Tree
from reactive_realizer.errors import RealizerError, quoted

ELEMENT: Final = "dynamicElement"
"""The name of the element of a movement."""

_TYPES: Final = ("linear", "curve", "via", "chop")
_CURVES: Final = {"RightC": (-1.0, False), "LeftC": (1.0, False), "RightS": (-1.0, True), "LeftS": (1.0, True)}
_USUAL_CURVE, _USUAL_EXTENT = "RightS", 0.2
"""Shape and extent of a curve without them, as in AsapRealizer."""

_VIA: Final = "via"
_PLACES: Final = ("start", _VIA, "end")
"""The types of values that are reached one after another."""
_VALUES: Final = (*_PLACES, "direction", "distance", "normal", "shape", "extent", "roundness", "skewedness")
"""All types of values."""


class MovementReader:
    """Reads movements, and the values of slots, of one description."""

    def __init__(self, source: MurmlSource) -> None:
        self._source = source

    def marks(self, tree: Tree, slot: Slot, scope: Scope, before: Sequence[Mark]) -> list[Mark]:
        """The marks of a dynamicElement after those before it.

        Raises:
            RealizerError: it needs a value, or one is bad.
        """
        values: dict[str, Tree] = {}
        for child in self._source.children(tree, ("value",)):
            kind = child.get("type", "")
            if kind in values and kind != _VIA:
                self._source.note(child, GivenTwice(what=f"the value '{quoted(kind)}'", counting=_counting(kind)))
            values[kind] = child
        for kind in values.keys() - set(_VALUES):
            self._source.note(values[kind], UnknownSymbol(slot="type of value", symbol=quoted(kind), known=_VALUES))
        stops = [child for child in self._source.children(tree, ("value",)) if child.get("type") in _PLACES]
        marks = [self._mark(child, slot, scope) for child in stops]
        if before and marks and stops[0].get("type") == "start" and marks[0].value == before[-1].value:
            marks.pop(0)
        way = self._way(tree, slot, values)
        if way is not None:
            marks.append(way)
        if not marks:
            raise RealizerError(
                self._source.at(tree, MissingMurmlValue(slot=slot, values="values of the types start and end"))
            )
        if not before and isinstance(marks[0].value, Shift):
            raise RealizerError(self._source.at(tree, MissingMurmlValue(slot=slot, values="a value of the type start")))
        first = before[-1].position + 1.0 if before else 0.0
        bend = self._bend(tree, values) if slot is Slot.HAND_LOCATION else None
        bent = marks[-1] if len(marks) > 1 or before else None
        return [
            replace(mark, position=first + number, bend=bend if mark is bent else None)
            for number, mark in enumerate(marks)
        ]

    def value(self, tree: Tree, slot: Slot, scope: Scope, attribute: str) -> SlotValue:
        """The value of a slot in an attribute.

        Raises:
            RealizerError: it is missing or bad.
        """
        text = tree.get(attribute)
        if text is None:
            raise RealizerError(
                self._source.at(tree, MissingMurmlValue(slot=slot, values=f"the attribute {attribute}"))
            )
        if slot is Slot.HAND_SHAPE and "(" in text:
            self._source.leave_out(tree, "a modified hand shape", "it has the shape of its first symbol")
        return self._source.located(tree, lambda: value_of(slot, scope, text))

    def _mark(self, tree: Tree, slot: Slot, scope: Scope) -> Mark:
        return Mark(0.0, self.value(tree, slot, scope, "name"), self._source.locate(tree), id=tree.get("id") or None)

    def _way(self, tree: Tree, slot: Slot, values: dict[str, Tree]) -> Mark | None:
        """The end of a movement that is given by a direction and a distance; None for another one."""
        if slot is not Slot.HAND_LOCATION or "end" in values or "direction" not in values:
            return None
        direction = values["direction"]
        heading = self._source.located(direction, lambda: direction_of(slot, direction.get("name", "")))
        far = SYMBOLS.ways["DistNorm"]
        if "distance" in values:
            distance = values["distance"]
            far = self._source.located(distance, lambda: number_of("distance", distance.get("name", ""), SYMBOLS.ways))
        return Mark(0.0, Shift(heading, far), self._source.locate(direction), id=direction.get("id") or None)

    def _bend(self, tree: Tree, values: dict[str, Tree]) -> Bend | None:
        """The curve of a movement; None for a straight one."""
        kind = tree.get("type", "linear").lower()
        if kind not in _TYPES:
            self._source.note(tree, UnknownSymbol(slot=f"type of {ELEMENT}", symbol=quoted(kind), known=_TYPES))
        if kind != "curve":
            return None
        if "normal" not in values:
            missing = MissingMurmlValue(slot="type curve", values="a value of the type normal; it is straight now")
            self._source.note(tree, missing)
            return None
        normal = values["normal"]
        axis = self._source.located(normal, lambda: direction_of("normal", normal.get("name", "")))
        extent, shape = _USUAL_EXTENT, _USUAL_CURVE
        if "extent" in values:
            written = values["extent"]
            extent = self._source.located(
                written, lambda: number_of("extent", written.get("name", ""), SYMBOLS.extents)
            )
        if "shape" in values:
            shape = values["shape"].get("name", "")
            if shape not in _CURVES:
                known = tuple(_CURVES)
                raise RealizerError(
                    self._source.at(values["shape"], UnknownSymbol(slot="shape", symbol=quoted(shape), known=known))
                )
        side, double = _CURVES[shape]
        roundness = self._degree(values, "roundness", SYMBOLS.roundnesses)
        return Bend(axis, side * extent, double, roundness, self._degree(values, "skewedness", SYMBOLS.skewednesses))

    def _degree(self, values: Mapping[str, Tree], name: str, symbols: Mapping[str, float]) -> float:
        """The roundness or skewedness of a curve; 0 if it has none."""
        written = values.get(name)
        if written is None:
            return 0.0
        return self._source.located(written, lambda: degree_of(name, written.get("name", ""), symbols))


def _counting(kind: str) -> str:
    """Which of two values of a type counts: places are reached one after another."""
    return "each of them" if kind in _PLACES else "this one"
