"""Finds plug-ins by name. Built-in parts are in the same entry-point groups as plug-ins."""

import logging
import sys
from collections.abc import Callable
from functools import lru_cache
from importlib.metadata import EntryPoint, entry_points
from typing import Any

from reactive_realizer.assembly.faults import BrokenPlugin, NoPlugin
from reactive_realizer.engine.faults import TwoPlugins
from reactive_realizer.errors import RealizerError

logger = logging.getLogger(__name__)

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


def load(group: str, name: str, kind: Any = Callable) -> Any:
    """Imports the object of an entry point of ``reactive_realizer.GROUP``.

    Args:
        group: of plug-ins.
        name: in the group.
        kind: the class that the object has to belong to; by default, it is a class itself, or a function.

    Raises:
        RealizerError: "no-plugin", "two-plugins", or "broken-plugin": it cannot be imported, or is of another kind.
    """
    point = _point(group, name)
    plugin = _imported(group, point)
    if not isinstance(plugin, kind):
        raise _broken(group, point, f"it is of the type {type(plugin).__name__}, not {kind.__name__}")
    return plugin


def broken(group: str, name: str, problem: BaseException) -> RealizerError:
    """The error of a plug-in that raised an exception while it was set up."""
    return _broken(group, _point(group, name), one_line(problem))


def load_all() -> None:
    """Import every plug-in of every group that can be imported, so that all faults are defined."""
    for group in _GROUPS:
        for point in _points(group):
            try:
                _imported(group, point)
            except RealizerError as problem:
                logger.warning("%s", problem.fault.sentence)


def _point(group: str, name: str) -> EntryPoint:
    found = [point for point in _points(group) if point.name == name]
    if not found:
        raise RealizerError(NoPlugin(group=group, name=name, known=tuple(names(group))))
    if len({point.value for point in found}) > 1:
        raise RealizerError(TwoPlugins(group=group, name=name, known=tuple(sorted(map(_source, found)))))
    return found[0]


def _imported(group: str, point: EntryPoint) -> Any:
    try:
        return point.load()
    except (Exception, SystemExit) as problem:
        raise _broken(group, point, one_line(problem)) from problem


def _broken(group: str, point: EntryPoint, reason: str) -> RealizerError:
    return RealizerError(BrokenPlugin(group=group, name=point.name, source=_source(point), reason=reason))


def _source(point: EntryPoint) -> str:
    """Return the distribution and the object of a plug-in, for messages."""
    return point.value if point.dist is None else f"{point.dist.name} ({point.value})"


def one_line(problem: BaseException) -> str:
    """An exception on one line; of a group, those in it."""
    if isinstance(problem, BaseExceptionGroup):
        return "; ".join(map(one_line, problem.exceptions))
    return " ".join(f"{type(problem).__name__}: {problem}".split()).removesuffix(":")


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
