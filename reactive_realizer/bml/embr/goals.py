"""Reads the constraints of key poses as goals."""

from collections.abc import Callable, Mapping
from typing import Final, NamedTuple

from reactive_realizer.bml.embr.faults import UnknownName
from reactive_realizer.bml.embr.syntax import LOOK_AT, ORIENTATION, POSE_TARGET, POSITION, SWIVEL, Node
from reactive_realizer.bml.embr.values import Notes
from reactive_realizer.bml.embr.words import JOINTS
from reactive_realizer.bml.key_poses import (
    Coordinates,
    KeyPoseGoal,
    LookAtGoal,
    OrientationGoal,
    PoseGoal,
    PositionGoal,
    SwivelGoal,
)
from reactive_realizer.bml.vocabulary import BodyAxis, BodyGroup
from reactive_realizer.errors import RealizerError, quoted


class _Part(NamedTuple):
    """A part of the body that has an orientation.

    Attributes:
        joint: the one that has it where a script names none, without its side; empty for both shoulders.
        meant: its axis where a script names none.
        axes: NORMAL in lowercase -> its name here, and its sign; that of THUMB is the one of a left hand.
    """

    joint: str
    meant: BodyAxis
    axes: Mapping[str, tuple[BodyAxis, float]]


_HAND: Final = _Part(
    "wrist",
    BodyAxis.PALM,
    {"xaxis": (BodyAxis.THUMB, 1.0), "yaxis": (BodyAxis.FINGERS, 1.0), "zaxis": (BodyAxis.PALM, -1.0)},
)
"""y is along the hand, z out of its back."""
_HEAD: Final = _Part(
    "skullbase",
    BodyAxis.FACE,
    {"xaxis": (BodyAxis.LEFT_EAR, 1.0), "yaxis": (BodyAxis.CROWN, 1.0), "zaxis": (BodyAxis.FACE, 1.0)},
)
_TRUNK: Final = _Part(
    "vt6",
    BodyAxis.CHEST,
    {"xaxis": (BodyAxis.LEFT_SIDE, 1.0), "yaxis": (BodyAxis.SPINE, 1.0), "zaxis": (BodyAxis.CHEST, 1.0)},
)
_SHOULDER: Final = _Part("", BodyAxis.SHOULDER, {"yaxis": (BodyAxis.SHOULDER, 1.0)})
_EYE: Final = _Part("eyeball_joint", BodyAxis.SIGHT, {"yaxis": (BodyAxis.SIGHT, 1.0)})

_PARTS: Final[Mapping[BodyGroup, _Part]] = {
    BodyGroup.TRUNK: _TRUNK,
    BodyGroup.SHOULDERS: _SHOULDER,
    **dict.fromkeys((BodyGroup.HEAD, BodyGroup.HEAD_NECK, BodyGroup.HEAD_CHEST, BodyGroup.HEAD_BACK), _HEAD),
    **dict.fromkeys((BodyGroup.EYES, BodyGroup.LEFT_EYE, BodyGroup.RIGHT_EYE), _EYE),
}
"""The part of each group; of others, it is the hand."""


def read_goal(node: Node, notes: Notes) -> KeyPoseGoal:
    """The goal of a constraint on the skeleton.

    Raises:
        RealizerError: a parameter is missing or bad.
    """
    return _READERS[node.name](node, notes)


def _position(node: Node, notes: Notes) -> KeyPoseGoal:
    target, offset = notes.vector(node, "TARGET"), notes.vector(node, "OFFSET", (0.0, 0.0, 0.0))
    return PositionGoal(target=target, joint=_joint(node), offset=offset, location=node.location)


def _orientation(node: Node, notes: Notes) -> KeyPoseGoal:
    """The direction of a part of the body.

    Some scripts write a vector as NORMAL: the direction of the palm, as DIRECTION without a NORMAL is.
    """
    normal = node.values.get("NORMAL")
    if normal is not None and ";" in normal.text:
        return _directed(node, notes.vector(node, "NORMAL"), None, notes)
    return _directed(node, notes.vector(node, "DIRECTION"), normal and normal.text, notes)


def _directed(node: Node, direction: Coordinates, axis: str | None, notes: Notes) -> KeyPoseGoal:
    joint, group = _joint(node), notes.body_group(node)
    part = _PARTS.get(group, _HAND)
    name, sign = part.meant, 1.0
    if axis is not None:
        if axis.lower() not in part.axes:
            fault = UnknownName(kind="NORMAL", name=quoted(axis), known=tuple(each.capitalize() for each in part.axes))
            place = node.values["NORMAL"].location
            raise RealizerError(fault.located(place.line, place.column))
        name, sign = part.axes[axis.lower()]
    if name is BodyAxis.THUMB and (group is BodyGroup.RIGHT_ARM or (joint or "").startswith("r_")):
        sign = -sign
    x, y, z = (sign * each + 0.0 for each in direction)
    other = None if joint is not None and joint.endswith(part.joint) and part.joint else joint
    return OrientationGoal(direction=(x, y, z), axis=name, joint=other, location=node.location)


def _swivel(node: Node, notes: Notes) -> KeyPoseGoal:
    # Scripts of EMBR write the angle as a TARGET too.
    name = "TARGET" if "TARGET" in node.values and "SWIVEL_ANGLE" not in node.values else "SWIVEL_ANGLE"
    return SwivelGoal(angle=notes.number(node, name, low=-180.0, high=180.0), location=node.location)


def _look_at(node: Node, notes: Notes) -> KeyPoseGoal:
    return LookAtGoal(target=notes.vector(node, "TARGET"), location=node.location)


def _pose(node: Node, notes: Notes) -> KeyPoseGoal:
    influence = notes.number(node, "INFLUENCE", 1.0, 0.0, 1.0)
    return PoseGoal(pose=notes.text(node, "POSE_KEY"), influence=influence, location=node.location)


_READERS: Final[Mapping[str, Callable[[Node, Notes], KeyPoseGoal]]] = {
    POSITION: _position,
    ORIENTATION: _orientation,
    SWIVEL: _swivel,
    LOOK_AT: _look_at,
    POSE_TARGET: _pose,
}

GOALS: Final = frozenset(_READERS)
"""The constraints on the skeleton."""


def _joint(node: Node) -> str | None:
    """The H-Anim name of the joint of a constraint.

    Raises:
        RealizerError: there is no such joint.
    """
    value = node.values.get("JOINT")
    if value is None or not value.text:
        return None
    if value.text not in JOINTS:
        fault = UnknownName(kind="JOINT", name=quoted(value.text), known=tuple(JOINTS))
        raise RealizerError(fault.located(value.location.line, value.location.column))
    return JOINTS[value.text]
