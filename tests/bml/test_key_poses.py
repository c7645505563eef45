"""Key poses in BML: what is read, and what is wrong with them."""

from collections.abc import Callable

import pytest

from reactive_realizer.bml.block import BehaviorBlock, Parsed
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.key_poses import KeyPoses, LookAtGoal, OrientationGoal, PositionGoal
from reactive_realizer.bml.names import BML, OWN
from reactive_realizer.bml.time_warps import warped
from reactive_realizer.bml.vocabulary import BodyAxis, BodyGroup, WarpKind
from reactive_realizer.limits import Limits

NAMESPACE = 'xmlns="urn:reactive-realizer:1"'


def test_a_key_pose_has_a_time_a_hold_and_goals(block: Callable[[str], BehaviorBlock]) -> None:
    (poses,) = block(
        f'<keyPoses {NAMESPACE} id="k" group="RIGHT_ARM" fadeIn="0.2" warp="EXP" steepness="3" start="1" up="speech:w">'
        '<keyPose id="up" time="0.5" hold="0.2">'
        '<position target="-0.1 0.2 .3"/><orientation direction="0 0 1"/></keyPose>'
        '<keyPose time="1"><position target="0 0 0" joint="r_index3" offset="0 -0.02 0"/></keyPose></keyPoses>'
    ).behaviors
    assert isinstance(poses, KeyPoses)
    assert (poses.group, poses.fade_in, poses.fade_out, poses.warp) == (BodyGroup.RIGHT_ARM, 0.2, 0.0, WarpKind.EXP)
    up, down = poses.poses
    assert (up.id, up.time, up.hold) == ("up", 0.5, 0.2)
    position, orientation = up.goals
    assert isinstance(position, PositionGoal)
    assert position.target == (-0.1, 0.2, 0.3)
    assert isinstance(orientation, OrientationGoal)
    assert orientation.axis is BodyAxis.PALM
    assert down.goals[0].location.line == 1
    assert {sync: str(ref) for sync, ref in poses.syncs.items()} == {"start": "1", "up": "speech:w"}


def test_children_may_be_in_the_namespace_of_bml(read: Callable[[str], Parsed]) -> None:
    document = (
        f'<bml xmlns="{BML}" xmlns:rr="urn:reactive-realizer:1" id="b"><rr:keyPoses id="k" group="HEAD_NECK">'
        '<keyPose time="1"><lookAt target="1 1 1"/></keyPose></rr:keyPoses></bml>'
    )
    (parsed,) = parse(document, Limits())
    assert parsed.block is not None
    (poses,) = parsed.block.behaviors
    assert isinstance(poses, KeyPoses)
    assert isinstance(poses.poses[0].goals[0], LookAtGoal)


@pytest.mark.parametrize(
    ("poses", "problem"),
    [
        ('<keyPose time="1"><lookAt target="1 1"/></keyPose>', "three numbers, not 2"),
        ('<keyPose time="1"/>', "must contain <position> or"),
        ('<keyPose><lookAt target="1 1 1"/></keyPose>', "time"),
        (
            '<keyPose time="0.2"><lookAt target="1 1 1"/></keyPose>',
            "0.20 s is before the end of the one before it, at 0.50",
        ),
        ('<keyPose id="a" time="1"><lookAt target="1 1 1"/></keyPose>', "'a'"),
        ('<keyPose time="1"><shrug/></keyPose>', "shrug"),
    ],
)
def test_a_pose_that_cannot_be_read_is_left_out(read: Callable[[str], Parsed], poses: str, problem: str) -> None:
    first = '<keyPose id="a" time="0.3" hold="0.2"><lookAt target="0 0 1"/></keyPose>'
    parsed = read(f'<keyPoses {NAMESPACE} id="k" group="HEAD">{first}{poses}</keyPoses>')
    assert parsed.block is not None
    (behavior,) = parsed.block.behaviors
    assert isinstance(behavior, KeyPoses)
    assert len(behavior.poses) == 1
    assert any(problem in each.fault.sentence for each in parsed.problems)
    assert all(each.id == "b:k" for each in parsed.problems)


