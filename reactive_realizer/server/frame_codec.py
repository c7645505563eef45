"""The binary frame: one pose of one character, in its avatar's own bones (docs/protocol.md, frames)."""

import struct

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.clock.units import GlobalTime

_HEADER = struct.Struct("<BBHIdHH3f")
_KIND, _VERSION = 1, 1
_ROTATION_SCALE = 32767
_WEIGHT_SCALE = 65535
_MOST_SEQUENCE = 2**32


def encode_frame(
    character: int,
    sequence: int,
    time: GlobalTime,
    root: NDArray[np.float64],
    rotations: NDArray[np.float64],
    weights: NDArray[np.float64],
) -> bytes:
    """A frame as it goes over the wire, little-endian.

    A header of 32 bytes (u8 kind, u8 version, u16 character, u32 sequence, f64 time, u16 J, u16 M, 3 x f32 root), then
    J x 4 int16 and M x uint16.

    Args:
        character: its index in hello.
        sequence: counts the frames of the character; it wraps.
        time: s.
        root: place of HumanoidRoot in the world, m, (3,).
        rotations: (J, 4) unit quaternions w x y z local to the parent bone.
        weights: (M,) of the morphs, 0..1.
    """
    header = _HEADER.pack(
        _KIND, _VERSION, character, sequence % _MOST_SEQUENCE, time, len(rotations), len(weights), *root.tolist()
    )
    turned = np.rint(rotations * _ROTATION_SCALE).clip(-_ROTATION_SCALE, _ROTATION_SCALE).astype("<i2")
    weighed = np.rint(weights * _WEIGHT_SCALE).clip(0, _WEIGHT_SCALE).astype("<u2")
    return header + turned.tobytes() + weighed.tobytes()
