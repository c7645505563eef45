"""Reads AsapRealizer's speech bindings: the motion of joints for each viseme (thesis 8.10, SpeechBinding)."""

import logging
import math
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Final

from reactive_realizer.binding.asset_file import XmlElement, asset_error, attribute, number, read_xml
from reactive_realizer.binding.mouth_shapes import Articulator, MouthShape
from reactive_realizer.binding.viseme_file import MouthTables
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.humanoid import Humanoid
from reactive_realizer.embodiment.quaternion import angle, rotation_vector
from reactive_realizer.embodiment.turn_weights import turn_weights, weights_of_joint
from reactive_realizer.engines.animation.motion_parameters import listed
from reactive_realizer.engines.animation.procedural.procedural_animation_reader import read_procedural_animation

_NUMBERS: Final[Mapping[str, int]] = MappingProxyType(
    {"sil": 0, "PP": 21, "FF": 18, "TH": 17, "DD": 19, "kk": 20, "CH": 16, "SS": 15, "nn": 19, "RR": 13}
    | {"aa": 2, "E": 4, "ih": 6, "oh": 8, "ou": 7}
)
"""Visemes with their numbers in Microsoft's speech API (SPVISEMES), whose voices AsapRealizer can use."""
_CLOSED: Final = "PP"
"""The viseme that neighbors do not open."""
_PART: Final = "joints"
"""The articulator."""
_LAST_NUMBER: Final = 21
_PHASES: Final = 20
"""Parts of a motion among whose ends the widest pose is found."""
_WIDEST: Final = math.radians(45.0)
_TIME: Final = 0.06
"""Time constant of the articulator before and after a sound, s."""

logger = logging.getLogger(__name__)


def read_speech_binding(path: Path, asset: Callable[[str], Path], humanoid: Humanoid) -> MouthTables:
    """Read a binding.

    The turns of a viseme are the widest pose of its motion, and visemes without an entry are the mouth at rest. All
    joints of the file are one part of the mouth. Parameters that a motion does not have are logged.

    Args:
        path: of the file.
        asset: finds the files of its motions by their names.
        humanoid: the figure.

    Raises:
        RealizerError: "bad-asset", with file, line and element; "no-asset", "forbidden-path".
        OSError: a file cannot be read.
    """
    turns: dict[int, Mapping[str, float]] = {}
    joints: set[str] = set()
    document = read_xml(path, "speechbinding")
    for entry in document:
        if entry.tag != "VisimeSpec":
            raise asset_error(entry, "known is VisimeSpec")
        viseme = number(entry, "visime")
        if viseme not in range(_LAST_NUMBER + 1):
            raise asset_error(entry, f"visime='{viseme:g}' is not from 0 to {_LAST_NUMBER}")
        if viseme in turns:
            raise asset_error(entry, f"visime='{viseme:g}' is given twice")
        turned = _widest(entry, asset, humanoid)
        turns[int(viseme)] = {
            weight: value for joint in turned.items() for weight, value in turn_weights(*joint).items()
        }
        joints |= turned.keys()
    if not joints:
        raise asset_error(document, "it turns no joint of the figure")
    moved = tuple(weight for joint in sorted(joints) for weight in weights_of_joint(joint))
    shapes = {
        name: MouthShape(turns[found], contact=(_PART,) if name == _CLOSED else ())
        for name, found in _NUMBERS.items()
        if found in turns
    }
    return MouthTables(path.name, {}, shapes, {_PART: Articulator(moved, _TIME, _TIME)})


def _widest(
    entry: XmlElement, asset: Callable[[str], Path], humanoid: Humanoid
) -> dict[str, tuple[float, float, float]]:
    """Return the rotation vectors of joints, rad, in the pose of a motion in which they turn most."""
    motion = entry.find("MotionUnit")
    if motion is None:
        raise asset_error(entry, "it has no MotionUnit")
    if attribute(motion, "type") != "ProcAnimation":
        raise asset_error(motion, "only motions of the type ProcAnimation play visemes")
    rest = Body(humanoid.avatar.skeleton)
    animation = read_procedural_animation(asset(attribute(motion, "file"))).fitted_to(rest.skeleton)
    given = {attribute(each, "name"): number(each, "value") for each in entry.iterfind("parameterdefaults/*")}
    if unknown := given.keys() - animation.parameters:
        lacks, has = listed(unknown), listed(animation.parameters) or "none"
        place = f"{Path(entry.base or '').name}, line {entry.sourceline}"
        logger.warning("%s: the motion of this entry has no parameter %s; it has %s", place, lacks, has)
    parameters = animation.values(given)
    poses = [animation.sample(step / _PHASES, parameters, rest).rotations for step in range(_PHASES + 1)]
    widest = max(poses, key=lambda pose: max(map(angle, pose.values()), default=0.0))
    for joint, turn in widest.items():
        if angle(turn) > _WIDEST:
            raise asset_error(motion, f"{joint} turns by {math.degrees(angle(turn)):.0f} degrees; the limit is 45")
    return {joint: rotation_vector(turn) for joint, turn in widest.items()}
