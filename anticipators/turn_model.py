"""Turn models: they predict the end of a user's turn from the voice and the words so far."""

import re
from dataclasses import dataclass
from math import log
from typing import Protocol

from anticipators.parameters import within
from reactive_realizer.clock.units import GlobalTime, Time


@dataclass(frozen=True, slots=True)
class Turn:
    """The input of a turn so far.

    Attributes:
        words: the recognized words.
        voice: whether the user speaks; None if voice activity is not reported.
        since: time of the last change of ``voice``, or of ``words`` if voice activity is not reported; None before the
            turn.
    """

    words: str = ""
    voice: bool | None = None
    since: Time = None


class TurnModel(Protocol):
    """A model of the ends of turns, for `anticipators.speech_stop.SpeechStop`."""

    def end(self, turn: Turn) -> Time:
        """The end of a turn, if there is no further input; None while it is unknown."""


_FINISHED = re.compile(r"[.!?][\"')\]]*$")
_OPEN = re.compile(
    r"(?:[,;:\u2026-]|\b(?:a|an|the|my|your|his|her|our|their|this|these|and|or|but|because|if|while|to|of|from|with"
    r"|into|um|uh|er|erm))$",
    re.IGNORECASE,
)
_AFTER_FINISHED, _AFTER_OPEN, _AFTER_OTHER = 0.85, 0.1, 0.5


class PauseModel:
    """Ends a turn when a pause is too long to be one within the turn.

    It assumes that pauses within a turn are distributed exponentially with mean ``pause``, and that the words before a
    silence are the last ones with a probability p: 0.85 after punctuation that ends a sentence, 0.1 after a comma or an
    English word that another one follows (*the*, *and*, *um*), and 0.5 otherwise. By Bayes' theorem, the turn has ended
    after ``t`` seconds of silence with probability ``p / (p + (1 - p) exp(-t / pause))``; the predicted end is where
    this reaches ``certainty``. With voice activity alone, that is after 0.88 s, which is in the range of dialog systems
    (0.5 to 1 s, thesis 12.2.2). On endpointing by pause and syntax, see L. Ferrer, E. Shriberg, A. Stolcke, Is the
    speaker done yet?, ICSLP 2002; A. Raux, M. Eskenazi, Optimizing endpointing thresholds, SIGdial 2008.

    Args:
        certainty: probability from which the turn counts as ended, 0.5 to 0.999.
        pause: mean pause within a turn, s, 0.01 to 10.

    Raises:
        RealizerError: a parameter is out of range.
    """

    def __init__(self, certainty: float, pause: float) -> None:
        self._odds = _odds(within("certainty", certainty, 0.5, 0.999))
        self._pause = within("pause", pause, 0.01, 10.0)

    def end(self, turn: Turn) -> Time:
        """The end of the silence that is needed for certainty; None while the user speaks."""
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
