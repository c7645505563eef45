"""Pointing arms (thesis 4.2.2): accuracy, reach and speed profile."""

import math
from itertools import pairwise

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.quaternion import angle, from_euler
from reactive_realizer.embodiment.vector import Vec3, add, distance, dot, scale, subtract, unit
from reactive_realizer.engines.animation.motion_unit import GESTURE_POINTS, Moment, Resource
from reactive_realizer.engines.animation.motions.pointing import ASYMMETRY, DEFAULTS, PointingMotionUnit
from reactive_realizer.engines.animation.motions.pointing_arm import PointingArm
from reactive_realizer.engines.animation.motions.reaching import sigmoid

from .bodies import shown

SIDES = ("l", "r")
PLACES = st.tuples(st.floats(-3, 3), st.floats(-0.5, 3.5), st.floats(-1.5, 4))
NEAR = st.tuples(st.floats(-0.7, 0.7), st.floats(0.5, 2.1), st.floats(-0.3, 0.9))
LEANS = st.tuples(st.floats(-0.4, 0.4), st.floats(-0.6, 0.6), st.floats(-0.3, 0.3))
AHEAD = (0.0, 1.3, 2.5)


def miss(body: Body, side: str, target: Vec3) -> float:
    """The angle, degrees, between the line of the index finger and the way from its base to a target."""
    base, tip = (body.transform(f"{side}_index{i}").position for i in (1, 3))
    cosine = dot(unit(subtract(tip, base)), unit(subtract(target, base)))
    return math.degrees(math.acos(min(1.0, cosine)))


def pointing(body: Body, target: Vec3 = AHEAD, sides: str = "r", **parameters: float) -> PointingMotionUnit:
    arms = [PointingArm(body.skeleton, side) for side in sides]
    return PointingMotionUnit("it", arms, lambda time=None: target, lambda _: body, body, {**DEFAULTS, **parameters})


def speeds(unit_: PointingMotionUnit, body: Body, first: float, last: float, count: int = 60) -> list[float]:
    """Of the right wrist in steps of equal length between two phases."""
    phases = (first + (last - first) * i / count for i in range(count + 1))
    places = [body.posed(shown(unit_, phase, body)).transform("r_wrist").position for phase in phases]
    return [distance(a, b) for a, b in pairwise(places)]


@given(target=st.one_of(PLACES, NEAR), lean=LEANS)
def test_the_finger_points_exactly_at_every_reachable_target(skeleton: Skeleton, target: Vec3, lean: Vec3) -> None:
    body = Body(skeleton, {"vl5": from_euler(*lean), "r_sternoclavicular": from_euler(0.0, 0.0, -0.1)})
    for side in SIDES:
        aim = PointingArm(skeleton, side).aim(body, target)
        if aim.fault is None:
            assert miss(body.posed(aim.rotations), side, target) < 2.0


@given(target=st.one_of(PLACES, NEAR), length=st.sampled_from([0.001, 0.01, 0.05, 0.6]))
def test_an_arm_with_unusual_proportions_points_as_well_as_possible(
    skeleton: Skeleton, target: Vec3, length: float
) -> None:
    offsets = [
        scale(unit(offset), length) if joint.endswith("_wrist") else offset
        for joint, offset in zip(skeleton.joints, skeleton.offsets, strict=True)
    ]
    odd = Skeleton(skeleton.joints, skeleton.parents, tuple(offsets))
    for side in SIDES:
        rotations = PointingArm(odd, side).aim(Body(odd), target).rotations
        assert all(sum(part * part for part in turn) == pytest.approx(1.0) for turn in rotations.values())


@given(target=st.one_of(PLACES, NEAR))
@example(target=(1.0, 0.0, -1.0))
def test_elbow_and_wrist_stay_within_human_ranges(skeleton: Skeleton, target: Vec3) -> None:
    for side in SIDES:
        rotations = PointingArm(skeleton, side).aim(Body(skeleton), target).rotations
        body = Body(skeleton, rotations)
        places = [body.transform(f"{side}_{joint}").position for joint in ("shoulder", "elbow", "wrist")]
        upper, lower = (unit(subtract(b, a)) for a, b in pairwise(places))
        assert 5.0 < math.degrees(math.acos(max(-1.0, dot(upper, lower)))) < 152.0
        assert math.degrees(angle(rotations[f"{side}_wrist"])) < 45.0
        assert all(math.isfinite(part) for rotation in rotations.values() for part in rotation)


