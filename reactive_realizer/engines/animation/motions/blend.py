"""Clips that are played over and over, added to other motion, or mixed by parameters."""

from collections.abc import Mapping
from itertools import pairwise

import numpy as np

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.feet import grounded
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.vector import add
from reactive_realizer.engines.animation.easing import minimum_jerk, share
from reactive_realizer.engines.animation.inertialization import InertializedStart, start_duration
from reactive_realizer.engines.animation.keyframe.blend_files import AXES
from reactive_realizer.engines.animation.keyframe.blend_space import BlendSpace
from reactive_realizer.engines.animation.keyframe.clip_durations import shortest_clip_parts
from reactive_realizer.engines.animation.keyframe.clip_mix import ClipMix
from reactive_realizer.engines.animation.motion_unit import (
    ANY_VALUE,
    START_TO_END,
    Moment,
    MotionPose,
    MotionUnit,
    ordered,
    resources_used,
)


class BlendMotionUnit(MotionUnit):
    """Plays a mix of clips once or, as a loop, until it ends.

    The values of its parameters x, y and z say how much each clip counts, also while it plays. A loop turns with the
    speed of the mix; the position in the mix never jumps.

    Args:
        mix: of clips that the figure can play.
        space: with the places of the clips.
        rest: the figure at rest.
        place: first values of the parameters.
        loops: whether it is played until its end.
        adds: whether the clips are turns that are added to other motion.
        speed: 1 for that of the clips.
        fades: shares of a clip in which its weight rises and, if it is played once, falls.
        fixed: names of parameters that are read before it is made.
        lacking: requested joints that a clip or the figure lacks.
    """

    def __init__(
        self,
        mix: ClipMix,
        space: BlendSpace,
        rest: Body,
        place: Mapping[str, float],
        *,
        loops: bool,
        adds: bool,
        speed: float,
        fades: tuple[float, float],
        fixed: frozenset[str],
        lacking: frozenset[str],
    ) -> None:
        self._mix, self._space = mix, space
        self._loops, self._speed, self._fades = loops, speed, fades
        self.fixed, self.lacking = fixed, lacking
        self.kind = LayerKind.ADDITIVE if adds else LayerKind.FULL_BODY
        self.joints = frozenset(mix.clips[0].joints)
        self.resources = frozenset() if adds else resources_used(self.joints)
        self.parameters = dict(place)
        self.ranges = dict.fromkeys(place, ANY_VALUE)
        weights = self._weights()
        self._times = mix.times(weights)
        whole = self._times[-1]
        self.preferred_duration = whole / speed
        self.entrance = start_duration(whole)
        self.key_positions = START_TO_END if loops else ordered(self._points(weights))
        sampled = mix.sampled(weights)
        self.shortest = {} if loops else shortest_clip_parts(sampled, rest, self.key_positions)
        moves = sampled.roots is not None
        self._stand = grounded(Body(rest.skeleton, sampled.rotations_at(0.0))).root if moves and not adds else None
        self._arrival: InertializedStart | None = None
        self._course, self._since, self._last = 0.0, GlobalTime(0.0), GlobalTime(0.0)
        self._begun = False

    def start(self, body: Body) -> None:
        """Start from the current body."""
        self._begun = False
        if self.kind is not LayerKind.ADDITIVE:
            self._arrival = InertializedStart(body, self._posed(0.0), self._times[-1])

    def pose(self, moment: Moment) -> MotionPose:
        """Return the pose of the mix, inertialized."""
        done = self._turn(moment.time) if self._loops else moment.phase
        course = self._course if self._loops else float(np.interp(done, self._phases(), range(len(self._times))))
        posed = self._posed(course)
        if self._arrival is not None:
            posed = self._arrival(posed, min(done, 1.0))
        rising, falling = self._fades
        weight = minimum_jerk(share(done, 0.0, rising)) if rising else 1.0
        if falling and not self._loops:
            weight *= minimum_jerk(share(1.0 - done, 0.0, falling))
        return posed if weight == 1.0 else posed._replace(weight=weight)

    def _turn(self, now: GlobalTime) -> float:
        """Go on with a loop until a time, s; returns the rounds that have passed, with the first duration."""
        if not self._begun:
            self._begun, self._since, self._last, self._course = True, now, now, 0.0
        left = self._speed * max(0.0, now - self._last)
        self._last = max(now, self._last)
        steps = [later - earlier for earlier, later in pairwise(self._mix.times(self._weights()))]
        left %= sum(steps)
        while left > 0.0:
            k = min(int(self._course), len(steps) - 1)
            way = min(left, (k + 1 - self._course) * steps[k])
            self._course = k + 1.0 if way < left else self._course + way / steps[k]
            left -= way
            if self._course >= len(steps):
                self._course = 0.0
        return (self._last - self._since) / self.preferred_duration

    def _posed(self, course: float) -> MotionPose:
        weights = self._weights()
        moved = self._mix.root_at(course, weights)
        if self.kind is LayerKind.ADDITIVE:
            return MotionPose(self._mix.rotations_at(course, weights), root=moved)
        root = None if moved is None or self._stand is None else add(self._stand, moved)
        return MotionPose(self._mix.rotations_at(course, weights), root=root)

    def _weights(self) -> tuple[float, ...]:
        return self._space.weights([self.parameters[axis] for axis in AXES[: self._space.size]])

    def _phases(self) -> list[float]:
        """Return the phases of the marks, by the weights with which it was planned."""
        return [time / self._times[-1] for time in self._times]

    def _points(self, weights: tuple[float, ...]) -> dict[str, float]:
        """Return the phases of the sync points that all clips have."""
        courses = {sync: self._mix.course(sync, weights) for sync in sorted(self._mix.clips[0].points)}
        phases = self._phases()
        return {
            sync: float(np.interp(course, range(len(phases)), phases))
            for sync, course in courses.items()
            if course is not None
        }
