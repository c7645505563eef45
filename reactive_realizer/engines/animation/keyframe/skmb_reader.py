"""Reads motions in SmartBody's binary format ``.skmb``: a message of Protocol Buffers (its sbmotion.proto)."""

import struct
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Final

import numpy as np

from reactive_realizer.binding.asset_file import ENDS, read_bytes
from reactive_realizer.engines.animation.faults import BadBinaryMotion
from reactive_realizer.engines.animation.keyframe.capture import Array
from reactive_realizer.engines.animation.keyframe.capture_words import LARGEST
from reactive_realizer.engines.animation.keyframe.sk_motion import (
    ANGLES,
    KINDS,
    ONE_POSE,
    QUAT,
    UNPLAYED,
    SkMotion,
    add_point,
    completed,
)
from reactive_realizer.errors import RealizerError

_TYPES: Final = (*KINDS, *UNPLAYED)
"""Kinds of channels, in the order of the numbers that stand for them."""
_NAMES, _KINDS, _TIMES, _VALUES, _POINTS = 3, 4, 6, 7, 8
"""Numbers of fields."""
_VARINT, _EIGHT_BYTES, _BYTES, _FOUR_BYTES = 0, 1, 2, 5
"""Types of fields."""
_LONGEST_VARINT: Final = 10
_SYNCS: Final = ("start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end")

_Field = tuple[int, int, bytes]
"""Number, type and content of a field; a varint is its little-endian bytes."""


def read_binary_motion(path: Path) -> SkMotion:
    """Read a motion.

    Raises:
        RealizerError: "bad-binary-motion", with file and reason; or the file is too big.
        OSError: the file cannot be read.
    """
    try:
        fields = list(_fields(read_bytes(path)))
        return _motion(path.name, fields)
    except (ValueError, struct.error) as problem:
        raise RealizerError(BadBinaryMotion(file=path.name, reason=str(problem))) from problem


def _motion(name: str, fields: Sequence[_Field]) -> SkMotion:
    joints = [content.decode() for number, _, content in fields if number == _NAMES]
    kinds = [_kind(number) for number in _numbers(fields, _KINDS)]
    if not kinds or len(joints) != len(kinds):
        raise ValueError(f"{len(joints)} names of joints are for {len(kinds)} channels")
    if unplayed := next((kind for kind in kinds if kind in UNPLAYED), None):
        raise ValueError(f"it has a channel {unplayed.capitalize()}, which SmartBody does not play either")
    times = _floats(fields, _TIMES)
    values = _floats(fields, _VALUES)
    wide = sum(4 if kind == QUAT else 1 for kind in kinds)
    if not len(times) or len(values) != wide * len(times):
        raise ValueError(f"{len(values)} values are not those of {len(times)} frames with {wide} each")
    if (np.diff(times) <= 0.0).any():
        raise ValueError("the times of the frames do not increase")
    values = _as_written(values.reshape(len(times), wide), kinds)
    if len(times) == 1:
        times, values = np.append(times, times[0] + ONE_POSE), np.repeat(values, 2, axis=0)
    points: dict[str, float] = {}
    for sync, time in zip(_SYNCS, _floats(fields, _POINTS).tolist(), strict=False):
        if sync not in ENDS:
            add_point(points, sync, time, times.tolist(), name)
    channels = tuple(zip(joints, kinds, strict=True))
    return SkMotion(channels, times, values, completed(points, times.tolist()), meters=False)


def _kind(number: int) -> str:
    if number >= len(_TYPES):
        raise ValueError(f"there is no kind of channels {number}")
    return _TYPES[number]


def _as_written(values: Array, kinds: Sequence[str]) -> Array:
    """Return values as they are in files of text: rotations as axis times angle, rad, and angles in degrees."""
    columns, column = [], 0
    for kind in kinds:
        if kind == QUAT:
            columns.append(_rotation_vectors(values[:, column : column + 4]))
            column += 4
        else:
            columns.append(values[:, column : column + 1] * (np.degrees(1.0) if kind in ANGLES else 1.0))
            column += 1
    return np.concatenate(columns, axis=1)


def _rotation_vectors(quats: Array) -> Array:
    """Return axis times angle, rad, (F, 3), of quaternions w x y z, (F, 4)."""
    lengths = np.linalg.norm(quats, axis=1, keepdims=True)
    if (lengths == 0.0).any():
        raise ValueError("a rotation has the length 0")
    quats = np.where(quats[:, :1] < 0.0, -quats, quats) / lengths
    sines = np.linalg.norm(quats[:, 1:], axis=1, keepdims=True)
    half = np.arctan2(sines, quats[:, :1])
    vectors: Array = 2.0 * quats[:, 1:] / np.sinc(half / np.pi)
    return vectors


def _floats(fields: Sequence[_Field], wanted: int) -> Array:
    """Return the values of a field with numbers of four bytes, together in one field or in one each."""
    content = b"".join(content for number, _, content in fields if number == wanted)
    found = np.array(struct.unpack(f"<{len(content) // 4}f", content))
    if not (np.abs(found) <= LARGEST).all():
        raise ValueError(f"there are values that are no numbers up to {LARGEST:g}")
    return found


def _numbers(fields: Sequence[_Field], wanted: int) -> Iterator[int]:
    """Yield the values of a field with varints, together in one field or in one each."""
    for number, kind, content in fields:
        if number == wanted and kind == _VARINT:
            yield int.from_bytes(content, "little")
        elif number == wanted:
            place = 0
            while place < len(content):
                value, place = _varint(content, place)
                yield value


def _fields(message: bytes) -> Iterator[_Field]:
    place = 0
    while place < len(message):
        key, place = _varint(message, place)
        kind, size = key & 7, 0
        if kind == _VARINT:
            value, place = _varint(message, place)
            yield key >> 3, kind, value.to_bytes(_LONGEST_VARINT, "little")
            continue
        if kind == _BYTES:
            size, place = _varint(message, place)
        elif kind in (_FOUR_BYTES, _EIGHT_BYTES):
            size = 4 if kind == _FOUR_BYTES else 8
        else:
            raise ValueError(f"there is a field of the type {kind}: it is no motion in the format skmb")
        if place + size > len(message):
            raise ValueError("it ends unexpectedly")
        yield key >> 3, kind, message[place : place + size]
        place += size


def _varint(message: bytes, place: int) -> tuple[int, int]:
    """Return a number of variable length, and the place behind it."""
    value = 0
    for count in range(_LONGEST_VARINT):
        if place + count >= len(message):
            raise ValueError("it ends unexpectedly")
        byte = message[place + count]
        value |= (byte & 0x7F) << 7 * count
        if byte < 0x80:
            return value, place + count + 1
    raise ValueError("a number is too long: it is no motion in the format skmb")
