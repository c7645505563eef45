"""The end of the user's turn (thesis 6.5.2, 8.5.1, 12.2.2), from voice activity, from the words understood, or both."""

from dataclasses import replace

from anticipators.parameters import within
from anticipators.turn_model import PauseModel, Turn, TurnModel
from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.pegboard.time_peg import AnticipatorPeg

_RESUMED = 1.0
"""For so long (s) after its end the user may still go on with a turn."""


class SpeechStop(Anticipator):
    """One point, ``stop``: the end of the turn that goes on, or of the next one.

    While the user's voice sounds it is unknown. As soon as the voice is gone it is predicted, from the model of turns,
    and again with all that is understood of the words meanwhile. Once it has come, its name means the end of the next
    turn. A user who goes on takes it back, also within a second after it has come: then what hangs on it and has not
    begun waits for the end of the turn after all. After that second the turn is over for good. It assumes one user,
    whose voice is told from noise by whoever sends it.

    Where no voice was ever told, words are a turn, other words go on with it, and no words are no turn. Where it was,
    words alone neither begin a turn nor go on with it.

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
        self._old: list[AnticipatorPeg] = []  # stops of this turn that came: those who hang on them may still wait

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
        """A stop that has come makes place for the next one, and the turn does a second later."""
        if is_due(self._stop, now):
            self._came, self._stop = self._stop, None
            self._old.append(self._board.predicted(self.id, "stop"))
            self.renew("stop")
        if self._came is not None and now > self._came + _RESUMED:
            self._close()

    def event(self, name: str, value: float | None, now: GlobalTime) -> None:
        """``voice``: how probable it is that the voice sounds; from 0.5 on it does."""
        if name != "voice" or value is None:
            return
        voice = value >= 0.5
        if voice is not self._turn.voice:
            self._take(self._with_voice(voice, now), now, goes_on=voice)

    def hear(self, name: str, text: str, now: GlobalTime) -> None:
        """``words``: all words of the turn so far, as understood now; the same ones again mean nothing.

        None, where there were some, take them back, or make room for those of the next turn if this one has ended.
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
        """Know more of the turn; what is learned after its stop has come moves that only if the user goes on."""
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
        """The turn is over for good: what is heard from now on belongs to another one, be it the same words."""
        self._turn = Turn(voice=self._turn.voice)
        self._came = None
        self._old.clear()
