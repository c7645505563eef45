"""Postures by lexemes, and the bodies that posture files define for them."""

import logging
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType

from reactive_realizer.binding.asset_file import first_asset
from reactive_realizer.binding.faults import NoAsset
from reactive_realizer.binding.gesture_binding import RestPose
from reactive_realizer.bml.behaviors import Pose
from reactive_realizer.bml.vocabulary import PosePart, StanceType
from reactive_realizer.embodiment.body import Body, JointRotations, Skeleton
from reactive_realizer.embodiment.feet import grounded
from reactive_realizer.embodiment.joints import (
    HEAD,
    LEFT_ARM,
    LEFT_LEG,
    LEGS,
    LOWER_BODY,
    RIGHT_ARM,
    RIGHT_LEG,
    ROOT,
    TRUNK,
)
from reactive_realizer.embodiment.pose import Layer, LayerKind, checked
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat
from reactive_realizer.embodiment.vector import distance, length
from reactive_realizer.engines.animation.faults import NoPosture
from reactive_realizer.engines.animation.keyframe.clip_files import CAPTURES, is_capture, load_clip
from reactive_realizer.engines.animation.keyframe.keyframe_files import read_skeleton_pose
from reactive_realizer.engines.animation.procedural.procedural_animation import ProceduralAnimation
from reactive_realizer.engines.animation.procedural.procedural_animation_reader import load_animation
from reactive_realizer.errors import RealizerError

_ARMS = LEFT_ARM | RIGHT_ARM

PART_JOINTS: Mapping[PosePart, frozenset[str]] = MappingProxyType(
    {
        PosePart.WHOLEBODY: frozenset((*TRUNK, *HEAD)) | _ARMS | LEGS,
        PosePart.LEGS: LEGS,
        PosePart.LEFT_LEG: LEFT_LEG,
        PosePart.RIGHT_LEG: RIGHT_LEG,
        PosePart.HEAD: frozenset(HEAD),
        PosePart.ARMS: _ARMS,
        PosePart.LEFT_ARM: LEFT_ARM,
        PosePart.RIGHT_ARM: RIGHT_ARM,
    }
)
"""Part of the body -> its joints. Poses are applied in this order: hands may depend on trunk and legs."""


@dataclass(frozen=True, slots=True)
class BodyPosture:
    """A posture by lexemes: a stance, and poses of single parts of the body.

    Attributes:
        stance: the global position.
        poses: of parts of the body; if two affect the same joints, the later one takes precedence.
    """

    stance: StanceType = StanceType.STANDING
    poses: tuple[Pose, ...] = ()

    def changed(self, stance: StanceType | None, poses: Iterable[Pose]) -> "BodyPosture":
        """Return this posture with another stance, if given, and with other poses of some parts.

        Crossed arms stay crossed when the figure sits down. A new pose of the arms ends an old one of the left arm.
        """
        new = tuple(poses)
        kept = (old for old in self.poses if not any(PART_JOINTS[old.part] <= PART_JOINTS[pose.part] for pose in new))
        return BodyPosture(stance or self.stance, (*kept, *new))


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
"""Poses of the package: those of BML 1.0, and two of AsapRealizer's scripts."""

_ORDER = tuple(PART_JOINTS)


