"""Curves of rotations with tension, continuity and bias (D. Kochanek and R. Bartels 1984; K. Shoemake 1987)."""

import math
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.embodiment.quaternion import (
    Quat,
    angle,
    difference,
    from_axis_angle,
    from_rotation_vector,
    multiply,
    rotation_vector,
)
from reactive_realizer.embodiment.vector import Vec3, length, scale, unit
from reactive_realizer.engines.animation.expression.functions import hermite, tcbspline
from reactive_realizer.engines.animation.tcb import Corner, Tcb, turn_on_way

STEP = 1e-5

Times = tuple[float, ...]

vectors = st.tuples(*(st.floats(-1.4, 1.4) for _ in range(3)))
turns = vectors.map(from_rotation_vector)
four = st.tuples(turns, turns, turns, turns)
spacings = st.tuples(*(st.floats(0.1, 2.0) for _ in range(3)))
axes = vectors.filter(lambda vector: length(vector) > 0.1).map(unit)
angles = st.tuples(*(st.floats(-0.7, 0.7) for _ in range(4)))
numbers = st.builds(Tcb, *(st.floats(-1.0, 1.0) for _ in range(3)))
smooth = st.builds(Tcb, st.floats(-1.0, 1.0), st.just(0.0), st.floats(-1.0, 1.0))

checked = settings(max_examples=150, deadline=None, derandomize=True)


def on_curve(keys: tuple[Quat, ...], spacing: Times, time: float, first: Tcb, second: Tcb) -> Quat:
    """The rotation at a time after the first of four keys, on the curve past the two inner ones, from rest to rest."""
    before, between, after = spacing
    ways = [rotation_vector(difference(*pair)) for pair in pairwise(keys)]
    corner, other = Corner(ways[0], ways[1], (before, between)), Corner(ways[1], ways[2], (between, after))
    if time < before:
        return multiply(keys[0], turn_on_way(ways[0], time / before, arriving=corner.tangent(first, "arriving")))
    if time < before + between:
        velocities = corner.tangent(first, "leaving"), other.tangent(second, "arriving")
        return multiply(keys[1], turn_on_way(ways[1], (time - before) / between, *velocities))
    u = (time - before - between) / after
    return multiply(keys[2], turn_on_way(ways[2], u, other.tangent(second, "leaving")))


def apart(a: Quat, b: Quat) -> float:
    return angle(difference(a, b))


def velocity(a: Quat, b: Quat) -> Vec3:
    return scale(rotation_vector(difference(a, b)), 1.0 / STEP)


@checked
@given(four, spacings, numbers, numbers)
def test_a_curve_passes_its_keys_at_their_times(
    keys: tuple[Quat, ...], spacing: Times, first: Tcb, second: Tcb
) -> None:
    times = (0.0, spacing[0], spacing[0] + spacing[1], sum(spacing))
    for key, time in zip(keys, times, strict=True):
        assert apart(on_curve(keys, spacing, time, first, second), key) < 1e-6
        assert apart(on_curve(keys, spacing, time - STEP if time else STEP, first, second), key) < 1e-2


@checked
@given(four, spacings, smooth, smooth)
def test_without_continuity_a_curve_goes_on_with_its_velocity_however_its_keys_are_spaced(
    keys: tuple[Quat, ...], spacing: Times, first: Tcb, second: Tcb
) -> None:
    for time in (spacing[0], spacing[0] + spacing[1]):
        early, here, late = (on_curve(keys, spacing, time + step, first, second) for step in (-STEP, 0.0, STEP))
        assert velocity(early, here) == pytest.approx(velocity(here, late), abs=0.02)


@checked
@given(four, spacings, st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))
def test_with_a_tension_of_1_a_curve_stops_at_its_keys(
    keys: tuple[Quat, ...], spacing: Times, continuity: float, bias: float
) -> None:
    tight = Tcb(1.0, continuity, bias)
    for time in (spacing[0], spacing[0] + spacing[1]):
        for step in (-STEP, STEP):
            here, there = (on_curve(keys, spacing, time + shift, tight, tight) for shift in (0.0, step))
            assert length(velocity(here, there)) < 0.01


@checked
@given(axes, turns, angles, st.floats(0.0, 1.0))
def test_about_one_axis_at_equal_times_it_is_a_catmull_rom_curve(
    axis: Vec3, start: Quat, given: Times, u: float
) -> None:
    keys = tuple(multiply(start, from_axis_angle(axis, each)) for each in given)
    curve = on_curve(keys, (1.0, 1.0, 1.0), 1.0 + u, Tcb(), Tcb())
    assert apart(curve, multiply(start, from_axis_angle(axis, hermite(1.0 + u, 0.0, 0.0, *given)))) < 1e-6


@checked
@given(axes, turns, angles, spacings, numbers, numbers, st.floats(0.0, 1.0))
def test_about_one_axis_it_is_the_curve_of_numbers(
    axis: Vec3, start: Quat, given: Times, spacing: Times, first: Tcb, second: Tcb, share: float
) -> None:
    keys = tuple(multiply(start, from_axis_angle(axis, each)) for each in given)
    time, times = share * sum(spacing), (0.0, spacing[0], spacing[0] + spacing[1], sum(spacing))
    inner = (given[1], times[1], *first, given[2], times[2], *second)
    number = tcbspline(time, 0.0, 0.0, given[0], times[0], *inner, given[3], times[3])
    curve = on_curve(keys, spacing, time, first, second)
    assert apart(curve, multiply(start, from_axis_angle(axis, number))) < 1e-5


@checked
@given(four, spacings, numbers, numbers, st.floats(0.0, 1.0), st.tuples(*[st.booleans()] * 4))
def test_the_sign_of_a_quaternion_does_not_matter(
    keys: tuple[Quat, ...], spacing: Times, first: Tcb, second: Tcb, share: float, flipped: tuple[bool, ...]
) -> None:
    other = tuple((-w, -x, -y, -z) if flip else (w, x, y, z) for (w, x, y, z), flip in zip(keys, flipped, strict=True))
    time = share * sum(spacing)
    assert apart(on_curve(keys, spacing, time, first, second), on_curve(other, spacing, time, first, second)) < 1e-6


@pytest.mark.parametrize(("continuity", "corner"), [(0.0, False), (-1.0, True), (1.0, True)])
def test_continuity_makes_a_corner(continuity: float, corner: bool) -> None:
    keys = tuple(from_axis_angle((1.0, 0.0, 0.0), turn) for turn in (0.0, 1.0, 0.5, 0.0))
    tcb = Tcb(0.0, continuity, 0.0)
    early, here, late = (on_curve(keys, (1.0, 1.0, 1.0), 1.0 + step, tcb, Tcb()) for step in (-STEP, 0.0, STEP))
    assert (math.dist(velocity(early, here), velocity(here, late)) > 0.5) == corner


@pytest.mark.parametrize(("bias", "time"), [(1.0, 1.1), (-1.0, 0.9)])
def test_with_bias_a_curve_overshoots_a_key_after_it_and_with_negative_bias_before_it(bias: float, time: float) -> None:
    keys = tuple(from_axis_angle((1.0, 0.0, 0.0), turn) for turn in (0.0, 1.0, 0.0, 0.0))
    there, straight = (
        rotation_vector(on_curve(keys, (1.0, 1.0, 1.0), time, Tcb(0.0, 0.0, each), Tcb()))[0] for each in (bias, 0.0)
    )
    assert there > 1.02
    assert straight < 1.0
