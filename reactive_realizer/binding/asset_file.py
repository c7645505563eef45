"""The bytes of files that people write for the realizer."""

from pathlib import Path

from reactive_realizer.errors import error

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
