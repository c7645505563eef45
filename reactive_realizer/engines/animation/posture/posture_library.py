"""From the words of a posture to the body in it, by files that a user edits."""

import logging
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType

from reactive_realizer.binding.asset_file import first_asset
from reactive_realizer.bml.posture import Pose
from reactive_realizer.bml.words import PosePart, StanceType
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.ground import grounded
from reactive_realizer.embodiment.joints import LOWER_BODY, ROOT
from reactive_realizer.embodiment.pose import Layer, LayerKind, checked
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat
from reactive_realizer.embodiment.skeleton import Skeleton
from reactive_realizer.embodiment.vector import distance, length
from reactive_realizer.engines.animation.keyframe.skeleton_pose import read_skeleton_pose
from reactive_realizer.engines.animation.posture.body_posture import BodyPosture
from reactive_realizer.engines.animation.posture.parts import JOINTS
from reactive_realizer.engines.animation.procedural.animation_cache import animation_in
from reactive_realizer.engines.animation.procedural.proc_animation import ProcAnimation
from reactive_realizer.errors import RealizerError, error

_log = logging.getLogger(__name__)

LEXEMES = (
    "ARMS_AKIMBO",
    "ARMS_CROSSED",
    "ARMS_FORWARD",
    "ARMS_NEUTRAL",
    "ARMS_OPEN",
    "ARMS_SPREAD",
    "LEANING_BACKWARD",
    "LEANING_FORWARD",
    "LEGS_CROSSED",
    "LEGS_NEUTRAL",
    "LEGS_OPEN",
)
"""The poses that ship: those of BML 1.0, and two that AsapRealizer's scripts use."""

_ORDER = tuple(JOINTS)


