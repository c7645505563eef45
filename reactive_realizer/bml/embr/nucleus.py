"""Nuclei: the expressive parts of gestures, which may spread over several sequences (Heloir and Kipp 2010, section 5).

A nucleus changes the poses that refer to it before they are read, so that what it means can be written as key poses.
"""

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Final

from reactive_realizer.bml.embr.faults import UnknownName
from reactive_realizer.bml.embr.syntax import NUCLEUS, ORIENTATION, POSITION, SWIVEL, Node, Value
from reactive_realizer.bml.embr.timeline import SHORTEST, Timed
from reactive_realizer.bml.embr.values import Notes
from reactive_realizer.bml.expressivity import MOST, NEUTRAL, Expressivity
from reactive_realizer.bml.motion_faults import GivenTwice
from reactive_realizer.errors import RealizerError, quoted

_PARAMETERS: Final = ("SPATIAL_EXT", "TEMPORAL_EXT", "POWER", "FLUIDITY")
"""In the order of the fields of `Expressivity`."""

_SWING: Final = 0.2
"""Duration of a back-swing with all power, s; the paper leaves it open."""

_ROUNDING: Final = 1e-9

Place = tuple[float, float, float]
"""A place in EMBR's axes, m."""


class Nuclei:
    """The nuclei of a script."""

    def __init__(self, script: Iterable[Node], notes: Notes) -> None:
        """Read them.

        Args:
            script: its elements; a nucleus may come after the poses that refer to it.
            notes: receives the faults of what is left out.
        """
        self._notes = notes
        self._known: dict[str, Expressivity] = {}
        elements = list(script)
        for node in elements:
            if node.name == NUCLEUS:
                self._read(node)
        places: dict[str, list[Place]] = {}
        for pose in (child for node in elements for child in node.children if "NUCLEUS" in child.values):
            places.setdefault(pose.values["NUCLEUS"].text, []).extend(_places(pose).values())
        self._centers = {nucleus: _center(own) for nucleus, own in places.items() if own}

    def _read(self, node: Node) -> None:
        try:
            id_ = self._notes.text(node, "NUCLEUS_ID")
        except RealizerError as refused:
            self._notes.faults.append(refused.fault)
            return
        if id_ in self._known:
            twice = GivenTwice(what=f"the NUCLEUS {quoted(id_)}", counting="this one")
            self._notes.add(twice, node.values["NUCLEUS_ID"].location)
        self._known[id_] = Expressivity(*(self._number(node, name) for name in _PARAMETERS))

    def _number(self, node: Node, name: str) -> float:
        """The value of a parameter; one that is out of range has a fault, and the nearest valid value, as in EMBR."""
        try:
            return self._notes.number(node, name, 0.0, -MOST, MOST)
        except RealizerError as refused:
            self._notes.faults.append(refused.fault)
        try:
            value = float(node.values[name].text)
        except ValueError:
            return 0.0
        return 0.0 if math.isnan(value) else min(MOST, max(-MOST, value))

    def _of(self, pose: Node) -> Expressivity:
        """The expressivity of a pose; a nucleus that the script does not have is a fault."""
        if "NUCLEUS" not in pose.values:
            return NEUTRAL
        id_, place = pose.values["NUCLEUS"]
        if id_ not in self._known:
            self._notes.add(UnknownName(kind="NUCLEUS", name=quoted(id_), known=tuple(self._known)), place)
        return self._known.get(id_, NEUTRAL)

    def expressed(self, sequence: Iterable[Timed]) -> Iterator[Timed]:
        """The poses of a sequence in order, with expressivity; others come later if they have to.

        Movements to poses of a nucleus, and their holds, have other durations. The movement after a hold that fluidity
        shortens begins at its end. With power, a pose in the opposite direction, with a hold, comes before the first
        movement of a nucleus whose beginning the script states.
        """
        last, saved, places = 0.0, 0.0, dict[str, Place]()
        previous: Timed | None = None
        swung: set[str] = set()
        for each in sequence:
            expressivity = self._of(each.node)
            after_nucleus = previous is not None and previous.node.values.keys() >= {"NUCLEUS"}
            if expressivity == NEUTRAL:
                begins = max(each.begins - saved, last)
                reached = each.reached if each.reached > begins + _ROUNDING else begins + SHORTEST
                new = Timed(each.node, begins, reached, reached + each.left - each.reached)
            else:
                id_ = each.node.values["NUCLEUS"].text
                node = self._scaled(each.node, id_, expressivity)
                begins = last if after_nucleus else max(each.begins - saved, last)
                ways = {group: (places[group], goal) for group, goal in _places(node).items() if group in places}
                if expressivity.power > 0.0 and ways and id_ not in swung and previous is not None:
                    swung.add(id_)
                    there = begins + _SWING * expressivity.power
                    swing = _back_swing(previous.node, node, ways, expressivity.back_swing)
                    begins = there + expressivity.swing_hold
                    yield _rounded(Timed(swing, last, there, begins))
                reached = begins + expressivity.movement(each.reached - each.begins, SHORTEST, expressivity.speed)
                hold = expressivity.pause(each.left - each.reached)
                new = Timed(node, begins, reached, reached + hold, expressivity.power)
            yield _rounded(new)
            saved = max(0.0, each.left - each.reached - (new.left - new.reached))
            last, previous = new.left, new
            places |= _places(new.node)

    def _scaled(self, pose: Node, nucleus: str, expressivity: Expressivity) -> Node:
        """A pose with its places scaled about the center of the box of all places of its nucleus."""
        if nucleus not in self._centers or expressivity.size == 1.0:
            return pose
        center = self._centers[nucleus]
        return _moved(pose, {group: _along(center, place, expressivity.size) for group, place in _places(pose).items()})


