"""The flesh of a figure in a pose, for finding points that are in it: trunk, thighs and head as round shapes."""

import math
from collections.abc import Sequence
from typing import NamedTuple, Protocol

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.girth import SECTIONS, Cone, Girth
from reactive_realizer.embodiment.joints import ROOT, SIDES, TRUNK
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, conjugate, rotate
from reactive_realizer.embodiment.vector import (
    FORWARD,
    UP,
    ZERO,
    Vec3,
    add,
    cross,
    distance,
    dot,
    length,
    rejected,
    scale,
    subtract,
    unit,
)

_STEP = SECTIONS[1] - SECTIONS[0]
_BOTTOM, _TOP = SECTIONS[0], SECTIONS[-1]
_CAP = 0.05
"""Height of the round ends of the trunk, m."""

_BENT = 0.04
"""Room for a trunk that is bent, m."""

_BACK = 0.6
"""Place of the center of a thigh behind its axis, in its radii."""

_NEARLY_ZERO = 1e-9


class Depth(NamedTuple):
    """How deep a point is in flesh, m, negative outside of it, and the direction of the shortest way out."""

    depth: float
    out: Vec3


Contacts = dict[int, Depth]
"""Number of a point -> how deep it is."""


class Ball(NamedTuple):
    """A ball, by center and radius, m."""

    center: Vec3
    radius: float


class Flesh(Protocol):
    """A part of a figure."""

    def ball(self, body: Body) -> Ball:
        """Return a ball in which the part of a body is, in the figure's frame, before it is posed."""
        ...

    def pose(self, body: Body) -> None:
        """Set the body whose part it is from now on."""
        ...

    def contacts(self, points: Sequence[Vec3], radii: Sequence[float], within: float) -> Contacts:
        """Return how deep some balls are in it, or how near to it.

        Args:
            points: their centers in the figure's frame, m.
            radii: m.
            within: distance beyond which they are left out, m.
        """
        ...


def flesh_of(skeleton: Skeleton, girth: Girth) -> tuple[Flesh, ...]:
    """Return the parts of a figure that its skeleton has."""
    thighs = ((f"{side}_hip", f"{side}_knee") for side in SIDES)
    legs = (Thigh(*joints, girth.thigh) for joints in thighs if all(joint in skeleton for joint in joints))
    return (Trunk(skeleton, girth), *legs, Head(girth))


class _Axes(NamedTuple):
    """Axes of a part in the figure's frame, unit vectors: to its left, along it, and to its front."""

    x: Vec3
    y: Vec3
    z: Vec3

    def outward(self, found: Depth) -> Depth:
        """Return a depth whose way out is in these axes, in the figure's frame."""
        deep, (a, b, c) = found
        (x0, x1, x2), (y0, y1, y2), (z0, z1, z2) = self
        return Depth(deep, (a * x0 + b * y0 + c * z0, a * x1 + b * y1 + c * z1, a * x2 + b * y2 + c * z2))


class Thigh:
    """A cone with round ends; its center is near its back, so that what is in it goes out in front or aside."""

    def __init__(self, begin: str, end: str, radii: Cone) -> None:
        self._joints, self._radii = (begin, end), radii
        self._start = ZERO
        self._axes = _Axes(ZERO, ZERO, ZERO)
        self._size = 0.0

    def ball(self, body: Body) -> Ball:
        """See `Flesh`."""
        (hx, hy, hz), (kx, ky, kz) = (body.transform(joint).position for joint in self._joints)
        center = 0.5 * (hx + kx), 0.5 * (hy + ky), 0.5 * (hz + kz)
        return Ball(center, distance(center, (hx, hy, hz)) + (1.0 + _BACK) * max(self._radii))

    def pose(self, body: Body) -> None:
        """See `Flesh`."""
        hip, knee = (body.transform(joint) for joint in self._joints)
        self._start, way = hip.position, subtract(knee.position, hip.position)
        self._size = max(length(way), _NEARLY_ZERO)
        along = scale(way, 1.0 / self._size)
        lateral = _lateral(hip.rotation, along)
        self._axes = _Axes(lateral, along, cross(along, lateral))

    def contacts(self, points: Sequence[Vec3], radii: Sequence[float], within: float) -> Contacts:
        """See `Flesh`."""
        # Written out, as in `Trunk`: calls take longer than what they do.
        found: Contacts = {}
        (sx, sy, sz), (lx, ly, lz), (ux, uy, uz), (fx, fy, fz) = self._start, *self._axes
        size, (begin, end) = self._size, self._radii
        for index, (px, py, pz) in enumerate(points):
            x, y, z = px - sx, py - sy, pz - sz
            along = x * ux + y * uy + z * uz
            inside = 0.0 if along < 0.0 else size if along > size else along
            x, y, z = x - inside * ux, y - inside * uy, z - inside * uz
            thick = begin + inside / size * (end - begin)
            wide = thick + radii[index]
            far = wide + within
            if x * x + y * y + z * z < far * far:
                deep = x * fx + y * fy + z * fz + _BACK * thick
                front = wide + (_BACK if deep > 0.0 else -_BACK) * thick
                depth = _out(x * lx + y * ly + z * lz, along - inside, deep, wide, wide, front)
                if depth.depth > -within:
                    found[index] = self._axes.outward(depth)
        return found


