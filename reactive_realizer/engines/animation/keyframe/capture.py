"""What a motion capture file says: a figure of its own, and how it moved."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engines.animation.keyframe.quaternions import about, product, rotated


@dataclass(frozen=True, slots=True)
class CapturedJoint:
    """A joint of the captured figure.

    Attributes:
        name: as in the file.
        parent: index of the joint above, -1 for the root.
        offset: from the joint above, in the unit of the file.
        channels: what each frame says of it, in order: X, Y or Z, then "position" or "rotation".
    """

    name: str
    parent: int
    offset: Vec3
    channels: tuple[str, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Capture:
    """A figure and its motion, in the axes and the unit of length of the file.

    Attributes:
        name: of the file.
        joints: each after the one above it, (J,).
        step: from frame to frame, s.
        frames: (F, C), the values of all channels of all joints, in their order; angles in degrees.
    """

    name: str
    joints: tuple[CapturedJoint, ...]
    step: float
    frames: NDArray[np.float64]

    def rotations(self) -> NDArray[np.float64]:
        """Of each joint in each frame, in the axes of the file, (F, J, 4) unit quaternions w x y z.

        Channels are applied from the left to the right: "Zrotation Xrotation Yrotation" is Rz Rx Ry.
        """
        out = np.zeros((len(self.frames), len(self.joints), 4))
        out[..., 0] = 1.0
        first = 0
        for index, joint in enumerate(self.joints):
            if joint.parent >= 0:
                out[:, index] = out[:, joint.parent]
            for column, channel in enumerate(joint.channels, first):
                if channel.endswith("rotation"):
                    turn = about("XYZ".index(channel[0]), np.radians(self.frames[:, column]))
                    out[:, index] = product(out[:, index], turn)
            first += len(joint.channels)
        return out

    def places(self, index: int, turned: NDArray[np.float64]) -> NDArray[np.float64]:
        """Where a joint is in frames, (F, 3), from the origin, in the axes and the unit of the file.

        Args:
            index: of the joint.
            turned: the `rotations` of all frames, or of the first ones.
        """
        out = np.zeros((len(turned), 3))
        while (above := self.joints[index].parent) >= 0:
            out += rotated(turned[:, above], self._ways(index)[: len(turned)])
            index = above
        return out + self._ways(index)[: len(turned)]

    def _ways(self, index: int) -> NDArray[np.float64]:
        """From the joint above to a joint in each frame, (F, 3): its offset, if channels do not say another."""
        out = np.tile(self.joints[index].offset, (len(self.frames), 1))
        first = sum(len(joint.channels) for joint in self.joints[:index])
        for column, channel in enumerate(self.joints[index].channels, first):
            if channel.endswith("position"):
                out[:, "XYZ".index(channel[0])] = self.frames[:, column]
        return out

    def rest_place(self, index: int) -> Vec3:
        """Where a joint is at rest, seen from the root."""
        x = y = z = 0.0
        while self.joints[index].parent >= 0:
            dx, dy, dz = self.joints[index].offset
            x, y, z = x + dx, y + dy, z + dz
            index = self.joints[index].parent
        return (x, y, z)
