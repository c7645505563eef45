"""Sounds of voices."""

import numpy as np

RATE = 22_050


def voice(pitch: float, seconds: float = 0.5, rate: int = RATE) -> bytes:
    """A vowel: the harmonics of a pitch, each weaker than the one below."""
    time = np.arange(int(seconds * rate)) / rate
    sound = sum(np.sin(2.0 * np.pi * pitch * number * time) / number for number in range(1, 11))
    return (8000.0 * np.asarray(sound)).astype("<i2").tobytes()
