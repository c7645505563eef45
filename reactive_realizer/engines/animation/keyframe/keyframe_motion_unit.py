"""A keyframe animation or a capture as a motion."""

from collections.abc import Mapping

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.ground import grounded
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.skeleton import Skeleton
from reactive_realizer.embodiment.vector import add
from reactive_realizer.engines.animation.arrival import Arrival
from reactive_realizer.engines.animation.keyframe.clip import Clip
from reactive_realizer.engines.animation.motion_unit import (
    OF_FILES,
    Foreseen,
    Moment,
    MotionUnit,
    Posed,
    in_order,
    owned,
)

FILTER = "filter"
"""The parameter that says what is filtered out: what is faster than so many Hz."""


class KeyframeMotionUnit(MotionUnit):
    """Plays a clip: in the time that it took when it was made, if nothing else is asked for.

    A clip that moves the root moves it from where the figure stands: in its first key whatever of the figure is lowest
    touches the ground (`grounded`), for the place in a file is that of a figure of another size.
    """

    kind = LayerKind.FULL_BODY
    fixed = OF_FILES | {FILTER}
    foreseen = Foreseen.ALWAYS

    def __init__(self, clip: Clip, skeleton: Skeleton, lacking: frozenset[str] = frozenset()) -> None:
        """Prepares a motion.

        Args:
            clip: of joints that the figure has.
            skeleton: the figure's.
            lacking: the joints that are wanted and that the clip or the figure has not.
        """
        self.parameters = {}
        self.lacking = lacking
        self.joints = frozenset(clip.joints)
        self.resources = owned(self.joints)
        self.preferred_duration = clip.duration
        self._clip = clip
        self.key_positions = self._keys()
        self.exits = tuple(sync for sync in self.key_positions if sync in clip.points and clip.points[sync].leave)
        first = clip.rotations_at(clip.times[0])
        self._stand = None if clip.roots is None else grounded(Body(skeleton, first)).root
        self._arrival: Arrival | None = None

    def _keys(self) -> Mapping[str, float]:
        """Start and end, and the points that the clip names."""
        return in_order({sync: self._phase(point.time) for sync, point in self._clip.points.items()})

    def start(self, body: Body) -> None:
        """It sets in from where the body is."""
        self._arrival = Arrival(body, self._posed(0.0), self._clip.duration)

    def pose(self, moment: Moment) -> Posed:
        """The clip's rotations, and its root."""
        posed = self._posed(moment.phase)
        return posed if self._arrival is None else self._arrival(posed, moment.phase)

    def _posed(self, phase: float) -> Posed:
        time = self._clip.times[0] + phase * self._clip.duration
        moved = self._clip.root_at(time)
        root = None if moved is None or self._stand is None else add(self._stand, moved)
        return Posed(self._clip.rotations_at(time), root=root)

    def _phase(self, time: float) -> float:
        return (time - self._clip.times[0]) / self._clip.duration