@given(way=st.tuples(st.floats(-2, 2), st.floats(-2, 2), st.floats(-1, 3)))
def test_left_and_right_arm_are_mirror_images(skeleton: Skeleton, way: Vec3) -> None:
    body, tips = Body(skeleton), []
    for side, mirror in (("l", 1.0), ("r", -1.0)):
        shoulder = body.transform(f"{side}_shoulder").position
        aim = PointingArm(skeleton, side).aim(body, add(shoulder, (mirror * way[0], way[1], way[2])))
        x, y, z = subtract(body.posed(aim.rotations).transform(f"{side}_wrist").position, shoulder)
        tips.append((mirror * x, y, z, aim.fault is None))
    assert tips[0] == pytest.approx(tips[1], abs=0.02)


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize(
    "target",
    [(0.0, 1.3, 3.0), (0.1, 4.0, 0.3), (0.2, 0.0, 0.8), (2.0, 1.2, 1.0), (-2.0, 1.2, 1.0), (0.1, 1.3, 0.55)],
    ids=["ahead", "up", "down", "left", "right", "near"],
)
def test_either_arm_reaches_targets_ahead_above_below_aside_across_and_near(
    skeleton: Skeleton, side: str, target: Vec3
) -> None:
    assert PointingArm(skeleton, side).aim(Body(skeleton), target).fault is None


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize("target", [(0.0, 1.3, -3.0), (0.0, 0.2, -1.0)], ids=["behind", "behind and below"])
def test_a_target_behind_the_back_is_pointed_at_as_far_as_is_natural(
    skeleton: Skeleton, side: str, target: Vec3
) -> None:
    aim = PointingArm(skeleton, side).aim(Body(skeleton), target)
    assert aim.fault is not None
    assert "behind" in aim.fault
    hand = Body(skeleton, aim.rotations).transform(f"{side}_wrist").position
    assert distance(hand, Body(skeleton).transform(f"{side}_shoulder").position) > 0.2


@pytest.mark.parametrize("side", SIDES)
def test_a_target_nearer_than_a_hand_is_out_of_reach(skeleton: Skeleton, side: str) -> None:
    body = Body(skeleton)
    shoulder = body.transform(f"{side}_shoulder").position
    for way in ((0.0, 0.0, 0.0), (0.0, 0.0, 0.1), (0.02, 0.1, 0.0)):
        assert PointingArm(skeleton, side).aim(body, add(shoulder, way)).fault == "it is too near"


@pytest.mark.parametrize("side", SIDES)
def test_the_arm_is_nearly_straight_for_a_far_target_and_its_elbow_hangs(skeleton: Skeleton, side: str) -> None:
    body = Body(skeleton)
    body = body.posed(PointingArm(skeleton, side).aim(body, (0.3 if side == "l" else -0.3, 1.3, 5.0)).rotations)
    shoulder, elbow, wrist = (body.transform(f"{side}_{joint}").position for joint in ("shoulder", "elbow", "wrist"))
    straight = distance(shoulder, elbow) + distance(elbow, wrist)
    assert distance(shoulder, wrist) > 0.95 * straight
    assert elbow[1] < add(shoulder, scale(subtract(wrist, shoulder), 0.5))[1]


@pytest.mark.parametrize("side", SIDES)
def test_a_small_move_of_the_target_moves_the_arm_a_little(skeleton: Skeleton, side: str) -> None:
    arm, body = PointingArm(skeleton, side), Body(skeleton)
    circle = [2.2 * i / 500 for i in range(-500, 501)]
    path = [(2.0 * math.sin(a), 1.3 + 0.9 * math.sin(3.0 * a), 0.6 + 1.4 * math.cos(a)) for a in circle]
    bodies = [body.posed(arm.aim(body, target).rotations) for target in path]
    for joint in (f"{side}_elbow", f"{side}_wrist", f"{side}_index3"):
        places = [b.transform(joint).position for b in bodies]
        assert max(distance(a, b) for a, b in pairwise(places)) < 0.06


