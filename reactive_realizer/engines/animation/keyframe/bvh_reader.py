"""Reads motion captures in Biovision's BVH format.

A HIERARCHY of joints with offsets and channels, then the MOTION, frame by frame (M. Meredith and S. Maddock, "Motion
capture file formats explained", 2001). Existing libraries are unmaintained or depend on plotting packages.
"""

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.binding.asset_file import read_bytes
from reactive_realizer.engines.animation.faults import BadCapture
from reactive_realizer.engines.animation.keyframe.capture import Capture, CapturedJoint
from reactive_realizer.errors import RealizerError

_CHANNELS = frozenset(f"{axis}{what}" for axis in "XYZ" for what in ("position", "rotation"))
_MOST_DIGITS = 9
_LARGEST = 1e9
"""Limit of lengths, in any unit, and of angles."""
_MOST_JOINTS = 1000
_MOST_TURNS = 1_000_000
"""Limit of joints times frames, above that of any file of the allowed size."""
_PIECE = 5000
_END = "End"
"""An end site has an offset but no name, and does not turn."""


def read_capture(path: Path) -> Capture:
    """Read the capture of a file.

    Raises:
        RealizerError: "bad-capture", with file, line and reason; or the file is too big.
        OSError: the file cannot be read.
    """
    text = read_bytes(path).decode("utf-8-sig", errors="replace")
    return _CaptureReader(path.name, text.replace("\r\n", "\n").replace("\r", "\n")).read()


class _CaptureReader:
    """Parses the words of a file."""

    def __init__(self, name: str, text: str) -> None:
        self._name = name
        head, motion, self._numbers = text.partition("\nMOTION")
        self._words = _words(head)
        self._row = 1
        self._motion_row = head.count("\n") + 2
        if not motion:
            raise self._bad("there is no MOTION")

    def read(self) -> Capture:
        """Parse the whole file."""
        self._expect("HIERARCHY")
        self._expect("ROOT")
        joints = self._joints()
        if len(joints) > _MOST_JOINTS:
            raise self._bad(f"{len(joints)} joints are more than {_MOST_JOINTS}")
        step, frames = self._motion(sum(len(joint.channels) for joint in joints))
        if len(frames) * len(joints) > _MOST_TURNS:
            raise self._bad(f"{len(frames)} frames of {len(joints)} joints are more than {_MOST_TURNS} rotations")
        return Capture(self._name, tuple(joints), step, frames)

    def _joints(self) -> list[CapturedJoint]:
        """Parse the root and all its descendants."""
        joints: list[CapturedJoint] = []
        above: list[int] = []
        name = self._name_before_brace()
        while True:
            above.append(self._joint(name, above, joints))
            while (word := self._next()) == "}":
                above.pop()
                if not above:
                    return joints
            name = self._name_before_brace() if word == "JOINT" else self._end(word)

    def _joint(self, name: str, above: list[int], joints: list[CapturedJoint]) -> int:
        """Parse the start of a joint; return its index, or that of its parent for an end site."""
        self._expect("OFFSET")
        offset = (self._number(), self._number(), self._number())
        parent = above[-1] if above else -1
        if name == _END:
            return parent
        self._expect("CHANNELS")
        channels = tuple(self._channel() for _ in range(self._count()))
        joints.append(CapturedJoint(name, parent, offset, channels))
        return len(joints) - 1

    def _end(self, word: str) -> str:
        if word != _END:
            raise self._bad(f"found '{word}' instead of JOINT, End Site or }}")
        self._expect("Site")
        self._expect("{")
        return _END

    def _motion(self, width: int) -> tuple[float, NDArray[np.float64]]:
        words = [word for line in self._numbers.splitlines() for word in line.split()]
        self._row = self._motion_row
        if words[:1] != ["Frames:"] or words[2:4] != ["Frame", "Time:"] or len(words) < 5:
            raise self._bad("'Frames: N' and 'Frame Time: s' must follow MOTION")
        count, step = self._whole(words[1]), self._finite(words[4])
        try:
            values = _values(words[5:])
        except ValueError as problem:
            raise self._bad(str(problem)) from problem
        if values.size == (count - 1) * width:  # many exporters count the frames from 0 to the last one
            count -= 1
        if count < 2 or step <= 0.0 or values.size != count * width or not (np.abs(values) <= _LARGEST).all():
            wanted = f"{count} frames of {width} numbers up to {_LARGEST:g}, {step:g} s apart"
            raise self._bad(f"the {values.size} numbers are not {wanted}, or there are fewer than two frames")
        return step, values.reshape(count, width)

    def _channel(self) -> str:
        word = self._next()
        if word not in _CHANNELS:
            raise self._bad(f"there is no channel '{word}'")
        return word

    def _name_before_brace(self) -> str:
        """Parse a name, which may consist of several words."""
        words = []
        while (word := self._next()) != "{":
            words.append(word)
        return " ".join(words)

    def _count(self) -> int:
        return self._whole(self._next())

    def _number(self) -> float:
        return self._finite(self._next())

    def _whole(self, word: str) -> int:
        if not word.isdecimal() or len(word) > _MOST_DIGITS:
            raise self._bad(f"'{word}' is not a count")
        return int(word)

    def _finite(self, word: str) -> float:
        try:
            value = float(word)
        except ValueError:
            value = math.nan
        if not abs(value) <= _LARGEST:
            raise self._bad(f"'{word}' is not a number up to {_LARGEST:g}")
        return value

    def _expect(self, wanted: str) -> None:
        word = self._next()
        if word != wanted:
            raise self._bad(f"found '{word}' instead of {wanted}")

    def _next(self) -> str:
        self._row, word = next(self._words, (self._row, ""))
        if not word:
            raise self._bad("the HIERARCHY ends unexpectedly")
        return word

    def _bad(self, reason: str) -> RealizerError:
        return RealizerError(BadCapture(file=self._name, row=self._row, reason=reason))


def _values(words: list[str]) -> NDArray[np.float64]:
    """Convert words to numbers in chunks, so that other threads, which move the figures, can run in between."""
    starts = range(0, len(words) or 1, _PIECE)
    return np.concatenate([np.array(words[start : start + _PIECE], dtype=np.float64) for start in starts])


def _words(text: str) -> Iterator[tuple[int, str]]:
    for row, line in enumerate(text.splitlines(), 1):
        for word in line.split():
            yield row, word
