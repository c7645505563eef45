"""Physical models of figures."""

import math
from collections.abc import Collection

import mujoco
import numpy as np
import pytest

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.joints import LEGS, ROOT
from reactive_realizer.physics.mjcf import mjcf, stature, usual_weight
from reactive_realizer.physics.segments import LIMITS, REFERENCE_WEIGHT, SEGMENTS

from .skeletons import without


def loaded(skeleton: Skeleton, weight: float | None = None) -> mujoco.MjModel:
    return mujoco.MjModel.from_xml_string(mjcf(skeleton, weight).decode())


def volume(model: mujoco.MjModel, geom: int) -> float:
    """The volume of a geometric primitive, m^3."""
    a, b, c = map(float, model.geom_size[geom])
    kind = model.geom_type[geom]
    if kind == mujoco.mjtGeom.mjGEOM_ELLIPSOID:
        return 4.0 / 3.0 * math.pi * a * b * c
    if kind == mujoco.mjtGeom.mjGEOM_CYLINDER:
        return 2.0 * math.pi * a * a * b
    assert kind == mujoco.mjtGeom.mjGEOM_BOX
    return 8.0 * a * b * c


def test_the_rows_of_figure_3_5_sum_to_78_9_kg() -> None:
    assert pytest.approx(78.9) == REFERENCE_WEIGHT
    assert len(SEGMENTS) == 15


def test_a_model_has_the_masses_of_its_segments_in_proportion_to_its_weight(skeleton: Skeleton) -> None:
    model = loaded(skeleton, 2.0 * REFERENCE_WEIGHT)
    assert {model.body(i).name for i in range(1, model.nbody)} == {segment.joint for segment in SEGMENTS}
    for segment in SEGMENTS:
        assert model.body(segment.joint).mass == pytest.approx(2.0 * segment.mass, rel=1e-5)


def test_without_a_weight_the_mass_is_that_of_the_same_body_mass_index(skeleton: Skeleton) -> None:
    assert loaded(skeleton).body_subtreemass[1] == pytest.approx(usual_weight(skeleton), rel=1e-5)
    index = usual_weight(skeleton) / stature(skeleton) ** 2
    assert 22.0 < index < 27.0


def test_each_segment_has_the_density_of_its_row(skeleton: Skeleton) -> None:
    model = loaded(skeleton)
    for segment in SEGMENTS:
        (geom,) = np.flatnonzero(model.geom_bodyid == model.body(segment.joint).id).tolist()
        assert model.body(segment.joint).mass / volume(model, geom) == pytest.approx(segment.density, rel=1e-4)


def test_joints_are_where_the_skeleton_has_them_with_z_up(skeleton: Skeleton) -> None:
    model = loaded(skeleton)
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    body = Body(skeleton)
    for segment in SEGMENTS:
        x, y, z = body.transform(segment.joint).position
        assert data.body(segment.joint).xpos == pytest.approx((x, -z, y), abs=1e-6)


def test_the_figure_stands_on_its_soles(skeleton: Skeleton) -> None:
    model = loaded(skeleton)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    touching = {model.body(model.geom_bodyid[max(contact.geom)]).name for contact in data.contact}
    assert touching == {"l_ankle", "r_ankle"}
    assert min(contact.dist for contact in data.contact) > -1e-6


def test_a_joint_turns_no_further_than_the_widest_of_its_limits(skeleton: Skeleton) -> None:
    model = loaded(skeleton)
    for joint in LIMITS:
        assert model.joint(joint).range[1] == pytest.approx(math.radians(min(180.0, LIMITS[joint].widest)))


@pytest.mark.parametrize(
    "lacking",
    [LEGS, {"vl5", "vt10", "vt6"}, {"vc4"}, {"l_midtarsal", "l_middle1"}],
    ids=["legs", "spine", "neck", "ends"],
)
def test_a_figure_that_lacks_joints_lacks_their_segments(skeleton: Skeleton, lacking: Collection[str]) -> None:
    model = loaded(without(skeleton, lacking))
    names = {model.body(i).name for i in range(1, model.nbody)}
    assert names == {segment.joint for segment in SEGMENTS if segment.joint not in lacking}
    assert ROOT in names


def test_the_limits_of_both_sides_are_mirror_images() -> None:
    assert LIMITS["r_wrist"].z == (-81.0, 90.0)
    assert LIMITS["r_shoulder"].z == (-134.0, 48.0)
    assert LIMITS["l_knee"].x == LIMITS["r_knee"].x == (0.0, 113.0)
