"""How pelvis, trunk and arms move with the feet of a walking figure."""

import math
from collections.abc import Mapping, Sequence

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import ROOT, SIDES
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.embodiment.quaternion import Quat, from_euler, multiply, twist
from reactive_realizer.embodiment.vector import UP
from reactive_realizer.engines.animation.easing import share, smoothstep
from reactive_realizer.engines.animation.walking.pelvis_height import PelvisHeight
from reactive_realizer.engines.animation.walking.progression import Axis, Progression
from reactive_realizer.engines.animation.walking.walker import FootPose, Walker

_SWAY = 0.25
"""How far the pelvis goes toward the foot that bears it, as a share of the way to that foot."""

_WIDEST = 0.15
"""Limit of that way, m."""

_SWAY_GAIN = 5.0
"""Speed at which it goes there, per distance, 1/s."""

_GAP = 0.1
"""A figure that was shown longer ago than this sets out anew, s."""

_PELVIS_YAW = 0.16
"""Turn of the pelvis with the foot in front, rad per meter between the feet."""

_PELVIS_ROLL = 1.3
"""Roll of the pelvis toward the foot in the air, rad per meter of its sway."""

_ARM_SWING, _RUNNING_ARM_SWING = 0.5, 0.33
"""Swing of each arm with the foot of the other side, rad per meter between the feet."""

_ASIDE = 0.06
"""How much further arms are raised aside while they swing past the hips, rad."""

_ELBOW, _RUNNING_ELBOW = 0.2, 1.2
"""Bend of the elbows, beside that at rest, rad."""

_FORWARD_ELBOW = 0.7
"""How much further an elbow bends, relative to the swing of its arm to the front."""

_LEAN, _LEAN_TO_START = 0.025, 0.02
"""Lean of the trunk, rad per m/s of speed and per m/s^2 of acceleration."""

_RUNNING_FROM, _RUNNING_AT = 1.4, 2.4
"""Speeds between which a figure begins to move as in running, m/s."""

_RUNNING_GAIN = 8.0
"""How fast it does, also when the manner changes at once, 1/s."""


class Carriage:
    """Moves the upper body with the feet, so that it follows whatever they do.

    Pelvis and arms are functions of the places of the feet: the pelvis turns with the foot in front, and each arm
    swings with the foot of the other side (M. P. Murray and others, "Walking patterns of normal men", Journal of Bone
    and Joint Surgery 46-A, 1964). The amounts are our choice, within human ranges.
    """

    def __init__(self) -> None:
        self._sway = self._running = Axis(0.0)
        self._time, self._passed = GlobalTime(-math.inf), math.inf
        self._height = PelvisHeight()

    def pelvis(self, now: GlobalTime, walker: Walker, rest: Body, walking: float) -> Layer:
        """Return the additive layer of the pelvis, and of the trunk that balances it.

        Args:
            now: s.
            walker: with the feet.
            rest: the body at rest.
            walking: how much of it is to be seen, 0 to 1.
        """
        spots = walker.over_ground()
        apart = spots[1][2] - spots[0][2]
        passed, self._time = now - self._time, now
        self._passed = passed if passed <= _GAP else math.inf
        bearing, runs = walker.bearing, _running(walker.progression)
        sway = 0.0 if bearing is None else _SWAY * max(-_WIDEST, min(_WIDEST, spots[bearing][0]))
        self._sway = _followed(self._sway, sway, _SWAY_GAIN, self._passed, Axis(0.0))
        self._running = _followed(self._running, runs, _RUNNING_GAIN, self._passed, Axis(runs))
        aside = self._sway.at
        forward, change = walker.progression.forward
        yaw, roll = _PELVIS_YAW * apart, _PELVIS_ROLL * aside
        lean = _LEAN * forward + _LEAN_TO_START * change
        down = self._height.swung(apart, spots[0][0] - spots[1][0], self._running.at, walking)
        turns = {
            ROOT: from_euler(0.3 * lean, yaw, roll),
            "vl5": from_euler(0.7 * lean, -yaw, -roll),
            "vt10": from_euler(0.0, -0.6 * yaw, 0.0),
            "vc4": from_euler(-0.8 * lean, 0.6 * yaw, 0.0),
        }
        return Layer(LayerKind.ADDITIVE, turns, root=(aside, -down, 0.0))

    def lowered(self, body: Body, feet: Sequence[FootPose], walking: float) -> Layer:
        """Return the additive layer of the pelvis that goes down for the legs to reach the feet that stand.

        Args:
            body: with the pelvis of `pelvis`, in the same frame.
            feet: left first.
            walking: how much of it is to be seen, 0 to 1.
        """
        return Layer(LayerKind.ADDITIVE, {}, root=(0.0, -self._height.lowered(self._passed, body, feet, walking), 0.0))

    def limbs(self, progression: Progression, feet: Sequence[FootPose], rest: Body) -> Layer:
        """Return the layer of arms, hips and toes.

        Args:
            progression: of the figure.
            feet: left first.
            rest: the body at rest.
        """
        arms = _arms(progression.forward[0], self._running.at, feet, rest)
        turns = {**arms, **_toes(feet, rest), **_hips(feet, rest)}
        return Layer(LayerKind.FULL_BODY, {joint: turn for joint, turn in turns.items() if joint in rest.skeleton})


