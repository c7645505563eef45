"""Lids that close now and then."""

from random import Random

from reactive_realizer.engines.animation.easing import share, smoothstep
from reactive_realizer.engines.animation.idle.episodes import Episodes

_BLINK = 0.2
"""s, from open to open."""

_PAUSE = (2.0, 6.0)
"""s, shortest and longest from one blink to the next."""

_CLOSING = 0.41
"""Lids close in this share of a blink and open in the rest: closing is faster by 40 to 47 %.

C. Sforza and others, "Spontaneous blinking in healthy persons: an optoelectronic study of eyelid motion" (Ophthalmic
and Physiological Optics 28, 2008).
"""


class Blinks:
    """A blink every four seconds on average, and with a large turn of gaze.

    Who rests and looks at nothing near blinks 8 to 21 times a minute: M. J. Doughty, "Consideration of three types of
    spontaneous eyeblink activity in normal humans" (Optometry and Vision Science 78, 2001).
    """

    def __init__(self, random: Random) -> None:
        """Draws from a generator that nobody else draws from."""
        self._episodes = Episodes(None, lambda: (random.uniform(*_PAUSE), None))
        self._asked = -_BLINK

    def ask(self, time: float) -> None:
        """Blink now, too: people do when they turn to something far aside.

        C. Evinger et al., "Not looking while leaping: the linkage of blinking and saccadic gaze shifts" (Experimental
        Brain Research 100, 1994).
        """
        if time - self._asked >= _BLINK:
            self._asked = time

    def closed(self, time: float) -> float:
        """How far the lids are closed, 0 to 1."""
        now, _ = self._episodes.at(time)
        # Life begins with open eyes, not with a blink.
        own = _shut(time - now.since) if now.since > 0.0 else 0.0
        return max(own, _shut(time - self._asked))


def _shut(passed: float) -> float:
    done = passed / _BLINK
    if not 0.0 < done < 1.0:
        return 0.0
    part = share(done, 0.0, _CLOSING) if done < _CLOSING else share(1.0 - done, 0.0, 1.0 - _CLOSING)
    return smoothstep(part)
