"""Whether somebody has finished speaking, from what was heard so far."""

import re
from dataclasses import dataclass
from math import log
from typing import Protocol

from anticipators.parameters import within
from reactive_realizer.clock.units import GlobalTime, Time


@dataclass(frozen=True, slots=True)
class Turn:
    """What was heard of a turn.

    Attributes:
        words: as far as they were understood.
        voice: whether the voice sounds; None where only words are told.
        since: since when it does or does not; where only words are told, since when they are these; None before the
            turn.
    """

    words: str = ""
    voice: bool | None = None
    since: Time = None


class TurnModel(Protocol):
    """A model of when turns end; `anticipators.speech_stop.SpeechStop` takes any."""

    def end(self, turn: Turn) -> Time:
        """When a turn ends if nothing more is heard; None while that cannot be said."""


_FINISHED = re.compile(r"[.!?][\"')\]]*$")
_OPEN = re.compile(
    r"(?:[,;:\u2026-]|\b(?:a|an|the|my|your|his|her|our|their|this|these|and|or|but|because|if|while|to|of|from|with"
    r"|into|um|uh|er|erm))$",
    re.IGNORECASE,
)
_AFTER_FINISHED, _AFTER_OPEN, _AFTER_OTHER = 0.85, 0.1, 0.5


class PauseModel:
    """A turn has ended when a pause has become too long to be one within the turn.

    Pauses within a turn are taken to last ``pause`` on average and to be distributed exponentially, and the words
    before a silence to be the last ones with a probability p: 0.85 after a mark that ends a sentence, 0.1 after a comma
    or an English word that wants another (*the*, *and*, *um*), else 0.5. By Bayes the turn has then ended, after ``t``
    seconds of silence, with probability ``p / (p + (1 - p) exp(-t / pause))``, which grows with ``t``; the end is where
    it reaches ``certainty``. With nothing but a voice that is 0.88 s, among the pauses that dialog systems wait for
    (0.5 to 1 s, thesis 12.2.2); as in the endpointers that weigh pause and syntax (L. Ferrer, E. Shriberg, A. Stolcke,
    Is the speaker done yet?, ICSLP 2002; A. Raux, M. Eskenazi, Optimizing endpointing thresholds, SIGdial 2008).

    Args:
        certainty: with which the end is said to be one, 0.5 to 0.999.
        pause: mean pause within a turn, s, 0.01 to 10.

    Raises:
        RealizerError: one of them is out of its range.
    """

    def __init__(self, certainty: float, pause: float) -> None:
        self._odds = _odds(within("certainty", certainty, 0.5, 0.999))
        self._pause = within("pause", pause, 0.01, 10.0)

    def end(self, turn: Turn) -> Time:
        """While the voice sounds, unknown; else as long after it as it takes to be certain."""
        if turn.voice or turn.since is None:
            return None
        silence = self._pause * log(self._odds / _odds(_finished(turn.words)))
        return GlobalTime(turn.since + max(0.0, silence))


def _finished(words: str) -> float:
    """The probability that these are the last words."""
    if _FINISHED.search(words):
        return _AFTER_FINISHED
    return _AFTER_OPEN if _OPEN.search(words) else _AFTER_OTHER


def _odds(probability: float) -> float:
    return probability / (1 - probability)