def _followed(axis: Axis, goal: float, gain: float, passed: float, first: Axis) -> Axis:
    """Return the motion of a value that follows a goal with a gain, 1/s; the first one if it sets out anew."""
    return first if passed == math.inf else axis.driven(gain * (goal - axis.at), 4.0 * gain, passed)


def _arms(speed: float, running: float, feet: Sequence[FootPose], rest: Body) -> Mapping[str, Quat]:
    """Return shoulders and elbows."""
    left, right = (foot.ankle.position[2] for foot in feet)
    swing = (_ARM_SWING + running * (_RUNNING_ARM_SWING - _ARM_SWING)) * (right - left)
    going = smoothstep(share(abs(speed), 0.0, 1.0))
    bent, aside = _ELBOW * going + running * _RUNNING_ELBOW, _ASIDE * going
    turns = {}
    for side, forward, outward in (("l", swing, aside), ("r", -swing, -aside)):
        bend = bent + _FORWARD_ELBOW * max(0.0, forward)
        shoulder, elbow = f"{side}_shoulder", f"{side}_elbow"
        turns[shoulder] = multiply(from_euler(-forward, 0.0, outward), rest.rotation(shoulder))
        turns[elbow] = multiply(from_euler(-bend, 0.0, 0.0), rest.rotation(elbow))
    return turns


def _running(progression: Progression) -> float:
    """Return how much a figure moves as in running, 0 to 1."""
    runs = progression.goal is not None and progression.goal.manner.flies
    return smoothstep(share(progression.forward[0], _RUNNING_FROM, _RUNNING_AT)) if runs else 0.0


def _toes(feet: Sequence[FootPose], rest: Body) -> Mapping[str, Quat]:
    """Return the turns by which the toes stay level while a foot rolls off over its ball."""
    rolled = ((f"{side}_midtarsal", max(0.0, foot.pitch)) for side, foot in zip(SIDES, feet, strict=True))
    return {joint: multiply(from_euler(-pitch, 0.0, 0.0), rest.rotation(joint)) for joint, pitch in rolled}


def _hips(feet: Sequence[FootPose], rest: Body) -> Mapping[str, Quat]:
    """Return the turns by which each knee points halfway to where its foot points."""
    turns = {}
    for side, foot in zip(SIDES, feet, strict=True):
        w, _, y, _ = twist(foot.ankle.rotation, UP)
        joint = f"{side}_hip"
        turns[joint] = multiply(from_euler(0.0, math.atan2(y, w), 0.0), rest.rotation(joint))
    return turns
