"""Plug-ins by short id: the built-in ones stand in the same entry-point groups as everybody's."""

from importlib.metadata import entry_points
from typing import Any

from reactive_realizer.errors import error

GROUP = "reactive_realizer"


def load(group: str, name: str) -> Any:
    """What an entry point of ``reactive_realizer.GROUP`` names; imported only now.

    Raises:
        RealizerError: no such name, or two plug-ins that claim it.
    """
    known = names(group)
    found = [point for point in entry_points(group=f"{GROUP}.{group}") if point.name == name]
    if not found:
        raise error("no-plugin", group=group, name=name, known=", ".join(known) or "none")
    if len({point.value for point in found}) > 1:
        raise error("two-plugins", group=group, name=name, known=", ".join(sorted(point.value for point in found)))
    return found[0].load()


def names(group: str) -> list[str]:
    """The ids of a group."""
    return sorted({point.name for point in entry_points(group=f"{GROUP}.{group}")})
