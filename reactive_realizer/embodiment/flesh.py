"""The flesh of a figure in a pose, for finding points that are in it: trunk, thighs and head as tubes around axes."""

import math
from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from math import atan2, floor
from typing import NamedTuple

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.girth import Girth
from reactive_realizer.embodiment.joints import HEAD, ROOT, SIDES, TRUNK
from reactive_realizer.embodiment.profile import ANGLES, PER_RADIAN, Patch, Profile
from reactive_realizer.embodiment.quaternion import Quat, rotate
from reactive_realizer.embodiment.vector import (
    FORWARD,
    UP,
    ZERO,
    Vec3,
    add,
    cross,
    dot,
    length,
    rejected,
    scale,
    subtract,
    unit,
)

_LEFT: Vec3 = (1.0, 0.0, 0.0)

_CAP = 0.05
"""Height of the blunt ends of trunk and head, m."""

_CORE = 0.5
"""Share of the way from the axis to the surface within which the surface has no effect on the sideways way out."""

_NEARLY_ZERO = 1e-9


class Depth(NamedTuple):
    """How deep a point is in flesh, m, negative outside of it, and the direction of the shortest way out."""

    depth: float
    out: Vec3


Contacts = dict[int, Depth]
"""Number of a point -> how deep it is."""


class Windows(NamedTuple):
    """Where some round things are near to a tube.

    Attributes:
        first: number of bands before the first row of the profile.
        distances: for each thing and each band, the distance from the axis up to which it is near, m.
    """

    first: int
    distances: tuple[tuple[float, ...], ...]