def test_poses_with_goals_beyond_the_limit_are_left_out_and_the_first_one_is_named() -> None:
    look, turn = '<lookAt target="0 0 1"/>', '<orientation axis="CROWN" direction="0 1 0"/>'
    poses = "".join(f'\n<keyPose time="{number}">{look}{turn}</keyPose>' for number in range(1, 5))
    text = f'<bml xmlns="{BML}" id="b"><rr:keyPoses xmlns:rr="{OWN}" id="k" group="HEAD">{poses}</rr:keyPoses></bml>'
    (parsed,) = parse(text, Limits(goals_per_behavior=5))
    assert parsed.block is not None
    (found,) = parsed.block.behaviors
    assert isinstance(found, KeyPoses)
    assert [pose.time for pose in found.poses] == [1.0, 2.0]
    told = "this keyPose and all after it are left out: at most 5 goals are played (goals_per_behavior)"
    assert [(each.fault.line, each.fault.sentence) for each in parsed.problems] == [(4, told)]


def test_a_pose_that_is_held_has_no_use_for_the_parameters_of_a_curve(read: Callable[[str], Parsed]) -> None:
    goal = '<lookAt target="0 0 1"/>'
    parsed = read(
        f'<keyPoses {NAMESPACE} id="k" group="HEAD">'
        f'<keyPose time="0.3" tension="0.5" bias="-1">{goal}</keyPose>'
        f'<keyPose time="1" hold="0.2" tension="0" bias="0">{goal}</keyPose></keyPoses>'
    )
    assert parsed.block is not None
    (behavior,) = parsed.block.behaviors
    assert isinstance(behavior, KeyPoses)
    assert behavior.poses[0].curve == {"tension": 0.5, "bias": -1.0}
    (problem,) = parsed.problems
    assert problem.fault.code == "held-curve"
    assert "no use for tension, bias" in problem.fault.sentence


def test_key_poses_without_any_pose_are_refused(read: Callable[[str], Parsed]) -> None:
    parsed = read(f'<keyPoses {NAMESPACE} id="k" group="HEAD"/>')
    assert parsed.block is not None
    assert parsed.block.behaviors == ()
    assert "must contain <keyPose>" in parsed.problems[0].fault.sentence


def test_key_poses_that_cannot_be_read_are_refused_with_the_first_reason(read: Callable[[str], Parsed]) -> None:
    pose = '<keyPose time="1"><lookAt target="nan 0 1"/></keyPose>'
    parsed = read(f'<keyPoses {NAMESPACE} id="k" group="HEAD">{pose}<keyPose time="-1"/></keyPoses>')
    assert parsed.block is not None
    assert parsed.block.behaviors == ()
    (problem,) = parsed.problems
    assert "target='nan 0 1'" in problem.fault.sentence


@pytest.mark.parametrize("kind", list(WarpKind))
def test_a_time_warp_goes_from_0_to_1_with_its_steepness_at_the_beginning(kind: WarpKind) -> None:
    for steepness in (0.3, 1.0, 3.0):
        assert warped(0.0, kind, steepness) == 0.0
        assert warped(1.0, kind, steepness) == pytest.approx(1.0)
        assert warped(1e-6, kind, steepness) / 1e-6 == pytest.approx(steepness, abs=1e-3)


def test_a_steep_exponential_warp_eases_out_and_a_steeper_one_overshoots() -> None:
    assert warped(0.5, WarpKind.EXP, 1.0) == pytest.approx(0.5)
    assert warped(0.5, WarpKind.EXP, 3.0) > 0.8
    assert max(warped(share / 100, WarpKind.EXP, 3.0) for share in range(101)) <= 1.0
    assert max(warped(share / 100, WarpKind.EXP, 6.0) for share in range(101)) > 1.1
