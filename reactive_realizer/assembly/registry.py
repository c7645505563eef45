"""Finds plug-ins by name. Built-in parts are in the same entry-point groups as plug-ins."""

import sys
from functools import lru_cache
from importlib.metadata import EntryPoint, entry_points
from typing import Any

from reactive_realizer.assembly.faults import NoPlugin
from reactive_realizer.engine.faults import TwoPlugins
from reactive_realizer.errors import RealizerError

GROUP = "reactive_realizer"
_GROUPS = (
    "engines",
    "tts",
    "anticipators",
    "strategies",
    "trajectories",
    "functions",
    "motions",
    "dialects",
    "bridges",
)


def load(group: str, name: str) -> Any:
    """Imports the object of an entry point of ``reactive_realizer.GROUP``.

    Raises:
        RealizerError: no plug-in has the name, or two have it.
    """
    known = names(group)
    found = [point for point in _points(group) if point.name == name]
    if not found:
        raise RealizerError(NoPlugin(group=group, name=name, known=tuple(known)))
    if len({point.value for point in found}) > 1:
        raise RealizerError(TwoPlugins(group=group, name=name, known=tuple(sorted(point.value for point in found))))
    return found[0].load()


def load_all() -> None:
    """Import every plug-in of every group, so that all faults are defined."""
    for group in _GROUPS:
        for point in _points(group):
            point.load()


def names(group: str) -> list[str]:
    """The ids of a group."""
    return sorted({point.name for point in _points(group)})


def _points(group: str) -> tuple[EntryPoint, ...]:
    return _points_on(tuple(sys.path), group)


@lru_cache(maxsize=64)
def _points_on(path: tuple[str, ...], group: str) -> tuple[EntryPoint, ...]:
    """The entry points of a group, read once for each state of ``sys.path``.

    Looking them up reads the metadata of all installed packages (7 ms with 70 packages), and a scene needs some thirty.
    """
    return tuple(entry_points(group=f"{GROUP}.{group}"))
