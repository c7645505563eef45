"""Predicts the end of the user's turn (thesis 6.5.2, 8.5.1, 12.2.2), from voice activity, recognized words, or both."""

from dataclasses import replace

from anticipators.parameters import within
from anticipators.turn_model import PauseModel, Turn, TurnModel
from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import AnticipatorPeg

_RESUMED = 1.0
"""Time (s) after the end of a turn in which the user may still resume it."""


class SpeechStop(Anticipator):
    """Its point is ``stop``: the end of the current turn, or of the next one.

    It is unknown while the user speaks. When the voice stops, the turn model predicts it, and again whenever more words
    are recognized. Once it has passed, its name means the end of the next turn. If the user resumes the turn, at most a
    second after it has passed, the prediction is withdrawn: behaviors that depend on it and have not begun wait for the
    end of the turn. After that second, the turn is over. It assumes one user, and voice activity without noise.

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
        id: str,  # noqa: A002
        board: PegBoard,
        certainty: float = 0.9,
        pause: float = 0.4,
        *,
        model: TurnModel | None = None,
    ) -> None:
        super().__init__(id, board)
        self._model = model or PauseModel(certainty, pause)
        self._turn = Turn()
        self._stop: Time = None
        self._came: Time = None
        self._old: list[AnticipatorPeg] = []  # passed ends of this turn, to be withdrawn if it is resumed

    def forecast(self, sync: str) -> Time:
        """The predicted end of the turn; None for other names."""
        return self._stop if sync == "stop" else None

    def check(self, name: str, value: float | None) -> None:
        """Check that voice activity is a probability.

        Raises:
            RealizerError: "bad-number" or "unknown-event".
        """
        super().check(name, value)
        if name == "voice":
            within(name, value, 0.0, 1.0)

    def advance(self, now: GlobalTime) -> None:
        """Renew the point when it has passed, and close the turn a second later."""
        if is_due(self._stop, now):
            self._came, self._stop = self._stop, None
            self._old.append(self._board.predicted(self.id, "stop"))
            self.renew("stop")
        if self._came is not None and now > self._came + _RESUMED:
            self._close()

    def event(self, name: str, value: float | None, now: GlobalTime) -> None:
        """Handle ``voice``: the probability that the user speaks, which counts as speech from 0.5 on."""
        if name != "voice" or value is None:
            return
        voice = value >= 0.5
        if voice is not self._turn.voice:
            self._take(self._with_voice(voice, now), now, goes_on=voice)

    def hear(self, name: str, text: str, now: GlobalTime) -> None:
        """Handle ``words``: all words of the turn recognized so far; the same words again have no effect.

        An empty text withdraws earlier words or, if the turn has ended, prepares for the next turn.
        """
        words = text.strip()
        if name != "words" or words == self._turn.words:
            return
        if self._turn.voice is not None:
            self._take(replace(self._turn, words=words), now, goes_on=False)
        elif words or self._came is None:
            self._take(Turn(words, since=now if words else None), now, goes_on=True)
        else:
            self._close()

    def _with_voice(self, voice: bool, now: GlobalTime) -> Turn:
        if self._turn.since is not None:
            return replace(self._turn, voice=voice, since=now)
        return Turn("", True, now) if voice else replace(self._turn, voice=False)

    def _take(self, turn: Turn, now: GlobalTime, *, goes_on: bool) -> None:
        """Update the turn; after its end has passed, that is moved only if the user resumes it."""
        self._turn = turn
        if self._came is not None and not goes_on:
            return
        end = self._model.end(turn)
        self._stop = None if end is None else max(end, now)
        self._came = None
        self.predict("stop", self._stop, now)
        for peg in self._old:
            peg.set(self._stop)

    def _close(self) -> None:
        """Close the turn: later input belongs to the next one, even if the words are the same."""
        self._turn = Turn(voice=self._turn.voice)
        self._came = None
        self._old.clear()
