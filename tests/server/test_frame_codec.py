"""The binary frame, byte by byte."""

import struct

import numpy as np

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.server.frame_stream import encode_frame

ROOT = np.array([0.5, 1.0, -2.0])
ROTATIONS = np.array([[1.0, 0.0, 0.0, 0.0], [0.0, -1.0, 0.0, 0.0], [0.5, 0.5, -0.5, 0.5]])
WEIGHTS = np.array([0.0, 1.0])


def encoded(sequence: int = 7, rotations: np.ndarray = ROTATIONS, weights: np.ndarray = WEIGHTS) -> bytes:
    return encode_frame(3, sequence, GlobalTime(12.34), ROOT, rotations, weights)


def test_a_frame_is_a_header_then_rotations_then_weights_little_endian() -> None:
    assert encoded() == (
        struct.pack("<BBHIdHHfff", 1, 1, 3, 7, 12.34, 3, 2, 0.5, 1.0, -2.0)
        + struct.pack("<4h", 32767, 0, 0, 0)
        + struct.pack("<4h", 0, -32767, 0, 0)
        + struct.pack("<4h", 16384, 16384, -16384, 16384)
        + struct.pack("<2H", 0, 65535)
    )


def test_the_header_keeps_the_numbers_aligned() -> None:
    assert len(encoded(rotations=np.zeros((0, 4)), weights=np.zeros(0))) == 32


def test_numbers_that_are_rounded_out_of_range_do_not_wrap() -> None:
    frame = encoded(rotations=np.array([[1.0000001, 0, 0, 0]]), weights=np.array([1.0000001, -1e-9]))
    assert struct.unpack_from("<4h2H", frame, 32) == (32767, 0, 0, 0, 65535, 0)


def test_the_sequence_number_wraps() -> None:
    assert struct.unpack_from("<I", encoded(2**32 + 5), 4) == (5,)
