"""A key (thesis 8.5.1): nothing is predicted, a behavior follows at once when it is pressed or released.

With it an experimenter who listens can stand in for what no program detects yet (thesis 10.4).
"""

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.anticipator import Anticipator

_POINTS = ("press", "release")


class Spacebar(Anticipator):
    """Points ``press`` and ``release``: each the next time this happens.

    What hangs on such a point when the key moves happens at the coming tick, or as long after it as it says. What is
    hung on it from then on waits for the next time. It assumes that whoever reports a key leaves out its auto-repeat.
    """

    kind = "spacebar"
    events = _POINTS
    points = _POINTS

    def event(self, name: str, value: float | None, now: GlobalTime) -> None:
        """``press`` and ``release``."""
        if name in _POINTS:
            self.predict(name, now, now)
            self.renew(name)
