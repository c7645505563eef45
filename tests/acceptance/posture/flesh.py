"""Clearance between limbs, in frames."""

from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from reactive_realizer.embodiment.body import Body

Vector = npt.NDArray[np.float64]

_LIMBS = {
    "hand": ("wrist", "middle2", 0.02),
    "forearm": ("elbow", "wrist", 0.035),
    "thigh": ("hip", "knee", 0.065),
    "shank": ("knee", "ankle", 0.05),
}
"""Where a limb begins and ends, and how thick it is: the radius of a capsule, m."""

_TRUNK = ("vl5", "vt6", 0.1)
_SAMPLES = np.linspace(0.0, 1.0, 9)[:, np.newaxis]


def deepest_in_legs(bodies: Iterable[Body]) -> float:
    """The largest penetration of a hand or forearm into a thigh or shank, m."""
    return max(
        _depth(body, _limb(arm, side), _limb(leg, other))
        for body in bodies
        for side in "lr"
        for other in "lr"
        for arm in ("hand", "forearm")
        for leg in ("thigh", "shank")
    )


def deepest_in_trunk(bodies: Iterable[Body]) -> float:
    """The largest penetration of a forearm into the trunk, m."""
    return max(_depth(body, _limb("forearm", side), _TRUNK) for body in bodies for side in "lr")


def deepest_in_each_other(bodies: Iterable[Body]) -> float:
    """The largest penetration of a thigh or shank into the other leg, m."""
    pairs = [("thigh", "thigh"), ("thigh", "shank"), ("shank", "thigh"), ("shank", "shank")]
    return max(_depth(body, _limb(left, "l"), _limb(right, "r")) for body in bodies for left, right in pairs)


def _limb(name: str, side: str) -> tuple[str, str, float]:
    begin, end, radius = _LIMBS[name]
    return f"{side}_{begin}", f"{side}_{end}", radius


def _depth(body: Body, a: tuple[str, str, float], b: tuple[str, str, float]) -> float:
    (start, end), (other_start, other_end) = _ends(body, a), _ends(body, b)
    points, way = start + (end - start) * _SAMPLES, other_end - other_start
    along = np.clip((points - other_start) @ way / (way @ way), 0.0, 1.0)[:, np.newaxis]
    gap = np.linalg.norm(points - other_start - along * way, axis=1).min()
    return float(a[2] + b[2] - gap)


def _ends(body: Body, limb: tuple[str, str, float]) -> tuple[Vector, Vector]:
    begin, end = (np.array(body.transform(joint).position) for joint in limb[:2])
    return begin, end
