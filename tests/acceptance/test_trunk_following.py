"""Trunk, head and pelvis follow a gesturing or pointing arm."""

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import difference, rotation_vector
from reactive_realizer.testing.pilot import RealizerPilot

from .conftest import OpenStill

SCENE = """
[target.across]
position = [0.9, 1.2, 0.9]

[target.aside]
position = [-1.5, 1.2, 0.3]

[target.ahead]
position = [-0.2, 1.3, 2.5]
"""
POINT = '<pointing id="g" mode="RIGHT_HAND" target="{}"{}/>'
GESTURE = '<gesture id="g" mode="RIGHT_HAND" lexeme="{}"/>'
SEEN = 0.02
"""Degrees."""


def turns(bodies: Sequence[Body], joint: str) -> NDArray[np.float64]:
    """Of a joint in the world since the first frame, (F, 3), degrees: bow, turn to the left, bend to the right."""
    begin = bodies[0].transform(joint).rotation
    return np.degrees([rotation_vector(difference(begin, body.transform(joint).rotation)) for body in bodies])


def followed(bodies: Sequence[Body]) -> float:
    """How far the head follows, with the trunk, degrees."""
    return float(np.linalg.norm(turns(bodies, "skullbase"), axis=1).max())


@pytest.mark.parametrize(
    "wide",
    [*map(POINT.format, ("across", "aside", "ahead"), ("", "", "")), *map(GESTURE.format, ("GREET", "CHOP", "REFUSE"))],
)
async def test_trunk_and_head_follow_a_wide_gesture_by_three_to_eight_degrees(open_still: OpenStill, wide: str) -> None:
    async with open_still(scene=SCENE) as still:
        still.block("b", wide)
        await still.advance(4)
        assert 3.0 < followed(still.bodies()) < 8.0
        trunk = np.linalg.norm(turns(still.bodies(), "vt6"), axis=1)
        assert trunk.max() > 2.0
        assert trunk[-1] < SEEN


@pytest.mark.parametrize("small", ["BEAT", "OFFER", "SELF", "CONDUIT"])
async def test_they_do_not_follow_a_small_one(still: RealizerPilot, small: str) -> None:
    still.block("b", GESTURE.format(small))
    await still.advance(3)
    assert followed(still.bodies()) < 0.5


async def test_they_turn_to_the_side_to_which_the_arm_points(open_still: OpenStill) -> None:
    for target, left in (("across", 1.0), ("aside", -1.0)):
        async with open_still(scene=SCENE) as still:
            still.block("b", POINT.format(target, ""))
            await still.advance(4)
            sideways = left * turns(still.bodies(), "vt6")[:, 1]
            assert sideways.max() > 2.5
            assert sideways.min() > -SEEN


async def test_the_trunk_speeds_up_once_and_slows_down_once_on_its_way_and_lags_behind_the_arm(
    open_still: OpenStill,
) -> None:
    async with open_still(scene=SCENE) as still:
        still.block("b", POINT.format("across", ' ready="0.8" relax="2.5"'))
        await still.advance(2.4)
        speeds = np.linalg.norm(np.diff(turns(still.bodies(), "vt6"), axis=0), axis=1)
        peak = int(speeds.argmax())
        assert 0.3 < peak / 50 < 0.8
        rounding = 1e-3
        assert (np.diff(speeds[: peak + 1]) > -rounding).all()
        assert (np.diff(speeds[peak:]) < rounding).all()
        assert speeds[-1] < rounding


async def test_a_head_that_looks_at_something_keeps_its_direction(open_still: OpenStill) -> None:
    heads = []
    for gesture in ("", POINT.format("across", ' start="1" ready="1.7" relax="2.5"')):
        async with open_still(scene=SCENE) as still:
            look = '<gaze id="l" target="aside" influence="WAIST" start="0" ready="0.8" relax="3.5" end="4.2"/>'
            still.block("b", look + gesture)
            await still.advance(5)
            assert still.feedback.warnings == []
            heads.append([body.transform("skullbase").rotation for body in still.bodies()])
    offs = [np.degrees(np.linalg.norm(rotation_vector(difference(*both)))) for both in zip(*heads, strict=True)]
    assert max(offs[:175]) < 0.5, "until the gaze relaxes"
    assert max(abs(after - before) for before, after in pairwise(offs)) < 0.3, "degrees a frame"


@pytest.mark.parametrize(("target", "left"), [("aside", -1.0), ("across", 1.0)])
async def test_the_pelvis_moves_to_the_foot_that_carries_a_wide_gesture_and_no_foot_slides(
    open_still: OpenStill, target: str, left: float
) -> None:
    async with open_still(scene=SCENE) as still:
        still.block("b", POINT.format(target, ""))
        await still.advance(4)
        bodies = still.bodies()
        assert 0.005 < max(left * body.root[0] for body in bodies) < 0.03
        for ankle in ("l_ankle", "r_ankle"):
            places = [body.transform(ankle).position for body in bodies]
            assert max(math.dist(place, places[0]) for place in places) < 1e-3
        assert abs(bodies[-1].root[0]) < 1e-4


async def test_a_sitting_figure_shifts_no_weight(open_still: OpenStill) -> None:
    async with open_still(scene=SCENE) as still:
        still.block("a", '<postureShift id="s"><stance type="SITTING"/></postureShift>')
        await still.advance(4)
        first = len(still.bodies())
        still.block("b", POINT.format("aside", ""))
        await still.advance(4)
        roots = [body.root for body in still.bodies()[first:]]
        assert max(math.dist(root, roots[0]) for root in roots) < 1e-3


@pytest.mark.parametrize("after", [0.3, 0.7, 1.2])
async def test_trunk_and_pelvis_come_back_softly_from_a_gesture_that_is_interrupted(
    open_still: OpenStill, after: float
) -> None:
    async with open_still(scene=SCENE) as still:
        still.block("b", POINT.format("across", ""))
        await still.advance(after)
        still.block("i", '<bmla:interrupt id="i" target="b"/>')
        await still.advance(2)
        trunk = turns(still.bodies(), "vt6")
        assert np.linalg.norm(np.diff(trunk, 2, axis=0), axis=1).max() * 2500 < 600.0, "degrees/s²"
        sideways = np.array([body.root[0] for body in still.bodies()])
        assert np.abs(np.diff(sideways, 2)).max() * 2500 < 1.5, "m/s²"
        assert np.linalg.norm(trunk[-1]) < SEEN
