"""Animations read once."""

from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType

from reactive_realizer.embodiment.skeleton import Skeleton
from reactive_realizer.engines.animation.expression.functions import FUNCTIONS, Function
from reactive_realizer.engines.animation.procedural.proc_animation import ProcAnimation
from reactive_realizer.engines.animation.procedural.proc_animation_reader import read_proc_animation

NO_MORE: Mapping[str, Function] = MappingProxyType({})


def animation_in(
    path: Path,
    skeleton: Skeleton,
    *,
    mirror: bool = False,
    joints: frozenset[str] = frozenset(),
    functions: Mapping[str, Function] = NO_MORE,
) -> ProcAnimation:
    """The animation in a file, for a figure; a file that was saved anew is read anew.

    Args:
        path: the file.
        skeleton: of the figure.
        mirror: whether left is right.
        joints: to which it is confined, as they are called in the mirror; none: all that it turns.
        functions: what its formulas may call besides `FUNCTIONS`.

    Raises:
        RealizerError: it cannot be read, or turns none of the joints.
    """
    return _made(path, path.stat().st_mtime_ns, tuple(functions.items()), skeleton, mirror, joints)


_Functions = tuple[tuple[str, Function], ...]


@lru_cache
def _made(
    path: Path, changed: int, functions: _Functions, skeleton: Skeleton, mirror: bool, joints: frozenset[str]
) -> ProcAnimation:
    animation = _read(path, changed, functions)
    if mirror:
        animation = animation.mirrored()
    return (animation.of(joints) if joints else animation).on(skeleton)


@lru_cache
def _read(path: Path, changed: int, functions: _Functions) -> ProcAnimation:
    """Read once for all characters: it takes some milliseconds, which a tick hardly has."""
    return read_proc_animation(path, {**FUNCTIONS, **dict(functions)})
