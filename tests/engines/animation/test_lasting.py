"""What ended and stays."""

import math
from itertools import pairwise

import pytest

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import LayerKind, compose
from reactive_realizer.embodiment.quaternion import angle, from_axis_angle
from reactive_realizer.embodiment.vector import UP
from reactive_realizer.engines.animation.lasting import Lasting
from reactive_realizer.engines.animation.motion_unit import Posed


class Turned:
    """A motion that turns joints to the left by so much."""

    kind = LayerKind.GAZE

    def __init__(self, lasts, radians, *joints):
        self.lasts = lasts
        self._rotations = {joint: from_axis_angle(UP, radians) for joint in joints}

    def pose(self, moment):
        return Posed(self._rotations)


@pytest.fixture
def lasting():
    return Lasting()


@pytest.fixture
def turn(lasting, skeleton):
    """How far a joint is turned at a time by what stays."""
    return lambda joint, now: angle(compose(skeleton, lasting.layers(now, Body(skeleton))).shown.pose[joint])


def test_what_has_ended_stays_until_another_of_its_name_has_ended(lasting, turn, skeleton):
    lasting.keep(Turned("gaze", 0.5, "skullbase"), 1.0, Body(skeleton))
    assert turn("skullbase", 1.0) == turn("skullbase", 100.0) == pytest.approx(0.5)
    lasting.keep(Turned("head", 0.3, "vc4"), 100.0, Body(skeleton))
    assert (turn("skullbase", 100.0), turn("vc4", 100.0)) == pytest.approx((0.5, 0.3))
    lasting.keep(Turned("gaze", 0.2, "skullbase"), 101.0, Body(skeleton))
    assert turn("skullbase", 101.0) == turn("skullbase", 101.3) == pytest.approx(0.2)
    assert len(lasting.motions) == 2


def test_what_is_replaced_leaves_joints_that_its_successor_does_not_move_without_a_jump(lasting, turn, skeleton):
    lasting.keep(Turned("gaze", 0.5, "skullbase", "vl5"), 1.0, Body(skeleton))
    lasting.keep(Turned("gaze", 0.2, "skullbase"), 2.0, Body(skeleton))
    trunk = [turn("vl5", 2.0 + i / 50) for i in range(60)]
    assert trunk[0] == pytest.approx(0.5)
    assert trunk[-1] == 0.0
    assert max(a - b for a, b in pairwise(trunk)) < 0.05


def test_what_goes_when_it_ends_does_not_stay(lasting, skeleton):
    lasting.keep(Turned(None, 0.5, "skullbase"), 1.0, Body(skeleton))
    assert lasting.layers(1.0, Body(skeleton)) == ()


def test_after_a_clearing_nothing_stays_nor_leaves(lasting, skeleton):
    lasting.keep(Turned("gaze", 0.5, "skullbase"), 1.0, Body(skeleton))
    lasting.keep(Turned("gaze", 0.2, "skullbase"), 1.0, Body(skeleton))
    lasting.clear()
    assert lasting.layers(1.1, Body(skeleton)) == ()


def test_one_that_fails_stays_no_longer_and_the_others_do(lasting, turn, skeleton, caplog):
    lasting.keep(Turned("gaze", math.nan, "skullbase"), 1.0, Body(skeleton))
    lasting.keep(Turned("head", 0.3, "vc4"), 1.0, Body(skeleton))
    assert (turn("skullbase", 1.0), turn("vc4", 1.0)) == pytest.approx((0.0, 0.3))
    assert [motion.lasts for motion in lasting.motions] == ["head"]
    assert "'gaze' failed" in caplog.text
