"""A fake voice that speaks a clause at a time, when a test lets it."""

import asyncio
from collections.abc import AsyncIterator
from dataclasses import replace
from itertools import accumulate, pairwise

from reactive_realizer.engine.tts import Utterance, Word
from reactive_realizer.engines.speech.text_voice import TextVoice

SLOWER = 1.5
"""How much longer than estimated all clauses but the first take."""
_RATE = 8000


_estimated = TextVoice().synthesize
"""The synthesis of the text voice, which a test may replace."""


class FakeStreamingVoice:
    """Estimates times as the text voice does, and makes silence of the right duration, clause by clause.

    Attributes:
        asked: the texts that were requested.
        canceled: those that were canceled.
        fails_at: index of the clause that cannot be made.
    """

    def __init__(self) -> None:
        self.asked: list[str] = []
        self.canceled: list[str] = []
        self.fails_at: int | None = None
        self._most: int | None = None
        self._let = asyncio.Event()

    def hold(self, clauses: int = 1) -> None:
        """Make no more than some clauses of each text, until `let`."""
        self._most = clauses

    def let(self, clauses: int | None = None) -> None:
        """Make some clauses in all, by default all of them."""
        self._most = clauses
        self._let.set()
        self._let = asyncio.Event()

    async def synthesize(
        self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None
    ) -> AsyncIterator[Utterance]:
        """Speaks a text; see `TTSBinding.synthesize`."""
        self.asked.append(text)
        try:
            for made, part in enumerate(_parts(_estimated(text, marks), marks)):
                while self._most is not None and made >= self._most:
                    await self._let.wait()
                if made == self.fails_at:
                    raise OSError("it lost its voice")
                yield part
        except asyncio.CancelledError:
            self.canceled.append(text)
            raise


def _parts(estimate: Utterance, marks: tuple[tuple[str, int], ...]) -> list[Utterance]:
    firsts = [0, *(k for k, (one, other) in enumerate(pairwise(estimate.words), 1) if _pause(estimate, one, other))]
    begins = [*(estimate.words[first].start for first in firsts), estimate.duration]
    durations = [(end - begin) * (1.0 if k == 0 else SLOWER) for k, (begin, end) in enumerate(pairwise(begins))]
    ends = [*accumulate(durations)]
    return [_part(estimate, marks, begins, ends, k) for k in range(len(ends))]


def _part(
    estimate: Utterance, marks: tuple[tuple[str, int], ...], begins: list[float], ends: list[float], last: int
) -> Utterance:
    """The utterance of which the clauses up to the last one are made."""

    def time(estimated: float) -> float:
        clause = next(k for k, end in enumerate(begins[1:]) if estimated < end or k == len(ends) - 1)
        if clause > last:
            return ends[last] + estimated - begins[last + 1]
        begin = 0.0 if clause == 0 else ends[clause - 1]
        return begin + (estimated - begins[clause]) * (1.0 if clause == 0 else SLOWER)

    words = tuple(replace(word, start=time(word.start)) for word in estimate.words)
    audio = bytes(2 * round(ends[last] * _RATE))
    spoken = Utterance(estimate.text, time(estimate.duration), words, {}, (), audio, _RATE, ends[last])
    return replace(spoken, marks={name: spoken.time_of_character(index) for name, index in marks})


def _pause(estimate: Utterance, one: Word, other: Word) -> bool:
    return any(mark in estimate.text[one.last : other.first] for mark in ",;.")
