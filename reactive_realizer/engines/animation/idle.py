"""Idle animation: breathing, sway, weight shifts, loose arms, blinks and glances. Without it a figure is frozen."""

import math
from collections.abc import Collection, Mapping
from random import Random

from reactive_realizer.bml.idle_change import IdleParameter
from reactive_realizer.embodiment.joints import EYES, SIDES
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.embodiment.quaternion import Quat, from_axis_angle, from_euler, multiply
from reactive_realizer.embodiment.vector import scale
from reactive_realizer.engines.animation.blinks import USUAL_RATE, Blinks
from reactive_realizer.engines.animation.easing import smoothstep
from reactive_realizer.engines.animation.idle_course import IdleCourse
from reactive_realizer.engines.animation.idle_movements import (
    USUAL_BREATHING,
    USUAL_GLANCES,
    Breath,
    Glances,
    Leaning,
    leaning,
)
from reactive_realizer.engines.animation.idle_waves import Fixation, Looseness
from reactive_realizer.engines.animation.weight_shifts import USUAL_WEIGHT_SHIFTS, WeightShifts

_WAVES = ((0.43, 1.9, 0.0), (0.31, 2.3, 1.0), (0.23, 1.3, 2.0))
"""Sway to the side, forward and about the vertical: for each a slow and a fast wave, rad/s, and their phase, rad."""

_QUICKER = 0.25
"""Share of the faster wave in a sway."""

_STILLING = 0.3
"""Time in which an elbow comes to rest when a motion begins to move its arm, and is loose again afterward, s."""


