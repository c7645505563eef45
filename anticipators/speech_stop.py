"""The end of the user's turn (thesis 6.5.2, 8.5.1, 12.2.2), from voice activity, from the words understood, or both."""

from dataclasses import replace

from anticipators.parameters import within
from anticipators.turn_model import PauseModel, Turn, TurnModel
from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.pegboard.pegboard import PegBoard

_RESUMED = 1.0
"""For so long (s) after its end the user may still go on with a turn."""


class SpeechStop(Anticipator):
    """One point, ``stop``: the end of the turn that goes on, or of the next one.

    While the user's voice sounds it is unknown. As soon as the voice is gone it is predicted, from the model of turns,
    and again with all that is understood of the words meanwhile. A user who goes on takes the prediction back, even
    within a second after it has come: then what has not begun waits. After that the next turn is meant. It assumes one
    user, whose voice is told from noise by whoever sends it.

    Args:
        certainty: of the model with which the end is said to be one, 0.5 to 0.999: less is quicker, and interrupts.
        pause: mean pause within a turn, s, 0.01 to 10.
        model: another model of turns than a `PauseModel` of these two.

    Raises:
        RealizerError: a parameter out of its range.
    """

    kind = "speech_stop"
    events = ("voice",)
    heard = ("words",)

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

    def forecast(self, sync: str) -> Time:
        """The end of the turn, as predicted last; other names are never known."""
        return self._stop if sync == "stop" else None

    def check(self, name: str, value: float | None) -> None:
        """Voice activity is a probability.

        Raises:
            RealizerError: it is not, or "unknown-event".
        """
        super().check(name, value)
        if name == "voice":
            within(name, value, 0.0, 1.0)

    def advance(self, now: GlobalTime) -> None:
        """A turn that has ended for good makes place for the next one."""
        if self._stop is not None and now > self._stop + _RESUMED:
            self._turn = replace(self._turn, since=None)
            self._stop = None
            self.renew("stop")

    def event(self, name: str, value: float | None, now: GlobalTime) -> None:
        """``voice``: how probable it is that the voice sounds; from 0.5 on it does."""
        if name != "voice" or value is None:
            return
        voice = value >= 0.5
        if voice is not self._turn.voice:
            self._take(self._with_voice(voice, now), now)

    def hear(self, name: str, text: str, now: GlobalTime) -> None:
        """``words``: all words of the turn so far, as understood now; the same ones again mean nothing."""
        words = text.strip()
        if name != "words" or words == self._turn.words:
            return
        since = now if self._turn.voice is None else self._turn.since
        self._take(replace(self._turn, words=words, since=since), now)

    def _with_voice(self, voice: bool, now: GlobalTime) -> Turn:
        if self._turn.since is not None:
            return replace(self._turn, voice=voice, since=now)
        return Turn("", True, now) if voice else replace(self._turn, voice=False)

    def _take(self, turn: Turn, now: GlobalTime) -> None:
        end = self._model.end(turn)
        stop = None if end is None else max(end, now)
        self.predict("stop", stop, now)
        self._turn, self._stop = turn, stop
