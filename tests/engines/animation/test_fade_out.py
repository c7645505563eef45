"""Fading layers."""

from collections.abc import Sequence
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Skeleton
from reactive_realizer.embodiment.pose import Layer, LayerKind, compose
from reactive_realizer.embodiment.quaternion import IDENTITY, angle, from_euler
from reactive_realizer.engines.animation.fade_out import LOWEST, FadeOut, FadeOuts, fade_out_duration

JOINT = "r_elbow"
NEW = Layer(LayerKind.POSTURE, {JOINT: from_euler(1.0, 0.0, 0.0)})
OLD = Layer(LayerKind.BASE, {JOINT: IDENTITY})


def shift(weight: float) -> Layer:
    return Layer(LayerKind.POSTURE, NEW.rotations, weight)


def fading(*layers: FadeOut) -> FadeOuts:
    fade_outs = FadeOuts()
    for layer in layers:
        fade_outs.start(layer)
    return fade_outs


def shown(
    skeleton: Skeleton,
    releases: Sequence[FadeOut],
    now: float,
    playing: Sequence[tuple[tuple[float, float], Layer]] = (),
) -> float:
    """The angle of the joint, rad, over a base that is the new posture."""
    layers = [Layer(LayerKind.BASE, NEW.rotations), *fading(*releases).with_playing(playing, GlobalTime(now))]
    return angle(compose(skeleton, layers).shown.rotation(JOINT))


@given(st.floats(0.002, 0.998))
def test_an_unfinished_shift_that_becomes_the_base_goes_straight_to_it(skeleton: Skeleton, weight: float) -> None:
    releases = (
        FadeOut(OLD, GlobalTime(0.0), 1.0, under=weight),
        FadeOut(shift(weight), GlobalTime(0.0), 1.0, (0.0, 0.0)),
    )
    way = [shown(skeleton, releases, 0.05 * step) for step in range(21)]
    assert way[0] == pytest.approx(weight, abs=1e-6)
    assert way[-1] == pytest.approx(1.0)
    assert min(b - a for a, b in pairwise(way)) > -1e-6


def test_layers_below_a_shift_fade_out_where_it_does_not_hide_them(skeleton: Skeleton) -> None:
    below = Layer(LayerKind.POSTURE, {JOINT: IDENTITY})
    releases = (FadeOut(shift(1.0), GlobalTime(0.0), 1.0, (4.0, -5.0)),)
    way = [shown(skeleton, releases, 0.05 * step, [((0.0, -9.0), below)]) for step in range(21)]
    assert (way[0], way[-1]) == pytest.approx((1.0, 0.0), abs=1e-9)
    assert 0.0 < max(a - b for a, b in pairwise(way)) < 0.1


def test_fading_and_playing_layers_keep_their_stacking_order() -> None:
    upper, lower = shift(1.0), Layer(LayerKind.POSTURE, {})
    fade_outs = fading(FadeOut(upper, GlobalTime(0.0), 1.0, (0.0, -1.0)))
    assert fade_outs.with_playing([((0.0, -9.0), lower)], GlobalTime(0.0)) == [lower, upper]


def test_an_invisible_layer_is_dropped_at_once() -> None:
    assert FadeOut(OLD, GlobalTime(0.0), under=1.0).finished(GlobalTime(0.0))
    assert FadeOut(shift(0.0), GlobalTime(0.0), 1.0, LOWEST).finished(GlobalTime(0.0))


def test_a_fade_out_takes_longer_for_a_longer_displacement() -> None:
    sitting = Layer(LayerKind.POSTURE, {}, root=(0.0, -0.5, 0.0))
    near, far = (0.0, -0.45, 0.0), (0.0, 0.0, 0.0)
    assert fade_out_duration(sitting, [near]) == 0.6
    assert fade_out_duration(sitting, [near, far]) == pytest.approx(1.4)
