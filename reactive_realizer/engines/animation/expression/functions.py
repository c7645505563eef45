"""Functions that formulas may call: those of the language, among them splines and noise, and those of plug-ins."""

import inspect
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from random import Random
from types import MappingProxyType

from reactive_realizer.engine.faults import TwoPlugins
from reactive_realizer.engines.animation.tcb import Side, Tcb
from reactive_realizer.errors import RealizerError


def hermite(x: float, start_speed: float, end_speed: float, *points: float) -> float:
    """A cubic curve through points one unit of x apart, the first at x = 0; constant outside.

    The slope at an inner point is half the difference of its neighbors (Catmull and Rom 1974).

    Args:
        x: position on the curve, 0 to len(points) - 1.
        start_speed: slope at the first point, per unit of x.
        end_speed: slope at the last point, per unit of x.
        points: values, two or more.
    """
    last = len(points) - 1
    if x >= last:
        return points[last]
    if x < 0.0:
        return points[0]
    i = int(x)
    enter = start_speed if i == 0 else 0.5 * (points[i + 1] - points[i - 1])
    leave = end_speed if i + 1 == last else 0.5 * (points[i + 2] - points[i])
    return _cubic(x - i, points[i], points[i + 1], enter, leave)


def tcbspline(t: float, start_speed: float, end_speed: float, *keys: float) -> float:
    """A curve through keys with tension, continuity and bias; constant outside.

    D. Kochanek and R. Bartels, "Interpolating splines with local tension, continuity, and bias control" (SIGGRAPH
    1984), with their correction for unequal intervals. The order of the arguments is AsapRealizer's.

    Args:
        t: position on the curve.
        start_speed: slope at the first key, per first interval.
        end_speed: slope at the last key, per last interval.
        keys: value and time of the first key; value, time, tension, continuity and bias of each inner key; value and
            time of the last. Tension, continuity and bias are from -1 to 1; if all are 0 it is a Catmull-Rom curve.
    """
    values = (keys[0], *keys[2:-2:5], keys[-2])
    times = (keys[1], *keys[3:-2:5], keys[-1])
    right = next((i for i, time in enumerate(times) if time > t), None)
    if right is None:
        return values[-1]
    if right == 0:
        return values[0]
    left = right - 1
    interval = times[right] - times[left]
    enter, leave = start_speed, end_speed
    # Slopes are per interval; the corrections make them equal per unit of t on both sides of a key.
    if left > 0:
        enter = _tangent(values, keys, left, "leaving") * 2.0 * interval / (times[right] - times[left - 1])
    if right + 1 < len(values):
        leave = _tangent(values, keys, right, "arriving") * 2.0 * interval / (times[right + 1] - times[left])
    return _cubic((t - times[left]) / interval, values[left], values[right], enter, leave)


def _tangent(values: Sequence[float], keys: Sequence[float], i: int, side: Side) -> float:
    """Return the slope at an inner key, per interval, on one side of it."""
    before, after = Tcb(*keys[5 * i - 1 : 5 * i + 2]).shares(side)
    return before * (values[i] - values[i - 1]) + after * (values[i + 1] - values[i])


def _cubic(u: float, a: float, b: float, enter: float, leave: float) -> float:
    """Return the cubic from a to b over u from 0 to 1, with slopes at its ends."""
    rest = 1.0 - u
    return rest * rest * ((1.0 + 2.0 * u) * a + u * enter) + u * u * ((1.0 + 2.0 * rest) * b - rest * leave)


_MOST_OCTAVES = 16
"""Limit of octaves; faster ones would not be visible as motion."""


class PerlinNoise:
    """A smooth random function of one number, from -1 to 1, that is 0 at integers and repeats after 256.

    K. Perlin, "Improving noise" (SIGGRAPH 2002), in one dimension: slopes at integers, blended by the quintic
    polynomial whose velocity and acceleration are 0 at both ends.
    """

    def __init__(self, seed: int) -> None:
        """Create noise; equal seeds give equal noise."""
        self._slopes = [(2 * i - 255) / 255 for i in Random(seed).sample(range(256), 256)]

    def __call__(self, x: float) -> float:
        """Return its value at x.

        Raises:
            ValueError: x is not a number.
            OverflowError: x is infinite.
        """
        i = math.floor(x)
        u = x - i
        blend = u * u * u * (10.0 + u * (6.0 * u - 15.0))
        before, after = self._slopes[i % 256] * u, self._slopes[(i + 1) % 256] * (u - 1.0)
        return 2.0 * (before + blend * (after - before))

    def octaves(self, x: float, count: int, persistence: float) -> float:
        """Return the weighted mean of octaves, -1 to 1.

        Each is twice as fast as the one before, with `persistence` times its weight.

        Raises:
            ValueError: the number of octaves is out of range, or the persistence is negative.
        """
        if not 1 <= count <= _MOST_OCTAVES or persistence < 0.0:
            raise ValueError(f"noise has 1 to {_MOST_OCTAVES} octaves, and a persistence of 0 or more")
        weights = [persistence**i for i in range(count)]
        # Octaves are shifted against each other, because all are 0 at integers.
        values = (self(x * 2.0**i + 37.4 * i) for i in range(count))
        return sum(weight * value for weight, value in zip(weights, values, strict=True)) / sum(weights)


