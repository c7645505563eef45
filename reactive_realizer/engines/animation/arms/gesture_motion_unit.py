"""A gesture: a stroke from a file, with the way there and the way back."""

from collections.abc import Mapping
from itertools import pairwise

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import Quat, slerp
from reactive_realizer.engines.animation.arms.pace import comfortable, seven_points
from reactive_realizer.engines.animation.easing import minimum_jerk, share
from reactive_realizer.engines.animation.motion_unit import (
    AMOUNT,
    AMOUNT_RANGE,
    ANY_VALUE,
    GESTURE_POINTS,
    OF_FILES,
    Foreseen,
    Moment,
    MotionUnit,
    Posed,
    arms_of,
    completed,
)
from reactive_realizer.engines.animation.procedural.proc_animation import ProcAnimation
from reactive_realizer.planunit.parameter import Range

HOLD = "postStrokeHoldDuration"
"""The parameter of a binding that says how long the hands stay after the stroke, s."""

HOLD_RANGE = Range(0.0, 600.0)

_INNER = GESTURE_POINTS[1:-1]


class GestureMotionUnit(MotionUnit):
    """Prepares from wherever the arms are, makes the stroke, holds, and retracts to the rest pose.

    The animation is played from its `ready` to its `relax`; what it has before and after is left out, for how the hands
    come and go depends on where they are. Between two points its own phase runs evenly; where two of its points
    coincide, as ready and strokeStart mostly do, the hands wait. Preparation and retraction start and stop as people do
    (`minimum_jerk`), every joint along its shortest arc.

    Of less than its full `AMOUNT`, which is as authored, it stays nearer to the rest pose, all of it: a hand raised as
    high as ever for a smaller stroke would not look like a smaller gesture.
    """

    kind = LayerKind.GESTURE
    fixed = OF_FILES | {HOLD}
    foreseen = Foreseen.ONCE_BEGUN

    def __init__(self, animation: ProcAnimation, parameters: Mapping[str, float], rest: Body) -> None:
        """Plans a gesture.

        Args:
            animation: the stroke.
            parameters: values for some of the animation's parameters, and `HOLD`.
            rest: where the hands are expected to set out, and return to: from their way to the stroke follow the
                preferred durations of preparation and retraction.

        Raises:
            RealizerError: "no-motion": the animation has no pose at its ready or relax.
        """
        self.parameters = {AMOUNT: parameters.get(AMOUNT, 1.0), **animation.values(parameters)}
        self.ranges = {**dict.fromkeys(self.parameters, ANY_VALUE), AMOUNT: AMOUNT_RANGE}
        self.joints, self.lacking = animation.joints, animation.lacking
        self.resources = arms_of(animation.joints)
        self._animation = animation
        self._rest = rest
        self._begin = {joint: rest.rotation(joint) for joint in animation.joints}
        self._asked: tuple[float, ...] = ()
        self._found: Mapping[str, Quat] = {}
        timing = animation.timing(self.parameters)
        keys = completed(timing.key_positions)
        self._inner = [keys[point] for point in _INNER]
        durations = self._durations(timing.duration, parameters.get(HOLD, 0.0))
        self.preferred_duration = sum(durations)
        self.key_positions = seven_points(durations)

    def _durations(self, whole: float, hold: float) -> list[float]:
        """Of the six phases between the seven points, s."""
        rest = self._rest
        relax = rest.posed(self._animation.sample(self._inner[-1], self.parameters, rest).rotations)
        stroke = [whole * (after - before) for before, after in pairwise(self._inner)]
        stroke[-1] += hold
        return [self.preparation(rest), *stroke, comfortable(relax, rest, self.joints)]

    def start(self, body: Body) -> None:
        """The hands set out from where they are now."""
        self._begin = {joint: body.rotation(joint) for joint in self.joints}

    def pose(self, moment: Moment) -> Posed:
        """Rotations of arms and fingers; they leave for whatever lies below."""
        keys, phase = self.key_positions, moment.phase
        stroke = self._stroke(moment)
        if phase < keys["ready"]:
            done = minimum_jerk(share(phase, 0.0, keys["ready"]))
            return Posed({joint: slerp(self._begin[joint], goal, done) for joint, goal in stroke.items()})
        return Posed(stroke, 1.0 - minimum_jerk(share(phase, keys["relax"], 1.0)) if phase > keys["relax"] else 1.0)

    def preparation(self, body: Body) -> float:
        """How long the hands would like to take to the stroke from where a body has them, s."""
        ready = body.posed(self._animation.sample(self._inner[0], self.parameters, body).rotations)
        return comfortable(body, ready, self.joints)

    def _stroke(self, moment: Moment) -> Mapping[str, Quat]:
        """The animation's pose at a phase, as much of it as is to be shown; while the hands come and go, the same."""
        asked = (self._animation_phase(moment.phase), *self.parameters.values())
        if asked != self._asked or not self._animation.alone:
            self._asked, self._found = asked, self._sampled(asked[0], moment)
        return self._found

    def _sampled(self, phase: float, moment: Moment) -> Mapping[str, Quat]:
        posed = self._animation.sample(phase, self.parameters, moment.body, moment.shown)
        if moment.shown is not None:
            self.fault = self.fault or posed.fault
        amount = self.parameters[AMOUNT]
        if amount == 1.0:
            return posed.rotations
        return {joint: slerp(self._rest.rotation(joint), goal, amount) for joint, goal in posed.rotations.items()}

    def _animation_phase(self, phase: float) -> float:
        """The animation's own phase: its ready until the hands are there, its relax from when they leave."""
        positions = [self.key_positions[point] for point in _INNER]
        for (left, right), (begin, end) in zip(pairwise(positions), pairwise(self._inner), strict=True):
            if phase < right:
                return begin + (end - begin) * share(phase, left, right) if phase > left else begin
        return self._inner[-1]
