"""Reads motions in SmartBody's format ``.skm``, with the skeleton that they are for.

A motion names channels of joints, then their values at times, then its sync points (sk_motion_io and sk_channel of
SmartBody). A rotation is written as axis times angle, rad, in the turned axes of its joint; a position is added to the
offset of its joint.
"""

import logging
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np

from reactive_realizer.bml.smartbody.joints import joint_named
from reactive_realizer.embodiment.joints import EYES, JAW
from reactive_realizer.embodiment.quaternion import multiply
from reactive_realizer.embodiment.vector import scale
from reactive_realizer.engines.animation.keyframe.capture import Array, Capture, CapturedJoint, product
from reactive_realizer.engines.animation.keyframe.capture_words import CaptureWords, read_text
from reactive_realizer.engines.animation.keyframe.sk_reader import SK_WORD, SkJoint, read_skeleton, without_comments

_log = logging.getLogger(__name__)

_SIGNATURES: Final = ("skmotion", "homotion", "knmotion")
_QUAT: Final = "quat"
_PLACES: Final = ("xpos", "ypos", "zpos")
_KINDS: Final = (_QUAT, *_PLACES)
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
_ROUNDED: Final = 0.05
"""Time by which a sync point may be outside of its motion because it was rounded, s."""
_ONE_POSE: Final = 1.0 / 30.0
"""Duration of a motion of one frame, s."""
_METERS: Final = re.compile(r"^\s*#.*\bUnits:\s*m\b", re.MULTILINE)
_CENTIMETER: Final = 0.01
_STANDARD: Final = Path(__file__).with_name("standard.sk")
"""The joints of SmartBody's first characters, in a T-pose with axes along those of the figure; in centimeters."""
_NEVER: Final = frozenset((*EYES, JAW))
"""Joints that gaze and speech move; motions have channels for all joints, these too."""


class SkMotion(NamedTuple):
    """A motion without a skeleton.

    Attributes:
        name: in the file, often that of its skeleton, "@" and its own; empty if there is none.
        channels: name of the joint and kind, in lower case, in the order of the values.
        times: of the frames, s, (F,).
        values: of all channels in each frame, (F, C).
        points: sync id -> time, s.
        meters: whether the file says that its lengths are in meters.
    """

    name: str
    channels: tuple[tuple[str, str], ...]
    times: Array
    values: Array
    points: Mapping[str, float]
    meters: bool


def read_motion(path: Path, skeleton: Path | None) -> Capture:
    """Read a motion.

    Args:
        path: of the motion.
        skeleton: its skeleton; None for the standard one.

    Raises:
        RealizerError: "bad-capture", with file, line and reason; or a file is too big.
        OSError: a file cannot be read.
    """
    text = read_text(path)
    words = CaptureWords(path.name, without_comments(text), "motion", SK_WORD)
    motion = _read(path.name, words, meters=_METERS.search(text) is not None)
    words.row = 1
    joints = read_skeleton(skeleton or _STANDARD)
    if not {joint.name for joint in joints} & {joint for joint, _ in motion.channels}:
        own = f"of {skeleton.name}" if skeleton else "of SmartBody's standard skeleton, and its own is not beside it"
        raise words.bad(f"its joints, such as {motion.channels[0][0]}, are not those {own}")
    words.check_size(len(joints), len(motion.times))
    if skeleton is None:
        _log.warning("%s: no skeleton is beside it; SmartBody's standard skeleton is assumed", path.name)
        joints = tuple(_in_unit(joint, motion) for joint in joints)
    return _capture(path.name, motion, joints)


def _in_unit(joint: SkJoint, motion: SkMotion) -> SkJoint:
    """Return a joint of the standard skeleton in the unit of a motion."""
    size = _CENTIMETER if motion.meters else 1.0
    return SkJoint(joint.name, joint.parent, scale(joint.offset, size), joint.before, joint.after)


