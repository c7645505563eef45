"""Files that people write for the realizer."""

from collections.abc import Callable
from pathlib import Path

from reactive_realizer.errors import RealizerError, error

LARGEST = 8 * 1024 * 1024
"""Bytes of one file: minutes of captured motion."""


def read_bytes(path: Path) -> bytes:
    """What is in a file.

    Raises:
        RealizerError: "asset-too-big"; none of it has been read.
        OSError: the file cannot be read.
    """
    size = path.stat().st_size
    if size > LARGEST:
        raise error("asset-too-big", file=path.name, size=size, limit=LARGEST)
    return path.read_bytes()


def first_asset(asset: Callable[[str], Path], *names: str) -> Path:
    """The first of several files that is there.

    Args:
        asset: finds a file by name.
        names: one or more.

    Raises:
        RealizerError: "no-asset": none of them is, all of which it names; or the name of one is wrong.
    """
    missing = []
    for name in names:
        try:
            return asset(name)
        except RealizerError as problem:
            if problem.fault.code != "no-asset":
                raise
            missing.append(str(problem.fault.details["name"]))
    raise error("no-asset", name="' or '".join(missing))
