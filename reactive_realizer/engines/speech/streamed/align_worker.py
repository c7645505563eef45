"""The worker that finds the words of a text in speech while it arrives, for one speech.

The first request has the ``words`` of the text and the ``rate`` of the samples (Hz). Each other one has samples in its
body, mono and int16, and is ``last`` or not. Its reply has the ``words`` that have begun, as (start, end), of which the
first ones are ``settled``: they end before the last one that is recognized. It has the ``phones`` of the words that
were settled since the previous reply, as (name, start, end). Times are in seconds from the start of the speech.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import soxr

from reactive_realizer.engines.speech.recorded.align_program import align_with, new_decoder
from reactive_realizer.engines.speech.worker_messages import WorkerMessage, WorkerPipe

_RATE = 16_000
_FRAME = _RATE // 100
"""Samples of a frame of the decoder."""
_MARGIN = 10
"""Frames around a phrase in which its sounds are looked for."""
_PAUSE = 20
"""Frames of silence after which a word is settled."""


class _Segment(NamedTuple):
    """A word or a silence, with its first frame and the one after its last."""

    word: str
    first: int
    last: int


class SpeechAligner:
    """Finds the words of a text in speech that arrives.

    Args:
        words: of the text, in lower case and without punctuation.
        rate: of the samples, Hz.
    """

    def __init__(self, words: Sequence[str], rate: int) -> None:
        self._words = words
        self._resampling = soxr.ResampleStream(rate, _RATE, 1, dtype="int16")
        self._decoder = new_decoder(words)
        self._decoder.set_align_text(" ".join(words))
        self._decoder.start_utt()
        # The sounds of a phrase are found by another search, which needs a decoder of its own.
        self._sounds = new_decoder(words)
        self._heard = np.zeros(0, np.int16)
        self._settled: list[_Segment] = []

    def hear(self, samples: bytes, *, last: bool) -> WorkerMessage:
        """The reply to further samples."""
        heard = self._resampling.resample_chunk(np.frombuffer(samples, "<i2"), last=last)
        self._heard = np.concatenate([self._heard, heard])
        self._decoder.process_raw(heard.tobytes())
        if last:
            self._decoder.end_utt()
        segments = [_Segment(each.word, each.start_frame, each.end_frame + 1) for each in self._decoder.seg() or ()]
        spoken = [each for each in segments if each.word[0] not in "<["]  # silence and noise
        before = len(self._settled)
        settled = len(spoken) if last or _ends_in_pause(segments) else len(spoken) - 1
        self._settled += spoken[before:settled]
        begun = [*self._settled, *spoken[len(self._settled) :]]
        phones = self._phones(before, begun)
        words = [(each.first / 100, each.last / 100) for each in begun]
        return WorkerMessage({"words": words, "settled": len(self._settled), "phones": phones})

    def _phones(self, before: int, begun: Sequence[_Segment]) -> list[tuple[str, float, float]]:
        """The sounds of the words that were settled after some."""
        new = self._settled[before:]
        if not new:
            return []
        first = max(new[0].first - _MARGIN, self._settled[before - 1].last if before else 0)
        following = begun[len(self._settled) : len(self._settled) + 1]
        last = min(new[-1].last + _MARGIN, following[0].first if following else new[-1].last + _MARGIN)
        words = self._words[before : len(self._settled)]
        try:
            found = align_with(self._sounds, words, self._heard[first * _FRAME : last * _FRAME].tobytes())
        except (ValueError, RuntimeError):
            return [phone for word, segment in zip(words, new, strict=True) for phone in self._spread(word, segment)]
        return [
            (name, (first + begin) / 100, (first + begin + frames) / 100)
            for phones in found
            for name, begin, frames in phones
        ]

    def _spread(self, word: str, segment: _Segment) -> list[tuple[str, float, float]]:
        """The sounds of a word, all of the same duration."""
        names = (self._sounds.lookup_word(word) or "").split()
        each = (segment.last - segment.first) / 100 / max(len(names), 1)
        begins = [segment.first / 100 + number * each for number in range(len(names))]
        return [(name, begin, begin + each) for name, begin in zip(names, begins, strict=True)]


def _ends_in_pause(segments: Sequence[_Segment]) -> bool:
    return bool(segments) and segments[-1].word[0] in "<[" and segments[-1].last - segments[-1].first >= _PAUSE


def _main() -> None:
    pipe = WorkerPipe()
    pipe.send(WorkerMessage({}).encode())
    aligner: SpeechAligner | None = None
    for request in pipe.requests():
        if aligner is None:
            aligner = SpeechAligner(request.header["words"], request.header["rate"])
            pipe.send(WorkerMessage({}).encode())
        else:
            pipe.send(aligner.hear(request.body, last=request.header["last"]).encode())


if __name__ == "__main__":
    _main()
