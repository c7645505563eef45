"""Gestures: a stroke from an animation file, with preparation and retraction."""

from collections.abc import Mapping
from functools import lru_cache
from itertools import pairwise
from random import Random

from reactive_realizer.binding.spec_reader import finite_numbers
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import LEFT_ARM, ROOT, SIDES
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import Quat, slerp
from reactive_realizer.embodiment.vector import distance
from reactive_realizer.engines.animation.easing import minimum_jerk, share
from reactive_realizer.engines.animation.motion_maker import MakerContext, MotionRequest
from reactive_realizer.engines.animation.motion_parameters import parameter_values
from reactive_realizer.engines.animation.motion_unit import (
    AMOUNT,
    AMOUNT_RANGE,
    ANY_VALUE,
    FILE_PARAMETERS,
    GESTURE_POINTS,
    Moment,
    MotionPose,
    MotionUnit,
    PhaseDuration,
    Predictability,
    arms_used,
    with_gesture_points,
)
from reactive_realizer.engines.animation.motions.procedural import AnimationFinder
from reactive_realizer.engines.animation.motions.reaching import gesture_key_positions, reach, shortest_phases
from reactive_realizer.engines.animation.motions.variation import TrailingPhase, Variation
from reactive_realizer.engines.animation.procedural.procedural_animation import ProceduralAnimation
from reactive_realizer.engines.animation.shortest import shortest_duration
from reactive_realizer.planunit.parameter import Range

HOLD = "postStrokeHoldDuration"
"""Parameter of a binding: hold after the stroke, s."""

HOLD_RANGE = Range(0.0, 600.0)

_INNER = GESTURE_POINTS[1:-1]

_TOUCHING = 0.15
"""Distance between two wrists within which hands may touch, m."""

_VARIED = frozenset(f"{side}_{joint}" for side in SIDES for joint in ("sternoclavicular", "shoulder", "elbow", "wrist"))
"""The joints whose strokes vary in size."""


class _Stroke:
    """The stroke of one or both arms.

    Attributes:
        animation: that has it.
        sampled_at: phase of the animation, and values of parameters, that were sampled last.
        pose: of that.
    """

    def __init__(self, animation: ProceduralAnimation) -> None:
        self.animation = animation
        self.sampled_at: tuple[float, ...] = ()
        self.pose: Mapping[str, Quat] = {}


