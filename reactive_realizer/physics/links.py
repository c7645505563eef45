"""Which joints of a skeleton turn a segment."""

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, conjugate, multiply
from reactive_realizer.physics.segments import SEGMENTS


class Links:
    """The joints that turn a segment in its parent segment: the segment's joint, and those before and after it.

    Attributes:
        joints: all of them.
    """

    def __init__(self, skeleton: Skeleton, joint: str) -> None:
        chain = skeleton.chain(_end(skeleton, joint))
        own = chain.index(joint)
        parent = next((name for name in reversed(chain[:own]) if name in _ENDS), None)
        first = 0 if parent is None else chain.index(_end(skeleton, parent)) + 1
        self._before, self._joint, self._after = chain[first:own], joint, chain[own + 1 :]
        self.joints = frozenset(chain[first:])

    def rotation(self, body: Body) -> Quat:
        """Return the rotation of the segment in a body."""
        turn = body.pose.get  # not `Body.rotation`, which takes three times as long: all segments turn in each frame
        rotation = turn(self._joint, IDENTITY)
        for joint in reversed(self._before):
            rotation = multiply(turn(joint, IDENTITY), rotation)
        for joint in self._after:
            rotation = multiply(rotation, turn(joint, IDENTITY))
        return rotation

    def local(self, body: Body, rotation: Quat) -> Quat:
        """Return the rotation of the joint that gives the segment a rotation, with all others as in a body."""
        for joint in self._before:
            rotation = multiply(conjugate(body.rotation(joint)), rotation)
        for joint in reversed(self._after):
            rotation = multiply(rotation, conjugate(body.rotation(joint)))
        return rotation


_ENDS = {segment.joint: segment.end or segment.joint for segment in SEGMENTS}


def _end(skeleton: Skeleton, joint: str) -> str:
    """Return the joint that has the orientation of a segment."""
    return _ENDS[joint] if _ENDS[joint] in skeleton else joint
