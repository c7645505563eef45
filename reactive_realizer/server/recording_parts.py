"""The files of a recording: one, or several parts of limited size, which are replayed in order."""

from contextlib import suppress
from math import inf
from pathlib import Path


def part_path(path: Path, number: int) -> Path:
    """The file of a part of a recording: ``session.jsonl``, then ``session.2.jsonl`` and so on.

    Args:
        path: of the first part.
        number: of the part, from 1.
    """
    return path if number == 1 else path.with_stem(f"{path.stem}.{number}")


class RecordingParts:
    """Writes the lines of a recording, and begins another part when one has reached its size.

    Every part begins with the first line of the recording. The last line of a part names the number of the next one,
    which exists by then, so that the parts can be read whenever the writer is killed.

    Args:
        path: of the first part, which is emptied.
        most: size in bytes from which a part is followed by another one.

    Raises:
        OSError: the file cannot be written.
    """

    def __init__(self, path: Path, most: float = inf) -> None:
        self._path = path
        self._most = most
        self._number = 1
        self._header = ""
        self._size = 0
        self._stream = path.open("w", encoding="ascii")

    def close(self) -> None:
        """Close the last part."""
        with suppress(OSError):  # `write` has raised it
            self._stream.close()

    def write(self, lines: str) -> None:
        """Write complete lines into the same part.

        Raises:
            OSError: they cannot be written.
        """
        if self._size >= self._most:
            self._begin_part()
        self._header = self._header or lines.partition("\n")[0] + "\n"
        self._append(lines)

    def _begin_part(self) -> None:
        self._number += 1
        following = part_path(self._path, self._number).open("w", encoding="ascii")
        last, self._stream = self._stream, following
        with last:
            self._size = 0
            self._append(self._header)
            last.write(f'{{"part": {self._number}}}\n')

    def _append(self, lines: str) -> None:
        self._stream.write(lines)
        self._stream.flush()
        self._size += len(lines)
