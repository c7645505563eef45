"""The plan units of pictures: sequences that come and go, and a background that stays."""

from collections.abc import Callable

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.picture import Picture
from reactive_realizer.engines.picture.picture_animation import PictureAnimation
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.phase_clock import PhaseClock
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import Phase, PhaseKind, Timing, timing_at


class PictureUnit(PlanUnit):
    """Shows a sequence of pictures on a layer from its start to its end."""

    def __init__(self, block: BlockKey, behavior: Behavior, animation: PictureAnimation, layer: float) -> None:
        super().__init__(block, behavior, timing_at(animation.points))
        self.planning_work += len(animation.files) // 2  # each one may be looked for
        self._animation = animation
        self._layer = layer
        self._clock = PhaseClock(animation.phases)

    def shown(self, now: GlobalTime) -> Picture:
        """Return the picture of now."""
        return Picture(self._layer, self._animation.file(self._clock.advance(self, now)))


class BackgroundUnit(PlanUnit):
    """Replaces the background at once.

    Args:
        file: name of the picture among the assets.
        started: is given that name when the unit starts.
    """

    def __init__(self, block: BlockKey, behavior: Behavior, file: str, started: Callable[[str], None]) -> None:
        super().__init__(block, behavior, Timing(("start", "end"), (Phase(0.0, PhaseKind.RIGID),), instant=True))
        self._file = file
        self._started = started

    def on_start(self, time: GlobalTime) -> None:
        """Show the picture from now on."""
        self._started(self._file)
