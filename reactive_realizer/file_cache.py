"""Remembers what was read from files, so that characters, and scenes of one process, share it."""

from collections.abc import Callable, Hashable
from functools import lru_cache, wraps
from pathlib import Path
from typing import TypeVar

T = TypeVar("T")

_MOST = 64
"""Results that one function remembers; a scene has about as many avatars or bindings at most."""


def remembered(read: Callable[..., T]) -> Callable[..., T]:
    """A function that reads the files among its arguments again only when one of them has changed.

    Its other arguments are hashable. Its results are shared, so they must not be changed. Failures are not remembered.
    """

    @lru_cache(_MOST)
    def read_version(arguments: tuple[Hashable, ...], versions: tuple[tuple[int, int], ...]) -> T:
        return read(*arguments)

    @wraps(read)
    def read_if_changed(*arguments: Hashable) -> T:
        found = [each.stat() for each in arguments if isinstance(each, Path)]
        return read_version(arguments, tuple((each.st_mtime_ns, each.st_size) for each in found))

    return read_if_changed
