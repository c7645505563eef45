"""Controllers by their names in BML and in files."""

import re
from collections.abc import Callable, Mapping
from types import MappingProxyType

from reactive_realizer.embodiment.body import Skeleton
from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.errors import RealizerError
from reactive_realizer.physics.controllers.balance import BalanceController
from reactive_realizer.physics.controllers.controller import NoController, PhysicalController, RagdollController
from reactive_realizer.physics.controllers.joints import AXES, BallJointController, HingeJointController, PoseController
from reactive_realizer.physics.faults import BadAxis, MissingJoint, NoLegs, NoSegment, UnknownController
from reactive_realizer.physics.mjcf import segment_joints

Parameters = Mapping[str, str]
"""Name -> value, as written."""


def new_controller(kind: str, parameters: Parameters, skeleton: Skeleton) -> PhysicalController:
    """Return a new controller.

    Args:
        kind: its name; a Java package before it is ignored.
        parameters: of which those that select joints are read.
        skeleton: of the figure.

    Raises:
        RealizerError: there is no such controller, or it cannot be made for the figure.
    """
    name = kind.rpartition(".")[2]
    if name not in CONTROLLERS:
        raise RealizerError(UnknownController(kind=name, known=tuple(CONTROLLERS)))
    return CONTROLLERS[name](parameters, skeleton)


def _balance(parameters: Parameters, skeleton: Skeleton) -> PhysicalController:
    missing = BalanceController.needed() - set(segment_joints(skeleton))
    if missing:
        raise RealizerError(NoLegs(joints=tuple(sorted(missing))))
    return BalanceController(skeleton)


def _ragdoll(parameters: Parameters, skeleton: Skeleton) -> PhysicalController:
    return RagdollController(_joints(parameters, skeleton) or segment_joints(skeleton))


def _pose(parameters: Parameters, skeleton: Skeleton) -> PhysicalController:
    every = (joint for joint in segment_joints(skeleton) if joint != ROOT)
    return PoseController(_joints(parameters, skeleton) or tuple(every))


def _ball(parameters: Parameters, skeleton: Skeleton) -> PhysicalController:
    return BallJointController(_joint("BallJointController", parameters, skeleton))


def _hinge(parameters: Parameters, skeleton: Skeleton) -> PhysicalController:
    axis = parameters.get("axis", "0")
    if axis not in ("0", "1", "2", *AXES):
        raise RealizerError(BadAxis(axis=axis))
    index = AXES.index(axis) if axis in AXES else int(axis)
    return HingeJointController(_joint("HingeJointController", parameters, skeleton), index)


def _joint(kind: str, parameters: Parameters, skeleton: Skeleton) -> str:
    joint = parameters.get("joint")
    if joint is None:
        raise RealizerError(MissingJoint(kind=kind))
    return _checked(joint, skeleton)


def _joints(parameters: Parameters, skeleton: Skeleton) -> tuple[str, ...]:
    return tuple(_checked(joint, skeleton) for joint in re.findall(r"[^\s,]+", parameters.get("joints", "")))


def _checked(joint: str, skeleton: Skeleton) -> str:
    known = segment_joints(skeleton)
    if joint not in known:
        raise RealizerError(NoSegment(joint=joint, known=known))
    return joint


CONTROLLERS: Mapping[str, Callable[[Parameters, Skeleton], PhysicalController]] = MappingProxyType(
    {
        "BalanceController": _balance,
        "BallJointController": _ball,
        "HingeJointController": _hinge,
        "NoController": lambda parameters, skeleton: NoController(),
        "PoseController": _pose,
        "RagdollController": _ragdoll,
    }
)
"""Name of a kind of controller -> creates one."""