class Head:
    """An ellipsoid in the axes of skullbase."""

    def __init__(self, girth: Girth) -> None:
        self._center, self._size = girth.head, girth.head_size
        self._furthest = max(girth.head_size)
        self._at, self._turn = ZERO, IDENTITY

    def ball(self, body: Body) -> Ball:
        """See `Flesh`."""
        return Ball(body.transform("skullbase").position, length(self._center) + self._furthest)

    def pose(self, body: Body) -> None:
        """See `Flesh`."""
        place = body.transform("skullbase")
        self._turn = place.rotation
        self._at = add(place.position, rotate(place.rotation, self._center))

    def contacts(self, points: Sequence[Vec3], radii: Sequence[float], within: float) -> Contacts:
        """See `Flesh`."""
        found: Contacts = {}
        hx, hy, hz = self._at
        for index, (px, py, pz) in enumerate(points):
            x, y, z = px - hx, py - hy, pz - hz
            far = self._furthest + radii[index] + within
            if x * x + y * y + z * z < far * far:
                depth = self._depth((x, y, z), radii[index])
                if depth.depth > -within:
                    found[index] = depth
        return found

    def _depth(self, way: Vec3, radius: float) -> Depth:
        (x, y, z), (a, b, c) = rotate(conjugate(self._turn), way), self._size
        found = _out(x, y, z, a + radius, b + radius, c + radius)
        return Depth(found.depth, rotate(self._turn, found.out))