def _places(pose: Node) -> dict[str, Place]:
    """The places of a pose by body group; those that cannot be read are left out."""
    targets = {
        node.values["BODY_GROUP"].text: node.values["TARGET"].text.split(";")
        for node in pose.children
        if node.name == POSITION and node.values.keys() >= {"BODY_GROUP", "TARGET"}
    }
    places = dict[str, Place]()
    for group, parts in targets.items():
        try:
            x, y, z = map(float, parts)
        except ValueError:
            continue
        if math.isfinite(x) and math.isfinite(y) and math.isfinite(z):
            places[group] = x, y, z
    return places


def _center(places: Iterable[Place]) -> Place:
    """The center of the bounding box of places."""
    x, y, z = (0.5 * (min(own) + max(own)) for own in zip(*places, strict=True))
    return x, y, z


def _along(begin: Place, end: Place, share: float) -> Place:
    """The place after a share of a way, which may be less than 0 or more than 1."""
    x, y, z = (a + share * (b - a) for a, b in zip(begin, end, strict=True))
    return x, y, z


def _moved(pose: Node, places: Mapping[str, Place]) -> Node:
    """A pose with other places, by body group."""

    def moved(node: Node) -> Node:
        place = places.get(node.values["BODY_GROUP"].text) if node.name == POSITION else None
        if place is None:
            return node
        target = Value(";".join(f"{part:.6g}" for part in place), node.values["TARGET"].location)
        return replace(node, values={**node.values, "TARGET": target})

    return replace(pose, children=[moved(node) if "BODY_GROUP" in node.values else node for node in pose.children])


def _back_swing(before: Node, pose: Node, ways: Mapping[str, tuple[Place, Place]], share: float) -> Node:
    """A pose a share of the ways to a pose in the opposite direction, with the directions of the hands before it."""
    hands = [node for node in pose.children if node.name == POSITION]
    kept = [node for node in before.children if node.name in (ORIENTATION, SWIVEL)]
    own = [node for node in (*hands, *kept) if "BODY_GROUP" in node.values and node.values["BODY_GROUP"].text in ways]
    swing = _moved(replace(pose, children=own), {group: _along(*ends, -share) for group, ends in ways.items()})
    return replace(swing, values={}, children=[_unnamed(node) for node in swing.children])


def _unnamed(node: Node) -> Node:
    """A constraint without its sync point."""
    return replace(node, values={name: value for name, value in node.values.items() if name != "FEEDBACK_ID"})


def _rounded(timed: Timed) -> Timed:
    return replace(timed, begins=round(timed.begins, 6), reached=round(timed.reached, 6), left=round(timed.left, 6))
