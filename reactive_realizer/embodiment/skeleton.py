"""A skeleton in its H-Anim default pose, and where its joints are in any other."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.vector import Vec3

Pose = Mapping[str, Quat]
"""Joint name -> rotation local to the parent; a joint left out is in its default pose."""


class Place(NamedTuple):
    """Where a joint is in the figure's frame.

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
        joints: H-Anim names; the order of every pose array, (J,).
        parents: index of each joint's parent, -1 for the root, (J,).
        offsets: from the parent joint to the joint in the default pose, m; of the root, its place above the ground.
    """

    joints: tuple[str, ...]
    parents: tuple[int, ...]
    offsets: tuple[Vec3, ...]
    _chains: dict[str, tuple[tuple[str, Vec3], ...]] = field(init=False, repr=False, compare=False)
    _hash: int = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_chains", {name: self._chain(i) for i, name in enumerate(self.joints)})
        object.__setattr__(self, "_hash", hash((self.joints, self.parents, self.offsets)))

    def __hash__(self) -> int:
        return self._hash  # asked for with every motion that is made for a figure

    def _chain(self, index: int) -> tuple[tuple[str, Vec3], ...]:
        links: list[tuple[str, Vec3]] = []
        while index >= 0:
            links.append((self.joints[index], self.offsets[index]))
            index = self.parents[index]
        return tuple(reversed(links))

    def __contains__(self, joint: str) -> bool:
        return joint in self._chains

    def links(self, joint: str) -> tuple[tuple[str, Vec3], ...]:
        """The joints from the root to a joint, both included, each with its offset.

        Raises:
            KeyError: no such joint.
        """
        return self._chains[joint]

    def chain(self, joint: str) -> tuple[str, ...]:
        """The joints from the root to a joint, both included.

        Raises:
            KeyError: no such joint.
        """
        return tuple(name for name, _ in self._chains[joint])

    def offset(self, joint: str) -> Vec3:
        """From its parent to a joint in the default pose, m.

        Raises:
            KeyError: no such joint.
        """
        return self._chains[joint][-1][1]

    def parent(self, joint: str) -> str | None:
        """The joint above, None for the root.

        Raises:
            KeyError: no such joint.
        """
        chain = self._chains[joint]
        return chain[-2][0] if len(chain) > 1 else None
