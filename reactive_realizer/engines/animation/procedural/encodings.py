"""How the keyframes of a procedural animation write rotations."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, from_axis_angle, from_euler, normalize
from reactive_realizer.embodiment.vector import unit


@dataclass(frozen=True, slots=True)
class Encoding:
    """One way to write a rotation as numbers.

    Attributes:
        size: how many numbers.
        mirrored: which of them change their sign in a mirror.
        rotation: from the numbers; raises ArithmeticError where they name no rotation.
    """

    size: int
    mirrored: tuple[int, ...]
    rotation: Callable[[Sequence[float]], Quat]


def _quaternion(values: Sequence[float]) -> Quat:
    w, x, y, z = values
    return normalize((w, x, y, z))


def _axis_angle(values: Sequence[float]) -> Quat:
    x, y, z, angle = values
    return from_axis_angle(unit((x, y, z)), angle) if angle else IDENTITY


def _euler(values: Sequence[float]) -> Quat:
    x, y, z = values
    return from_euler(x, y, z)


ENCODINGS: Mapping[str, Encoding] = MappingProxyType(
    {
        "quaternion": Encoding(4, (2, 3), _quaternion),
        "axisangles": Encoding(4, (1, 2), _axis_angle),
        "euler": Encoding(3, (1, 2), _euler),
    }
)
"""By AsapRealizer's names: w;x;y;z, or the axis x;y;z and the angle about it by the right hand, or the angles of
`from_euler`; rad."""
