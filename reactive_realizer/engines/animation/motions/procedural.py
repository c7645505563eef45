"""Procedural animations as motions: head movements, and animations that a behavior chooses by file."""

from collections.abc import Mapping
from contextlib import suppress
from functools import lru_cache
from random import Random

from reactive_realizer.binding.spec_reader import finite_numbers
from reactive_realizer.bml.behaviors import MOST_REPETITIONS
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.engines.animation.inertialization import InertializedStart, start_duration
from reactive_realizer.engines.animation.motion_maker import MakerContext, MotionRequest
from reactive_realizer.engines.animation.motion_parameters import check_ranges
from reactive_realizer.engines.animation.motion_unit import (
    ANY_VALUE,
    FILE_PARAMETERS,
    JOINTS,
    MIRROR,
    NAME,
    Moment,
    MotionPose,
    MotionUnit,
    Predictability,
    Resource,
    ordered,
    resources_used,
    with_gesture_points,
)
from reactive_realizer.engines.animation.motions.variation import Variation
from reactive_realizer.engines.animation.procedural.procedural_animation import AuthoredTiming, ProceduralAnimation
from reactive_realizer.engines.animation.procedural.procedural_animation_reader import load_animation
from reactive_realizer.engines.animation.shortest import shortest_parts
from reactive_realizer.errors import RealizerError
from reactive_realizer.planunit.parameter import Range

_SAID = (NAME, MIRROR, JOINTS)
"""Parameters that select the animation, together with the file."""


class AnimationFinder:
    """Finds the animations of requests, for one figure. Changed files are read again.

    Found files are cached until the next refresh: finding takes as long as planning.
    """

    def __init__(self, context: MakerContext) -> None:
        self._context = context
        self._found: dict[tuple[str | None, ...], ProceduralAnimation] = {}

    def refresh(self) -> None:
        """Look for files again: they may have changed."""
        self._found.clear()

    def __call__(self, request: MotionRequest) -> ProceduralAnimation:
        """Return the requested animation.

        Every animation has two more parameters (thesis C.1.5): `mirror`, true or false, and `joints`, H-Anim names
        separated by spaces or commas, to which the animation is restricted after mirroring.

        Raises:
            RealizerError: there is no such file, it is invalid, or it turns none of the joints.
        """
        key = (request.file, *map(request.parameters.get, _SAID))
        if key not in self._found:
            self._found[key] = self._read(request)
        return self._found[key]

    def _read(self, request: MotionRequest) -> ProceduralAnimation:
        return load_animation(
            self._context.file_of(request, "xml"),
            self._context.humanoid.avatar.skeleton,
            mirror=request.mirror,
            joints=request.joints,
            functions=self._context.functions,
        )


REPEATS = "r"
"""Parameter for the number of strokes, by convention of the published files."""

_PATH = 10
"""Work of computing how fast the joints can follow, as the limit `planning_per_tick` counts."""

_REPEATS_RANGE = Range(0.0, float(MOST_REPETITIONS))


