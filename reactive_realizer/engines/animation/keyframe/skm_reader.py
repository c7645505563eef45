"""Reads motions in SmartBody's formats ``.skm`` and ``.skmb``, with the skeleton that they are for.

A motion names channels of joints, then their values at times, then its sync points (sk_motion_io and sk_channel of
SmartBody). A rotation is written as axis times angle, rad, in the turned axes of its joint; a position is added to the
offset of its joint.
"""

import logging
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Final

import numpy as np

from reactive_realizer.bml.smartbody.joints import joint_named
from reactive_realizer.embodiment.joints import EYES, JAW
from reactive_realizer.embodiment.quaternion import multiply
from reactive_realizer.embodiment.vector import scale
from reactive_realizer.engines.animation.keyframe.capture import Array, Capture, CapturedJoint, product
from reactive_realizer.engines.animation.keyframe.capture_words import CaptureWords, read_text
from reactive_realizer.engines.animation.keyframe.sk_motion import (
    ANGLES,
    KINDS,
    ONE_POSE,
    PLACES,
    QUAT,
    UNPLAYED,
    SkMotion,
    add_point,
    completed,
    width,
)
from reactive_realizer.engines.animation.keyframe.sk_reader import SK_WORD, SkJoint, read_skeleton, without_comments
from reactive_realizer.engines.animation.keyframe.skmb_reader import read_binary_motion

_log = logging.getLogger(__name__)

_BINARY: Final = ".skmb"
_SIGNATURES: Final = ("skmotion", "homotion", "knmotion")
_POINTS: Final = {
    "ready": "ready",
    "stroke_start": "strokeStart",
    "strokeStart": "strokeStart",
    "emphasis": "stroke",
    "stroke_emphasis": "stroke",
    "stroke": "strokeEnd",
    "stroke_end": "strokeEnd",
    "strokeEnd": "strokeEnd",
    "relax": "relax",
}
"""Sync points of SmartBody's motions, to those of BML: its emphasis is BML's stroke, and its stroke the end of it."""
_SPELLINGS: Final = {spelled: sync for name, sync in _POINTS.items() for spelled in (name, f"{name}Time")}
_METERS: Final = re.compile(r"^\s*#.*\bUnits:\s*m\b", re.MULTILINE)
_CENTIMETER: Final = 0.01
_STANDARD: Final = Path(__file__).with_name("standard.sk")
"""The joints of SmartBody's first characters, in a T-pose with axes along those of the figure; in centimeters."""
_NEVER: Final = frozenset((*EYES, JAW))
"""Joints that gaze and speech move; motions have channels for all joints, these too."""


def read_motion(path: Path, skeleton: Path | None) -> Capture:
    """Read a motion in text or, if its name ends in ``.skmb``, in the binary format.

    Args:
        path: of the motion.
        skeleton: its skeleton; None for the standard one.

    Raises:
        RealizerError: "bad-capture", with file, line and reason, or "bad-binary-motion"; or a file is too big.
        OSError: a file cannot be read.
    """
    motion = read_binary_motion(path) if path.suffix.lower() == _BINARY else _read_text(path)
    whole = CaptureWords(path.name, "", "motion")  # names the file, and its first line, in errors
    joints = read_skeleton(skeleton or _STANDARD)
    if not {joint.name for joint in joints} & {joint for joint, _ in motion.channels}:
        own = f"of {skeleton.name}" if skeleton else "of SmartBody's standard skeleton, and its own is not beside it"
        raise whole.bad(f"its joints, such as {motion.channels[0][0]}, are not those {own}")
    whole.check_size(len(joints), len(motion.times))
    if skeleton is None:
        _log.warning("%s: no skeleton is beside it; SmartBody's standard skeleton is assumed", path.name)
        joints = tuple(_in_unit(joint, motion) for joint in joints)
    return _capture(path.name, motion, joints)


def _read_text(path: Path) -> SkMotion:
    text = read_text(path)
    words = CaptureWords(path.name, without_comments(text), "motion", SK_WORD)
    return _read(path.name, words, meters=_METERS.search(text) is not None)


def _in_unit(joint: SkJoint, motion: SkMotion) -> SkJoint:
    """Return a joint of the standard skeleton in the unit of a motion."""
    size = _CENTIMETER if motion.meters else 1.0
    return SkJoint(joint.name, joint.parent, scale(joint.offset, size), joint.before, joint.after)


