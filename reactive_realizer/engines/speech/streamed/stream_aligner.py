"""Finds the words and sounds of a text in speech while it arrives, in a worker process (pocketsphinx, an extra).

Words are found when about half a second more has been heard, and then corrected. Their times deviate by some 30 ms from
those of synthesized voices, like those of recordings.
"""

from collections.abc import Awaitable, Sequence
from importlib.util import find_spec
from typing import Any

from reactive_realizer.engine.tts import Phoneme
from reactive_realizer.engines.speech.recorded.aligner import LAG, CannotAlign, NoAligner
from reactive_realizer.engines.speech.recorded.phones import CMU, spelled
from reactive_realizer.engines.speech.recorded.speech_times import phoneme
from reactive_realizer.engines.speech.worker_process import WorkerProcess
from reactive_realizer.errors import RealizerError

_WORKER = "reactive_realizer.engines.speech.streamed.align_worker"
_PATIENCE = 30.0
"""Time limit for one answer, s: an answer takes 0.2 s per second of speech, and loading the models 2 s."""
_GAP = 0.015
"""Duration above which there is silence between two sounds, s."""


class StreamAligner:
    """Finds the words of one text.

    Attributes:
        begins: of the words that have begun, s from the start of the speech.
        phonemes: of the words that are settled, with the silences before and between them.
    """

    def __init__(self, process: WorkerProcess, begun: Awaitable[object], stream: str) -> None:
        self.begins: tuple[float, ...] = ()
        self.phonemes: list[Phoneme] = []
        self._process = process
        self._begun = begun
        self._stream = stream

    @classmethod
    async def start(cls, words: Sequence[str], rate: int, stream: str) -> "StreamAligner":
        """Starts a worker, without waiting until it is ready.

        Args:
            words: of the text, without punctuation.
            rate: of the samples, Hz.
            stream: its name, for messages.

        Raises:
            RealizerError: "no-aligner" or "words-estimated".
        """
        if find_spec("pocketsphinx") is None:
            raise RealizerError(NoAligner())
        plain = [word.casefold().replace("\u2019", "'") for word in words]
        if not all(map(spelled, plain)):
            raise RealizerError(_estimated(stream, "the text has words in another script"))
        process = await WorkerProcess.start(_WORKER, _PATIENCE)
        return cls(process, process.request({"words": plain, "rate": rate}), stream)

    @property
    def settled(self) -> float:
        """Until when the sounds are known, s."""
        return self.phonemes[-1].start + self.phonemes[-1].duration if self.phonemes else 0.0

    async def hear(self, samples: bytes, *, last: bool) -> None:
        """Find words in what has arrived.

        Raises:
            RealizerError: "words-estimated".
        """
        await self._begun
        reply = await self._process.request({"last": last}, body=samples)
        if "failed" in reply.header:
            raise RealizerError(_estimated(self._stream, "the search for them failed"))
        found: dict[str, Any] = reply.header
        self.begins = tuple(begin + LAG for begin, _ in found["words"])
        for name, begin, end in found["phones"]:
            start = max(begin + LAG, self.settled)
            if start > self.settled + _GAP:
                self.phonemes.append(Phoneme("", self.settled, start - self.settled))
            self.phonemes.append(phoneme(CMU[name], start, max(end + LAG, start)))

    async def close(self) -> None:
        """Ends the worker."""
        await self._process.close()


def _estimated(stream: str, reason: str) -> CannotAlign:
    return CannotAlign(file=f"the stream '{stream}'", reason=reason)
