"""One picture of one character."""

from dataclasses import dataclass
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.quaternion import IDENTITY
from reactive_realizer.embodiment.skeleton import Pose, Skeleton


@dataclass(frozen=True, slots=True, eq=False)
class Frame:
    """What is published for one time.

    Attributes:
        time: of the tick it was composed for, s.
        root: place of HumanoidRoot, m, (3,).
        rotations: (J, 4) unit quaternions w x y z local to the parent, in the order of the skeleton's joints.
        weights: (M,) 0..1, in the order of the avatar's morphs.
    """

    time: GlobalTime
    root: NDArray[np.float64]
    rotations: NDArray[np.float64]
    weights: NDArray[np.float64]


def rotation_array(skeleton: Skeleton, pose: Pose) -> NDArray[np.float64]:
    """A pose as an array, (J, 4), in the order of the skeleton's joints."""
    rotations = [pose.get(joint, IDENTITY) for joint in skeleton.joints]
    # In half the time of an array of tuples.
    return np.fromiter(chain.from_iterable(rotations), float, 4 * len(rotations)).reshape(-1, 4)
