"""Skeletons, and bodies: a skeleton in a pose, with forward kinematics."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from reactive_realizer.embodiment.quaternion import IDENTITY, Quat
from reactive_realizer.embodiment.vector import ZERO, Vec3

JointRotations = Mapping[str, Quat]
"""Joint name -> rotation local to the parent; joints that are left out are in the default pose."""


_transform = tuple.__new__  # three times as fast as Transform()


class Transform(NamedTuple):
    """Position and rotation of a joint in the figure's frame.

    Attributes:
        position: m.
        rotation: from the joint's axes to the figure's.
    """

    position: Vec3
    rotation: Quat


@dataclass(frozen=True, slots=True)
class Skeleton:
    """A tree of joints.

    Attributes:
        joints: H-Anim names; this is the order of every pose array, (J,).
        parents: index of each joint's parent, -1 for the root, (J,).
        offsets: from the parent joint in the default pose, m; for the root, its position above the ground.
    """

    joints: tuple[str, ...]
    parents: tuple[int, ...]
    offsets: tuple[Vec3, ...]
    _chains: dict[str, tuple[tuple[str, Vec3], ...]] = field(init=False, repr=False, compare=False)
    _links: dict[str, tuple[str | None, Vec3]] = field(init=False, repr=False, compare=False)
    _hash: int = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_chains", {name: self._chain(i) for i, name in enumerate(self.joints)})
        parents = (self.joints[parent] if parent >= 0 else None for parent in self.parents)
        links = zip(parents, self.offsets, strict=True)
        object.__setattr__(self, "_links", dict(zip(self.joints, links, strict=True)))
        object.__setattr__(self, "_hash", hash((self.joints, self.parents, self.offsets)))

    def __hash__(self) -> int:
        return self._hash  # a key of every cache of motions

    def _chain(self, index: int) -> tuple[tuple[str, Vec3], ...]:
        links: list[tuple[str, Vec3]] = []
        while index >= 0:
            links.append((self.joints[index], self.offsets[index]))
            index = self.parents[index]
        return tuple(reversed(links))

    def __contains__(self, joint: str) -> bool:
        return joint in self._links

    def links(self, joint: str) -> tuple[tuple[str, Vec3], ...]:
        """Return the joints from the root to a joint, both included, each with its offset.

        Raises:
            KeyError: no such joint.
        """
        return self._chains[joint]

    def chain(self, joint: str) -> tuple[str, ...]:
        """Return the names of the joints from the root to a joint, both included.

        Raises:
            KeyError: no such joint.
        """
        return tuple(name for name, _ in self._chains[joint])

    def offset(self, joint: str) -> Vec3:
        """Return the offset of a joint from its parent in the default pose, m.

        Raises:
            KeyError: no such joint.
        """
        return self._links[joint][1]

    def parent(self, joint: str) -> str | None:
        """Return the parent of a joint, None for the root.

        Raises:
            KeyError: no such joint.
        """
        return self._links[joint][0]

    def carried(self, joints: Iterable[str]) -> frozenset[str]:
        """Return some joints, and all that are below them."""
        above = frozenset(joints)
        return frozenset(joint for joint in self.joints if not above.isdisjoint(self.chain(joint)))


@dataclass(frozen=True, slots=True)
class Body:
    """A skeleton in a pose, in the figure's own frame.

    Attributes:
        skeleton: with the proportions of the figure.
        pose: of its joints; never modified. A motion that starts gets the pose without additive layers, which would
            otherwise be added twice.
        root: displacement of HumanoidRoot from its position in the default pose, m.
    """

    skeleton: Skeleton
    pose: JointRotations = field(default_factory=dict)
    root: Vec3 = ZERO
    # All motions of a frame need transforms along the same few chains.
    _transforms: dict[str, Transform] = field(init=False, repr=False, compare=False, default_factory=dict)
    _hash: int = field(init=False, repr=False, compare=False, default=0)

    def __hash__(self) -> int:
        if not self._hash:
            object.__setattr__(self, "_hash", hash((self.skeleton, self.root, frozenset(self.pose.items()))))
        return self._hash  # a key of caches of motions

    def transform(self, joint: str) -> Transform:
        """Return the transform of a joint, by forward kinematics from its parent. Each joint is computed once.

        Raises:
            KeyError: no such joint.
        """
        transforms = self._transforms
        if joint in transforms:
            return transforms[joint]
        parent, (ox, oy, oz) = self.skeleton._links[joint]
        (px, py, pz), (w, x, y, z) = (self.root, IDENTITY) if parent is None else self.transform(parent)
        # Nothing else runs as often: add, rotate and multiply are written out, because calls take longer than they do.
        tx, ty, tz = 2.0 * (y * oz - z * oy), 2.0 * (z * ox - x * oz), 2.0 * (x * oy - y * ox)
        px += ox + w * tx + y * tz - z * ty
        py += oy + w * ty + z * tx - x * tz
        pz += oz + w * tz + x * ty - y * tx
        if joint in self.pose:
            qw, qx, qy, qz = self.pose[joint]
            w, x, y, z = (
                w * qw - x * qx - y * qy - z * qz,
                w * qx + x * qw + y * qz - z * qy,
                w * qy - x * qz + y * qw + z * qx,
                w * qz + x * qy - y * qx + z * qw,
            )
        transforms[joint] = transform = _transform(Transform, ((px, py, pz), (w, x, y, z)))
        return transform

    def rotation(self, joint: str) -> Quat:
        """Return the rotation of a joint local to its parent."""
        return self.pose.get(joint, IDENTITY)

    def posed(self, rotations: Mapping[str, Quat], root: Vec3 | None = None) -> "Body":
        """Return this body with other rotations for some joints, and another root displacement if one is given."""
        return Body(self.skeleton, {**self.pose, **rotations}, self.root if root is None else root)

    def turned(self, rotations: Mapping[str, Quat], moving: frozenset[str]) -> "Body":
        """Return this body with other rotations for some joints; it knows the transforms of those that stay in place.

        Args:
            rotations: of these joints.
            moving: these joints, and all that they carry (`Skeleton.carried`).
        """
        body = Body(self.skeleton, {**self.pose, **rotations}, self.root)
        body._transforms.update({joint: at for joint, at in self._transforms.items() if joint not in moving})
        return body
