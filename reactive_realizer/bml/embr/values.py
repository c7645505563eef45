"""Reads the values of parameters, and keeps what cannot be read."""

import math
from typing import Final

from reactive_realizer.bml.embr.faults import BadValue, Missing, NotRealized, UnknownName
from reactive_realizer.bml.embr.syntax import Node
from reactive_realizer.bml.embr.words import BODY_GROUPS
from reactive_realizer.bml.key_poses import STEEPNESS, Coordinates
from reactive_realizer.bml.names import Location
from reactive_realizer.bml.vocabulary import BodyGroup, WarpKind
from reactive_realizer.errors import Fault, RealizerError, quoted
from reactive_realizer.limits import Limits

_MS: Final = 0.001
_FARTHEST: Final = 1e6


class Notes:
    """The faults of a script, in the order in which they are found.

    Attributes:
        faults: so far.
        most_goals: limit of the goals of a behavior.
    """

    def __init__(self, limits: Limits) -> None:
        self.faults: list[Fault] = []
        self.most_goals = limits.goals_per_behavior
        self._longest = limits.time_seconds
        self._left_out: set[str] = set()

    def add(self, fault: Fault, place: Location) -> None:
        """Adds a fault at a place."""
        self.faults.append(fault.located(place.line, place.column))

    def left_out(self, feature: str, reason: str, place: Location) -> None:
        """Adds a feature that is not realized, once for the script."""
        if feature not in self._left_out:
            self._left_out.add(feature)
            self.add(NotRealized(feature=feature, reason=reason), place)

    # --- values

    def text(self, node: Node, name: str) -> str:
        """The text of a parameter.

        Raises:
            RealizerError: it is missing.
        """
        value = node.values.get(name)
        if value is None or not value.text:
            place = node.location if value is None else value.location
            raise RealizerError(Missing(element=node.name, parameter=name).located(place.line, place.column))
        return value.text

    def number(
        self, node: Node, name: str, default: float | None = None, low: float = -_FARTHEST, high: float = _FARTHEST
    ) -> float:
        """The number of a parameter.

        Raises:
            RealizerError: it is missing and has no default, or it is not a number in the range.
        """
        if default is not None and name not in node.values:
            return default
        return self._number(node, name, self.text(node, name), low, high)

    def seconds(self, node: Node, name: str, default: float | None = None) -> float:
        """The time of a parameter, which is written in ms, in s.

        Raises:
            RealizerError: as `number`.
        """
        written = None if default is None else default / _MS
        return _MS * self.number(node, name, written, 0.0, self._longest / _MS)

    def moment(self, node: Node, name: str) -> tuple[bool, float]:
        """Read the time of a parameter.

        Returns:
            True for a relative time (``+200``), and the time, s.

        Raises:
            RealizerError: as `number`.
        """
        text = self.text(node, name)
        return text.startswith("+"), _MS * self._number(node, name, text.removeprefix("+"), 0.0, self._longest / _MS)

    def vector(self, node: Node, name: str, default: Coordinates | None = None) -> Coordinates:
        """The vector of a parameter, in the figure's axes here: to its left, up, ahead.

        EMBR's axes are to the figure's left, back and up.

        Raises:
            RealizerError: it is missing and has no default, or it has not three numbers.
        """
        if default is not None and name not in node.values:
            return default
        text = self.text(node, name)
        parts = text.split(";")
        if len(parts) != 3:
            raise self._bad(node, name, "a vector is X;Y;Z")
        x, y, z = (self._number(node, name, part, -_FARTHEST, _FARTHEST) for part in parts)
        return x, z, 0.0 - y

    def body_group(self, node: Node) -> BodyGroup:
        """The body group of an element.

        Raises:
            RealizerError: it is missing or unknown.
        """
        text = self.text(node, "BODY_GROUP")
        if text not in BODY_GROUPS:
            place = node.values["BODY_GROUP"].location
            fault = UnknownName(kind="BODY_GROUP", name=quoted(text), known=tuple(BODY_GROUPS))
            raise RealizerError(fault.located(place.line, place.column))
        return BODY_GROUPS[text]

    def warp(self, node: Node) -> tuple[WarpKind | None, float]:
        """The time warp of an element and its steepness; none if it is missing or of a kind without a curve.

        Raises:
            RealizerError: it has another form.
        """
        if "TIME_WARP" not in node.values:
            return None, 1.0
        kind, _, steepness = self.text(node, "TIME_WARP").partition(";")
        slope = self._number(node, "TIME_WARP", steepness or "1", *STEEPNESS)
        if kind not in tuple(WarpKind):
            self.left_out(f"TIME_WARP:{kind}", "known are TAN and EXP", node.values["TIME_WARP"].location)
            return None, 1.0
        return WarpKind(kind), slope

    def _number(self, node: Node, name: str, text: str, low: float, high: float) -> float:
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not low <= value <= high:
            raise self._bad(node, name, f"it must be a number from {low:g} to {high:g}")
        return value

    def _bad(self, node: Node, name: str, reason: str) -> RealizerError:
        value = node.values[name]
        fault = BadValue(parameter=name, value=quoted(value.text), reason=reason)
        return RealizerError(fault.located(value.location.line, value.location.column))
