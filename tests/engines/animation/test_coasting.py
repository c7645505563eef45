"""Coasting of layers that are no longer driven."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.embodiment.quaternion import angle, from_euler
from reactive_realizer.embodiment.speed_limit import fastest
from reactive_realizer.engines.animation.coasting import Coasting, LayerSample

FRAME = 0.02


def turned(joint: str, radians: float, weight: float = 1.0) -> Layer:
    return Layer(LayerKind.GESTURE, {joint: from_euler(radians, 0.0, 0.0)}, weight)


def coasting(before: Layer, last: Layer) -> Coasting:
    going = drift(before, last)
    assert going
    return going


def drift(before: Layer, last: Layer, frame: float = FRAME, ended: float = 0.0) -> Coasting | None:
    """The coasting of a layer with frames up to time 0 that ended some time later."""
    return Coasting.from_samples(
        [LayerSample(GlobalTime(-frame), before), LayerSample(GlobalTime(0.0), last)], GlobalTime(ended)
    )


@given(st.floats(0.1, 10.0))
def test_coasting_starts_at_the_last_speed_and_covers_a_third_of_its_distance(speed: float) -> None:
    last = turned("r_elbow", 0.0)
    going = coasting(turned("r_elbow", -speed * FRAME), last)
    at = [angle(going(last, GlobalTime(time)).rotations["r_elbow"]) for time in (0.0, 0.001, 0.2, 1.0)]
    assert at[0] == pytest.approx(0.0, abs=1e-9)
    assert at[1] / 0.001 == pytest.approx(speed, rel=0.02)
    assert at[2] == at[3] == pytest.approx(speed * 0.2 / 3.0, rel=1e-6)


def test_a_resting_layer_does_not_coast() -> None:
    still = turned("r_elbow", 0.4, 0.7)
    assert coasting(still, still)(still, GlobalTime(0.1)) == still


def test_the_weight_coasts_within_its_bounds() -> None:
    low, high = turned("r_elbow", 0.0, 0.5), turned("r_elbow", 0.0, 0.53)
    assert coasting(low, high)(high, GlobalTime(1.0)).weight == pytest.approx(0.53 + 0.03 / FRAME * 0.2 / 3.0)
    assert (
        coasting(turned("r_elbow", 0.0, 0.9), turned("r_elbow", 0.0))(turned("r_elbow", 0.0), GlobalTime(1.0)).weight
        == 1.0
    )
    gone = turned("r_elbow", 0.0, 0.01)
    assert coasting(turned("r_elbow", 0.0, 0.2), gone)(gone, GlobalTime(1.0)).weight == 0.0


@pytest.mark.parametrize("joint", ["skullbase", "vl5", "r_elbow"])
def test_a_joint_that_turned_faster_than_its_limit_does_not_coast(joint: str) -> None:
    last = turned(joint, 0.0)
    for speed, goes in ((0.99 * fastest(joint), True), (1.01 * fastest(joint), False)):
        gone = angle(coasting(turned(joint, -speed * FRAME), last)(last, GlobalTime(1.0)).rotations[joint])
        assert (gone > 0.0) is goes


@pytest.mark.parametrize("joint", ["HumanoidRoot", "l_hip", "r_ankle"])
def test_legs_and_pelvis_do_not_coast(joint: str) -> None:
    last = turned(joint, 0.0)
    assert coasting(turned(joint, -0.05), last)(last, GlobalTime(1.0)) == last


def test_old_or_distant_frames_give_no_coasting() -> None:
    before, last = turned("r_elbow", -0.05), turned("r_elbow", 0.0)
    assert drift(before, last, ended=0.5) is None
    assert drift(before, last, frame=0.3) is None
    assert Coasting.from_samples([LayerSample(GlobalTime(0.0), last)], GlobalTime(0.0)) is None
