"""Frames of all characters in their binary form, encoded once a tick for all viewers (docs/protocol.md, frames)."""

import struct
from collections.abc import Callable, Mapping
from itertools import count

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.frame import Frame
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.server.frame_watch import FrameWatch
from reactive_realizer.server.socket_writer import binary_message

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
    """Encodes a frame, little-endian.

    A header of 32 bytes (u8 kind, u8 version, u16 character, u32 sequence, f64 time, u16 J, u16 M, 3 x f32 root), then
    J x 4 int16 and M x uint16.

    Args:
        character: index of the character in hello.
        sequence: number of the frame of the character; it wraps.
        time: s.
        root: position of HumanoidRoot in the world, m, (3,).
        rotations: (J, 4) unit quaternions w x y z local to the parent bone.
        weights: (M,) of the morphs, 0..1.
    """
    header = _HEADER.pack(
        _KIND, _VERSION, character, sequence % _MOST_SEQUENCE, time, len(rotations), len(weights), *root.tolist()
    )
    turned = np.rint(rotations * _ROTATION_SCALE).clip(-_ROTATION_SCALE, _ROTATION_SCALE).astype("<i2")
    weighed = np.rint(weights * _WEIGHT_SCALE).clip(0, _WEIGHT_SCALE).astype("<u2")
    return header + turned.tobytes() + weighed.tobytes()


class FrameStream:
    """Sends frames to viewers. Without viewers, the realizer composes no frames."""

    def __init__(self, realizer: Realizer) -> None:
        self._realizer = realizer
        self._watch: FrameWatch[bytes] = FrameWatch(realizer, self._send)
        self._indices = {id_: index for index, id_ in enumerate(realizer.characters)}
        self._sequences = {id_: count() for id_ in realizer.characters}

    def subscribe(self, listener: Callable[[bytes], None]) -> Callable[[], None]:
        """Gives a listener the frames of each tick, as one message ready to be written to its socket.

        The returned function ends that.
        """
        return self._watch.subscribe(listener)

    def _send(self, frames: Mapping[str, Frame]) -> None:
        self._watch.publish(binary_message(b"".join(map(self._encode, frames, frames.values()))))

    def _encode(self, id_: str, frame: Frame) -> bytes:
        rotations = self._realizer.characters[id_].humanoid.avatar.bone_rotations(frame.rotations)
        index, sequence = self._indices[id_], next(self._sequences[id_])
        return encode_frame(index, sequence, frame.time, frame.root, rotations, frame.weights)
