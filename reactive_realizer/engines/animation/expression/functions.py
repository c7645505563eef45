"""What a formula may call."""

import inspect
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from random import Random
from types import MappingProxyType

from reactive_realizer.engines.animation.expression.noise import PerlinNoise
from reactive_realizer.engines.animation.expression.splines import hermite, tcbspline
from reactive_realizer.errors import error


@dataclass(frozen=True, slots=True)
class Function:
    """A function and the numbers of arguments it takes.

    Attributes:
        call: of floats, and of nothing else: the same arguments always give the same value. Where it has none it raises
            ArithmeticError or ValueError.
        accepts: whether it takes this number of arguments.
        takes: the same for people.
    """

    call: Callable[..., float]
    accepts: Callable[[int], bool]
    takes: str

    @classmethod
    def of(cls, name: str, call: Callable[..., float]) -> "Function":
        """A function of a plug-in: what it raises means that it has no value there.

        Raises:
            TypeError: it is no function.
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
    """A smooth curve through random points, 0 to 1, that lie one unit of x apart; it repeats after so many points.

    As in AsapRealizer, where the points are others each time that the program is started.
    """
    length = int(points)
    if not 1 <= length <= len(_POINTS):
        raise ValueError(f"noise repeats after 1 to {len(_POINTS)} points, not after {points:g}")
    i = math.floor(x)
    near = [_POINTS[(i + step) % length] for step in (-1, 0, 1, 2)]
    return hermite(x - i, 0.5 * (near[2] - near[0]), 0.5 * (near[3] - near[1]), near[1], near[2])


def perlin(x: float, octaves: float = 1.0, persistence: float = 0.5) -> float:
    """Perlin's noise, -1 to 1 (`PerlinNoise.octaves`)."""
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


def registered(calls: Mapping[str, Callable[..., float]]) -> Mapping[str, Function]:
    """Functions of plug-ins, by name.

    Raises:
        RealizerError: "two-plugins": one is called as a function of the language.
    """
    for name in calls.keys() & {"if", *FUNCTIONS}:
        raise error("two-plugins", name=name, group="functions", known="the language of formulas and a plug-in")
    return {name: Function.of(name, call) for name, call in calls.items()}


CONSTANTS: Mapping[str, float] = {"pi": math.pi, "e": math.e}
