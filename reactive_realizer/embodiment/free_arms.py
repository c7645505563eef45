"""Tells which arms cannot have come near to the figure's own body since they were last seen far from it.

Conservative advancement (B. Mirtich, "Impulse-based dynamic simulation of rigid body systems", 1996): what is far apart
need not be looked at again before it can have met. Arms that hang or rest move little from one frame to the next.
"""

from collections.abc import Iterable, Mapping
from math import dist
from operator import itemgetter
from typing import NamedTuple

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.clearance import Clearance
from reactive_realizer.embodiment.joints import ROOT, SIDES
from reactive_realizer.embodiment.posed_arm import ArmLinks
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.vector import length

_FARTHEST = 0.05
"""Distance from flesh up to which it is measured how far an arm is from it, m."""

_SHARE = 0.5
"""Share of this distance that an arm may approach: it is a first-order estimate (`Flesh.contacts`)."""

_SLOW = 0.002
"""Largest movement of an arm in a frame, m, up to which measuring its distance saves time."""

_Turns = tuple[Quat, ...]
"""Rotations of the joints that move an arm or flesh."""


class _Seen(NamedTuple):
    """An arm as it was last looked at.

    Attributes:
        turns: of the joints that move it or flesh, then.
        room: how far arm and flesh may approach each other from there, m; 0 if that is not known.
    """

    turns: _Turns
    room: float


_UNKNOWN = _Seen((), 0.0)


class FreeArms:
    """Keeps arms clear of the body as `Clearance` does, but does not look at those that are still free.

    Args:
        clearance: of the figure.
        skeleton: of the figure.
    """

    def __init__(self, clearance: Clearance, skeleton: Skeleton) -> None:
        self._clearance = clearance
        levers = {side: _levers(skeleton, clearance, links) for side, links in clearance.arms.items()}
        self._levers = {side: tuple(each.values()) for side, each in levers.items()}
        self._turns = {side: itemgetter(*each) for side, each in levers.items()}
        self._seen = dict.fromkeys(SIDES, _UNKNOWN)
        self._present: dict[str, _Turns] = dict.fromkeys(SIDES, ())

    def __call__(self, body: Body, shares: Mapping[str, float]) -> Body:
        """Return a body with both arms out of its flesh, as `Clearance` does; the same one if they are.

        Args:
            body: of the next frame, with a rotation for each joint.
            shares: "l" and "r" -> how much of its way out an arm goes, 0 to 1.
        """
        before, self._present = self._present, {side: turns(body.pose) for side, turns in self._turns.items()}
        looked = {side: share for side, share in shares.items() if not self._still_free(side)}
        if not looked:
            return body
        clear = self._clearance(body, shares=looked)
        for side in looked:
            slow = before[side] and not self._farther(side, before[side], _SLOW)
            shoulder = self._clearance.arms[side].shoulder
            free = slow and clear.rotation(shoulder) is body.rotation(shoulder)
            self._seen[side] = self._measured(side, body) if free else _UNKNOWN
        return clear

    def _still_free(self, side: str) -> bool:
        turns, room = self._seen[side]
        return room > 0.0 and not self._farther(side, turns, room)

    def _farther(self, side: str, before: _Turns, way: float) -> bool:
        """Return whether arm and flesh can have approached each other by more than a way, m, since a former pose."""
        for old, new, lever in zip(before, self._present[side], self._levers[side], strict=True):
            if old is not new:
                way -= lever * dist(old, new)
                if way < 0.0:
                    return True
        return False

    def _measured(self, side: str, body: Body) -> _Seen:
        return _Seen(self._present[side], _SHARE * self._clearance.room(body, side, _FARTHEST))


def _levers(skeleton: Skeleton, clearance: Clearance, links: ArmLinks) -> dict[str, float]:
    """Return the joints that move an arm or flesh, and by how much, m, for a change of their quaternions by 1, at most.

    A turn by an angle a moves what is at a distance d from a joint by 2 d sin(a/2), which is less than 2 d times the
    length of the difference of quaternions, 2 sin(a/4). The root moves both alike.
    """
    thickest = max(links.radii)
    arm = {joint: thickest + max(map(length, points), default=0.0) for joint, points in links.hand}
    carried = _distances(skeleton, arm.items())
    flesh = _distances(skeleton, (carrier for part in clearance.parts for carrier in part.carriers.items()))
    joints = (joint for joint in {**carried, **flesh} if joint != ROOT)  # first those that move most
    return {joint: 2.0 * (carried.get(joint, 0.0) + flesh.get(joint, 0.0)) for joint in joints}


def _distances(skeleton: Skeleton, ends: Iterable[tuple[str, float]]) -> dict[str, float]:
    """Return how far what joints carry is from them at most, m, for what some of them carry directly."""
    distances: dict[str, float] = {}
    for end, far in ends:
        for joint, offset in reversed(skeleton.links(end)):
            distances[joint] = max(distances.get(joint, 0.0), far)
            far += length(offset)
    return distances
