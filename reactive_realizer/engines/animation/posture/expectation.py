"""In which posture a figure will be."""

from collections.abc import Iterable, Iterator

from reactive_realizer.embodiment.body import Body
from reactive_realizer.engines.animation.motion_unit import MotionUnit
from reactive_realizer.engines.animation.posture.body_posture import BodyPosture
from reactive_realizer.engines.animation.posture.posture_motion_unit import PostureMotionUnit


def posture_after(posture: BodyPosture, motions: Iterable[MotionUnit]) -> BodyPosture:
    """The posture in which one ends who begins in a posture and makes motions, of which shifts change it."""
    for motion in motions:
        if isinstance(motion, PostureMotionUnit) and motion.lasts is not None:
            posture = posture.changed(*motion.change)
    return posture


def bodies_in(motions: Iterable[MotionUnit]) -> Iterator[Body]:
    """The figure in each posture among the motions that it makes for a while."""
    for motion in motions:
        if isinstance(motion, PostureMotionUnit) and motion.lasts is None:
            yield motion.body
