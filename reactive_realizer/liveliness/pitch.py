"""The pitch of a voice, estimated from its sound.

The method is that of P. Boersma, "Accurate short-term analysis of the fundamental frequency and the harmonics-to-noise
ratio of a sampled sound" (1993), without its search for the best path: the autocorrelation of a windowed frame, divided
by that of the window, has its highest peak at the period. A median of three frames removes single errors of an octave.
"""

from typing import Final

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

STEP: Final = 0.02
"""Time from one frame to the next, s."""

LOWEST, HIGHEST = 70.0, 450.0
"""Range of the pitch of voices, Hz."""

_WINDOW: Final = 3.0 / LOWEST
"""Duration of a frame, s: three periods of the lowest voice."""

_RATE: Final = 5_000.0
"""Samples a second that suffice, Hz: a period of the highest voice is 11 samples, and peaks are interpolated."""

_FINER: Final = 2
"""Lags per sample at which the autocorrelation is computed: peaks of high voices are narrow."""

_VOICED: Final = 0.5
"""The least autocorrelation of a voiced frame, of 1 for a periodic sound."""

_SILENT: Final = 0.03
"""Amplitude of a silent frame, as a share of the loudest sample."""

_OCTAVE_COST: Final = 0.05
"""How much higher the peak at a period must be for each octave that it is longer: its multiples are as high."""


def pitches(sound: bytes, rate: int) -> NDArray[np.float64]:
    """The pitch of a sound every `STEP`, (N,), Hz; nan where no voice is heard.

    Args:
        sound: mono PCM, int16 little-endian.
        rate: its samples per second, Hz.
    """
    frames, rate_kept = _frames(np.frombuffer(sound, "<i2").astype(np.float64) / 32768.0, rate)
    if not len(frames):
        return np.empty(0)
    heights, lags = _peaks(frames, rate_kept)
    loud = np.abs(frames).max(axis=1) > _SILENT * np.abs(frames).max()
    found = np.where(loud & (heights > _VOICED), rate_kept / lags, np.nan)
    return _medians(found)


def _frames(samples: NDArray[np.float64], rate: int) -> tuple[NDArray[np.float64], float]:
    """The frames of a sound at a lower rate, (N, S), around the multiples of the step; and this rate, Hz."""
    factor = max(1, int(rate / _RATE))
    kept = len(samples) // factor * factor
    fewer = samples[:kept].reshape(-1, factor).mean(axis=1)
    rate_kept = rate / factor
    size = int(_WINDOW * rate_kept)
    if len(fewer) < size:
        return np.empty((0, size)), rate_kept
    padded = np.pad(fewer, size // 2)
    starts = np.round(np.arange(0.0, len(fewer) / rate_kept, STEP) * rate_kept).astype(int)
    return sliding_window_view(padded, size)[starts[starts <= len(padded) - size]], rate_kept


def _peaks(frames: NDArray[np.float64], rate: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Height and lag (samples) of the best peak of the autocorrelation of each frame."""
    size, finer = frames.shape[1], _FINER * rate
    window = np.hanning(size)
    centered = (frames - frames.mean(axis=1, keepdims=True)) * window
    own = _autocorrelation(window[None, :])
    correlation = _autocorrelation(centered) / own
    first, last = int(finer / HIGHEST), min(int(finer / LOWEST) + 1, correlation.shape[1] - 1)
    left, middle, right = (correlation[:, first + shift : last + shift] for shift in (-1, 0, 1))
    bend = left - 2.0 * middle + right
    peak = (middle >= left) & (middle >= right) & (bend < 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):  # a parabola through three samples
        lags = np.arange(first, last) + np.where(peak, (left - right) / (2.0 * bend), 0.0)
        heights = np.where(peak, middle - (left - right) ** 2 / (8.0 * bend), -np.inf)
    best = np.argmax(heights - _OCTAVE_COST * np.log2(lags / first), axis=1)[:, None]
    return np.take_along_axis(heights, best, 1)[:, 0], np.take_along_axis(lags, best, 1)[:, 0] / _FINER


def _autocorrelation(rows: NDArray[np.float64]) -> NDArray[np.float64]:
    """The autocorrelation of each row at fractions of samples, up to half of its length, divided by its power."""
    size = rows.shape[1]
    length = 1 << (3 * size // 2).bit_length()
    spectrum = np.fft.rfft(rows, length)
    found = np.fft.irfft(np.abs(spectrum) ** 2, _FINER * length)[:, : _FINER * (size // 2)]
    power = found[:, :1]
    return np.divide(found, power, out=np.zeros_like(found), where=power > 0.0)


def _medians(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """The median of each voiced frame and its neighbors; one without a voice counts as the frame itself."""
    neighbors = sliding_window_view(np.pad(values, 1, constant_values=np.nan), 3)
    filled = np.where(np.isnan(neighbors), values[:, None], neighbors)
    return np.sort(filled, axis=1)[:, 1]
