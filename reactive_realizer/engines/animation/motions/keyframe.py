"""Keyframe animations and captures as motions."""

from collections.abc import Mapping

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.feet import grounded
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.vector import add
from reactive_realizer.engines.animation.easing import minimum_jerk, share
from reactive_realizer.engines.animation.inertialization import InertializedStart, start_duration
from reactive_realizer.engines.animation.keyframe.clip import Clip
from reactive_realizer.engines.animation.keyframe.clip_durations import shortest_clip_parts
from reactive_realizer.engines.animation.motion_unit import (
    FILE_PARAMETERS,
    Moment,
    MotionPose,
    MotionUnit,
    Predictability,
    ordered,
    resources_used,
)

FILTER = "filter"
"""Parameter for the cutoff frequency of the low-pass filter, Hz."""

GROUP = "group"
"""Parameter for the body group to which the motion is restricted."""

SPEED = "speed"
"""Parameter for the speed at which it plays by default, 1 for that of the file."""

BELOW = "below"
"""Parameter for a joint: the motion is restricted to that and all below it."""

LOOP, ADDITIVE = "loop", "additive"
"""Parameters for whether it is played over and over until its end, and whether it is added to other motion."""

FADE_IN, FADE_OUT = "fadeIn", "fadeOut"
"""Parameters for the shares of its duration in which its weight rises and falls."""


FIXED = FILE_PARAMETERS | {FILTER, GROUP, BELOW, SPEED, LOOP, ADDITIVE, FADE_IN, FADE_OUT}
"""Parameters that are read when a motion is made."""


class KeyframeMotionUnit(MotionUnit):
    """Plays a clip, by default with its own duration.

    A clip that moves the root moves it from where the figure stands. In its first key the figure is `grounded`, because
    the position in the file is that of a figure of another size.
    """

    kind = LayerKind.FULL_BODY
    fixed = FIXED
    predictability = Predictability.ALWAYS

    def __init__(
        self,
        clip: Clip,
        rest: Body,
        lacking: frozenset[str] = frozenset(),
        fades: tuple[float, float] = (0.0, 0.0),
        speed: float = 1.0,
    ) -> None:
        """Prepare a motion.

        Args:
            clip: of joints that the figure has.
            rest: the figure at rest.
            lacking: requested joints that the clip or the figure lacks.
            fades: shares of its duration in which its weight rises and falls.
            speed: at which it plays by default, 1 for that of the clip.
        """
        self.parameters = {}
        self.lacking = lacking
        self.joints = frozenset(clip.joints)
        self.resources = resources_used(self.joints)
        self.preferred_duration = clip.duration / speed
        self.entrance = start_duration(clip.duration)
        self._clip = clip
        self._fades = fades
        self.key_positions = self._keys()
        self.shortest = shortest_clip_parts(clip, rest, self.key_positions)
        self.exits = tuple(sync for sync in self.key_positions if sync in clip.points and clip.points[sync].leave)
        first = clip.rotations_at(clip.times[0])
        self._stand = None if clip.roots is None else grounded(Body(rest.skeleton, first)).root
        self._arrival: InertializedStart | None = None

    def _keys(self) -> Mapping[str, float]:
        """Return start and end, and the points of the clip."""
        return ordered({sync: self._phase(point.time) for sync, point in self._clip.points.items()})

    def start(self, body: Body) -> None:
        """Start from the current body."""
        self._arrival = InertializedStart(body, self._posed(0.0), self._clip.duration)

    def pose(self, moment: Moment) -> MotionPose:
        """Return the pose of the clip, inertialized."""
        posed = self._posed(moment.phase)
        if self._arrival is not None:
            posed = self._arrival(posed, moment.phase)
        return posed if self._fades == (0.0, 0.0) else posed._replace(weight=self._weight(moment.phase))

    def _weight(self, phase: float) -> float:
        rising, falling = self._fades
        return minimum_jerk(share(phase, 0.0, rising)) * minimum_jerk(share(1.0 - phase, 0.0, falling))

    def _posed(self, phase: float) -> MotionPose:
        time = self._clip.times[0] + phase * self._clip.duration
        moved = self._clip.root_at(time)
        root = None if moved is None or self._stand is None else add(self._stand, moved)
        return MotionPose(self._clip.rotations_at(time), root=root)

    def _phase(self, time: float) -> float:
        return (time - self._clip.times[0]) / self._clip.duration
