"""Finds sounds in speech while it arrives, and the words of its text, in a worker process (pocketsphinx, an extra).

Sounds are found when 0.2 s more has been heard. Words are found when about half a second more has been heard, and then
corrected. Their times deviate by some 30 ms from those of synthesized voices, like those of recordings.
"""

import asyncio
from collections.abc import Sequence
from dataclasses import replace
from importlib.util import find_spec
from typing import Any

from reactive_realizer.engine.tts import Phoneme
from reactive_realizer.engines.speech.recorded.aligner import LAG, CannotAlign, NoAligner
from reactive_realizer.engines.speech.recorded.phones import CMU, spelled
from reactive_realizer.engines.speech.recorded.speech_times import phoneme
from reactive_realizer.engines.speech.worker_messages import WorkerMessage
from reactive_realizer.engines.speech.worker_process import WorkerProcess
from reactive_realizer.errors import RealizerError

_WORKER = "reactive_realizer.engines.speech.streamed.align_worker"
_PATIENCE = 30.0
"""Time limit for one answer, s: an answer takes 0.2 s per second of speech, and loading the models 2 s."""
_GAP = 0.015
"""Duration above which there is silence between two sounds, s."""
_SOON = 0.2
"""How long the lips of a speech without words wait for an answer, s; a later one counts when it comes."""


class StreamAligner:
    """Finds the sounds of one speech, and the words of its text.

    Attributes:
        begins: of the words that have begun, s from the start of the speech.
        with_words: whether it looks for words.
    """

    def __init__(
        self, process: WorkerProcess, begun: asyncio.Future[WorkerMessage], stream: str, *, with_words: bool
    ) -> None:
        self.begins: tuple[float, ...] = ()
        self.with_words = with_words
        self._of_words: list[Phoneme] = []
        self._heard: list[Phoneme] = []
        self._process = process
        self._stream = stream
        self._answers = [begun]

    @classmethod
    async def start(cls, words: Sequence[str], rate: int, stream: str) -> "StreamAligner":
        """Starts a worker, without waiting until it is ready.

        Args:
            words: of the text, without punctuation; none if only sounds are looked for.
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
        begun = process.request({"words": plain, "rate": rate})
        return cls(process, begun, stream, with_words=bool(plain))

    @property
    def phonemes(self) -> list[Phoneme]:
        """The sounds of the words that are settled, then those that are heard, with the silences between them."""
        settled = _end(self._of_words)
        following = [each for each in self._heard if _end([each]) > settled + _GAP]
        if following and following[0].start < settled:
            following[0] = replace(following[0], start=settled, duration=_end(following[:1]) - settled)
        return [*self._of_words, *following]

    @property
    def behind(self) -> bool:
        """Whether an answer is still to come."""
        return bool(self._answers)

    async def hear(self, samples: bytes, *, last: bool) -> None:
        """Find words and sounds in what has arrived. Without words, this waits no longer than lips may be late.

        Raises:
            RealizerError: "words-estimated": the search failed.
        """
        self._answers.append(self._process.request({"last": last}, body=samples))
        await self._take_answers(None if self.with_words else _SOON)

    async def catch_up(self) -> None:
        """Wait for the answers that are still to come.

        Raises:
            RealizerError: as `hear`.
        """
        await self._take_answers(None)

    async def close(self) -> None:
        """Ends the worker."""
        await self._process.close()

    async def _take_answers(self, patience: float | None) -> None:
        if self._answers:
            await asyncio.wait(self._answers, timeout=patience)
        while self._answers and self._answers[0].done():
            found: dict[str, Any] = self._answers.pop(0).result().header
            if "failed" in found:
                raise RealizerError(_estimated(self._stream, "the search for them failed"))
            if found:
                self._take(found)

    def _take(self, found: dict[str, Any]) -> None:
        self.begins = tuple(begin + LAG for begin, _ in found["words"])
        for name, begin, end in found["phones"]:
            settled = _end(self._of_words)
            start = max(begin + LAG, settled)
            if start > settled + _GAP:
                self._of_words.append(Phoneme("", settled, start - settled))
            self._of_words.append(phoneme(CMU[name], start, max(end + LAG, start)))
        if found["sounds"]:
            since = found["sounds"][0][1]
            self._heard = [each for each in self._heard if each.start < since]
            # What is no sound of speech, such as a breath, is silence.
            self._heard += [phoneme(CMU.get(name, ""), begin, end) for name, begin, end in found["sounds"]]


def _end(phonemes: Sequence[Phoneme]) -> float:
    return phonemes[-1].start + phonemes[-1].duration if phonemes else 0.0


def _estimated(stream: str, reason: str) -> CannotAlign:
    return CannotAlign(file=f"the stream '{stream}'", reason=reason)
