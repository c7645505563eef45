"""Published frames of a character."""

from dataclasses import dataclass
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import JointRotations, Skeleton
from reactive_realizer.embodiment.quaternion import IDENTITY


@dataclass(frozen=True, slots=True, eq=False)
class Frame:
    """One frame of one character.

    Attributes:
        time: of the tick that composed it, s.
        root: position of HumanoidRoot in the world, m, (3,).
        rotations: (J, 4) unit quaternions w x y z local to the parent, in the order of the skeleton's joints.
        weights: morph weights, (M,) 0 to 1, in the order of the avatar's morphs.
        pictures: names of files among the assets, of the pictures that show the character in place of its body, from
            the lowest to the uppermost.
    """

    time: GlobalTime
    root: NDArray[np.float64]
    rotations: NDArray[np.float64]
    weights: NDArray[np.float64]
    pictures: tuple[str, ...] = ()


def rotation_array(skeleton: Skeleton, pose: JointRotations) -> NDArray[np.float64]:
    """Return a pose as an array, (J, 4), in the order of the skeleton's joints."""
    rotations = [pose.get(joint, IDENTITY) for joint in skeleton.joints]
    # Twice as fast as np.array of tuples.
    return np.fromiter(chain.from_iterable(rotations), float, 4 * len(rotations)).reshape(-1, 4)
