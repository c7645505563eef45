"""Reads the constraints of key poses as goals."""

from collections.abc import Callable, Mapping
from typing import Final

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
from reactive_realizer.bml.vocabulary import BodyAxis
from reactive_realizer.errors import RealizerError, quoted

_AXES: Final[Mapping[str, tuple[BodyAxis, float]]] = {
    "xaxis": (BodyAxis.THUMB, 1.0),
    "yaxis": (BodyAxis.FINGERS, 1.0),
    "zaxis": (BodyAxis.PALM, -1.0),
}
"""Axis of a left hand -> its name here, and its sign: y is along the hand, z out of its back."""

_HEAD_AXES: Final[Mapping[str, BodyAxis]] = {
    "xaxis": BodyAxis.LEFT_EAR,
    "yaxis": BodyAxis.CROWN,
    "zaxis": BodyAxis.FACE,
}


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
    """The direction of a hand or head.

    Some scripts write a vector as NORMAL: the direction of the palm, as DIRECTION without a NORMAL is.
    """
    normal = node.values.get("NORMAL")
    if normal is not None and ";" in normal.text:
        return _directed(node, notes.vector(node, "NORMAL"), None)
    return _directed(node, notes.vector(node, "DIRECTION"), normal and normal.text)


def _directed(node: Node, direction: Coordinates, axis: str | None) -> KeyPoseGoal:
    joint = _joint(node) or ""
    if joint.startswith(("skullbase", "vc")):
        known: Mapping[str, tuple[BodyAxis, float]] = {name: (each, 1.0) for name, each in _HEAD_AXES.items()}
        meant = (BodyAxis.FACE, 1.0)
    else:
        known, meant = _AXES, (BodyAxis.PALM, 1.0)
    if axis is not None:
        if axis.lower() not in known:
            fault = UnknownName(kind="NORMAL", name=quoted(axis), known=("Xaxis", "Yaxis", "Zaxis"))
            place = node.values["NORMAL"].location
            raise RealizerError(fault.located(place.line, place.column))
        meant = known[axis.lower()]
    name, sign = meant
    if name is BodyAxis.THUMB and joint.startswith("r_"):
        sign = -sign
    x, y, z = (sign * part + 0.0 for part in direction)
    return OrientationGoal(direction=(x, y, z), axis=name, location=node.location)


def _swivel(node: Node, notes: Notes) -> KeyPoseGoal:
    return SwivelGoal(angle=notes.number(node, "SWIVEL_ANGLE", low=-180.0, high=180.0), location=node.location)


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
