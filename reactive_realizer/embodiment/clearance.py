"""Keeps the hands and forearms of a figure out of its own trunk, thighs and head.

Each pose is changed by itself, whatever came before: an arm that is in flesh goes out by the shortest way, by a turn
of its shoulder and a bend of its elbow, and the elbow swivels where the forearm is in the way. The way out begins
softly before the skin, so that a hand that comes near slides along the body, and does not stop at it.

After M. Müller and others, "Position based dynamics" (2007): each contact moves both ends of the forearm by as little
as possible.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from types import MappingProxyType
from typing import NamedTuple

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.flesh import Contacts, Flesh, Windows, flesh_of
from reactive_realizer.embodiment.girth import FOREARM, Girth, girth_of
from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.embodiment.posed_arm import HAND, STAYING, ArmLinks, PosedArm, Shift
from reactive_realizer.embodiment.quaternion import Quat, slerp
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, scale

MARGIN = 0.015
"""Distance from the skin at which the way out begins, m."""

_YIELDING = 0.003
"""Depth to which a hand that wants to be deep in flesh is in it, m: the skin gives way."""

_SOFTLY = MARGIN + _YIELDING
"""Depth around that within which the way out begins, m."""

_FAR = 0.005
"""Way out up to which one step of the solution is enough, m."""

_MORE = 16
"""Most further steps of the solution, after the first one: what leaves a thigh may enter the trunk, and the reverse."""

_LONGER = 1.5
"""Length of these steps, in ways out: a step for all points of an arm is shorter than the deepest one needs."""

_NOTHING = 1e-7
"""m²"""

ALL_THE_WAY: Mapping[str, float] = MappingProxyType(dict.fromkeys(SIDES, 1.0))
"""Shares of their ways out for arms that do not point."""

Clear = Callable[[Body, float], Body]
"""Returns a body with its arms out of its flesh, and away from it, m (`Clearance`)."""


class Clearance:
    """Keeps the arms of a figure out of its body; not for several threads at once.

    Args:
        skeleton: of the figure.
        girth: its thickness.

    Attributes:
        parts: its trunk, thighs and head.
        arms: "l" and "r" -> the arm.
    """

    def __init__(self, skeleton: Skeleton, girth: Girth) -> None:
        self.parts = flesh_of(skeleton, girth)
        self.arms = {side: ArmLinks.of(skeleton, side, girth) for side in SIDES}
        self._moving = skeleton.carried(links.shoulder for links in self.arms.values())
        self._windows: dict[tuple[str, float], tuple[Windows, ...]] = {}

    @staticmethod
    @lru_cache(64)
    def of(avatar: Avatar) -> "Clearance":
        """Return the clearance of an avatar, which all its figures share."""
        return Clearance(avatar.skeleton, girth_of(avatar))

    def __call__(self, body: Body, away: float = 0.0, shares: Mapping[str, float] = ALL_THE_WAY) -> Body:
        """Return a body with both arms out of its flesh; the same one if they are.

        Args:
            body: in any pose.
            away: distance from flesh that they keep, m.
            shares: "l" and "r" -> how much of its way out an arm goes, 0 to 1; an arm that is left out stays.
        """
        for part in self.parts:
            part.find(body)
        turns: dict[str, Quat] = {}
        for side, share in shares.items():
            near = self._near(body, side, away) if share > 0.0 else ()
            if near and (look := _look(body, self.arms[side], near, away)) is not None:
                turns |= _turns(body, look, share)
        return body.turned(turns, self._moving) if turns else body

    def deepest(self, body: Body) -> float:
        """Return how deep a hand or a forearm is in flesh, m; if none is, at least -`MARGIN`."""
        for part in self.parts:
            part.find(body)
            part.pose(body)
        found = (
            each.depth
            for links in self.arms.values()
            for part in self.parts
            for each in part.contacts(
                (*links.forearm_points(body), *links.hand_points(body)), links.radii, MARGIN
            ).values()
        )
        return max(found, default=-MARGIN)

    def room(self, body: Body, side: str, most: float) -> float:
        """Return how far an arm may approach flesh until it is moved out of it, m; negative if it is.

        Args:
            body: in any pose.
            side: of the arm, "l" or "r".
            most: up to which it is measured, m.
        """
        for part in self.parts:
            part.find(body)
        look = _look(body, self.arms[side], self._near(body, side, most), most)
        contacts = () if look is None else look.contacts.values()
        return most - MARGIN - max((each.depth for found in contacts for each in found.values()), default=-MARGIN)

    def _near(self, body: Body, side: str, away: float) -> "_Near":
        """Return the parts that may be near to an arm, in the pose of a body in which they have been found."""
        balls = self.arms[side].balls(body)
        windows = self._windows.get((side, away)) or self._watch(side, away)
        near = [
            (part, groups) for part, own in zip(self.parts, windows, strict=True) if (groups := part.near(balls, own))
        ]
        for part, _ in near:
            part.pose(body)
        return near

    def _watch(self, side: str, away: float) -> tuple[Windows, ...]:
        """Return where an arm is near to each part from which it keeps some distance, m."""
        links = self.arms[side]
        groups = [
            (reach, max((links.radii[index] for index in group), default=0.0))
            for reach, group in zip(links.reaches, links.groups, strict=True)
        ]
        self._windows[side, away] = tuple(part.windows(groups, MARGIN + away) for part in self.parts)
        return self._windows[side, away]


_Near = list[tuple[Flesh, int]]
"""Parts that are near to an arm, and the groups of its points to which they are: bit n for group n."""


class _Look(NamedTuple):
    """What is known of an arm that is near to flesh.

    Attributes:
        links: its joints.
        points: that are kept clear, m.
        radii: of these points, m.
        contacts: the parts that it is near to, and the points that are.
    """

    links: ArmLinks
    points: Sequence[Vec3]
    radii: Sequence[float]
    contacts: Mapping[Flesh, Contacts]


def _look(body: Body, links: ArmLinks, parts: _Near, away: float) -> _Look | None:
    """Return where an arm is in flesh, or near to it; None if it is not.

    Args:
        body: in any pose; the parts have it.
        links: the arm.
        parts: that may be near to it.
        away: distance from flesh that it keeps, m.
    """
    points = links.forearm_points(body)
    radii = [radius + away for radius in links.radii] if away else links.radii
    contacts: dict[Flesh, Contacts] = {}
    for part, groups in parts:
        if groups & HAND and len(points) == len(FOREARM):
            points += links.hand_points(body)
        if found := part.contacts(points, radii, MARGIN, links.spans[groups]):
            contacts[part] = found
    if not contacts:
        return None
    if len(points) == len(FOREARM):
        points += links.hand_points(body)
    return _Look(links, points, radii, contacts)


def _turns(body: Body, look: _Look, share: float) -> dict[str, Quat]:
    """Return the rotations with which an arm has gone a share of its way out of flesh."""
    arm = start = PosedArm.of(body, look.links, look.points)
    shares, furthest, left = look.links.shares, 0.0, {}
    for part, near in look.contacts.items():
        # What leaves one part may leave another one, too.
        found = near if arm is start else part.contacts(arm.points, look.radii, MARGIN)
        ways = {index: _way(each.depth) for index, each in found.items()}
        left[part] = {index: max(0.0, found[index].depth - way) for index, way in ways.items()}
        arm = arm.shifted(_shift(found, ways, shares))
        furthest = max((furthest, *ways.values()))
    for _ in range(_MORE if furthest > _FAR else 0):
        before = arm
        for part, deep in left.items():
            found = part.contacts(arm.points, look.radii, 0.0)
            ways = {index: _LONGER * max(0.0, each.depth - deep.get(index, 0.0)) for index, each in found.items()}
            arm = arm.shifted(_shift(found, ways, shares))
        if arm is before:
            break
    turns = {arm.links.shoulder: arm.shoulder, arm.links.elbow: arm.elbow}
    if share == 1.0:
        return turns
    return {joint: slerp(body.rotation(joint), turn, share) for joint, turn in turns.items()}


def _shift(contacts: Contacts, ways: Mapping[int, float], shares: Sequence[float]) -> Shift:
    """Return where a forearm should go, so that its points go out on their ways; the deeper ones count for more.

    Args:
        contacts: where each point leaves the part that it is in.
        ways: of these points, m.
        shares: of the forearm at which the points are.
    """
    total = sum(way * way for way in ways.values()) if ways else 0.0
    if total < _NOTHING:
        return STAYING
    elbow = wrist = ZERO
    for index, way in ways.items():
        if way > 0.0:
            share, out = shares[index], contacts[index].out
            gain = way * way * way / (total * (share * share + (1.0 - share) * (1.0 - share)))
            elbow = add(elbow, scale(out, gain * (1.0 - share)))
            wrist = add(wrist, scale(out, gain * share))
    return Shift(elbow, wrist)


def _way(deep: float) -> float:
    """Return how far a point at a depth goes out, m."""
    beyond = deep - _YIELDING
    if beyond >= _SOFTLY:
        return beyond
    return (beyond + _SOFTLY) ** 2 / (4.0 * _SOFTLY)
