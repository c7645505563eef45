"""Reads skeletons in SmartBody's format ``.sk``.

A tree of joints, each with its offset from the joint above and the turn of its axes, ``prerot``: the rotation of a
joint is prerot times that of the motion times ``postrot`` (sk_skeleton_io and sk_joint_quat of SmartBody). What else
joints have, such as limits, channels and geometry, does not matter for motions. ``#`` begins a comment.
"""

import math
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, from_axis_angle, multiply
from reactive_realizer.embodiment.vector import Vec3, length, scale, unit
from reactive_realizer.engines.animation.keyframe.capture_words import CaptureWords, read_text

SK_WORD: Final = re.compile(r'"[^"]*"|[{}]|[^\s{}"]+')
"""A word of SmartBody's formats: a string, a brace, or what is between white space."""
_COMMENT: Final = re.compile(r"#.*")
_OFFSETS: Final = ("offset", "center")
_BEFORE: Final = ("prerot", "framerot")
_AFTER: Final = "postrot"
_NESTED: Final = ("joint", "end")
_REFUSED: Final = ("align", "euler")
"""They would turn axes in ways that are not read."""


@dataclass(frozen=True, slots=True)
class SkJoint:
    """A joint of a skeleton.

    Attributes:
        name: in the file.
        parent: index of the joint above, -1 for the root.
        offset: from the joint above, in its axes and in the unit of the file.
        before: the turn of its axes, `prerot`.
        after: `postrot`.
    """

    name: str
    parent: int
    offset: Vec3 = (0.0, 0.0, 0.0)
    before: Quat = IDENTITY
    after: Quat = IDENTITY


def without_comments(text: str) -> str:
    """Return a text of SmartBody without its comments; lines stay where they are."""
    return _COMMENT.sub("", text)


def read_skeleton(path: Path) -> tuple[SkJoint, ...]:
    """Read the joints of a skeleton, each after the one above it.

    Raises:
        RealizerError: "bad-capture", with file, line and reason; or the file is too big.
        OSError: the file cannot be read.
    """
    words = CaptureWords(path.name, without_comments(read_text(path)), "skeleton", SK_WORD)
    size = 1.0
    while word := words.next_if_any().lower():
        if word == "set_scale":
            size = words.number()
        elif word == "skeleton":
            _expect(words, "root")
            break
    if not word:
        raise words.bad("there is no 'skeleton', 'root' and the name of a joint")
    joints = _joints(words)
    return tuple(_scaled(joint, size) for joint in joints)


def _joints(words: CaptureWords) -> list[SkJoint]:
    """Read the root and all joints below it."""
    joints = [SkJoint(_name_before_brace(words), -1)]
    above = [0]
    while above:
        word = words.next().lower()
        if word == "}":
            above.pop()
        elif word in _NESTED:
            joints.append(SkJoint(_name_before_brace(words), above[-1]))
            above.append(len(joints) - 1)
            words.check_size(len(joints))
        else:
            joints[above[-1]] = _told(joints[above[-1]], word, words)
    return joints


def _told(joint: SkJoint, word: str, words: CaptureWords) -> SkJoint:
    """Return a joint with what a word says about it."""
    before, offset, after = joint.before, joint.offset, joint.after
    if word in _OFFSETS:
        offset = (words.number(), words.number(), words.number())
    elif word in _BEFORE:
        before = multiply(before, _turn(words))
    elif word == _AFTER:
        after = multiply(after, _turn(words))
    elif word in _REFUSED:
        raise words.bad(f"'{word}' is not supported; the axes of a joint are turned by 'prerot' and 'postrot'")
    return SkJoint(joint.name, joint.parent, offset, before, after)


def _turn(words: CaptureWords) -> Quat:
    """Read ``axis X Y Z ang DEGREES``; an axis without a length is no turn."""
    _expect(words, "axis")
    axis = (words.number(), words.number(), words.number())
    _expect(words, "ang")
    angle = math.radians(words.number())
    return from_axis_angle(unit(axis), angle) if length(axis) else IDENTITY


def _name_before_brace(words: CaptureWords) -> str:
    """Read the name of a joint, which may consist of several words, up to its brace."""
    name = []
    while (word := words.next()) != "{":
        name.append(word.strip('"'))
    return " ".join(name)


def _expect(words: CaptureWords, wanted: str) -> None:
    word = words.next()
    if word.lower() != wanted:
        raise words.bad(f"found '{word}' instead of {wanted}")


def _scaled(joint: SkJoint, size: float) -> SkJoint:
    return SkJoint(joint.name, joint.parent, scale(joint.offset, size), joint.before, joint.after)