@dataclass(frozen=True, slots=True)
class Function:
    """A function, and the numbers of arguments that it accepts.

    Attributes:
        call: a pure function of floats; raises ArithmeticError or ValueError where it has no value.
        accepts: returns whether it takes this number of arguments.
        takes: description of its arguments, for messages.
    """

    call: Callable[..., float]
    accepts: Callable[[int], bool]
    takes: str

    @classmethod
    def of(cls, name: str, call: Callable[..., float]) -> "Function":
        """Wrap a function of a plug-in; an exception means that it has no value there.

        Raises:
            TypeError: it is not a function.
        """
        signature = inspect.signature(call)

        def accepts(given: int) -> bool:
            try:
                signature.bind(*[0.0] * given)
            except TypeError:
                return False
            return True

        def guarded(*arguments: float) -> float:
            try:
                return float(call(*arguments))
            except Exception as problem:
                raise ValueError(f"{name}: {problem}") from problem

        return cls(guarded, accepts, str(signature))


def noise(x: float, points: float) -> float:
    """A smooth curve through random points from 0 to 1 that lie one unit of x apart; it repeats after so many points.

    AsapRealizer's points change each time the program starts; these do not.
    """
    length = int(points)
    if not 1 <= length <= len(_POINTS):
        raise ValueError(f"noise repeats after 1 to {len(_POINTS)} points, not after {points:g}")
    i = math.floor(x)
    near = [_POINTS[(i + step) % length] for step in (-1, 0, 1, 2)]
    return hermite(x - i, 0.5 * (near[2] - near[0]), 0.5 * (near[3] - near[1]), near[1], near[2])


def perlin(x: float, octaves: float = 1.0, persistence: float = 0.5) -> float:
    """Perlin noise, -1 to 1 (`PerlinNoise.octaves`)."""
    return _PERLIN.octaves(x, int(octaves), persistence)


_POINTS: Sequence[float] = [i / 255 for i in Random(0).sample(range(256), 256)]
_PERLIN = PerlinNoise(0)


_OF_ONE: Mapping[str, Callable[[float], float]] = {
    **{name: getattr(math, name) for name in ("sin", "cos", "tan", "asin", "acos", "atan")},
    **{name: getattr(math, name) for name in ("sinh", "cosh", "tanh", "asinh", "acosh", "atanh")},
    **{name: getattr(math, name) for name in ("sqrt", "exp", "log", "log10")},
    "ln": math.log,
    "abs": abs,
    "floor": lambda x: float(math.floor(x)),
    "ceil": lambda x: float(math.ceil(x)),
    "round": lambda x: float(math.floor(x + 0.5)),
}
_OF_TWO: Mapping[str, Callable[[float, float], float]] = {"atan2": math.atan2, "mod": math.fmod}

FUNCTIONS: Mapping[str, Function] = MappingProxyType(
    {
        **{name: Function(call, lambda given: given == 1, "1") for name, call in _OF_ONE.items()},
        **{name: Function(call, lambda given: given == 2, "2") for name, call in _OF_TWO.items()},
        "min": Function(min, lambda given: given >= 2, "2 or more"),
        "max": Function(max, lambda given: given >= 2, "2 or more"),
        "hermite": Function(hermite, lambda given: given >= 5, "x, two speeds and 2 points or more"),
        "tcbspline": Function(
            tcbspline, lambda given: given >= 7 and given % 5 == 2, "t, two speeds, and keys of 2, 5, ..., 5, 2 numbers"
        ),
        "noise": Function(noise, lambda given: given == 2, "x and a number of points"),
        "perlin": Function(perlin, lambda given: 1 <= given <= 3, "x, octaves and persistence, the last two if wanted"),
    }
)
"""Those of the language, and of AsapRealizer's. `log` is the natural one, as in mathematics; there it is `log10`."""


def plugin_functions(calls: Mapping[str, Callable[..., float]]) -> Mapping[str, Function]:
    """Return the functions of plug-ins, by name.

    Raises:
        RealizerError: "two-plugins": the language has a function with this name.
    """
    for name in calls.keys() & {"if", *FUNCTIONS}:
        raise RealizerError(TwoPlugins(name=name, group="functions", known=("the language of formulas", "a plug-in")))
    return {name: Function.of(name, call) for name, call in calls.items()}


CONSTANTS: Mapping[str, float] = {"pi": math.pi, "e": math.e}