def _capture(name: str, motion: SkMotion, joints: Sequence[SkJoint]) -> Capture:
    places = {joint.name: index for index, joint in enumerate(joints)}
    rests = np.array([multiply(joint.before, joint.after) for joint in joints])
    turns = np.tile(rests, (len(motion.times), 1, 1))
    moves: dict[int, Array] = {}
    about: set[int] = set()
    column = 0
    for joint, kind in motion.channels:
        values = motion.values[:, column : column + _width(kind)]
        column += _width(kind)
        index = places.get(joint)
        if index is None:
            continue
        own = joints[index]
        about.add(index)
        if kind == _QUAT:
            turns[:, index] = product(product(np.array(own.before), _quaternions(values)), np.array(own.after))
        else:
            moved = moves.setdefault(index, np.tile(own.offset, (len(values), 1)))
            moved[:, _PLACES.index(kind)] += values[:, 0]
    captured = tuple(
        CapturedJoint(joint_named(own.name), own.parent, own.offset, _quat(rest))
        for own, rest in zip(joints, rests.tolist(), strict=True)
    )
    played = frozenset(index for index in about if captured[index].name not in _NEVER)
    return Capture(name, captured, tuple(motion.times.tolist()), turns, moves, played, motion.points)


def _quat(values: list[float]) -> tuple[float, float, float, float]:
    w, x, y, z = values
    return (w, x, y, z)


def _quaternions(vectors: Array) -> Array:
    """Return unit quaternions, (F, 4), of rotations written as axis times angle, rad, (F, 3)."""
    half = 0.5 * np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.concatenate([np.cos(half), 0.5 * vectors * np.sinc(half / np.pi)], axis=-1)


def _width(kind: str) -> int:
    return 3 if kind == _QUAT else 1


def _read(name: str, words: CaptureWords, *, meters: bool) -> SkMotion:
    """Read the words of a motion."""
    if words.next().lower() not in _SIGNATURES:
        raise words.bad("the file should begin with SkMotion")
    word, own = words.next(), ""
    if word == "name":
        own, word = words.next().strip('"'), words.next()
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
    times, values = _frames(words, sum(_width(kind) for _, kind in channels))
    if first is not None:
        times = times + (first - times[0])
    return SkMotion(own, channels, times, values, _points(name, words, times.tolist()), meters)


def _channel(words: CaptureWords) -> tuple[str, str]:
    """Read the name of a joint, which may consist of several words, and the kind of a channel, in one line."""
    name, kind = [words.next()], words.next()
    row = words.row
    while kind.lower() not in _KINDS:
        name.append(kind)
        kind = words.next()
        if words.row != row:
            raise words.bad(f"the channel before is none of XPos, YPos, ZPos and Quat: '{' '.join(name)}'")
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
        times, values = [times[0], times[0] + _ONE_POSE], values * 2
    return np.array(times), np.array(values)


def _points(name: str, words: CaptureWords, times: Sequence[float]) -> dict[str, float]:
    """Read the sync points behind the frames; other words there are data about the motion."""
    points: dict[str, float] = {}
    first, last = times[0], times[-1]
    while word := words.next_if_any():
        sync = _SPELLINGS.get(word.rstrip(":"))
        if sync is None:
            continue
        value = words.next()
        while value in ("time", "time:", ":"):
            value = words.next()
        time = words.finite(value.strip('"'))
        if first - _ROUNDED <= time <= last + _ROUNDED:
            points[sync] = min(max(time, first), last)
        elif time >= 0.0:  # a point below 0 is not set
            _log.warning("%s, line %d: %s at %g s is outside of the motion", name, words.row, word, time)
    return _completed(points, first, last)


def _completed(points: Mapping[str, float], first: float, last: float) -> dict[str, float]:
    """Return sync points with those that are missing, at the times of others, because every motion has all of them."""
    ready, relax = points.get("ready", first), points.get("relax", last)
    stroke_start = points.get("strokeStart", ready)
    missing = {
        "ready": ready,
        "strokeStart": stroke_start,
        "stroke": points.get("stroke", stroke_start),
        "strokeEnd": relax,
        "relax": relax,
    }
    return {**missing, **points}
