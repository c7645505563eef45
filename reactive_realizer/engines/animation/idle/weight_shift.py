"""From one foot to the other."""

from random import Random

from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.quaternion import Quat, from_euler
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engines.animation.easing import minimum_jerk
from reactive_realizer.engines.animation.idle.episodes import Episodes

_PAUSE = (10.0, 30.0)
"""s, shortest and longest that a figure stays as it is."""

_TAKES = 1.8
"""s, from foot to foot."""

_ASIDE = 0.030
"""m that the pelvis goes toward the foot that carries, at most."""

_DOWN = 0.006
"""m that it sinks there, beside what the legs need to reach their feet."""


class WeightShift:
    """Steps of balance: who stands for long moves his weight over, all at once, and stays there a while.

    After M. Duarte and V. M. Zatsiorsky, "Patterns of center of pressure migration during prolonged unconstrained
    standing" (Motor Control 3, 1999), of whose three patterns this is the one called shifting; how far and how often is
    our choice: theirs came every 199 s to the side, and who watches for a minute should see one. The hip of the leg
    that carries is the higher one, trunk and neck make up for the tilt, and the head stays level.
    """

    def __init__(self, random: Random) -> None:
        """Draws from a generator that nobody else draws from."""
        self._random = random
        self._episodes = Episodes(random.uniform(-0.4, 0.4), self._draw)
        self._side = random.choice((-1.0, 1.0))

    def _draw(self) -> tuple[float, float]:
        self._side = -self._side
        return self._random.uniform(*_PAUSE), self._side * self._random.uniform(0.4, 1.0)

    def at(self, time: float) -> float:
        """Which foot carries, -1 (the right) to 1 (the left)."""
        now, before = self._episodes.at(time)
        return before.what + (now.what - before.what) * minimum_jerk((time - now.since) / _TAKES)


def leaning(side: float) -> tuple[dict[str, Quat], Vec3]:
    """What pelvis, trunk and neck do, and where the pelvis goes, m; the foot that carries is -1 (right) to 1 (left)."""
    turns = {
        ROOT: from_euler(0.0, -0.04 * side, 0.050 * side),
        "vl5": from_euler(0.0, 0.03 * side, -0.075 * side),
        "vc4": from_euler(0.0, 0.01 * side, 0.025 * side),
    }
    return turns, (_ASIDE * side, -_DOWN * side * side, 0.0)
