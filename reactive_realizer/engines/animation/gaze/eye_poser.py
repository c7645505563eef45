"""Poses the eyes and their lids for all gazes of a figure."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import reduce
from operator import itemgetter

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.humanoid import EyePose, Eyes, Humanoid
from reactive_realizer.embodiment.joints import EYES
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, multiply
from reactive_realizer.embodiment.world import World
from reactive_realizer.engine.player import height
from reactive_realizer.engines.animation.animation_unit import AnimationUnit
from reactive_realizer.engines.animation.failure_isolation import FailureIsolation
from reactive_realizer.engines.animation.gaze.eye_controller import EyeController
from reactive_realizer.engines.animation.gaze.eyes import lid_weights
from reactive_realizer.engines.animation.gaze.viewer import VIEWER
from reactive_realizer.engines.animation.idle import Idle
from reactive_realizer.engines.animation.motion_unit import GazeGoal, MotionUnit


class EyePoser:
    """Turns the eyes for gazes and glances; without any, they rest on the viewer or as idle animation says.

    Args:
        humanoid: the figure.
        world: where targets and the viewer are.
        idle: its idle animation; None if it has none.
        lasting: returns the motions whose gaze persists after their ends.
        isolated: leaves out what fails.
    """

    def __init__(
        self,
        humanoid: Humanoid,
        world: World,
        idle: Idle | None,
        lasting: Callable[[], Iterable[MotionUnit]],
        isolated: FailureIsolation,
    ) -> None:
        self._humanoid = humanoid
        self._world = world
        self._idle = idle
        self._lasting = lasting
        self._isolated = isolated
        self._controller = EyeController(idle.blink) if idle is not None else EyeController()

    def note_change(self, time: GlobalTime) -> None:
        """Note that the eyes have other goals from a time on."""
        self._controller.note_change(time)

    def note_change_by(self, unit: AnimationUnit, time: GlobalTime) -> None:
        """Note that a unit has passed a point, if it moves the eyes."""
        gaze = unit.motion.gaze(0.0)
        if (gaze is not None and gaze.eyes > 0.0) or unit.motion.glance(0.0) is not None:
            self.note_change(time)

    def eyes(self, now: GlobalTime, playing: Sequence[AnimationUnit]) -> Eyes:
        """Return what poses the eyes in the head as shown; the lids follow."""
        gazes, aside = list(self._gazes(playing)), _aside(playing)
        return lambda body: self._pose(now, gazes, aside, body)

    def _pose(self, now: GlobalTime, gazes: Sequence[GazeGoal], aside: Quat, body: Body) -> EyePose:
        directed = any(gaze.eyes >= 1.0 and all(eye in gaze.directed for eye in EYES) for gaze in gazes)
        idle = self._idle
        resting: Mapping[str, Quat] = {}
        blinks: Mapping[str, float] = {}
        camera = None
        if idle is not None and not directed:
            resting = self._isolated("idle animation", lambda: idle.eyes(now), resting)
            camera = self._world.position(VIEWER)
        viewer = None if camera is None else self._humanoid.to_own_frame(camera)
        turns = self._isolated("gaze", lambda: self._controller.eyes(now, gazes, body, resting, viewer, aside), resting)
        if idle is not None:
            blinks = self._isolated("idle animation", lambda: idle.blinks(now), blinks)
        return EyePose(turns, lid_weights(turns), blinks)

    def _gazes(self, playing: Iterable[AnimationUnit]) -> Iterator[GazeGoal]:
        """Yield the active gaze goals: persistent ones, then playing ones, the latest last."""
        lasting = (motion.gaze(1.0) for motion in self._lasting())
        gazing = [(height(unit), gaze) for unit in playing if (gaze := unit.motion.gaze(unit.phase)) is not None]
        yield from (gaze for gaze in lasting if gaze is not None)
        yield from (gaze for _, gaze in sorted(gazing, key=itemgetter(0)))


def _aside(playing: Iterable[AnimationUnit]) -> Quat:
    """Return the turn of the eyes from where they look, in the axes of the head: that of all glances."""
    glances = (unit.motion.glance(unit.phase) for unit in playing)
    return reduce(multiply, (glance for glance in glances if glance is not None), IDENTITY)
