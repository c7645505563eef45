"""The words of text files of captured figures, and the limits of what they may contain."""

import math
import re
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.binding.asset_file import read_bytes
from reactive_realizer.engines.animation.faults import BadCapture
from reactive_realizer.errors import RealizerError

LARGEST: Final = 1e9
"""Limit of lengths, in any unit, and of angles."""
_MOST_JOINTS: Final = 1000
_MOST_TURNS: Final = 1_000_000
"""Limit of joints times frames, above that of any file of the allowed size."""
_MOST_DIGITS: Final = 9


def read_text(path: Path) -> str:
    """Return the text of a file, whatever ends its lines.

    Raises:
        RealizerError: the file is too big.
        OSError: the file cannot be read.
    """
    text = read_bytes(path).decode("utf-8-sig", errors="replace")
    return text.replace("\r\n", "\n").replace("\r", "\n")


class CaptureWords:
    """Reads the words of a text, one after the other.

    Args:
        name: of the file.
        text: to read.
        whole: what the text is, for the message if it ends too early.
        words: what separates them: by default, white space.
    """

    def __init__(self, name: str, text: str, whole: str, words: re.Pattern[str] = re.compile(r"\S+")) -> None:
        self._name = name
        self._whole = whole
        self._words = self._found(text, words)
        self.row = 1

    @staticmethod
    def _found(text: str, words: re.Pattern[str]) -> Iterator[tuple[int, str]]:
        for row, line in enumerate(text.splitlines(), 1):
            for found in words.finditer(line):
                yield row, found[0]

    def next(self) -> str:
        """Return the next word.

        Raises:
            RealizerError: "bad-capture": there is none.
        """
        word = self.next_if_any()
        if not word:
            raise self.bad(f"the {self._whole} ends unexpectedly")
        return word

    def next_if_any(self) -> str:
        """Return the next word; empty at the end."""
        self.row, word = next(self._words, (self.row, ""))
        return word

    def expect(self, wanted: str) -> None:
        """Read a certain word.

        Raises:
            RealizerError: "bad-capture": it is another one.
        """
        word = self.next()
        if word != wanted:
            raise self.bad(f"found '{word}' instead of {wanted}")

    def whole(self, word: str) -> int:
        """Return the number that a word is.

        Raises:
            RealizerError: "bad-capture": it is not a count.
        """
        if not word.isdecimal() or len(word) > _MOST_DIGITS:
            raise self.bad(f"'{word}' is not a count")
        return int(word)

    def count(self) -> int:
        """Read a count.

        Raises:
            RealizerError: "bad-capture": the next word is none.
        """
        return self.whole(self.next())

    def number(self) -> float:
        """Read a number.

        Raises:
            RealizerError: "bad-capture": the next word is none.
        """
        return self.finite(self.next())

    def finite(self, word: str) -> float:
        """Return the number that a word is.

        Raises:
            RealizerError: "bad-capture": it is none, or too large.
        """
        try:
            value = float(word)
        except ValueError:
            value = math.nan
        if not abs(value) <= LARGEST:
            raise self.bad(f"'{word}' is not a number up to {LARGEST:g}")
        return value

    def numbers(self, count: int) -> NDArray[np.float64]:
        """Read several numbers.

        Raises:
            RealizerError: "bad-capture": one of the next words is none, or too large.
        """
        words = [self.next() for _ in range(count)]
        with suppress(ValueError):
            found = np.array(words, dtype=np.float64)
            if (np.abs(found) <= LARGEST).all():
                return found
        return np.array([self.finite(word) for word in words])  # names the first one that is none

    def bad(self, reason: str) -> RealizerError:
        """Return an error about the line of the last word."""
        return RealizerError(BadCapture(file=self._name, row=self.row, reason=reason))

    def check_size(self, joints: int, frames: int = 0) -> None:
        """Check the size of a capture.

        Raises:
            RealizerError: "bad-capture": it has too many joints, or too many of them in its frames.
        """
        if joints > _MOST_JOINTS:
            raise self.bad(f"{joints} joints are more than {_MOST_JOINTS}")
        if frames * joints > _MOST_TURNS:
            raise self.bad(f"{frames} frames of {joints} joints are more than {_MOST_TURNS} rotations")
