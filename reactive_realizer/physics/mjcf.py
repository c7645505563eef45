"""MuJoCo models of figures, as MJCF (MuJoCo's XML format)."""

import math
from collections.abc import Iterable

import mujoco
import numpy as np
from lxml import etree
from numpy.typing import NDArray

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.humanoid import between_eyes
from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.quaternion import Quat, from_axis_angle, rotate
from reactive_realizer.embodiment.vector import subtract
from reactive_realizer.physics.segments import LIMITS, REFERENCE_STATURE, REFERENCE_WEIGHT, SEGMENTS
from reactive_realizer.physics.shapes import Shape, shape

TO_WORLD: Quat = from_axis_angle((1.0, 0.0, 0.0), math.pi / 2.0)
"""Rotation from the figure's frame, with y up, to MuJoCo's world, with z up. A figure faces -y there."""

_EYES = 0.936
"""Height of the eyes as a share of stature (Drillis and Contini 1966)."""

_FLOOR_KIND, _BODY_KIND = "1", "2"
"""Contact kinds: segments touch the floor, and not each other."""

_DAMPING, _DAMPING_POWER = 0.7, 0.65
"""Damping of a loose joint, Nms/rad: a factor, and the power of the inertia that turns about it, kg m^2.

This gives 0.03 for a wrist, 0.2 for an elbow and 0.5 for a shoulder, which is the magnitude of relaxed joints. In
proportion to inertia, light segments would whip when heavier ones stop.
"""


def stature(skeleton: Skeleton) -> float:
    """Return the stature of a figure, m."""
    return between_eyes(Body(skeleton))[1] / _EYES


def usual_weight(skeleton: Skeleton) -> float:
    """Return the weight of a figure that has the body mass index of the reference body, kg."""
    return REFERENCE_WEIGHT * (stature(skeleton) / REFERENCE_STATURE) ** 2


def segment_joints(skeleton: Skeleton) -> tuple[str, ...]:
    """Return the joints of the segments that a figure has; the root is the first, and parents precede children."""
    return tuple(segment.joint for segment in SEGMENTS if segment.joint in skeleton)


def mjcf(skeleton: Skeleton, weight: float | None = None) -> bytes:
    """Return the model of a figure that stands in the default pose on a floor.

    Every segment is a body with the name of its joint, and turns about a ball joint of the same name; the root has a
    free joint. The axes of a body in the default pose are those of the figure, `TO_WORLD`. A segment that the skeleton
    has no joint for is left out, with its mass.

    Args:
        skeleton: of the figure.
        weight: of all segments, kg; None for the `usual_weight`.
    """
    scale = (usual_weight(skeleton) if weight is None else weight) / REFERENCE_WEIGHT
    model = etree.Element("mujoco", model="figure")
    etree.SubElement(model, "compiler", angle="degree")
    etree.SubElement(model, "option", timestep="0.0025", gravity="0 0 -9.81")
    world = etree.SubElement(model, "worldbody")
    etree.SubElement(world, "light", pos="0 -3 4", dir="0 0.6 -0.8")
    etree.SubElement(
        world, "geom", name="floor", type="plane", size="5 5 0.1", contype=_FLOOR_KIND, conaffinity=_BODY_KIND
    )
    joints, body = segment_joints(skeleton), Body(skeleton)
    elements = {ROOT: _root(world, body)}
    for joint in joints[1:]:
        elements[joint] = _child(elements, body, joint)
    for segment in SEGMENTS:
        if segment.joint in elements:
            mass = scale * segment.mass
            _add_geom(elements[segment.joint], shape(skeleton, segment.joint, mass / segment.density), mass)
    _damp(model, joints[1:])
    return etree.tostring(model, pretty_print=True)


def _damp(model: etree._Element, joints: Iterable[str]) -> None:
    """Set the damping of ball joints."""
    compiled = mujoco.MjModel.from_xml_string(etree.tostring(model, encoding="unicode"))
    about = inertia(compiled)
    for joint in joints:
        first = compiled.joint(joint).dofadr[0]
        (element,) = model.iterfind(f".//joint[@name='{joint}']")
        element.set("damping", f"{_DAMPING * about[first : first + 3].max() ** _DAMPING_POWER:.6g}")


def inertia(model: mujoco.MjModel) -> NDArray[np.float64]:
    """Return the inertia that turns about each degree of freedom in the default pose, kg m^2 or kg, (nv,)."""
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    matrix = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, matrix)
    return matrix.diagonal().copy()


def _root(world: etree._Element, body: Body) -> etree._Element:
    place = rotate(TO_WORLD, body.transform(ROOT).position)
    element = etree.SubElement(world, "body", name=ROOT, pos=_text(place), quat=_text(TO_WORLD))
    etree.SubElement(element, "freejoint", name=ROOT)
    return element


def _child(elements: dict[str, etree._Element], body: Body, joint: str) -> etree._Element:
    parent = next(name for name in reversed(body.skeleton.chain(joint)[:-1]) if name in elements)
    way = subtract(body.transform(joint).position, body.transform(parent).position)
    element = etree.SubElement(elements[parent], "body", name=joint, pos=_text(way))
    most = f"0 {min(LIMITS[joint].widest, 180.0):g}"
    etree.SubElement(element, "joint", name=joint, type="ball", limited="true", range=most)
    return element


def _add_geom(element: etree._Element, own: Shape, mass: float) -> None:
    geom = etree.SubElement(
        element, "geom", type=own.kind, mass=f"{mass:.6g}", contype=_BODY_KIND, conaffinity=_FLOOR_KIND
    )
    if own.axis is None:
        geom.set("pos", _text(own.center))
        geom.set("size", _text(own.size))
    else:
        geom.set("fromto", _text((0.0, 0.0, 0.0, *own.axis)))
        geom.set("size", _text(own.size[:1]))


def _text(values: Iterable[float]) -> str:
    return " ".join(f"{value:.9g}" for value in values)