def _capture(name: str, motion: SkMotion, joints: Sequence[SkJoint]) -> Capture:
    places = {joint.name: index for index, joint in enumerate(joints)}
    rests = np.array([multiply(joint.before, joint.after) for joint in joints])
    turns = np.tile(rests, (len(motion.times), 1, 1))
    moves: dict[int, Array] = {}
    angles: dict[int, Array] = {}
    about: set[int] = set()
    column = 0
    for joint, kind in motion.channels:
        values = motion.values[:, column : column + width(kind)]
        column += width(kind)
        index = places.get(joint)
        if index is None:
            continue
        own = joints[index]
        about.add(index)
        if kind == QUAT:
            turns[:, index] = _turned(own, _quaternions(values))
        elif kind in ANGLES:
            angles.setdefault(index, np.zeros((len(values), 3)))[:, ANGLES.index(kind)] = values[:, 0]
        else:
            moved = moves.setdefault(index, np.tile(own.offset, (len(values), 1)))
            moved[:, PLACES.index(kind)] += values[:, 0]
    for index, turned in angles.items():
        turns[:, index] = _turned(joints[index], _of_angles(turned))
    captured = tuple(
        CapturedJoint(joint_named(own.name), own.parent, own.offset, _quat(rest))
        for own, rest in zip(joints, rests.tolist(), strict=True)
    )
    played = frozenset(index for index in about if captured[index].name not in _NEVER)
    return Capture(name, captured, tuple(motion.times.tolist()), turns, moves, played, motion.points)


def _turned(joint: SkJoint, turns: Array) -> Array:
    """Return the rotations of a joint, (F, 4), of which a motion has those in its turned axes."""
    return product(product(np.array(joint.before), turns), np.array(joint.after))


def _of_angles(degrees: Array) -> Array:
    """Return unit quaternions, (F, 4), of turns about y, then x, then z, of angles about x, y, z, degrees, (F, 3)."""
    about_x, about_y, about_z = (_quaternions(np.radians(degrees) * axis) for axis in np.eye(3))
    return product(product(about_z, about_x), about_y)


def _quat(values: list[float]) -> tuple[float, float, float, float]:
    w, x, y, z = values
    return (w, x, y, z)


def _quaternions(vectors: Array) -> Array:
    """Return unit quaternions, (F, 4), of rotations written as axis times angle, rad, (F, 3)."""
    half = 0.5 * np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.concatenate([np.cos(half), 0.5 * vectors * np.sinc(half / np.pi)], axis=-1)


def _read(name: str, words: CaptureWords, *, meters: bool) -> SkMotion:
    """Read the words of a motion."""
    if words.next().lower() not in _SIGNATURES:
        raise words.bad("the file should begin with SkMotion")
    word = words.next()
    if word == "name":
        _, word = words.next(), words.next()
    if word != "channels":
        raise words.bad(f"found '{word}' instead of channels")
    channels = tuple(_channel(words) for _ in range(words.count()))
    if not channels:
        raise words.bad("there are no channels")
    word, first = words.next(), None
    if word == "start_kt":
        first, word = words.number(), words.next()
    if word != "frames":
        raise words.bad(f"found '{word}' instead of frames")
    times, values = _frames(words, sum(width(kind) for _, kind in channels))
    if first is not None:
        times = times + (first - times[0])
    return SkMotion(channels, times, values, _points(name, words, times.tolist()), meters)


def _channel(words: CaptureWords) -> tuple[str, str]:
    """Read the name of a joint, which may consist of several words, and the kind of a channel, in one line."""
    name, kind = [words.next()], words.next()
    row = words.row
    while kind.lower() not in KINDS:
        if kind.lower() in UNPLAYED:
            raise words.bad(f"it has a channel {kind}, which SmartBody does not play either")
        name.append(kind)
        kind = words.next()
        if words.row != row:
            raise words.bad(
                f"the channel before is none of XPos, YPos, ZPos, XRot, YRot, ZRot and Quat: '{' '.join(name)}'"
            )
    return " ".join(name).strip('"'), kind.lower()


def _frames(words: CaptureWords, width: int) -> tuple[Array, Array]:
    """Read the times and the values of all frames."""
    count = words.count()
    times: list[float] = []
    values: list[Array] = []
    for _ in range(count):
        words.expect("kt")
        time = words.number()
        if times and time <= times[-1]:
            raise words.bad(f"the times of the frames do not increase: {times[-1]:g}, {time:g}")
        words.expect("fr")
        times.append(time)
        values.append(words.numbers(width))
    if not times:
        raise words.bad("there are no frames")
    if len(times) == 1:
        times, values = [times[0], times[0] + ONE_POSE], values * 2
    return np.array(times), np.array(values)


def _points(name: str, words: CaptureWords, times: Sequence[float]) -> dict[str, float]:
    """Read the sync points behind the frames; other words there are data about the motion."""
    points: dict[str, float] = {}
    while word := words.next_if_any():
        sync = _SPELLINGS.get(word.rstrip(":"))
        if sync is None:
            continue
        value = words.next()
        while value in ("time", "time:", ":"):
            value = words.next()
        add_point(points, sync, words.finite(value.strip('"')), times, f"{name}, line {words.row}")
    return completed(points, times)
