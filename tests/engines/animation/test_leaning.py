"""The lean of a trunk for hands that do not reach their goals: the solution itself."""

import math

from hypothesis import assume, given, settings
from hypothesis import strategies as st

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.pose import LayerKind, turned_further
from reactive_realizer.embodiment.quaternion import angle, difference, rotation_vector
from reactive_realizer.embodiment.two_bone_ik import Arm
from reactive_realizer.embodiment.vector import Vec3, add, distance, length, scale, unit
from reactive_realizer.engines.animation.easing import smoothstep
from reactive_realizer.engines.animation.leaning import Leaning
from reactive_realizer.engines.animation.spine_ik import SPINE_RANGES, HandGoal, Reached

_ENDS = ("skullbase", "HumanoidRoot")

directions = st.tuples(*(st.floats(-1.0, 1.0) for _ in range(3))).filter(lambda way: length(way) > 0.1).map(unit)
ahead = st.tuples(st.floats(-0.5, 0.5), st.floats(-0.5, 0.1), st.just(1.0)).map(unit)
shares = st.floats(0.0, 1.0)
sides = st.sampled_from(["l", "r"])

checked = settings(max_examples=60, deadline=None, derandomize=True)


def leant(skeleton: Skeleton, *goals: HandGoal) -> Body:
    """The figure in its default pose, leaning for goals."""
    body = Body(skeleton)
    layers = Leaning(skeleton, lambda joints, until: None).layers(GlobalTime(0.0), goals, body)
    assert all(layer.kind is LayerKind.ADDITIVE for layer in layers)
    return turned_further(body, *layers)


def beyond(skeleton: Skeleton, side: str, way: Vec3, far: float) -> Vec3:
    """A place a distance beyond the reach of an arm."""
    shoulder = Body(skeleton).transform(f"{side}_shoulder").position
    return add(shoulder, scale(way, Arm.of(skeleton, side).reach + far))


@checked
@given(side=sides, way=ahead, far=st.floats(0.0, 0.2))
def test_a_place_in_front_is_brought_within_the_reach_of_the_arm(
    skeleton: Skeleton, side: str, way: Vec3, far: float
) -> None:
    place = beyond(skeleton, side, way, far)
    assume(Reached.of(Body(skeleton), HandGoal(side, place)).left == 0.0 or far < 0.15)
    shoulder = leant(skeleton, HandGoal(side, place)).transform(f"{side}_shoulder").position
    assert distance(shoulder, place) < Arm.of(skeleton, side).reach + 0.002


@checked
@given(side=sides, way=directions, far=st.floats(-0.5, 1.0), share=shares)
def test_the_spine_keeps_within_its_ranges_and_the_head_its_direction_and_the_pelvis_stays(
    skeleton: Skeleton, side: str, way: Vec3, far: float, share: float
) -> None:
    upright, body = Body(skeleton), leant(skeleton, HandGoal(side, beyond(skeleton, side, way, far), share=share))
    for joint, ranges in SPINE_RANGES.items():
        for value, (low, high) in zip(rotation_vector(body.rotation(joint)), ranges, strict=True):
            assert low - 1e-6 <= value <= high + 1e-6
    head, pelvis = (difference(*(each.transform(joint).rotation for each in (body, upright))) for joint in _ENDS)
    assert max(angle(head), angle(pelvis)) < 1e-6
    assert body.root == upright.root


@checked
@given(side=sides, way=directions, far=st.floats(-0.3, 0.0), share=shares)
def test_for_a_place_within_reach_nothing_moves(
    skeleton: Skeleton, side: str, way: Vec3, far: float, share: float
) -> None:
    goal = HandGoal(side, beyond(skeleton, side, way, far - 1e-6), share=share)
    assert Leaning(skeleton, lambda joints, until: None).layers(GlobalTime(0.0), [goal], Body(skeleton)) == ()


@checked
@given(side=sides, way=directions, far=st.floats(0.0, 0.8), share=shares, step=directions)
def test_a_lean_changes_little_where_its_place_or_its_share_changes_little(
    skeleton: Skeleton, side: str, way: Vec3, far: float, share: float, step: Vec3
) -> None:
    place = beyond(skeleton, side, way, far)
    body = leant(skeleton, HandGoal(side, place, share=share))
    for other in (
        HandGoal(side, add(place, scale(step, 0.001)), share=share),
        HandGoal(side, place, share=max(0.0, share - 0.005)),
    ):
        moved = leant(skeleton, other)
        for joint in SPINE_RANGES:
            assert angle(difference(body.rotation(joint), moved.rotation(joint))) < math.radians(1.5)


def test_a_figure_leans_for_both_hands_at_once_and_no_further_than_they_need(skeleton: Skeleton) -> None:
    places = {side: beyond(skeleton, side, unit((0.0, -0.3, 1.0)), 0.12) for side in "lr"}
    both = leant(skeleton, *(HandGoal(side, place) for side, place in places.items()))
    for side, place in places.items():
        left = distance(both.transform(f"{side}_shoulder").position, place) - Arm.of(skeleton, side).reach
        assert abs(left) < 0.005
    for part in (0.25, 0.5, 0.75):
        one = leant(skeleton, HandGoal("l", places["l"], share=1.0 - part), HandGoal("l", places["l"], share=part))
        whole = leant(skeleton, HandGoal("l", places["l"]))
        assert angle(difference(one.rotation("vl5"), whole.rotation("vl5"))) < 1e-6


def test_joints_go_over_to_a_lean_that_jumps_and_follow_one_that_does_not(skeleton: Skeleton) -> None:
    released: list[float] = []
    leaning = Leaning(skeleton, lambda joints, until: released.append(until))
    near, far = (beyond(skeleton, "r", (0.0, 0.0, 1.0), each) for each in (-0.1, 0.2))
    goals = [HandGoal("r", far, share=smoothstep(number / 60)) for number in range(61)]
    goals += [HandGoal("r", far)] * 10
    for number, goal in enumerate(goals):
        leaning.layers(GlobalTime(0.02 * number), [goal], Body(skeleton))
    assert released == []
    leaning.layers(GlobalTime(2.0), [HandGoal("r", near)], Body(skeleton))
    assert len(released) == 1
    for number in range(10):
        leaning.layers(GlobalTime(2.02 + 0.02 * number), [], Body(skeleton))
    assert len(released) == 1
    assert leaning.rests
