"""Inverse kinematics of legs."""

from importlib.resources import files
from pathlib import Path

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body, Skeleton, Transform
from reactive_realizer.embodiment.feet import LEG_JOINTS, drawn, feet, legs, reach, walks
from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.embodiment.quaternion import Quat, angle, difference, from_euler
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, distance

AVATARS = Path(str(files("reactive_realizer"))) / "assets" / "avatars"
SKELETONS = [Avatar.read(AVATARS / f"{name}.glb").skeleton for name in ("female", "male")]

skeletons = st.sampled_from(SKELETONS)
ways = st.tuples(st.floats(-0.2, 0.2), st.floats(0.02, 0.3), st.floats(-0.3, 0.3))
turns = st.builds(from_euler, *[st.floats(-0.4, 0.4)] * 3)


def far(body: Body, side: str, foot: Transform) -> float:
    return distance(body.transform(f"{side}_hip").position, foot.position)


@given(skeletons, st.tuples(ways, ways), st.tuples(turns, turns), turns)
def test_legs_place_both_feet_anywhere_within_reach(
    skeleton: Skeleton, moved: tuple[Vec3, Vec3], turned: tuple[Quat, Quat], pelvis: Quat
) -> None:
    body = Body(skeleton, {"HumanoidRoot": pelvis})
    places = [
        Transform(add(foot.position, way), turn) for foot, way, turn in zip(feet(body), moved, turned, strict=True)
    ]
    assume(all(far(body, side, foot) < 0.99 * reach(skeleton, side) for side, foot in zip(SIDES, places, strict=True)))
    for foot, place in zip(feet(body.posed(legs(body, places))), places, strict=True):
        assert distance(foot.position, place.position) < 1e-6
        assert angle(difference(foot.rotation, place.rotation)) < 1e-6


@given(skeletons, turns)
def test_a_knee_stays_turned_as_it_was(skeleton: Skeleton, hip: Quat) -> None:
    body = Body(skeleton, {"l_hip": hip, "l_knee": from_euler(0.6, 0.0, 0.0)})
    again = legs(body, feet(body))
    for joint, turn in again.items():
        assert angle(difference(turn, body.rotation(joint))) < 1e-6


@pytest.mark.parametrize("skeleton", SKELETONS)
def test_a_leg_points_at_a_goal_out_of_reach(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    places = [Transform(add(foot.position, (0.0, -0.2, 0.4)), foot.rotation) for foot in feet(body)]
    for side, foot, place in zip(SIDES, feet(body.posed(legs(body, places))), places, strict=True):
        assert distance(foot.position, place.position) == pytest.approx(
            far(body, side, place) - reach(skeleton, side), abs=0.005
        )


@given(skeletons, st.floats(-3.0, 3.0), st.floats(-3.0, 3.0))
def test_feet_out_of_reach_are_dragged_along_together(skeleton: Skeleton, x: float, z: float) -> None:
    body = Body(skeleton, {}, (0.0, -0.1, 0.0))
    places = [Transform(add(foot.position, (-x, 0.0, -z)), foot.rotation) for foot in feet(Body(skeleton))]
    near = drawn(body, places, (x, 0.5, z))
    (left, right), (to_left, to_right) = places, near
    assert max(far(body, side, foot) - reach(skeleton, side) for side, foot in zip(SIDES, near, strict=True)) < 1e-6
    for one, other in zip(
        (a - b for a, b in zip(to_left.position, left.position, strict=True)),
        (a - b for a, b in zip(to_right.position, right.position, strict=True)),
        strict=True,
    ):
        assert one == pytest.approx(other)
    assert to_left.position[1] == left.position[1]


@pytest.mark.parametrize("skeleton", SKELETONS)
def test_feet_within_reach_are_not_dragged_and_none_beyond_the_end_of_the_path(skeleton: Skeleton) -> None:
    body = Body(skeleton, {}, (0.0, -0.1, 0.0))
    here = feet(Body(skeleton))
    assert tuple(drawn(body, here, (1.0, 0.0, 0.0))) == here
    assert tuple(drawn(body, here, ZERO)) == here
    ahead = [Transform(add(foot.position, (0.0, 0.0, 2.0)), foot.rotation) for foot in here]
    assert drawn(body, ahead, (0.0, 0.0, -0.5))[0].position[2] == pytest.approx(here[0].position[2] + 1.5)


@pytest.mark.parametrize("joint", sorted(LEG_JOINTS))
def test_a_figure_without_complete_legs_does_not_walk(joint: str) -> None:
    whole = SKELETONS[0]
    assert walks(whole)
    flat = tuple((0.0, 0.0, 0.0) if each == joint else whole.offset(each) for each in whole.joints)
    assert not walks(Skeleton(whole.joints, whole.parents, flat))
    assert not walks(Skeleton(("HumanoidRoot",), (-1,), (ZERO,)))


@pytest.mark.parametrize("skeleton", SKELETONS)
def test_a_leg_with_its_goal_at_the_hip_stays_as_it_is(skeleton: Skeleton) -> None:
    body = Body(skeleton, {"l_knee": from_euler(0.5, 0.0, 0.0)})
    hips = [body.transform(f"{side}_hip") for side in SIDES]
    assert legs(body, hips) == {joint: body.rotation(joint) for joint in LEG_JOINTS}