class Idle:
    """Idle motion as functions of time, but elbows come to rest in arms that move. Other seeds move differently.

    Attributes:
        courses: of its parameters, relative to their usual values.
        shifts: of the weight.
    """

    def __init__(self, random: Random, blink_rate: float = USUAL_RATE, degree: float = 1.0) -> None:
        """Draw all random choices from a generator that must not be shared.

        Args:
            random: the generator.
            blink_rate: blinks per minute; 0 for none.
            degree: how far trunk, head, elbows, fingers and eyes move, 0 to 1; blinks do not depend on it.
        """
        self._degree = degree
        self.courses: Mapping[IdleParameter, IdleCourse] = {
            parameter: IdleCourse(0.0 if parameter is IdleParameter.BLINK_RATE and blink_rate == 0.0 else 1.0)
            for parameter in IdleParameter
        }
        self._blink_rate = blink_rate or USUAL_RATE
        self._breath = Breath(Random(random.getrandbits(64)))
        self._sway = random.uniform(0.0, 100.0)
        blinking = Random(random.getrandbits(64))
        self._blinks = Blinks(blinking, self._blink_rate)
        self.shifts = WeightShifts(Random(random.getrandbits(64)), self.courses[IdleParameter.WEIGHT_SHIFT_RATE])
        self._leant: tuple[float, Leaning] | None = None
        self._glances = Glances(Random(random.getrandbits(64)))
        self._looseness = Looseness(Random(random.getrandbits(64)))
        self._time = 0.0
        # How loose each elbow is, 0 to 1, in even time.
        self._loose = dict.fromkeys(SIDES, 1.0)
        self._fixation = Fixation(Random(random.getrandbits(64)))

    def relative(self, parameter: IdleParameter, value: float) -> float:
        """Return a value of a parameter relative to its usual one."""
        usual = {
            IdleParameter.BREATHING_RATE: USUAL_BREATHING,
            IdleParameter.BLINK_RATE: self._blink_rate,
            IdleParameter.GLANCE_RATE: USUAL_GLANCES,
            IdleParameter.WEIGHT_SHIFT_RATE: USUAL_WEIGHT_SHIFTS,
        }
        return value / usual.get(parameter, 1.0)

    def reset(self, time: float) -> None:
        """Return to the usual values of all parameters."""
        for course in self.courses.values():
            course.reset(time)

    def layer(self, time: float, standing: float, busy: Collection[str] = ()) -> Layer:
        """Return the additive layer at a time.

        Args:
            time: s.
            standing: degree to which the figure may shift its weight, 0 to 1.
            busy: sides ("l", "r") of the arms that motions move: their hands should be where these want them.
        """
        step, self._time = max(0.0, time - self._time) / _STILLING, time
        for side, loose in self._loose.items():
            self._loose[side] = max(0.0, loose - step) if side in busy else min(1.0, loose + step)
        depth = standing * self._degree * self.courses[IdleParameter.WEIGHT_SHIFT_DEPTH].value(time)
        turns, root = self._leaning(depth * self.shifts.at(time) if depth else 0.0)
        rotations = {**turns, **self.rotations(time)}
        for joint, turn in turns.items():
            if rotations[joint] is not turn:
                rotations[joint] = multiply(turn, rotations[joint])
        return Layer(LayerKind.ADDITIVE, rotations, root=root)

    def _leaning(self, side: float) -> Leaning:
        if self._leant is None or self._leant[0] != side:  # a figure stays on its side between weight shifts
            self._leant = side, leaning(side)
        return self._leant[1]

    def rotations(self, time: float) -> dict[str, Quat]:
        """Return breathing, sway and looseness: the chest rises, and no part of the body is ever quite still."""
        degree = self._degree
        rate, depth = self.courses[IdleParameter.BREATHING_RATE], self.courses[IdleParameter.BREATHING_DEPTH]
        air = degree * depth.value(time) * self._breath.air(rate.integral(time))
        side, forth, turn = (degree * _wave(time + self._sway, *wave) for wave in _WAVES)
        loose = {side: degree * smoothstep(each) for side, each in self._loose.items() if each}
        nod, aside, tilt = scale(self._looseness.head(time), 0.5 * degree)
        return {
            "vl5": from_euler(0.006 * forth, 0.008 * turn, 0.006 * side),
            "vt6": from_axis_angle((1.0, 0.0, 0.0), -0.016 * air),
            "l_sternoclavicular": from_axis_angle((0.0, 0.0, 1.0), 0.022 * air),
            "r_sternoclavicular": from_axis_angle((0.0, 0.0, 1.0), -0.022 * air),
            "vc4": from_euler(0.012 * air - 0.006 * forth + nod, aside, tilt - 0.006 * side),
            "skullbase": from_euler(0.006 * forth + nod, 0.010 * turn + aside, 0.004 * side + tilt),
            **self._looseness.elbows(time, loose),
            **self._looseness.fingers(time, degree),
        }

    def eyes(self, time: float) -> dict[str, Quat]:
        """Return the rotations of eyes without a target: glances, microsaccades and drift."""
        self._glances.rate = self.courses[IdleParameter.GLANCE_RATE].value(time)
        (left, up), (further_left, further_up) = self._glances.at(time), self._fixation.at(time)
        turn = from_euler(-self._degree * (up + further_up), self._degree * (left + further_left), 0.0)
        return dict.fromkeys(EYES, turn)

    def blink(self, time: float) -> None:
        """Blink at a time, s, as with a large turn of gaze."""
        if self.courses[IdleParameter.BLINK_RATE].value(time) > 0.0:
            self._blinks.request_blink(time)

    def blinks(self, time: float) -> dict[str, float]:
        """Return the morph weights of blinks at a time, s."""
        rate = self.courses[IdleParameter.BLINK_RATE]
        depth = self.courses[IdleParameter.BLINK_DEPTH].value(time)
        closed = depth * self._blinks.closed(time, rate.integral(time), rate.value(time))
        return {"eyeBlinkLeft": closed, "eyeBlinkRight": closed}


def _wave(time: float, slow: float, quick: float, begin: float) -> float:
    """Return a sway at a time, -1 to 1: almost all of it is below half a cycle per second, without a visible period."""
    return (1.0 - _QUICKER) * math.sin(slow * time + begin) + _QUICKER * math.sin(quick * time + begin)
