"""Foot planting under a moving pelvis."""

import math
from itertools import pairwise

import pytest

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.pose import Layer, LayerKind, compose
from reactive_realizer.engines.animation.posture.foot_planting import FootPlanting

from .bodies import height


def walking(skeleton: Skeleton, way: float, share: float) -> Body:
    """A figure after a fraction of a straight walk, m."""
    below, goal = Layer(LayerKind.BASE, {}), Layer(LayerKind.POSTURE, {}, share, root=(0.0, 0.0, way))
    return compose(skeleton, (below, goal, *FootPlanting(skeleton).layers((below, goal), GlobalTime(0.0)))).shown


def test_long_walks_keep_the_pelvis_up_between_the_feet(skeleton: Skeleton) -> None:
    bodies = [walking(skeleton, 3.0, i / 300) for i in range(301)]
    leads = [
        [body.transform(ankle).position[2] - body.transform("l_hip").position[2] for ankle in ("l_ankle", "r_ankle")]
        for body in bodies
    ]
    assert max(abs(lead) for pair in leads for lead in pair) < 0.4
    assert sum((a[0] > a[1]) != (b[0] > b[1]) for a, b in pairwise(leads)) >= 4, "one passes the other"
    assert min(body.root[1] for body in bodies) > -0.08
    assert height(bodies[-1], "l_ankle") == pytest.approx(height(bodies[0], "l_ankle"), abs=1e-6)


def test_a_foot_on_the_ground_does_not_slide(skeleton: Skeleton) -> None:
    bodies = [walking(skeleton, 3.0, i / 300) for i in range(301)]
    for ankle in ("l_ankle", "r_ankle"):
        ground = height(bodies[0], ankle)
        for a, b in pairwise(bodies):
            if max(height(a, ankle), height(b, ankle)) < ground + 0.01:
                (x, _, z), (to_x, _, to_z) = (body.transform(ankle).position for body in (a, b))
                assert math.dist((x, z), (to_x, to_z)) < 1e-6


def test_the_pelvis_sinks_little_for_feet_that_it_has_left_behind(skeleton: Skeleton) -> None:
    pushed = Layer(LayerKind.ADDITIVE, {}, root=(1.5, 0.0, 0.0))
    lowered, _ = FootPlanting(skeleton).layers((Layer(LayerKind.BASE, {}), pushed), GlobalTime(0.0))
    assert lowered.root == pytest.approx((0.0, -0.25, 0.0))