def test_only_the_index_finger_is_stretched(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    body = body.posed(PointingArm(skeleton, "r").aim(body, AHEAD).rotations)
    for finger in ("index", "middle", "ring", "pinky"):
        base, *others = (body.transform(f"r_{finger}{i}").position for i in (1, 2, 3))
        bend = dot(unit(subtract(others[0], base)), unit(subtract(others[1], others[0])))
        assert bend > 0.99 if finger == "index" else bend < 0.3


@pytest.mark.parametrize("steepness", [1.5, 2.0, 3.0, 4.0])
@pytest.mark.parametrize("asymmetry", [-0.6, -0.1, 0.0, 0.4])
def test_the_sigmoid_has_one_peak_of_speed_with_the_given_steepness_and_asymmetry(
    steepness: float, asymmetry: float
) -> None:
    count = 2000
    way = [sigmoid(i / count, steepness, asymmetry) for i in range(count + 1)]
    speed = [(b - a) * count for a, b in pairwise(way)]
    peak = max(range(count), key=speed.__getitem__)
    assert (way[0], way[-1]) == (0.0, 1.0)
    assert speed[: peak + 1] == sorted(speed[: peak + 1])
    assert speed[peak:] == sorted(speed[peak:], reverse=True)
    assert speed[peak] == pytest.approx(steepness, rel=0.01)
    assert (peak + 0.5) / count == pytest.approx(0.5 * (1.0 + asymmetry), abs=0.002)


def test_the_speed_of_the_hand_is_bell_shaped_both_ways(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    unit_ = pointing(body)
    keys = unit_.key_positions
    for first, last in ((0.0, keys["ready"]), (keys["relax"], 1.0)):
        bell = speeds(unit_, body, first, last)
        peak = max(range(len(bell)), key=bell.__getitem__)
        assert bell[: peak + 1] == sorted(bell[: peak + 1])
        assert bell[peak:] == sorted(bell[peak:], reverse=True)
        assert 10 * max(bell[0], bell[-1]) < bell[peak]


def test_asymmetry_moves_the_peak(skeleton: Skeleton) -> None:
    body, peaks = Body(skeleton), []
    for asymmetry in (-0.5, 0.0, 0.5):
        unit_ = pointing(body, AHEAD, "r", **{ASYMMETRY: asymmetry})
        bell = speeds(unit_, body, 0.0, unit_.key_positions["ready"])
        peaks.append(max(range(len(bell)), key=bell.__getitem__))
    early, middle, late = peaks
    assert early < middle - 8 < middle + 8 < late


def test_pointing_has_seven_points_and_symmetric_durations(skeleton: Skeleton) -> None:
    unit_ = pointing(Body(skeleton))
    keys = unit_.key_positions
    assert tuple(keys) == GESTURE_POINTS
    assert keys["ready"] == keys["strokeStart"] == keys["stroke"] < keys["strokeEnd"] == keys["relax"]
    assert keys["ready"] == pytest.approx(1.0 - keys["relax"])


def test_pointing_starts_from_the_current_arm_and_ends_in_the_layers_below(skeleton: Skeleton) -> None:
    unit_ = pointing(Body(skeleton))
    raised = Body(skeleton, {"r_shoulder": from_euler(-1.4, 0.3, -0.4), "r_elbow": from_euler(-0.9, 0.0, 0.0)})
    unit_.start(raised)
    start = raised.posed(shown(unit_, 0.0, raised))
    end = raised.posed(shown(unit_, 1.0, raised))
    for body in (start, end):
        assert distance(body.transform("r_index3").position, raised.transform("r_index3").position) < 1e-9


def test_pointing_with_both_hands_owns_both_arms(skeleton: Skeleton) -> None:
    body = Body(skeleton)
    unit_ = pointing(body, sides="lr")
    posed = body.posed(unit_.pose(Moment(unit_.key_positions["stroke"], GlobalTime(0.0), body)).rotations)
    assert unit_.resources == {Resource.LEFT_ARM, Resource.RIGHT_ARM}
    assert max(miss(posed, side, AHEAD) for side in SIDES) < 2.0