class GestureMotionUnit(MotionUnit):
    """Prepares from the current pose of the arms, performs the stroke, holds, and retracts to the rest pose.

    The animation plays from its `ready` to its `relax`. What it has before and after is left out, because preparation
    and retraction depend on where the hands are. Phases pass evenly between two points; where two of its points
    coincide, as ready and strokeStart usually do, the hands hold. Preparation and retraction have a minimum-jerk speed
    profile, every joint along its shortest arc.

    With less than its full `AMOUNT`, which is as authored, the whole gesture stays nearer to the rest pose: a smaller
    stroke with a fully raised hand would not look like a smaller gesture.

    No two performances are alike (`Variation`): strokes are a little smaller than authored, seen from the ready pose,
    and quicker or slower within their phases; of two hands that do not touch, the left one trails.

    Attributes:
        random: draws the variation at the start; None for none.
    """

    random: Random | None = None

    kind = LayerKind.GESTURE
    authored = ("ready", "relax")
    fixed = FILE_PARAMETERS | {HOLD}
    predictability = Predictability.ONCE_STARTED

    def __init__(self, animation: ProceduralAnimation, parameters: Mapping[str, float], rest: Body) -> None:
        """Plan a gesture.

        Args:
            animation: with the stroke.
            parameters: values of some of the animation's parameters, and `HOLD`.
            rest: the expected body at the start and at the end. Preferred durations of preparation and retraction
                follow from the paths of the hands.

        Raises:
            RealizerError: "no-motion": the animation has no pose at its ready or relax.
        """
        self.parameters = {AMOUNT: parameters.get(AMOUNT, 1.0), **animation.values(parameters)}
        self.ranges = {**dict.fromkeys(self.parameters, ANY_VALUE), AMOUNT: AMOUNT_RANGE}
        self.joints, self.lacking = animation.joints, animation.lacking
        self.resources = arms_used(animation.joints)
        self._animation = animation
        self._rest = rest
        self._begin = {joint: rest.rotation(joint) for joint in animation.joints}
        self._variation: Variation | None = None
        self._trailing: TrailingPhase | None = None
        timing = animation.timing(self.parameters)
        keys = with_gesture_points(timing.key_positions)
        self._inner = [keys[point] for point in _INNER]
        self._arms = self._apart()
        self.stretch = timing.stretch
        durations = self._durations(timing.duration, parameters.get(HOLD, 0.0))
        self.preferred_duration = sum(each.preferred for each in durations)
        self.key_positions = gesture_key_positions([each.preferred for each in durations])
        outer = [self.key_positions[point] for point in _INNER]
        self._parts = list(zip(pairwise(outer), pairwise(self._inner), strict=True))
        self.shortest, self.retraction = shortest_phases(durations), durations[-1].shortest

    def _durations(self, whole: float, hold: float) -> list[PhaseDuration]:
        """Return the durations of the six phases between the seven points."""
        rest = self._rest
        stroke = [self._part(whole, before, after) for before, after in pairwise(self._inner)]
        stroke[-1] = PhaseDuration(stroke[-1].preferred + hold, stroke[-1].shortest)
        return [self.preparation(rest), *stroke, reach(self._body(self._inner[-1]), rest, self.joints)]

    def _part(self, whole: float, begin: float, end: float) -> PhaseDuration:
        """Return the duration of a part of the animation, between two of its phases."""
        if begin == end:
            return PhaseDuration(0.0)
        preferred = whole * (end - begin)
        return PhaseDuration(preferred, shortest_duration(self._body, begin, end, preferred, self.joints))

    def _body(self, phase: float) -> Body:
        """Return the body at rest in the pose of a phase of the animation."""
        return self._rest.posed(self._animation.sample(phase, self.parameters, self._rest).rotations)

    def _apart(self) -> tuple[_Stroke, ...]:
        """Return the strokes of arms that move apart: the one that leads, and one that trails if hands do not touch."""
        if not {"l_shoulder", "r_shoulder"} <= self.joints:
            return (_Stroke(self._animation),)
        bodies = map(self._body, sorted(set(self._inner)))
        wrists = ([body.transform(f"{side}_wrist").position for side in SIDES] for body in bodies)
        if any(distance(left, right) < _TOUCHING for left, right in wrists):
            return (_Stroke(self._animation),)
        left = self.joints & LEFT_ARM
        leading, trailing = (self._animation.restricted_to(part) for part in (self.joints - left | {ROOT}, left))
        return _Stroke(leading), _Stroke(trailing)

    def start(self, body: Body) -> None:
        """Start from the current pose of the arms."""
        self._begin = {joint: body.rotation(joint) for joint in self.joints}
        self._arms = tuple(_Stroke(arm.animation) for arm in self._arms)
        if self.random is not None:
            self._variation = Variation.drawn(self.random)
            self._trailing = TrailingPhase(self._variation.delay) if len(self._arms) > 1 else None
            self._ready = self._animation.sample(self._inner[0], self.parameters, body).rotations

    def pose(self, moment: Moment) -> MotionPose:
        """Return the rotations of arms and fingers; retraction fades to the layers below."""
        keys, phase, rotations = self.key_positions, moment.phase, dict[str, Quat]()
        later = phase
        if self._trailing is not None and moment.shown is not None:
            later = self._trailing(phase, moment.time)
        for arm, at in zip(self._arms, (phase, later), strict=False):
            stroke = self._stroke(arm, at, moment)
            if at < keys["ready"]:
                done = minimum_jerk(share(at, 0.0, keys["ready"]))
                stroke = {joint: slerp(self._begin[joint], goal, done) for joint, goal in stroke.items()}
            rotations |= stroke
        return MotionPose(
            rotations, 1.0 - minimum_jerk(share(phase, keys["relax"], 1.0)) if phase > keys["relax"] else 1.0
        )

    def preparation(self, body: Body) -> PhaseDuration:
        """Return the duration of the preparation from a body."""
        ready = body.posed(self._animation.sample(self._inner[0], self.parameters, body).rotations)
        return reach(body, ready, self.joints)

    def _stroke(self, arm: _Stroke, phase: float, moment: Moment) -> Mapping[str, Quat]:
        """Return the scaled pose of an arm at a phase. It is constant during preparation and retraction."""
        key = (self._animation_phase(phase), *self.parameters.values())
        if key != arm.sampled_at or not arm.animation.independent:
            arm.sampled_at, arm.pose = key, self._sampled(arm.animation, key[0], moment)
        return arm.pose

    def _sampled(self, animation: ProceduralAnimation, phase: float, moment: Moment) -> Mapping[str, Quat]:
        posed = animation.sample(phase, self.parameters, moment.body, moment.shown)
        if moment.shown is not None:
            self.fault = self.fault or posed.fault
        rotations, amount = posed.rotations, self.parameters[AMOUNT]
        if self._variation is not None and not animation.reaches:
            size = self._variation.size(phase)
            varied = _VARIED & rotations.keys()
            rotations = {**rotations, **{joint: slerp(self._ready[joint], rotations[joint], size) for joint in varied}}
        if amount == 1.0:
            return rotations
        return {joint: slerp(self._rest.rotation(joint), goal, amount) for joint, goal in rotations.items()}

    def _animation_phase(self, phase: float) -> float:
        """Return the phase of the animation: its ready during preparation, its relax during retraction."""
        for (left, right), (begin, end) in self._parts:
            if phase < right:
                return begin + (end - begin) * self._progress(phase, left, right) if phase > left else begin
        return self._inner[-1]

    def _progress(self, phase: float, left: float, right: float) -> float:
        """Return the progress of the stroke between two of its points, 0 to 1."""
        even = share(phase, left, right)
        return even if self._variation is None else self._variation.shifted(even)


_RANGES = {AMOUNT: AMOUNT_RANGE, HOLD: HOLD_RANGE}

_MOST = 256
"""Number of cached gestures, of all characters; a planner may ask for any number of amounts."""


class GestureMaker:
    """Makes gestures of animation files.

    Planning a gesture mostly consists of computing the paths of its hands. Equal gestures from equal rest postures are
    planned once.
    """

    def __init__(self, context: MakerContext) -> None:
        self._rest = context.rest
        self._random = Random(context.seed)
        self._files = AnimationFinder(context)

    def __call__(self, request: MotionRequest) -> GestureMotionUnit:
        """Make a gesture."""
        animation = self._files(request)
        parameters = finite_numbers(request.parameters) | parameter_values(request.parameters, _RANGES)
        motion = _planned(animation, tuple(parameters.items()), self._rest.body).copy()
        motion.random = self._random
        return motion

    def refresh(self) -> None:
        """Look for files again."""
        self._files.refresh()


@lru_cache(_MOST)
def _planned(
    animation: ProceduralAnimation, parameters: tuple[tuple[str, float], ...], rest: Body
) -> GestureMotionUnit:
    return GestureMotionUnit(animation, dict(parameters), rest)
