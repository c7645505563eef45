"""The elements of a description, and the faults of what is left out."""

from collections.abc import Callable
from typing import TypeVar

from reactive_realizer.bml.faults import UnknownElement
from reactive_realizer.bml.murml.faults import MurmlNotRealized
from reactive_realizer.bml.names import Location
from reactive_realizer.bml.trees import Tree, name_of
from reactive_realizer.errors import Fault, RealizerError

T = TypeVar("T")


class MurmlSource:
    """Gives elements their places, and collects faults.

    Attributes:
        locate: returns the place of an element.
        notes: faults of what is left out, with their places.
    """

    def __init__(self, locate: Callable[[Tree], Location]) -> None:
        self.locate = locate
        self.notes: list[Fault] = []
        self._left_out: set[str] = set()

    def children(self, tree: Tree, names: tuple[str, ...]) -> list[Tree]:
        """The children with these names; others are named in one note for each element."""
        unknown = [child for child in tree if name_of(child) not in names]
        if unknown:
            fault = UnknownElement(elements=tuple(map(name_of, unknown)), parent=name_of(tree), known=names)
            place = self.locate(unknown[0])
            located = fault.located(place.line, place.column)
            if located not in self.notes:
                self.notes.append(located)
        return [child for child in tree if name_of(child) in names]

    def located(self, tree: Tree, read: Callable[[], T]) -> T:
        """The result of a function; its fault gets the place of an element."""
        try:
            return read()
        except RealizerError as refused:
            raise RealizerError(self.at(tree, refused.fault)) from None

    def leave_out(self, tree: Tree, feature: str, reason: str) -> None:
        """Note, once, that a feature is not realized."""
        if feature not in self._left_out:
            self._left_out.add(feature)
            self.note(tree, MurmlNotRealized(feature=feature, reason=reason))

    def note(self, tree: Tree, fault: Fault) -> None:
        """Note a fault of an element."""
        self.notes.append(self.at(tree, fault))

    def at(self, tree: Tree, fault: Fault) -> Fault:
        """A fault with the place of an element."""
        place = self.locate(tree)
        return fault.located(place.line, place.column)
