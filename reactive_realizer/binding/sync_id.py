"""The names that files of motions give to points in time."""

from collections.abc import Iterable, Mapping
from types import MappingProxyType

from reactive_realizer.binding.xml_file import Element, attribute, bad
from reactive_realizer.bml.names import is_sync_id

ENDS: Mapping[str, float] = MappingProxyType({"start": 0.0, "end": 1.0})
"""The points that every motion has, and their phases."""


def sync_id(element: Element) -> str:
    """The id of a KeyPosition, which references and feedback will name.

    Raises:
        RealizerError: "bad-asset": there is none, or it is no such name (`is_sync_id`).
    """
    name = attribute(element, "id")
    if not is_sync_id(name):
        raise bad(
            element, f"id='{name}' cannot name a sync point; wanted is a name as attributes have, but id or xmlns"
        )
    return name


def by_sync_id(elements: Iterable[Element]) -> dict[str, Element]:
    """KeyPositions by their ids.

    Raises:
        RealizerError: "bad-asset": two have the same id, or one has none.
    """
    found: dict[str, Element] = {}
    for element in elements:
        name = sync_id(element)
        if name in found:
            raise bad(element, f"a second {element.tag} with id='{name}'")
        found[name] = element
    return found


def is_placed(sync: str, phase: float) -> bool:
    """Whether a point can lie at a phase: within 0 and 1, "start" only at 0 and "end" only at 1."""
    return 0.0 <= phase <= 1.0 and phase == ENDS.get(sync, phase)
