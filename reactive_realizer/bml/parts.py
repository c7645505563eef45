"""The parts of faces, postures, changes of parameters and keyframe animations, and parameters of all behaviors."""

from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import Any

from reactive_realizer.bml.attributes import attributes_of
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.continuous import ParameterValueChange, Trajectory
from reactive_realizer.bml.elements import ELEMENTS
from reactive_realizer.bml.face import Face
from reactive_realizer.bml.posture import Pose, Posture, Stance
from reactive_realizer.bml.source import Source
from reactive_realizer.bml.trees import PARAMETER, Tree, children_of, name_of
from reactive_realizer.bml.twente import Keyframe, Parameter
from reactive_realizer.bml.words import PosePart
from reactive_realizer.errors import Fault, RealizerError


def read_face(tree: Tree, source: Source, notes: list[Fault]) -> dict[str, Any]:
    """The parts of a face.

    Raises:
        RealizerError: there are none, or one is bad.
    """
    parts = children_of(tree, *Face.CHILDREN)
    _check_some(parts, tree, Face.CHILDREN, source)
    return {"parts": tuple(_expression(part, source, notes) for part in parts)}


def _expression(tree: Tree, source: Source, notes: list[Fault]) -> Behavior:
    """A part of a face: its id may be missing, and it has no times of its own."""
    element = ELEMENTS[name_of(tree)]
    attributes = [each for each in element.attributes if each.field != "id"]
    notes += source.unread(tree, ["id", *(each.name for each in attributes)])
    values = source.written(tree) | source.values(tree, attributes)
    return element.behavior(**values, id=tree.get("id", ""), namespace=element.namespace, order=0)


def read_change(tree: Tree, source: Source, notes: list[Fault]) -> dict[str, Any]:
    """The trajectory of a change of a parameter.

    Raises:
        RealizerError: there is none, there are two, or it is bad.
    """
    trajectories = children_of(tree, "trajectory")
    _check_some(trajectories, tree, ParameterValueChange.CHILDREN, source)
    if len(trajectories) > 1:
        raise _repeated(trajectories[1], "trajectory", tree, source)
    return {"trajectory": Trajectory(**_values(trajectories[0], Trajectory, source, notes))}


def read_posture(tree: Tree, source: Source, notes: list[Fault]) -> dict[str, Any]:
    """The stance and the poses of a posture.

    Raises:
        RealizerError: there are none, there are two for one part of the body, or one is bad.
    """
    stances, poses = children_of(tree, "stance"), children_of(tree, "pose")
    _check_some(stances + poses, tree, Posture.CHILDREN, source)
    if len(stances) > 1:
        raise _repeated(stances[1], "stance", tree, source)
    stance = Stance(**_values(stances[0], Stance, source, notes)).type if stances else None
    by_part: dict[PosePart, Pose] = {}
    for child in poses:
        pose = Pose(**_values(child, Pose, source, notes))
        if pose.part in by_part:
            raise _repeated(child, f"pose part='{pose.part}'", tree, source)
        by_part[pose.part] = pose
    return {"stance": stance, "poses": tuple(by_part.values())}


def read_interpolator(tree: Tree, source: Source, notes: list[Fault]) -> dict[str, Any]:
    """The keys that stand inside a keyframe animation, if they do.

    Raises:
        RealizerError: there are two.
    """
    written = children_of(tree, *Keyframe.CHILDREN)
    if len(written) > 1:
        raise _repeated(written[1], name_of(written[1]), tree, source)
    return {"interpolator": source.xml(written[0]) if written else None}


def read_parameters(tree: Tree, source: Source, notes: list[Fault]) -> Mapping[str, str]:
    """What a behavior says to what plays it, by name (thesis C.1.1).

    Raises:
        RealizerError: one is said twice, or is bad.
    """
    parameters: dict[str, str] = {}
    for child in children_of(tree, PARAMETER):
        parameter = Parameter(**_values(child, Parameter, source, notes))
        if parameter.name in parameters:
            raise _repeated(child, f"{PARAMETER} name='{parameter.name}'", tree, source)
        parameters[parameter.name] = parameter.value
    return MappingProxyType(parameters)


def _values(tree: Tree, kind: type, source: Source, notes: list[Fault]) -> dict[str, Any]:
    attributes = attributes_of(kind)
    notes += source.unread(tree, [each.name for each in attributes])
    return source.values(tree, attributes)


def _check_some(parts: list[Tree], tree: Tree, names: Iterable[str], source: Source) -> None:
    if not parts:
        wanted = " or ".join(f"<{name}>" for name in names)
        raise RealizerError(source.fault(tree, "missing-element", children=wanted))


def _repeated(child: Tree, element: str, tree: Tree, source: Source) -> RealizerError:
    return RealizerError(source.fault(child, "repeated-element", element=element, parent=name_of(tree)))
