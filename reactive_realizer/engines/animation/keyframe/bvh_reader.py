"""Reads motion captures in Biovision's BVH format.

A HIERARCHY of joints with offsets and channels, then the MOTION, frame by frame (M. Meredith and S. Maddock, "Motion
capture file formats explained", 2001). Existing libraries are unmaintained or depend on plotting packages.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from reactive_realizer.engines.animation.keyframe.capture import Array, Capture, CapturedJoint, about, product
from reactive_realizer.engines.animation.keyframe.capture_words import LARGEST, CaptureWords, read_text

_CHANNELS = frozenset(f"{axis}{what}" for axis in "XYZ" for what in ("position", "rotation"))
_PIECE = 5000
_END = "End"
"""An end site has an offset but no name, and does not turn."""


class _Channels(NamedTuple):
    """The values of a joint in each frame.

    Attributes:
        joint: that they move.
        names: in order: X, Y or Z, then "position" or "rotation".
    """

    joint: CapturedJoint
    names: tuple[str, ...]


def read_capture(path: Path) -> Capture:
    """Read the capture of a file.

    Raises:
        RealizerError: "bad-capture", with file, line and reason; or the file is too big.
        OSError: the file cannot be read.
    """
    return _CaptureReader(path.name, read_text(path)).read()


class _CaptureReader:
    """Parses the words of a file."""

    def __init__(self, name: str, text: str) -> None:
        self._name = name
        head, motion, self._numbers = text.partition("\nMOTION")
        self._words = CaptureWords(name, head, "HIERARCHY")
        self._motion_row = head.count("\n") + 2
        if not motion:
            raise self._words.bad("there is no MOTION")

    def read(self) -> Capture:
        """Parse the whole file."""
        self._words.expect("HIERARCHY")
        self._words.expect("ROOT")
        joints = self._joints()
        self._words.check_size(len(joints))
        step, frames = self._motion(sum(len(each.names) for each in joints))
        self._words.check_size(len(joints), len(frames))
        times = tuple((np.arange(len(frames)) * step).tolist())
        moves = _moves(joints, frames)
        return Capture(self._name, tuple(each.joint for each in joints), times, _turns(joints, frames), moves)

    def _joints(self) -> list[_Channels]:
        """Parse the root and all its descendants."""
        joints: list[_Channels] = []
        above: list[int] = []
        name = self._name_before_brace()
        while True:
            above.append(self._joint(name, above, joints))
            while (word := self._words.next()) == "}":
                above.pop()
                if not above:
                    return joints
            name = self._name_before_brace() if word == "JOINT" else self._end(word)

    def _joint(self, name: str, above: list[int], joints: list[_Channels]) -> int:
        """Parse the start of a joint; return its index, or that of its parent for an end site."""
        words = self._words
        words.expect("OFFSET")
        offset = (words.number(), words.number(), words.number())
        parent = above[-1] if above else -1
        if name == _END:
            return parent
        words.expect("CHANNELS")
        names = tuple(self._channel() for _ in range(words.count()))
        joints.append(_Channels(CapturedJoint(name, parent, offset), names))
        return len(joints) - 1

    def _end(self, word: str) -> str:
        if word != _END:
            raise self._words.bad(f"found '{word}' instead of JOINT, End Site or }}")
        self._words.expect("Site")
        self._words.expect("{")
        return _END

    def _motion(self, width: int) -> tuple[float, Array]:
        words = [word for line in self._numbers.splitlines() for word in line.split()]
        self._words.row = self._motion_row
        if words[:1] != ["Frames:"] or words[2:4] != ["Frame", "Time:"] or len(words) < 5:
            raise self._words.bad("'Frames: N' and 'Frame Time: s' must follow MOTION")
        count, step = self._words.whole(words[1]), self._words.finite(words[4])
        try:
            values = _values(words[5:])
        except ValueError as problem:
            raise self._words.bad(str(problem)) from problem
        if values.size == (count - 1) * width:  # many exporters count the frames from 0 to the last one
            count -= 1
        if count < 2 or step <= 0.0 or values.size != count * width or not (np.abs(values) <= LARGEST).all():
            wanted = f"{count} frames of {width} numbers up to {LARGEST:g}, {step:g} s apart"
            raise self._words.bad(f"the {values.size} numbers are not {wanted}, or there are fewer than two frames")
        return step, values.reshape(count, width)

    def _channel(self) -> str:
        word = self._words.next()
        if word not in _CHANNELS:
            raise self._words.bad(f"there is no channel '{word}'")
        return word

    def _name_before_brace(self) -> str:
        """Parse a name, which may consist of several words."""
        words = []
        while (word := self._words.next()) != "{":
            words.append(word)
        return " ".join(words)


def _turns(joints: Sequence[_Channels], frames: Array) -> Array:
    """Return the rotation of each joint in each frame, local to its parent, (F, J, 4).

    Channels are applied from left to right: "Zrotation Xrotation Yrotation" is Rz Rx Ry.
    """
    out = np.zeros((len(frames), len(joints), 4))
    out[..., 0] = 1.0
    column = 0
    for index, (_, names) in enumerate(joints):
        for channel in names:
            if channel.endswith("rotation"):
                turn = about("XYZ".index(channel[0]), np.radians(frames[:, column]))
                out[:, index] = product(out[:, index], turn)
            column += 1
    return out


def _moves(joints: Sequence[_Channels], frames: Array) -> dict[int, Array]:
    """Return the offsets, (F, 3), of the joints with channels for them; these override the constant ones."""
    moves: dict[int, Array] = {}
    column = 0
    for index, (joint, names) in enumerate(joints):
        for channel in names:
            if channel.endswith("position"):
                moved = moves.setdefault(index, np.tile(joint.offset, (len(frames), 1)))
                moved[:, "XYZ".index(channel[0])] = frames[:, column]
            column += 1
    return moves


def _values(words: list[str]) -> Array:
    """Convert words to numbers in chunks, so that other threads, which move the figures, can run in between."""
    starts = range(0, len(words) or 1, _PIECE)
    return np.concatenate([np.array(words[start : start + _PIECE], dtype=np.float64) for start in starts])
