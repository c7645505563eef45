"""Noise on a joint (thesis C.1.7)."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import angle, difference
from reactive_realizer.engines.animation.motion_unit import Moment, MotionPose
from reactive_realizer.engines.animation.motions.noise import NoiseMotionUnit

SEED = 7


def posed(unit: NoiseMotionUnit, time: float, skeleton: Skeleton) -> MotionPose:
    return unit.pose(Moment(0.5, GlobalTime(time), Body(skeleton)))


def about_x(unit: NoiseMotionUnit, times: NDArray[np.float64] | list[float], skeleton: Skeleton) -> np.ndarray:
    """The angles about x, rad, at times, s."""
    rotations = (posed(unit, time, skeleton).rotations["vl5"] for time in times)
    return np.array([2.0 * math.atan2(x, w) for w, x, _, _ in rotations])


def test_noise_is_additive_and_owns_nothing() -> None:
    unit = NoiseMotionUnit("vl5", {}, SEED)
    assert (unit.kind, set(unit.resources), set(unit.joints)) == (LayerKind.ADDITIVE, set(), {"vl5"})


def test_noise_stays_within_its_amplitude_about_its_offset(skeleton: Skeleton) -> None:
    unit = NoiseMotionUnit("vl5", {"baseamplitudex": 0.2, "offsetx": 0.1}, SEED)
    angles = about_x(unit, np.arange(0.0, 200.0, 0.02), skeleton)
    assert (np.abs(angles - 0.1) <= 0.2).all()
    assert angles.mean() == pytest.approx(0.1, abs=0.02)
    assert angles.std() > 0.02


def test_axes_are_independent(skeleton: Skeleton) -> None:
    unit = NoiseMotionUnit("vl5", {"baseamplitudex": 0.2, "baseamplitudez": 0.2}, SEED)
    rotations = np.array([posed(unit, time, skeleton).rotations["vl5"] for time in np.arange(0.0, 60.0, 0.1)])
    assert abs(np.corrcoef(rotations[:, 1], rotations[:, 3])[0, 1]) < 0.3
    assert np.abs(rotations[:, 2]).max() < 0.01


@pytest.mark.parametrize(("frequency", "low", "high"), [(0.5, 20, 90), (2.0, 80, 360)])
def test_a_higher_base_frequency_is_faster(skeleton: Skeleton, frequency: float, low: float, high: float) -> None:
    unit = NoiseMotionUnit("vl5", {"baseamplitudex": 0.2, "basefreqx": frequency, "persistencex": 0.0}, SEED)
    angles = about_x(unit, np.arange(0.0, 60.0, 0.02), skeleton)
    assert low < np.count_nonzero(np.diff(np.sign(angles))) < high


def test_a_higher_persistence_makes_it_rougher(skeleton: Skeleton) -> None:
    def roughness(persistence: float) -> float:
        unit = NoiseMotionUnit("vl5", {"baseamplitudex": 0.2, "persistencex": persistence}, SEED)
        return float(np.abs(np.diff(about_x(unit, np.arange(0.0, 30.0, 0.02), skeleton), 2)).mean())

    assert roughness(0.0) < 0.5 * roughness(0.8)


def test_a_noise_motion_depends_on_its_seed(skeleton: Skeleton) -> None:
    times = np.arange(0.0, 5.0, 0.02)
    parameters = {"baseamplitudex": 0.2}
    first, again, other = (about_x(NoiseMotionUnit("vl5", parameters, seed), times, skeleton) for seed in (7, 7, 8))
    assert np.array_equal(first, again)
    assert not np.allclose(first, other, atol=0.02)


def test_noise_does_not_depend_on_its_start_time(skeleton: Skeleton) -> None:
    first, later = (NoiseMotionUnit("vl5", {"baseamplitudex": 0.2}, SEED) for _ in range(2))
    times = np.arange(0.0, 3.0, 0.02)
    assert np.allclose(about_x(first, times, skeleton), about_x(later, times + 50.0, skeleton))


@pytest.mark.parametrize(("name", "value"), [("basefreqx", 4.0), ("baseamplitudex", 0.22), ("offsetx", 0.02)])
def test_a_parameter_change_causes_no_jump(skeleton: Skeleton, name: str, value: float) -> None:
    unit = NoiseMotionUnit("vl5", {"baseamplitudex": 0.2}, SEED)
    before = about_x(unit, np.arange(0.0, 40.0, 0.02), skeleton)
    unit.parameters = {**unit.parameters, name: value}
    (after,) = about_x(unit, [40.0], skeleton)
    assert abs(after - before[-1]) < 0.06


def test_noise_fades_in(skeleton: Skeleton) -> None:
    unit = NoiseMotionUnit("vl5", {"offsetx": 0.5}, SEED)
    assert [posed(unit, time, skeleton).weight for time in (3.0, 3.25, 3.5, 4.0)] == [0.0, 0.5, 1.0, 1.0]


def test_noise_without_parameters_does_not_move(skeleton: Skeleton) -> None:
    unit = NoiseMotionUnit("vl5", {}, SEED)
    turns = [posed(unit, time, skeleton).rotations["vl5"] for time in (0.0, 0.3, 7.7)]
    assert max(angle(difference(turns[0], turn)) for turn in turns) == 0.0
