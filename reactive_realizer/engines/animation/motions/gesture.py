"""Gestures: a stroke from an animation file, with preparation and retraction."""

from collections.abc import Mapping
from functools import lru_cache
from itertools import pairwise
from random import Random

from reactive_realizer.binding.spec_reader import finite_numbers
from reactive_realizer.bml.expressivity import NAMES, NEUTRAL, Expressivity
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import LEFT_ARM, ROOT, SIDES
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import Quat, slerp
from reactive_realizer.embodiment.vector import distance
from reactive_realizer.engines.animation.arm_shift import Way, on_way
from reactive_realizer.engines.animation.easing import minimum_jerk, share, smoothstep
from reactive_realizer.engines.animation.motion_maker import MakerContext, MotionRequest
from reactive_realizer.engines.animation.motion_parameters import parameter_values
from reactive_realizer.engines.animation.motion_unit import (
    AMOUNT,
    AMOUNT_RANGE,
    ANY_VALUE,
    EXPRESSIVITY_RANGES,
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
from reactive_realizer.engines.animation.motions.expressive_stroke import TOUCHING, ExpressiveStroke, StrokePhases
from reactive_realizer.engines.animation.motions.procedural import AnimationFinder
from reactive_realizer.engines.animation.motions.reaching import gesture_key_positions, reach, shortest_phases
from reactive_realizer.engines.animation.motions.variation import TrailingPhase, Variation
from reactive_realizer.engines.animation.procedural.procedural_animation import ProceduralAnimation
from reactive_realizer.engines.animation.shortest import shortest_duration
from reactive_realizer.planunit.parameter import Range

HOLD = "postStrokeHoldDuration"
"""Parameter of a binding: hold after the stroke, s."""

HOLD_RANGE = Range(0.0, 600.0)

_PATH = 150
"""Work of computing the path of a hand, as the limit `planning_per_tick` counts."""

_INNER = GESTURE_POINTS[1:-1]

_VARIED = frozenset(f"{side}_{joint}" for side in SIDES for joint in ("sternoclavicular", "shoulder", "elbow", "wrist"))
"""The joints whose strokes vary in size."""


class _Stroke:
    """The stroke of one or both arms.

    Attributes:
        animation: that has it.
        sampled_at: phase of the animation, and values of parameters, that were sampled last.
        pose: of that.
        expressed_at: how far ahead along the stroke, and the pose, that got expressivity last.
        expressed: the pose with expressivity.
    """

    def __init__(self, animation: ProceduralAnimation) -> None:
        self.animation = animation
        self.sampled_at: tuple[float, ...] = ()
        self.pose: Mapping[str, Quat] = {}
        self.expressed_at: tuple[float, Mapping[str, Quat]] = (0.0, {})
        self.expressed: Mapping[str, Quat] = {}


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

    Expressivity changes the durations of its phases and the strokes (`ExpressiveStroke`). A parameter of the animation
    that has the name of one of its four numbers takes the place of this one.

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
        own = animation.values(parameters)
        self._expressive = tuple(name for name in NAMES if name not in own)
        manner = {name: parameters.get(name, 0.0) for name in self._expressive}
        self.parameters = {AMOUNT: parameters.get(AMOUNT, 1.0), **manner, **own}
        ranges = {name: EXPRESSIVITY_RANGES[name] for name in self._expressive}
        self.ranges = {**dict.fromkeys(self.parameters, ANY_VALUE), AMOUNT: AMOUNT_RANGE, **ranges}
        self.joints, self.lacking = animation.joints, animation.lacking
        self.resources = arms_used(animation.joints)
        self.first_work = _PATH * max(1, len(self.resources))
        self._animation = animation
        self._rest = rest
        self._begin = {joint: rest.rotation(joint) for joint in animation.joints}
        self._variation: Variation | None = None
        self._trailing: TrailingPhase | None = None
        timing = animation.timing(self.parameters)
        keys = with_gesture_points(timing.key_positions)
        self._inner = [keys[point] for point in _INNER]
        self._arms = self._apart()
        self._stroke_shape: ExpressiveStroke | None = None
        self.stretch = timing.stretch
        self._authored = self._durations(timing.duration, parameters.get(HOLD, 0.0))
        durations = self.durations(self._expressivity(tuple(self.parameters.values())))
        self.preferred_duration = sum(each.preferred for each in durations)
        self.key_positions = gesture_key_positions([each.preferred for each in durations])
        outer = [self.key_positions[point] for point in _INNER]
        self._parts = list(zip(pairwise(outer), pairwise(self._inner), strict=True))
        self.shortest, self.retraction = shortest_phases(durations), durations[-1].shortest
        self._phases = StrokePhases.of(self.key_positions, self.preferred_duration)

    def _expressivity(self, values: tuple[float, ...]) -> Expressivity:
        """Return the expressivity for values of all parameters."""
        numbers = values[1 : 1 + len(self._expressive)]
        return Expressivity.of(dict(zip(self._expressive, numbers, strict=True))) if any(numbers) else NEUTRAL

    @property
    def _shape(self) -> ExpressiveStroke:
        """Return where the hands go; most gestures never need it."""
        if self._stroke_shape is None:
            self._stroke_shape = ExpressiveStroke(self._body, self._inner, self.joints)
        return self._stroke_shape

    def durations(self, expressivity: Expressivity) -> list[PhaseDuration]:
        """Return the durations of the six phases between the seven points, with expressivity.

        Temporal extent changes movements; power makes strokes quicker, and has the hands hold before them; fluidity
        changes pauses, and without it the hands rest at every point of the stroke.
        """
        if expressivity == NEUTRAL:
            return self._authored
        _, before, stroke, after, hold, _ = self._authored
        relaxed = self._rest.posed(self._expressed(self._pose_at(self._inner[-1]), self._rest, expressivity, 0.0))
        swing = expressivity.swing_hold if self._shape.moves else 0.0
        return [
            self._preparation(self._rest, expressivity),
            _paused(before, expressivity, swing),
            _moved(stroke, expressivity),
            _moved(after, expressivity, rest=self._rest_before(expressivity)),
            _paused(hold, expressivity),
            _way(reach(relaxed, self._rest, self.joints), expressivity),
        ]

    def slowed(self, before: float, after: float) -> Mapping[str, float]:
        """As `MotionUnit.slowed`: holds stay."""
        if NAMES[1] not in self._expressive:
            return {}
        now = self._expressivity(tuple(self.parameters.values()))
        first, second = (self._movements(now._replace(temporal_extent=extent)) for extent in (before, after))
        return {point: second[point] / first[point] for point in first if first[point] > 0.0}

    def _movements(self, expressivity: Expressivity) -> dict[str, float]:
        """Return the durations of the movements with expressivity, s, by the point at which each ends."""
        preparation, _, stroke, after, _, retraction = self._authored
        movements = {
            "ready": _way(preparation, expressivity),
            "stroke": _moved(stroke, expressivity),
            "strokeEnd": _moved(after, expressivity, rest=self._rest_before(expressivity)),
            "end": _way(retraction, expressivity),
        }
        return {point: each.preferred for point, each in movements.items()}

    def _rest_before(self, expressivity: Expressivity) -> float:
        """Return how long the hands rest at the stroke before they move on, s."""
        return expressivity.rest if self._authored[3].preferred > 0.0 else 0.0

    def _durations(self, whole: float, hold: float) -> list[PhaseDuration]:
        """Return the durations of the six phases between the seven points."""
        rest = self._rest
        stroke = [self._part(whole, before, after) for before, after in pairwise(self._inner)]
        stroke[-1] = PhaseDuration(stroke[-1].preferred + hold, stroke[-1].shortest)
        way = self._preparation(rest, NEUTRAL)
        return [way, *stroke, reach(self._body(self._inner[-1]), rest, self.joints)]

    def _part(self, whole: float, begin: float, end: float) -> PhaseDuration:
        """Return the duration of a part of the animation, between two of its phases."""
        if begin == end:
            return PhaseDuration(0.0)
        preferred = whole * (end - begin)
        return PhaseDuration(preferred, shortest_duration(self._body, begin, end, preferred, self.joints))

    def _body(self, phase: float) -> Body:
        """Return the body at rest in the pose of a phase of the animation."""
        return self._rest.posed(self._pose_at(phase))

    def _pose_at(self, phase: float) -> Mapping[str, Quat]:
        """Return the pose of a phase of the animation at rest."""
        return self._animation.sample(phase, self.parameters, self._rest).rotations

    def _apart(self) -> tuple[_Stroke, ...]:
        """Return the strokes of arms that move apart: the one that leads, and one that trails if hands do not touch."""
        if not {"l_shoulder", "r_shoulder"} <= self.joints:
            return (_Stroke(self._animation),)
        bodies = map(self._body, sorted(set(self._inner)))
        wrists = ([body.transform(f"{side}_wrist").position for side in SIDES] for body in bodies)
        if any(distance(left, right) < TOUCHING for left, right in wrists):
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
        values = tuple(self.parameters.values())
        expressivity = self._expressivity(values)
        later = phase
        if self._trailing is not None and moment.shown is not None:
            later = self._trailing(phase, moment.time)
        for arm, at in zip(self._arms, (phase, later), strict=False):
            stroke = self._stroke(arm, at, moment, values, expressivity)
            if at < keys["ready"]:
                stroke = self._prepared(stroke, minimum_jerk(share(at, 0.0, keys["ready"])), moment.body, expressivity)
            rotations |= stroke
        return MotionPose(
            rotations, 1.0 - minimum_jerk(share(phase, keys["relax"], 1.0)) if phase > keys["relax"] else 1.0
        )

    def _prepared(
        self, goal: Mapping[str, Quat], done: float, body: Body, expressivity: Expressivity
    ) -> Mapping[str, Quat]:
        """Return the pose after a share of the preparation; power makes the way of the hands straighter."""
        turned = {joint: slerp(self._begin[joint], rotation, done) for joint, rotation in goal.items()}
        if expressivity.power == 0.0:
            return turned
        return on_way(self._shape.arms, turned, Way(self._begin, goal, done, expressivity.curvature), body)

    def preparation(self, body: Body) -> PhaseDuration:
        """Return the duration of the preparation from a body."""
        return self._preparation(body, self._expressivity(tuple(self.parameters.values())))

    def _preparation(self, body: Body, expressivity: Expressivity) -> PhaseDuration:
        ready = self._animation.sample(self._inner[0], self.parameters, body).rotations
        if expressivity == NEUTRAL:
            return reach(body, body.posed(ready), self.joints)
        ready = self._expressed(ready, body, expressivity, -expressivity.back_swing)
        return _way(reach(body, body.posed(ready), self.joints), expressivity)

    def _expressed(
        self, rotations: Mapping[str, Quat], body: Body, expressivity: Expressivity, along: float
    ) -> Mapping[str, Quat]:
        """Return a pose of the stroke with expressivity (`ExpressiveStroke`)."""
        return self._shape.expressed(rotations, body, expressivity, along, self.parameters[AMOUNT])

    def _stroke(
        self, arm: _Stroke, phase: float, moment: Moment, values: tuple[float, ...], expressivity: Expressivity
    ) -> Mapping[str, Quat]:
        """Return the pose of an arm at a phase. It is constant during preparation and retraction."""
        key = (self._animation_phase(phase, expressivity), *values)
        if key != arm.sampled_at or not arm.animation.independent:
            arm.sampled_at, arm.pose = key, self._sampled(arm.animation, key[0], moment)
        if expressivity == NEUTRAL:
            return arm.pose
        along = self._shape.along(expressivity, self._phases, phase)
        if arm.expressed_at[0] != along or arm.expressed_at[1] is not arm.pose:
            arm.expressed_at = (along, arm.pose)
            arm.expressed = self._expressed(arm.pose, moment.body, expressivity, along)
        return arm.expressed

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

    def _animation_phase(self, phase: float, expressivity: Expressivity) -> float:
        """Return the phase of the animation: its ready during preparation, its relax during retraction."""
        for number, ((left, right), (begin, end)) in enumerate(self._parts):
            if phase < right:
                progress = self._progress(number, share(phase, left, right), expressivity)
                return begin + (end - begin) * progress if phase > left else begin
        return self._inner[-1]

    def _progress(self, number: int, even: float, expressivity: Expressivity) -> float:
        """Return the progress of a part of the stroke between two of its points, 0 to 1.

        Args:
            number: of the part: 1 ends at the stroke, 2 begins there.
            even: progress of its time.
            expressivity: with little fluidity, the hands come to rest at the stroke, and stay there.
        """
        if expressivity.fluidity < 0.0 and number in (1, 2):
            if number == 2 and (rest := self._rest_before(expressivity)):
                even = share(even, rest / _moved(self._authored[3], expressivity, rest).preferred, 1.0)
            even += expressivity.fluidity * (even - smoothstep(even))
        return even if self._variation is None else self._variation.shifted(even)


def _way(reached: PhaseDuration, expressivity: Expressivity) -> PhaseDuration:
    """Return the duration of a reach with expressivity."""
    return PhaseDuration(expressivity.movement(reached.preferred, reached.shortest), reached.shortest)


def _moved(phase: PhaseDuration, expressivity: Expressivity, rest: float = 0.0) -> PhaseDuration:
    """Return the duration of a phase of a stroke with expressivity, after a rest, s; some strokes lack the phase."""
    if phase.preferred == 0.0:
        return phase
    shortest = phase.shortest * max(1.0, expressivity.size) * (1.0 + expressivity.back_swing)
    return PhaseDuration(expressivity.movement(phase.preferred, shortest, expressivity.speed) + rest, shortest)


def _paused(phase: PhaseDuration, expressivity: Expressivity, more: float = 0.0) -> PhaseDuration:
    """Return the duration of a phase in which the hands hold, with expressivity; the hold may be longer before that, s.

    A phase in which they move too keeps the time that this needs.
    """
    return PhaseDuration(max(phase.shortest, expressivity.pause(phase.preferred + more)), phase.shortest)


_RANGES = {AMOUNT: AMOUNT_RANGE, HOLD: HOLD_RANGE, **EXPRESSIVITY_RANGES}

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
        self._manner = context.expressivity.parameters
        self._files = AnimationFinder(context)

    def __call__(self, request: MotionRequest) -> GestureMotionUnit:
        """Make a gesture."""
        animation = self._files(request)
        ranges = {name: limits for name, limits in _RANGES.items() if name not in animation.parameters}
        given = finite_numbers(request.parameters) | parameter_values(request.parameters, ranges)
        parameters = self._manner | given
        motion = _planned(animation, tuple(parameters.items()), self._rest.body).copy()
        motion.origin = (animation, tuple(parameters.items()), self._rest.body)
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