class Flesh(ABC):
    """A part of a figure: a tube around an axis, which may be twisted and bent.

    Args:
        profile: its surface.
        size: length of its axis in the default pose, m.
        blunt: height of its ends, m; None for ends that are half balls.
        behind: how far the axis of the profile is behind this one, m.
        mirrored: whether it is the mirror image of the profile.

    Attributes:
        carriers: joints that carry it, each with how far from there what it carries is at most, m.
    """

    carriers: Mapping[str, float]

    def __init__(
        self,
        profile: Profile,
        size: float,
        blunt: float | None = None,
        behind: float = 0.0,
        *,
        mirrored: bool = False,
    ) -> None:
        self._patches, self._blunt, self._mirrored = profile.patches(size, behind), blunt, mirrored
        # Of all patches of a row: how far away from the axis its surface is, m, and how steep.
        self._rows = [(max(p.farthest for p in line), max(p.steepest for p in line)) for line in self._patches]
        self._bottom, self._step, rows = profile.bottom, profile.step, len(profile.rows)
        self._top = self._bottom + self._step * (rows - 1)
        self._rest = size
        ends = (max(patch.farthest for patch in self._patches[row]) for row in (0, rows))
        self._ends = tuple(1.0 if blunt is None else farthest / blunt for farthest in ends)
        self._room, self._behind = 0.0, behind
        self._thick = behind + (blunt or 0.0) + max(farthest for farthest, _ in self._rows)
        self._start, self._along, self._size = ZERO, UP, 1.0
        self._left, self._front = _LEFT, FORWARD
        self._bend, self._twist = (0.0, 0.0), 0.0

    def windows(self, things: Sequence[tuple[float, float]], within: float) -> Windows:
        """Return where balls, or groups of them, may be near.

        Args:
            things: for each group, the distance of the furthest ball from its middle, m, and the largest radius, m.
            within: distance from the surface within which they are near, m.
        """
        first = 1 + max(math.ceil(self._beyond(reach, radius + within)) for reach, radius in things)
        return Windows(first, tuple(self._distances(first, reach, radius + within) for reach, radius in things))

    def _beyond(self, reach: float, further: float) -> float:
        """Return how far beyond the ends something is near, in bands."""
        end = self._blunt or self._behind + max(patch.farthest for line in self._patches for patch in line)
        return (reach + end + further) / (self._rest * self._step)

    def _distances(self, first: int, reach: float, further: float) -> tuple[float, ...]:
        """Return the distances from the axis up to which something is near, for each band, m.

        Args:
            first: number of bands before the first row.
            reach: its size around its middle, m.
            further: distance from the surface within which it is near, m.
        """
        rows, band = len(self._patches), self._rest * self._step
        far = [reach + max(each.outermost + each.steepest * further for each in line) for line in self._patches]
        # The axis is a little shorter in a trunk that is bent, and numbers are rounded toward the first row.
        side = math.ceil(1.2 * reach / band + 0.2)
        distances = []
        for at in range(-first, rows + first):
            low, high = min(max(0, at - side), rows - 1), max(min(rows - 1, at + side), 0)
            distance, beyond = max(far[low : high + 1]), band * max(0.0, -at - 0.5, at - rows + 1.5)
            if self._blunt is None:  # the ends are half balls
                distance = math.sqrt(max(0.0, distance * distance - beyond * beyond))
            distances.append(distance)
        return tuple(distances)

    def near(self, places: Sequence[Vec3], windows: Windows) -> int:
        """Return which of the things may be near, once the axis is set (`find`): bit n for thing n.

        Args:
            places: their middles, m.
            windows: where they are near.
        """
        found = 0
        (sx, sy, sz), (ux, uy, uz), room = self._start, self._along, self._room
        first, all_distances = windows
        bands, per_band = len(all_distances[0]), 1.0 / (self._size * self._step)
        offset = first + 0.5 - self._bottom / self._step
        bit = 1
        for (x, y, z), distances in zip(places, all_distances, strict=True):
            x, y, z = x - sx, y - sy, z - sz
            high = x * ux + y * uy + z * uz
            band = high * per_band + offset
            if 0.0 <= band < bands:
                far = distances[int(band)] + room
                if x * x + y * y + z * z - high * high < far * far:
                    found |= bit
            bit += bit
        return found

    @abstractmethod
    def find(self, body: Body) -> None:
        """Set where the axis is in a body, and how it is bent."""

    @abstractmethod
    def pose(self, body: Body) -> None:
        """Set the directions about the axis, after `find`."""

    def contacts(
        self, points: Sequence[Vec3], radii: Sequence[float], within: float, which: Iterable[int] | None = None
    ) -> Contacts:
        """Return how deep some balls are in it, or how near to it.

        Args:
            points: their centers in the figure's frame, m.
            radii: m.
            within: distance beyond which they are left out, m.
            which: numbers of those to look at; all if it is not given.
        """
        # Written out: calls take longer than what they do.
        found: Contacts = {}
        (sx, sy, sz), (ux, uy, uz), (lx, ly, lz), (fx, fy, fz) = self._start, self._along, self._left, self._front
        (bx, bz), twist, size, patches, rows = self._bend, self._twist, self._size, self._patches, self._rows
        behind = self._behind
        per_size, offset, last = 1.0 / size, 0.5 - self._bottom / self._step, len(self._patches) - 1
        per_row = per_size / self._step
        for index in range(len(points)) if which is None else which:
            px, py, pz = points[index]
            x, y, z = px - sx, py - sy, pz - sz
            high = x * ux + y * uy + z * uz
            across, ahead = x * lx + y * ly + z * lz, x * fx + y * fy + z * fz + behind
            share = 0.0
            if bx or bz:
                share = high * per_size
                share = 0.0 if share < 0.0 else 1.0 if share > 1.0 else share
                bent = share * (1.0 - share)
                across, ahead = across - bent * bx, ahead - bent * bz
            place = high * per_row + offset
            row = 0 if place < 0.0 else last if place > last else int(place)
            farthest, steepest = rows[row]
            around, off = radii[index] + within, across * across + ahead * ahead
            far = farthest + steepest * around
            if off >= far * far:
                continue
            turn = (atan2(across, ahead) - share * twist) * PER_RADIAN + 0.5
            column = floor(turn)
            patch = patches[row][column % ANGLES]
            far = patch.farthest + patch.steepest * around
            if off < far * far:
                along = place - row
                along = 0.0 if along < 0.0 else 1.0 if along > 1.0 else along
                depth = self._depth(patch, (along, turn - column), (across, high, ahead), radii[index])
                if depth.depth > -within:
                    found[index] = depth
        return found

    def _depth(self, patch: Patch, shares: tuple[float, float], place: Vec3, radius: float) -> Depth:
        """Return the depth of a ball.

        Args:
            patch: of the surface beside it.
            shares: of the patch along and around the axis.
            place: of its center: to the left of the axis, along it, and in front of it, m.
            radius: m.
        """
        (u, v), (across, high, ahead), size = shares, place, self._size
        c00, c01, c02, c10, c11, c12, c20, c21, c22 = patch.terms
        a, b, c = c00 + v * (c01 + v * c02), c10 + v * (c11 + v * c12), c20 + v * (c21 + v * c22)
        surface, along = a + u * (b + u * c), (b + 2.0 * u * c) / (self._step * size)
        around = c01 + 2.0 * v * c02 + u * (c11 + 2.0 * v * c12 + u * (c21 + 2.0 * v * c22))
        around *= PER_RADIAN
        off = math.sqrt(across * across + ahead * ahead)
        rise, from_axis = 0.0, off
        if not self._bottom * size < high < self._top * size:
            lower, upper = self._ends
            end, blunt = (self._bottom, lower) if high < self._bottom * size else (self._top, upper)
            rise = blunt * (high - end * size)
            from_axis = math.sqrt(off * off + rise * rise)
            rise *= blunt
        if from_axis < _NEARLY_ZERO:
            return Depth(surface + radius, self._front)
        # The gradient of the distance from the surface, in the axes of the part.
        radial, lift = off / from_axis, rise / from_axis - along
        sideways = -around / max(off, _CORE * surface)
        slope = math.sqrt(radial * radial + sideways * sideways + lift * lift)
        if off > _NEARLY_ZERO:
            across, ahead = across / off, ahead / off
        else:
            across, ahead = 0.0, 1.0
        to_left, to_front = radial * across + sideways * ahead, radial * ahead - sideways * across
        (lx, ly, lz), (ux, uy, uz), (fx, fy, fz) = self._left, self._along, self._front
        to_left, lift, to_front = to_left / slope, lift / slope, to_front / slope
        out = (
            to_left * lx + lift * ux + to_front * fx,
            to_left * ly + lift * uy + to_front * fy,
            to_left * lz + lift * uz + to_front * fz,
        )
        return Depth((surface - from_axis) / slope + radius, out)

    def _set_axis(self, start: Vec3, end: Vec3) -> None:
        (sx, sy, sz), (ex, ey, ez) = start, end
        x, y, z = ex - sx, ey - sy, ez - sz
        self._size = size = math.sqrt(x * x + y * y + z * z) or _NEARLY_ZERO
        self._start, self._along = start, (x / size, y / size, z / size)


