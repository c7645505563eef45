"""Where a body in a pose touches the ground."""

from collections.abc import Mapping

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.skeleton import Skeleton
from reactive_realizer.embodiment.vector import Vec3, add, scale

_FLESH = {ROOT: 0.11, "vt6": 0.12, "skullbase": 0.09, "l_knee": 0.06, "r_knee": 0.06}
"""How near these joints come to the ground, m: what is around them, of a body of ordinary size."""

_ANKLES = ("l_ankle", "r_ankle")
_SOLES = (*_ANKLES, "l_midtarsal", "r_midtarsal")


def grounded(body: Body) -> Body:
    """The body with its root where its feet stay in the place that they have in the default pose.

    Whatever is lowest touches the ground: of one who stands or sits the feet, of one who lies the back. The middle
    between the ankles stays where it is. The root of a figure without legs is not moved.
    """
    if not all(ankle in body.skeleton for ankle in _ANKLES):
        return Body(body.skeleton, body.pose)
    default, free = Body(body.skeleton), Body(body.skeleton, body.pose)
    clearances = {**_FLESH, **soles(body.skeleton)}.items()
    up = max(above - free.place(joint).position[1] for joint, above in clearances if joint in body.skeleton)
    (to_x, _, to_z), (x, _, z) = _between_feet(default), _between_feet(free)
    return Body(body.skeleton, body.pose, (to_x - x, up, to_z - z))


def soles(skeleton: Skeleton) -> dict[str, float]:
    """How high the joints of the feet are in the default pose, m: so thick are its soles."""
    default = Body(skeleton)
    return {joint: default.place(joint).position[1] for joint in _SOLES if joint in skeleton}


def depth(body: Body, thick: Mapping[str, float]) -> float:
    """How far the lowest of a body's `soles` is under the ground, m; 0 where none is."""
    return max(0.0, max((high - body.place(joint).position[1] for joint, high in thick.items()), default=0.0))


def _between_feet(body: Body) -> Vec3:
    left, right = (body.place(ankle).position for ankle in _ANKLES)
    return scale(add(left, right), 0.5)
