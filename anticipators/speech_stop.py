"""Predicts the end of the user's turn (thesis 6.5.2, 8.5.1, 12.2.2), from voice activity, recognized words, or both."""

from dataclasses import replace

from anticipators.parameters import within
from anticipators.turn_model import PauseModel, Turn, TurnModel
from reactive_realizer.clock.units import Time, is_due
from reactive_realizer.pegboard.anticipator import (
    Anticipator,
    AnticipatorContext,
    AnticipatorEvent,
    Predictions,
    Revoked,
)

_RESUMED = 1.0
"""Time (s) after the end of a turn in which the user may still resume it."""


class SpeechStop(Anticipator):
    """Its point is ``stop``: the end of the current turn, or of the next one.

    It is unknown while the user speaks. When the voice stops, the turn model predicts it, and again whenever more words
    are recognized. If the user resumes the turn, at most a second after it has passed, it is revoked: behaviors that
    depend on it and have not begun wait for the end of the turn. After that second, the turn is over. It assumes one
    user, and voice activity without noise.

    If voice activity was never reported, words begin a turn, and further words resume it. Otherwise, words do neither.

    Args:
        certainty: probability from which the turn counts as ended, 0.5 to 0.999; a low one is quick, but interrupts.
        pause: mean pause within a turn, s, 0.01 to 10.
        model: a turn model to use instead of a `PauseModel` with these two parameters.

    Raises:
        RealizerError: a parameter is out of range.
    """

    kind = "speech_stop"
    events = ("voice",)
    heard = ("words",)
    points = ("stop",)

    def __init__(
        self,
        context: AnticipatorContext,
        certainty: float = 0.9,
        pause: float = 0.4,
        *,
        model: TurnModel | None = None,
    ) -> None:
        super().__init__(context)
        self._model = model or PauseModel(certainty, pause)
        self._turn = Turn()
        self._stop: Time = None

    async def predictions(self) -> Predictions:
        """The end of the turn, after each change of what is heard."""
        async for event in self.inputs:
            now = event.time
            if self._stop is not None and now > self._stop + _RESUMED:
                self._close()
            heard = self._voice(event) if event.name == "voice" else self._words(event)
            if heard is None:
                continue
            self._turn, resumes = heard
            ended = is_due(self._stop, now)
            if ended and not resumes:
                continue
            if ended:
                yield Revoked("stop")
            end = self._model.end(self._turn)
            self._stop = None if end is None else max(end, now)
            yield "stop", self._stop

    def check(self, name: str, value: float | None) -> None:
        """Check that voice activity is a probability.

        Raises:
            RealizerError: "bad-number" or "unknown-event".
        """
        super().check(name, value)
        if name == "voice":
            within(name, value, 0.0, 1.0)

    def _voice(self, event: AnticipatorEvent) -> tuple[Turn, bool] | None:
        """The turn after ``voice``, the probability that the user speaks, which counts as speech from 0.5 on.

        Returns the turn and whether it resumes one that has ended, or None if nothing has changed.
        """
        voice = (event.value or 0.0) >= 0.5
        if voice is self._turn.voice:
            return None
        if self._turn.since is not None:
            return replace(self._turn, voice=voice, since=event.time), voice
        return (Turn("", True, event.time) if voice else replace(self._turn, voice=False)), voice

    def _words(self, event: AnticipatorEvent) -> tuple[Turn, bool] | None:
        """The turn after ``words``: all words of the turn recognized so far; the same words again have no effect.

        An empty text withdraws earlier words or, if the turn has ended, prepares for the next turn.
        """
        words = (event.text or "").strip()
        if words == self._turn.words:
            return None
        if self._turn.voice is not None:
            return replace(self._turn, words=words), False
        if words or not is_due(self._stop, event.time):
            return Turn(words, since=event.time if words else None), True
        self._close()
        return None

    def _close(self) -> None:
        """Close the turn: later input belongs to the next one, even if the words are the same."""
        self._turn = Turn(voice=self._turn.voice)
        self._stop = None
