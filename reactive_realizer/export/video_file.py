"""An MP4 file with H.264 and AAC (PyAV, an extra)."""

import io
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any, Final

import av
import numpy as np

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.played_sound import RATE as SAMPLE_RATE
from reactive_realizer.embodiment.sound_track import SoundTrack

RATE: Final = 25
"""Pictures a second."""
_QUALITY: Final = "18"
"""Constant rate factor of x264, at which most people see no loss."""


class VideoFile:
    """Collects the pictures of a video, and writes it when its sound is known.

    Args:
        path: of the file.
        size: width and height, pixels, even numbers.
    """

    def __init__(self, path: Path, size: tuple[int, int]) -> None:
        self._file = av.open(path, "w", format="mp4")
        self._video = self._file.add_stream("libx264", rate=RATE, options={"crf": _QUALITY})
        self._video.width, self._video.height = size
        self._video.pix_fmt = "yuv420p"
        self._packets: list[av.Packet[Any]] = []
        self._number = 0

    @property
    def duration(self) -> float:
        """Of the pictures so far, s: the time of the next one."""
        return self._number / RATE

    def add(self, picture: bytes) -> None:
        """Add the next picture, a JPEG or PNG of the right size."""
        with av.open(io.BytesIO(picture), "r") as image:
            frame = next(image.decode(video=0)).reformat(format="yuv420p")
        frame.pts, frame.time_base = self._number, Fraction(1, RATE)
        self._number += 1
        self._packets += self._video.encode(frame)

    def finish(self, track: SoundTrack, end: GlobalTime) -> None:
        """Write the file.

        Args:
            track: its sound.
            end: of the session, s.
        """
        channels, pieces = track.mixed(end)
        sound = self._file.add_stream("aac", rate=SAMPLE_RATE, layout="mono" if channels == 1 else "stereo")
        self._packets += self._video.encode()
        for frame in _frames(channels, pieces):
            self._packets += sound.encode(frame)
        self._packets += sound.encode()
        # Players read both streams at once, so they are interleaved by time.
        for packet in sorted(self._packets, key=lambda each: float((each.dts or 0) * each.time_base)):
            self._file.mux(packet)
        self._file.close()


def _frames(channels: int, pieces: Iterator[np.ndarray]) -> Iterator[av.AudioFrame]:
    begin = 0
    for piece in pieces:
        planes = np.ascontiguousarray(piece.clip(-1.0, 1.0).T)
        frame = av.AudioFrame.from_ndarray(planes, format="fltp", layout="mono" if channels == 1 else "stereo")
        frame.sample_rate, frame.pts = SAMPLE_RATE, begin
        begin += len(piece)
        yield frame