class Trunk:
    """A bent tube of half ellipses from the pelvis to the neck, twisted and bent as its joints are.

    Its center is near the spine, so that what is in the belly goes out in front.
    """

    def __init__(self, skeleton: Skeleton, girth: Girth) -> None:
        self._sections = girth.trunk
        self._neck = "vc4" if "vc4" in skeleton else "skullbase"
        below = [joint for joint in skeleton.chain(self._neck) if joint in TRUNK]
        self._chest, self._middle = below[-1], below[len(below) // 2]
        self._widest = max(max(each.side, each.front + each.ahead) for each in girth.trunk) + _BENT
        self._start, self._along, self._size = ZERO, UP, 1.0
        self._lateral: tuple[Vec3, Vec3] = ((1.0, 0.0, 0.0), ZERO)
        self._bend = ZERO
        self._bent_at_rest = 0.0
        self.pose(Body(skeleton))
        self._bent_at_rest = dot(self._bend, FORWARD)

    def ball(self, body: Body) -> Ball:
        """See `Flesh`."""
        (rx, ry, rz), (nx, ny, nz) = body.transform(ROOT).position, body.transform(self._neck).position
        center = 0.5 * (rx + nx), 0.5 * (ry + ny), 0.5 * (rz + nz)
        # The sections go on beyond both ends.
        half = distance(center, (rx, ry, rz)) * (1.0 + 2.0 * max(-_BOTTOM, _TOP - 1.0, 0.0))
        return Ball(center, half + self._widest + _CAP)

    def pose(self, body: Body) -> None:
        """See `Flesh`."""
        pelvis, chest = body.transform(ROOT), body.transform(self._chest)
        self._start = pelvis.position
        way = subtract(body.transform(self._neck).position, self._start)
        self._size = max(length(way), _NEARLY_ZERO)
        self._along = along = scale(way, 1.0 / self._size)
        low, high = (_lateral(each.rotation, along) for each in (pelvis, chest))
        self._lateral = (low, subtract(high, low))
        middle = subtract(body.transform(self._middle).position, self._start)
        share = min(0.9, max(0.1, dot(middle, along) / self._size))
        bend = scale(rejected(middle, along), 1.0 / (share * (1.0 - share)))
        self._bend = subtract(bend, scale(cross(low, along), self._bent_at_rest))

    def contacts(self, points: Sequence[Vec3], radii: Sequence[float], within: float) -> Contacts:
        """See `Flesh`."""
        found: Contacts = {}
        (ux, uy, uz), (sx, sy, sz) = self._along, self._start
        bottom, top = (end * self._size for end in (_BOTTOM, _TOP))
        for index, (px, py, pz) in enumerate(points):
            x, y, z = px - sx, py - sy, pz - sz
            high, radius = x * ux + y * uy + z * uz, radii[index]
            above = high - top if high > top else high - bottom if high < bottom else 0.0
            if abs(above) > _CAP + radius + within:
                continue
            x, y, z = x - high * ux, y - high * uy, z - high * uz
            far = self._widest + radius + within
            if x * x + y * y + z * z < far * far:
                depth, axes = self._depth((x, y, z), high / self._size, above, radius)
                if depth.depth > -within:
                    found[index] = axes.outward(depth)
        return found

    def _depth(self, across: Vec3, share: float, above: float, radius: float) -> tuple[Depth, _Axes]:
        """Return the depth of a ball, in some axes.

        Args:
            across: from the line between root and neck to its center, m.
            share: of this line up to which it is.
            above: height above the upper end, m; negative below the lower end.
            radius: m.
        """
        within = 0.0 if share < 0.0 else 1.0 if share > 1.0 else share
        (lx, ly, lz), (cx, cy, cz) = self._lateral
        lateral = (lx + within * cx, ly + within * cy, lz + within * cz)
        if (size := length(lateral)) > _NEARLY_ZERO:  # else it is twisted by half a turn
            lateral = scale(lateral, 1.0 / size)
        axes = _Axes(lateral, self._along, cross(lateral, self._along))
        place = (share - _BOTTOM) / _STEP
        lower = 0 if place < 0.0 else min(len(SECTIONS) - 2, int(place))
        rest = min(1.0, max(0.0, place - lower))
        (side, front, back, center), upper = self._sections[lower], self._sections[lower + 1]
        bend = within * (1.0 - within)
        x, y, z = across
        bx, by, bz = self._bend
        across = (x - bend * bx, y - bend * by, z - bend * bz)
        deep = dot(across, axes.z) - center - rest * (upper[3] - center)
        thick = front + rest * (upper[1] - front) if deep > 0.0 else back + rest * (upper[2] - back)
        wide = side + rest * (upper[0] - side) + radius
        return _out(dot(across, lateral), above, deep, wide, _CAP + radius, thick + radius), axes


def _lateral(turn: Quat, along: Vec3) -> Vec3:
    """Return the direction to the left of a part, for the rotation of its joint; any if it points along itself."""
    across = rejected(rotate(turn, (1.0, 0.0, 0.0)), along)
    if length(across) < _NEARLY_ZERO:
        across = rejected(rotate(turn, FORWARD), along)
    return unit(across) if length(across) > 0.0 else across


def _out(x: float, y: float, z: float, a: float, b: float, c: float) -> Depth:
    """Return how deep a point is in an ellipsoid with some semi-axes, by the first order of its equation, m."""
    gx, gy, gz = x / (a * a), y / (b * b), z / (c * c)
    slope = math.sqrt(gx * gx + gy * gy + gz * gz)
    if slope < _NEARLY_ZERO:
        return Depth(c, FORWARD)
    far = math.sqrt(x * gx + y * gy + z * gz)
    return Depth((1.0 - far) * far / slope, (gx / slope, gy / slope, gz / slope))