class Thigh(Flesh):
    """A thigh, around the line from hip to knee."""

    def __init__(self, skeleton: Skeleton, side: str, girth: Girth) -> None:
        self._joints = f"{side}_hip", f"{side}_knee"
        size = length(skeleton.offset(self._joints[1]))
        super().__init__(girth.thigh, size, behind=girth.behind, mirrored=side == "r")
        self.carriers = {self._joints[0]: size + self._thick}

    def find(self, body: Body) -> None:
        """See `Flesh`."""
        hip, knee = self._joints
        self._set_axis(body.transform(hip).position, body.transform(knee).position)

    def pose(self, body: Body) -> None:
        """See `Flesh`."""
        left = _lateral(body.transform(self._joints[0]).rotation, self._along)
        self._front = cross(self._along, left)
        self._left = scale(left, -1.0) if self._mirrored else left


class Head(Flesh):
    """A head, around an upward line in the axes of skullbase."""

    def __init__(self, girth: Girth) -> None:
        super().__init__(girth.head, girth.head_size, _CAP)
        self._chin, self._height = girth.chin, girth.head_size
        self.carriers = {HEAD[1]: length(self._chin) + self._height + self._thick}

    def find(self, body: Body) -> None:
        """See `Flesh`."""
        place = body.transform(HEAD[1])
        self._along = rotate(place.rotation, UP)
        self._start, self._size = add(place.position, rotate(place.rotation, self._chin)), self._height

    def pose(self, body: Body) -> None:
        """See `Flesh`."""
        turn = body.transform(HEAD[1]).rotation
        self._left, self._front = rotate(turn, _LEFT), rotate(turn, FORWARD)


class Trunk(Flesh):
    """A trunk, around the line from the root to the neck, twisted and bent as its joints are."""

    def __init__(self, skeleton: Skeleton, girth: Girth) -> None:
        self._neck = HEAD[0] if HEAD[0] in skeleton else HEAD[1]
        below = [joint for joint in skeleton.chain(self._neck) if joint in TRUNK]
        self._chest, self._middle = below[-1], below[len(below) // 2]
        body = Body(skeleton)
        way = subtract(body.transform(self._neck).position, body.transform(ROOT).position)
        super().__init__(girth.trunk, max(length(way), _NEARLY_ZERO), _CAP)
        self.carriers = {self._neck: self._thick}
        self._bent_at_rest = (0.0, 0.0)
        self.find(body)
        self._bent_at_rest = self._bend

    def find(self, body: Body) -> None:
        """See `Flesh`."""
        root = body.transform(ROOT)
        self._set_axis(root.position, body.transform(self._neck).position)
        along = self._along
        self._left = left = _lateral(root.rotation, along)
        self._front = front = cross(left, along)
        middle = subtract(body.transform(self._middle).position, self._start)
        share = min(0.9, max(0.1, dot(middle, along) / self._size))
        (x, z), bent = self._bent_at_rest, 1.0 / (share * (1.0 - share))
        x, z = bent * dot(middle, left) - x, bent * dot(middle, front) - z
        self._bend, self._room = (x, z), 0.25 * math.sqrt(x * x + z * z)

    def pose(self, body: Body) -> None:
        """See `Flesh`."""
        along, low = self._along, self._left
        high = _lateral(body.transform(self._chest).rotation, along)
        self._twist = math.atan2(dot(cross(low, high), along), dot(low, high))


def flesh_of(skeleton: Skeleton, girth: Girth) -> tuple[Flesh, ...]:
    """Return the parts of a figure that its skeleton has."""
    legs = (side for side in SIDES if f"{side}_hip" in skeleton and f"{side}_knee" in skeleton)
    return (Trunk(skeleton, girth), *(Thigh(skeleton, side, girth) for side in legs), Head(girth))


def _lateral(turn: Quat, along: Vec3) -> Vec3:
    """Return the direction to the left of a part, for the rotation of its joint; any if it points along itself."""
    (w, x, y, z), (ux, uy, uz) = turn, along
    lx, ly, lz = 1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)
    part = lx * ux + ly * uy + lz * uz
    lx, ly, lz = lx - part * ux, ly - part * uy, lz - part * uz
    size = math.sqrt(lx * lx + ly * ly + lz * lz)
    if size > _NEARLY_ZERO:
        return (lx / size, ly / size, lz / size)
    across = rejected(rotate(turn, FORWARD), along)
    return unit(across) if length(across) > 0.0 else across
