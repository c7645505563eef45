"""The worker that finds the sounds of speech while it arrives, and the words of its text, for one speech.

The first request has the ``words`` of the text, if it is known, and the ``rate`` of the samples (Hz). Each other one
has samples in its body, mono and int16, and is ``last`` or not. Its reply has the ``words`` that have begun, as (start,
end), of which the first ones are ``settled``: they end before the last one that is recognized. It has the ``phones`` of
the words that were settled since the previous reply, as (name, start, end), and the ``sounds`` that `PhoneLoop` hears.
Times are in seconds from the start of the speech.
"""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import soxr
from numpy.typing import NDArray

from reactive_realizer.engines.speech.recorded.align_program import align_with, new_decoder
from reactive_realizer.engines.speech.streamed.phone_loop import PhoneLoop
from reactive_realizer.engines.speech.worker_messages import WorkerMessage, WorkerPipe

_RATE = 16_000
_FRAME = _RATE // 100
"""Samples of a frame of the decoder."""
_MARGIN = 10
"""Frames around a phrase in which its sounds are looked for."""
_PAUSE = 20
"""Frames of silence after which a word is settled."""
_NO_WORDS: Mapping[str, Any] = {"words": (), "settled": 0, "phones": ()}


class _Segment(NamedTuple):
    """A word or a silence, with its first frame and the one after its last."""

    word: str
    first: int
    last: int


class SpeechAligner:
    """Finds the words of a text in speech that arrives.

    Args:
        words: of the text, in lower case and without punctuation.
    """

    def __init__(self, words: Sequence[str]) -> None:
        self._words = words
        self._decoder = new_decoder(words)
        self._decoder.set_align_text(" ".join(words))
        self._decoder.start_utt()
        # The sounds of a phrase are found by another search, which needs a decoder of its own.
        self._sounds = new_decoder(words)
        self._heard = np.zeros(0, np.int16)
        self._settled: list[_Segment] = []

    def hear(self, heard: NDArray[np.int16], *, last: bool) -> dict[str, Any]:
        """What is found in further samples, (N,) at 16 kHz, for the reply."""
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
        return {"words": words, "settled": len(self._settled), "phones": phones}

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


class _Listener:
    """Finds the sounds of a speech, and the words of its text, if it has any."""

    def __init__(self, words: Sequence[str], rate: int) -> None:
        self._resampling = soxr.ResampleStream(rate, _RATE, 1, dtype="int16")
        self._sounds = PhoneLoop()
        self._words = SpeechAligner(words) if words else None

    def hear(self, samples: bytes, *, last: bool) -> WorkerMessage:
        """The reply to further samples."""
        heard = self._resampling.resample_chunk(np.frombuffer(samples, "<i2"), last=last)
        found = _NO_WORDS if self._words is None else self._words.hear(heard, last=last)
        return WorkerMessage({**found, "sounds": self._sounds.hear(heard.tobytes(), last=last)})


def _ends_in_pause(segments: Sequence[_Segment]) -> bool:
    return bool(segments) and segments[-1].word[0] in "<[" and segments[-1].last - segments[-1].first >= _PAUSE


def _main() -> None:
    pipe = WorkerPipe()
    pipe.send(WorkerMessage({}).encode())
    listener: _Listener | None = None
    for request in pipe.requests():
        if listener is None:
            listener = _Listener(request.header["words"], request.header["rate"])
            pipe.send(WorkerMessage({}).encode())
        else:
            pipe.send(listener.hear(request.body, last=request.header["last"]).encode())


if __name__ == "__main__":
    _main()
