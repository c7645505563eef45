"""Predicts the places at which a listener may respond to a user who speaks (thesis 5.1.4, 10.3.7), from pitch."""

from anticipators.parameters import within
from reactive_realizer.clock.units import GlobalTime, Time, is_due
from reactive_realizer.pegboard.anticipator import Anticipator, AnticipatorContext, Predictions

_HIGHEST = 1000
"""Highest pitch, Hz."""

_GAP = 0.3
"""Longest time without pitch within speech, s: voiceless sounds and short pauses."""


class Backchannel(Anticipator):
    """Its point is ``backchannel``: the next place for a nod or an "uh-huh".

    The rule for English of N. Ward, W. Tsukahara, Prosodic features which cue back-channel responses in English and
    Japanese, Journal of Pragmatics 32, 2000: a region of pitch below the 26th percentile of this user's pitch that has
    lasted for 110 ms, and that comes after at least 700 ms of speech, asks for a response 700 ms later, if there was
    none in the last 800 ms. So each place is known 0.7 s ahead. It assumes one user, pitch without outliers, about a
    hundred values per second, and a response at each place.

    Args:
        level: the percentile below which pitch is low, as a share.
        low: duration of the low pitch, s.
        speech: duration of the speech before it, s.
        apart: least time between a place and the next cue, s.
        wait: time from the cue to the place, s.

    Raises:
        RealizerError: a parameter is out of range.
    """

    kind = "backchannel"
    events = ("pitch", "start")
    points = ("backchannel",)

    def __init__(
        self,
        context: AnticipatorContext,
        level: float = 0.26,
        low: float = 0.11,
        speech: float = 0.7,
        apart: float = 0.8,
        wait: float = 0.7,
    ) -> None:
        super().__init__(context)
        self._level = within("level", level, 0.01, 1.0)
        self._low = within("low", low, 0.0, 10.0)
        self._speech = within("speech", speech, 0.0, 60.0)
        self._apart = within("apart", apart, 0.0, 60.0)
        self._wait = within("wait", wait, 0.0, 10.0)
        self._user = _User()
        self._place: Time = None

    async def predictions(self) -> Predictions:
        """The next place, after each cue; ``start`` is the beginning of another user."""
        async for event in self.inputs:
            if event.name == "start":
                self._user, self._place = _User(), None
                yield "backchannel", None
            elif self._cue(event.value or 0.0, event.time):
                self._place = GlobalTime(event.time + self._wait)
                yield "backchannel", self._place

    def check(self, name: str, value: float | None) -> None:
        """Check that pitch is 0 (none) to 1000 Hz.

        Raises:
            RealizerError: "bad-number" or "unknown-event".
        """
        super().check(name, value)
        if name == "pitch":
            within(name, value, 0.0, _HIGHEST)

    def _cue(self, pitch: float, now: GlobalTime) -> bool:
        """Take a value of pitch, Hz, 0 if there is none; whether it completes a cue."""
        self._user.take(pitch, now, self._level)
        speech, low = self._user.speech_since, self._user.low_since
        if speech is None or low is None:
            return False
        free = self._place is None or is_due(self._place + self._apart, now)
        return free and is_due(low + self._low, now) and is_due(speech + self._speech, low)


class _User:
    """The pitch of a user so far.

    Attributes:
        speech_since: when the present speech began; None before the first.
        low_since: since when the pitch has been low; None while it is not.
    """

    def __init__(self) -> None:
        self.speech_since: Time = None
        self.low_since: Time = None
        self._voiced: Time = None
        self._heard = [0] * (_HIGHEST + 1)
        """The number of times that each pitch was heard, by Hz."""

    def take(self, pitch: float, now: GlobalTime, level: float) -> None:
        """Take a value, Hz, 0 if there is no pitch; it is low if at most a share ``level`` of all is not higher."""
        if pitch == 0.0:
            self.low_since = None
            return
        if self._voiced is None or now > self._voiced + _GAP:
            self.speech_since = now
        self._voiced = now
        self._heard[int(pitch)] += 1
        if sum(self._heard[: int(pitch) + 1]) >= level * sum(self._heard):
            self.low_since = None
        elif self.low_since is None:
            self.low_since = now