class PostureLibrary:
    """Bodies in postures, of one skeleton.

    A stance is the file `postures/STANCE.xml` among the assets, a pose `postures/STANCE/LEXEME.xml`, for a stance in
    which it looks different, or `postures/LEXEME.xml`, in small letters: a new file is a new word. Each is a
    ProcAnimation, of which the pose at phase 0 is taken. Of its parameters these have values: the lengths `upperarm`,
    `forearm`, `thigh`, `shank`, and the distances between the `shoulders` and between the `hips`, m; and `rootx`,
    `rooty`, `rootz`, the place of HumanoidRoot in the figure's frame, m. So hands meet whatever the proportions.
    A word that ends in NEUTRAL is what the stance alone does.
    """

    def __init__(
        self, skeleton: Skeleton, asset: Callable[[str], Path], rest_poses: Mapping[str, str] = MappingProxyType({})
    ) -> None:
        """Postures of a skeleton.

        Args:
            skeleton: whose.
            asset: finds a file by name.
            rest_poses: stance, as BML writes it -> SkeletonPose file of what some joints do in it, from a binding.
        """
        self._skeleton = skeleton
        self._asset = asset
        self._rest_poses = rest_poses
        self._lengths = _lengths(skeleton)
        self._told: set[StanceType] = set()
        for stance in StanceType:
            self._rest_pose(stance)

    def body(self, posture: BodyPosture) -> Body:
        """The figure in a posture, its feet (or whatever of it is lowest) on the ground, if no file says its root.

        Raises:
            RealizerError: "no-posture": no file has a word, or it says nothing about the part; a file is not usable.
        """
        stand = self._stand(posture.stance)
        body = stand
        for pose in sorted(posture.poses, key=lambda pose: _ORDER.index(pose.part)):
            animation = self._animation(posture.stance, pose)
            if animation is None:
                joints = JOINTS[pose.part] & body.pose.keys()
                body = _turned(body, {joint: stand.rotation(joint) for joint in joints})
            else:
                body = self._taken(animation, body)
        return body

    def check(self, posture: BodyPosture) -> None:
        """Whether there is such a posture.

        Raises:
            RealizerError: as of `body`.
        """
        for pose in posture.poses:
            self._animation(posture.stance, pose)

    def possible(self, posture: BodyPosture) -> BodyPosture:
        """A posture without the poses that are not there in its stance."""
        return replace(posture, poses=tuple(pose for pose in posture.poses if self._is_there(posture.stance, pose)))

    def _stand(self, stance: StanceType) -> Body:
        file = self._asset(f"postures/{stance.value.lower()}.xml")
        default = Body(self._skeleton, dict.fromkeys(self._skeleton.joints, IDENTITY))
        body = self._taken(animation_in(file, self._skeleton, joints=JOINTS[PosePart.WHOLEBODY]), default)
        return _turned(body, self._rest_pose(stance))

    def _rest_pose(self, stance: StanceType) -> Mapping[str, Quat]:
        """What the binding says of a stance; a file that is not usable says nothing, and the log says so once."""
        name = self._rest_poses.get(stance.value)
        if name is None:
            return {}
        try:
            rotations = read_skeleton_pose(self._asset(name))
        except RealizerError as problem:
            if stance not in self._told:
                self._told.add(stance)
                _log.warning("the rest pose of %s is our own: %s", stance.value, problem.fault.sentence)
            return {}
        return {joint: turn for joint, turn in rotations.items() if joint in self._skeleton}

    def _animation(self, stance: StanceType, pose: Pose) -> ProcAnimation | None:
        """What a pose does; None for one that is the stance's own."""
        try:
            file = self._file(stance, pose.lexeme)
        except RealizerError as problem:
            if problem.fault.code != "no-asset":
                raise
            known = ", ".join(word for word in LEXEMES if self._is_there(stance, Pose(part=pose.part, lexeme=word)))
            raise error("no-posture", part=pose.part, lexeme=pose.lexeme, stance=stance, known=known) from problem
        return None if file is None else animation_in(file, self._skeleton, joints=JOINTS[pose.part])

    def _is_there(self, stance: StanceType, pose: Pose) -> bool:
        try:
            if (file := self._file(stance, pose.lexeme)) is not None:
                animation_in(file, self._skeleton, joints=JOINTS[pose.part])
        except RealizerError:
            return False
        return True

    def _file(self, stance: StanceType, lexeme: str) -> Path | None:
        word = lexeme.strip().lower().replace("-", "_")
        if word.endswith("_neutral"):
            return None
        return first_asset(self._asset, f"postures/{stance.value.lower()}/{word}.xml", f"postures/{word}.xml")

    def _taken(self, animation: ProcAnimation, body: Body) -> Body:
        # Where hands go may depend on where the root is, and that on what the legs do: known after a first time.
        for _ in range(2):
            values = animation.values({**self._lengths, **_root(body)})
            posed = animation.sample(0.0, values, body)
            checked(Layer(LayerKind.BASE, posed.rotations, root=posed.root))
            said = posed.root is not None
            body = body.posed(posed.rotations, posed.root) if said else _turned(body, posed.rotations)
        return body


def _turned(body: Body, rotations: Mapping[str, Quat]) -> Body:
    """A body with joints turned, its feet on the ground again if that moves them."""
    turned = body.posed(rotations)
    return turned if LOWER_BODY.isdisjoint(rotations) else grounded(turned)


def _root(body: Body) -> Mapping[str, float]:
    return dict(zip(("rootx", "rooty", "rootz"), body.place(ROOT).position, strict=True))


def _lengths(skeleton: Skeleton) -> Mapping[str, float]:
    """Of bones, and across the body; 0 where a figure has no such joints."""
    bones = {"upperarm": "l_elbow", "forearm": "l_wrist", "thigh": "l_knee", "shank": "l_ankle"}
    widths = {"shoulders": ("l_shoulder", "r_shoulder"), "hips": ("l_hip", "r_hip")}
    body = Body(skeleton)
    return {
        **{name: length(skeleton.offset(joint)) if joint in skeleton else 0.0 for name, joint in bones.items()},
        **{name: _distance(body, *joints) for name, joints in widths.items()},
    }


def _distance(body: Body, left: str, right: str) -> float:
    if not (left in body.skeleton and right in body.skeleton):
        return 0.0
    return distance(body.place(left).position, body.place(right).position)