class ProceduralMotionUnit(MotionUnit):
    """Plays a procedural animation with given parameters.

    It starts from the current body (`InertializedStart`) and ends with the last pose of its file. Following motions
    continue from there; otherwise the engine fades it out.

    With r repeats, the stroke comes r times, 1/r of the whole apart: stroke:1 to stroke:r. Added to other motion, these
    strokes differ a little in size (`Variation`).

    Attributes:
        random: draws the variation at the start; None for none.
    """

    random: Random | None = None

    first_work = _PATH
    fixed = FILE_PARAMETERS
    predictability = Predictability.ALWAYS

    def __init__(
        self,
        animation: ProceduralAnimation,
        parameters: Mapping[str, float],
        kind: LayerKind,
        rest: Body | None = None,
    ) -> None:
        """Prepare a motion.

        Args:
            animation: to play.
            parameters: values of some parameters; unknown names have no effect.
            kind: of its layer; an additive motion owns nothing, a full-body one also owns the stance.
            rest: the body that it is planned for; without one, it has no shortest durations.

        Raises:
            RealizerError: "no-motion", "bad-keys": durations or key positions are invalid for these values;
                "bad-parameter": too many repeats.
        """
        self.parameters = animation.values(parameters)
        self.ranges = {name: _REPEATS_RANGE if name == REPEATS else ANY_VALUE for name in self.parameters}
        check_ranges(self.parameters, self.ranges)
        self.kind = kind
        self.joints, self.lacking = animation.joints, animation.lacking
        self.resources = frozenset() if kind is LayerKind.ADDITIVE else _owned(animation)
        self._animation = animation
        # Timing is fixed when planned; a parameter that changes while it plays changes only the motion.
        timing = animation.timing(self.parameters)
        self.preferred_duration, self.stretch = timing.duration, timing.stretch
        self.entrance = start_duration(timing.duration)
        repeats = round(self.parameters.get(REPEATS, 1.0))
        self.key_positions = _with_repeats(timing, repeats)
        self._varies = repeats > 1 and kind is LayerKind.ADDITIVE
        self._variation: Variation | None = None
        self._arrival: InertializedStart | None = None
        if rest is not None:
            self.shortest = self._shortest(rest)

    def _shortest(self, rest: Body) -> Mapping[str, float]:
        """Return the shortest durations; none if the animation has no pose at some phase."""

        def body_at(phase: float) -> Body:
            return rest.posed(self._animation.sample(phase, self.parameters, rest).rotations)

        with suppress(RealizerError):
            return shortest_parts(body_at, self.key_positions, self.preferred_duration, self.joints)
        return {}

    def start(self, body: Body) -> None:
        """Start from the current body, unless the motion is additive."""
        if self._varies and self.random is not None:
            self._variation = Variation.drawn(self.random)
        if self.kind is not LayerKind.ADDITIVE:
            first = self._animation.sample(0.0, self.parameters, body)
            self._arrival = InertializedStart(body, first, self.preferred_duration)

    def pose(self, moment: Moment) -> MotionPose:
        """Return the pose of the animation, inertialized."""
        posed = self._animation.sample(moment.phase, self.parameters, moment.body, moment.shown)
        if moment.shown is not None:
            self.fault = self.fault or posed.fault
        if self._variation is not None:
            return posed._replace(weight=self._variation.size(moment.phase))
        return posed if self._arrival is None else self._arrival(posed, moment.phase)


def kind_of(animation: ProceduralAnimation) -> LayerKind:
    """Return the layer kind of an animation. Gaze and gestures continue above motion of legs or root."""
    return LayerKind.FULL_BODY if Resource.STANCE in _owned(animation) else LayerKind.GESTURE


def _owned(animation: ProceduralAnimation) -> frozenset[str]:
    return resources_used(animation.joints if animation.root is None else animation.joints | {ROOT})


def _with_repeats(timing: AuthoredTiming, repeats: int) -> dict[str, float]:
    if repeats < 2:
        return ordered(timing.key_positions)
    keys = with_gesture_points(timing.key_positions)
    first = keys["stroke"]
    return with_gesture_points({**keys, **{f"stroke:{i + 1}": min(1.0, first + i / repeats) for i in range(repeats)}})


_MOST = 256
"""Number of cached motions, of all characters."""


class ProceduralMotionMaker:
    """Makes motions of animation files; equal motions are planned once."""

    def __init__(self, context: MakerContext) -> None:
        self._files = AnimationFinder(context)
        self._rest = context.rest
        self._random = Random(context.seed)

    def __call__(self, request: MotionRequest) -> ProceduralMotionUnit:
        """Make a motion."""
        parameters = tuple(finite_numbers(request.parameters).items())
        asked = self._files(request), parameters, request.added, self._rest.body
        motion = _planned(*asked).copy()
        motion.origin, motion.random = asked, self._random
        return motion

    def refresh(self) -> None:
        """Look for files again."""
        self._files.refresh()


@lru_cache(_MOST)
def _planned(
    animation: ProceduralAnimation, parameters: tuple[tuple[str, float], ...], added: bool, rest: Body
) -> ProceduralMotionUnit:
    kind = LayerKind.ADDITIVE if added else kind_of(animation)
    return ProceduralMotionUnit(animation, dict(parameters), kind, rest)
