"""How pelvis, trunk and arms move with the feet of a walking figure."""

import math
from collections.abc import Mapping, Sequence

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.feet import reach
from reactive_realizer.embodiment.joints import ROOT, SIDES
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.embodiment.quaternion import Quat, from_euler, multiply, twist
from reactive_realizer.embodiment.vector import UP, Vec3, subtract
from reactive_realizer.engines.animation.easing import share, smoothstep
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

_PENDULUM, _DEEPEST = 0.09, 0.06
"""How much lower the pelvis is with the feet apart, 1/m (it grows with their squared distance), and its limit, m."""

_WIDE_PENDULUM = 0.3
"""The same for feet that are aside of where they are at rest, 1/m."""

_BENT = 0.012
"""How much lower the pelvis is in walking than the legs would need, m: knees are never locked."""

_SOFTNESS = 0.012
"""Softness with which the pelvis is lowered for a leg that would not reach its foot, m."""

_FREELY, _LOWEST = 0.06, 0.12
"""Lowering of the pelvis for legs that do not reach their feet: where its limit begins to act, and the limit, m.

A foot that is still not reached is dragged along. Without a limit, a fast figure that turns would sink to its knees."""

_PELVIS_YAW = 0.16
"""Turn of the pelvis with the foot in front, rad per meter between the feet."""

_PELVIS_ROLL = 1.3
"""Roll of the pelvis toward the foot in the air, rad per meter of its sway."""

_ARM_SWING, _RUNNING_ARM_SWING = 0.55, 0.75
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
"""Speeds between which the arms begin to move as in running, m/s."""


class Carriage:
    """Moves the upper body with the feet, so that it follows whatever they do.

    Pelvis and arms are functions of the places of the feet: the pelvis turns with the foot in front, is lowest when the
    feet are apart, as an inverted pendulum, and each arm swings with the foot of the other side (M. P. Murray and
    others, "Walking patterns of normal men", Journal of Bone and Joint Surgery 46-A, 1964). The amounts are our choice,
    within human ranges.
    """

    def __init__(self) -> None:
        self._sway = Axis(0.0)
        self._time = GlobalTime(0.0)

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
        aside = self._aside(now, spots, walker.bearing)
        forward, change = walker.progression.forward
        yaw, roll = _PELVIS_YAW * apart, _PELVIS_ROLL * aside
        lean = _LEAN * forward + _LEAN_TO_START * change
        wide = max(0.0, spots[0][0] - spots[1][0] - 2.0 * _WIDEST)
        down = min(_DEEPEST, _BENT * walking + _PENDULUM * apart * apart + _WIDE_PENDULUM * wide * wide)
        turns = {
            ROOT: from_euler(0.3 * lean, yaw, roll),
            "vl5": from_euler(0.7 * lean, -yaw, -roll),
            "vt10": from_euler(0.0, -0.6 * yaw, 0.0),
            "vc4": from_euler(-0.8 * lean, 0.6 * yaw, 0.0),
        }
        return Layer(LayerKind.ADDITIVE, turns, root=(aside, -down, 0.0))

    def _aside(self, now: GlobalTime, spots: Sequence[Vec3], bearing: int | None) -> float:
        """Return how far the pelvis is to the left, m."""
        passed, self._time = now - self._time, now
        if passed > _GAP:
            self._sway, passed = Axis(0.0), 0.0
        goal = 0.0 if bearing is None else _SWAY * max(-_WIDEST, min(_WIDEST, spots[bearing][0]))
        self._sway = self._sway.driven(_SWAY_GAIN * (goal - self._sway.at), 4.0 * _SWAY_GAIN, passed)
        return self._sway.at


def lowering(body: Body, feet: Sequence[FootPose], walking: float) -> float:
    """Return how much lower the pelvis goes for the legs to reach the feet that stand, m; at most `_LOWEST`."""
    softness = max(1e-4, _SOFTNESS * walking)
    needed = sum(
        foot.bears * _softly(_lacking(body, side, foot), softness) for side, foot in zip(SIDES, feet, strict=True)
    )
    if needed <= _FREELY:
        return needed
    return _LOWEST - (_LOWEST - _FREELY) * math.exp((_FREELY - needed) / (_LOWEST - _FREELY))


def _lacking(body: Body, side: str, foot: FootPose) -> float:
    """Return how much lower the pelvis must be for a leg to reach its foot, m; negative if the leg reaches it."""
    x, y, z = subtract(body.transform(f"{side}_hip").position, foot.ankle.position)
    return y - math.sqrt(max(0.0, reach(body.skeleton, side) ** 2 - x * x - z * z))


def _softly(lacking: float, softness: float) -> float:
    """Return a length, or nearly 0 if it is negative."""
    return lacking if lacking > 30.0 * softness else softness * math.log1p(math.exp(lacking / softness))


def limbs(progression: Progression, feet: Sequence[FootPose], rest: Body) -> Layer:
    """Return the layer of arms, hips and toes.

    Args:
        progression: of the figure.
        feet: left first.
        rest: the body at rest.
    """
    turns = {**_arms(progression, feet, rest), **_toes(feet, rest), **_hips(feet, rest)}
    return Layer(LayerKind.FULL_BODY, {joint: turn for joint, turn in turns.items() if joint in rest.skeleton})


def _arms(progression: Progression, feet: Sequence[FootPose], rest: Body) -> Mapping[str, Quat]:
    """Return shoulders and elbows."""
    left, right = (foot.ankle.position[2] for foot in feet)
    apart, speed = right - left, progression.forward[0]
    runs = progression.goal is not None and progression.goal.manner.flies
    running = smoothstep(share(speed, _RUNNING_FROM, _RUNNING_AT)) if runs else 0.0
    swing = _ARM_SWING + running * (_RUNNING_ARM_SWING - _ARM_SWING)
    going = smoothstep(share(abs(speed), 0.0, 1.0))
    bent, aside = _ELBOW * going + running * _RUNNING_ELBOW, _ASIDE * going
    turns = {}
    for side, forward, outward in (("l", swing * apart, aside), ("r", -swing * apart, -aside)):
        bend = bent + _FORWARD_ELBOW * max(0.0, forward)
        shoulder, elbow = f"{side}_shoulder", f"{side}_elbow"
        turns[shoulder] = multiply(from_euler(-forward, 0.0, outward), rest.rotation(shoulder))
        turns[elbow] = multiply(from_euler(-bend, 0.0, 0.0), rest.rotation(elbow))
    return turns


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