class PostureLibrary:
    """Bodies in postures, for one skeleton.

    A stance is the asset `postures/STANCE.xml`. A pose is `postures/STANCE/LEXEME.xml` if it looks different in a
    stance, else `postures/LEXEME.xml`, in lower case; a new file is a new lexeme. Each file is a ProcAnimation, of
    which the pose at phase 0 is used. These parameters are set: the lengths `upperarm`, `forearm`, `thigh`, `shank`,
    and the widths `shoulders` and `hips`, m; and `rootx`, `rooty`, `rootz`, the position of HumanoidRoot in the
    figure's frame, m. So hands meet for any proportions. A lexeme that ends in NEUTRAL is the stance alone. The name of
    a capture among the assets is a lexeme too: the pose of its first frame.
    """

    def __init__(self, skeleton: Skeleton, asset: Callable[[str], Path], rest_poses: Sequence[RestPose] = ()) -> None:
        """Create the postures of a skeleton.

        Args:
            skeleton: of the figure.
            asset: finds a file by name.
            rest_poses: SkeletonPose files with some of the joints of stances and postures, from a binding. The one with
                the most poses of a posture applies, and of equal ones the first.
        """
        self._skeleton = skeleton
        self._asset = asset
        self._rest_poses = sorted(rest_poses, key=lambda rest: -len(rest.poses))
        self._lengths = _lengths(skeleton)
        self._logged: set[str] = set()
        for rest in rest_poses:
            self._rotations(rest)

    def body(self, posture: BodyPosture) -> Body:
        """Return the figure in a posture. Its lowest part is on the ground, unless a file places the root.

        Raises:
            RealizerError: "no-posture": a pose does not exist, or does not apply to its part; or a file cannot be used.
        """
        stand, bound = self._stand(posture.stance), self._bound(posture)
        body = stand if bound is None else _turned(stand, self._rotations(bound))
        for pose in sorted(_unbound(posture, bound), key=lambda pose: _ORDER.index(pose.part)):
            match self._shape(posture.stance, pose):
                case None:
                    joints = PART_JOINTS[pose.part] & body.pose.keys()
                    body = _turned(body, {joint: stand.rotation(joint) for joint in joints})
                case ProceduralAnimation() as animation:
                    body = self._taken(animation, body)
                case rotations:
                    body = _turned(body, rotations)
        return body

    def check(self, posture: BodyPosture) -> None:
        """Check that a posture exists.

        Raises:
            RealizerError: as for `body`.
        """
        for pose in _unbound(posture, self._bound(posture)):
            self._shape(posture.stance, pose)

    def captures(self, stance: StanceType, poses: Iterable[Pose]) -> list[Path]:
        """Return the files of poses that are those of captures; they take long to read."""
        found: list[Path] = []
        for pose in poses:
            if _word(pose.lexeme) in LEXEMES:  # the package has files for these
                continue
            with suppress(RealizerError):
                file = self._file(stance, pose.lexeme)
                found += [file] if file is not None and is_capture(file) else []
        return found

    def possible(self, posture: BodyPosture) -> BodyPosture:
        """Return a posture without the poses that do not exist in its stance."""
        other = _unbound(posture, self._bound(posture))
        missing = [pose for pose in other if not self._is_there(posture.stance, pose)]
        return replace(posture, poses=tuple(pose for pose in posture.poses if pose not in missing))

    def _stand(self, stance: StanceType) -> Body:
        file = self._asset(f"postures/{stance.value.lower()}.xml")
        default = Body(self._skeleton, dict.fromkeys(self._skeleton.joints, IDENTITY))
        body = self._taken(load_animation(file, self._skeleton, joints=PART_JOINTS[PosePart.WHOLEBODY]), default)
        rest = next((rest for rest in self._rest_poses if rest.stance == stance and not rest.poses), None)
        return body if rest is None else _turned(body, self._rotations(rest))

    def _bound(self, posture: BodyPosture) -> RestPose | None:
        """Return the rest pose of the binding with poses that a posture has too."""
        poses = {pose.part: _word(pose.lexeme) for pose in posture.poses}
        fitting = (rest for rest in self._rest_poses if rest.poses and rest.poses.items() <= poses.items())
        return next((rest for rest in fitting if rest.stance == posture.stance and self._rotations(rest)), None)

    def _rotations(self, rest: RestPose) -> Mapping[str, Quat]:
        """Return the rotations of a rest pose of the binding. An invalid file is ignored, and logged once."""
        try:
            rotations = read_skeleton_pose(self._asset(rest.file))
        except RealizerError as problem:
            if rest.file not in self._logged:
                self._logged.add(rest.file)
                _log.warning("the default rest pose of %s is used: %s", rest.stance.value, problem.fault.sentence)
            return {}
        return {joint: turn for joint, turn in rotations.items() if joint in self._skeleton}

    def _shape(self, stance: StanceType, pose: Pose) -> ProceduralAnimation | JointRotations | None:
        """Return the animation or the rotations of a pose; None if the pose is that of the stance."""
        try:
            file = self._file(stance, pose.lexeme)
        except RealizerError as problem:
            if not isinstance(problem.fault, NoAsset):
                raise
            known = tuple(word for word in LEXEMES if self._is_there(stance, Pose(part=pose.part, lexeme=word)))
            raise RealizerError(NoPosture(part=pose.part, lexeme=pose.lexeme, stance=stance, known=known)) from problem
        return None if file is None else self._read(file, pose.part)

    def _read(self, file: Path, part: PosePart) -> ProceduralAnimation | JointRotations:
        if not is_capture(file):
            return load_animation(file, self._skeleton, joints=PART_JOINTS[part])
        clip = load_clip(file, self._skeleton, 0.0)
        return clip.only(PART_JOINTS[part]).rotations_at(clip.times[0])

    def _is_there(self, stance: StanceType, pose: Pose) -> bool:
        try:
            if (file := self._file(stance, pose.lexeme)) is not None:
                self._read(file, pose.part)
        except RealizerError:
            return False
        return True

    def _file(self, stance: StanceType, lexeme: str) -> Path | None:
        word = _word(lexeme).lower()
        if word.endswith("_neutral"):
            return None
        own = (f"postures/{stance.value.lower()}/{word}.xml", f"postures/{word}.xml")
        return first_asset(self._asset, *own, *(f"**/{lexeme.strip()}.{suffix}" for suffix in CAPTURES))

    def _taken(self, animation: ProceduralAnimation, body: Body) -> Body:
        # Hands may depend on the root, and the root on the legs, which are known only after a first pass.
        for _ in range(2):
            values = animation.values({**self._lengths, **_root(body)})
            posed = animation.sample(0.0, values, body)
            checked(Layer(LayerKind.BASE, posed.rotations, root=posed.root))
            places_root = posed.root is not None
            body = body.posed(posed.rotations, posed.root) if places_root else _turned(body, posed.rotations)
        return body


def _word(lexeme: str) -> str:
    """Return a lexeme in capitals, its words joined by ``_``."""
    return lexeme.strip().upper().replace("-", "_")


def _unbound(posture: BodyPosture, bound: RestPose | None) -> list[Pose]:
    """Return the poses of a posture that a rest pose of the binding does not include."""
    return [pose for pose in posture.poses if bound is None or pose.part not in bound.poses]


def _turned(body: Body, rotations: Mapping[str, Quat]) -> Body:
    """Return a body with joints turned; if that moves its feet, it is grounded again."""
    turned = body.posed(rotations)
    return turned if LOWER_BODY.isdisjoint(rotations) else grounded(turned)


def _root(body: Body) -> Mapping[str, float]:
    return dict(zip(("rootx", "rooty", "rootz"), body.transform(ROOT).position, strict=True))


def _lengths(skeleton: Skeleton) -> Mapping[str, float]:
    """Return lengths of bones and widths of the body, m; 0 if the figure lacks the joints."""
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
    return distance(body.transform(left).position, body.transform(right).position)
