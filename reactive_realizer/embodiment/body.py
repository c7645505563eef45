"""What a motion needs to know of the body that it moves."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, multiply, rotate
from reactive_realizer.embodiment.skeleton import Place, Pose, Skeleton
from reactive_realizer.embodiment.vector import ZERO, Vec3, add


@dataclass(frozen=True, slots=True)
class Body:
    """A skeleton and the pose it is in, in the figure's own frame.

    Attributes:
        skeleton: its proportions.
        pose: of its joints, which nobody changes any more; for a motion that begins, the pose without additive layers,
            which would be added twice.
        root: how far HumanoidRoot is moved from its place in the default pose, m.
    """

    skeleton: Skeleton
    pose: Pose = field(default_factory=dict)
    root: Vec3 = ZERO
    # All motions of a frame ask for places along the same few chains.
    _places: dict[str, Place] = field(init=False, repr=False, compare=False, default_factory=dict)

    def place(self, joint: str) -> Place:
        """Where a joint is: forward kinematics along its chain, each joint of which is placed once.

        Raises:
            KeyError: no such joint.
        """
        places = self._places
        if joint in places:
            return places[joint]
        position, rotation = self.root, IDENTITY
        for name, offset in self.skeleton.links(joint):
            if name in places:
                position, rotation = places[name]
            else:
                position = add(position, rotate(rotation, offset))
                rotation = multiply(rotation, self.pose.get(name, IDENTITY))
                places[name] = Place(position, rotation)
        return Place(position, rotation)

    def rotation(self, joint: str) -> Quat:
        """A joint's rotation local to its parent."""
        return self.pose.get(joint, IDENTITY)

    def posed(self, rotations: Mapping[str, Quat], root: Vec3 | None = None) -> "Body":
        """This body with some joints turned otherwise, and its root elsewhere if that is said."""
        return Body(self.skeleton, {**self.pose, **rotations}, self.root if root is None else root)
