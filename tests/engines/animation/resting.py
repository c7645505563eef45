"""Bodies in postures, of the files that ship."""

from reactive_realizer.assembly.assets import Assets
from reactive_realizer.bml.posture import Pose
from reactive_realizer.bml.words import PosePart, StanceType
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.skeleton import Skeleton
from reactive_realizer.engines.animation.posture.body_posture import BodyPosture
from reactive_realizer.engines.animation.posture.posture_library import PostureLibrary

ASSET = Assets()


def pose(part: str, lexeme: str) -> Pose:
    """What a part of the body does."""
    return Pose(part=PosePart(part), lexeme=lexeme)


def posture(stance: str = "STANDING", **poses: str) -> BodyPosture:
    """A posture of a stance and of words by part."""
    return BodyPosture(StanceType(stance), tuple(pose(part, word) for part, word in poses.items()))


def body_in(skeleton: Skeleton, stance: str = "STANDING", **poses: str) -> Body:
    """A body in it."""
    return PostureLibrary(skeleton, ASSET).body(posture(stance, **poses))


REST_POSE = body_in(Avatar.read(ASSET("avatars/female.glb")).skeleton).pose
"""Joint -> rotation of a figure that stands at ease; the same for every figure."""
