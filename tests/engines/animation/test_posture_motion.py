"""Postures as motions, also on figures that lack joints."""

import pytest

from reactive_realizer.bml.behaviors import Pose
from reactive_realizer.bml.vocabulary import PosePart, StanceType
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Skeleton
from reactive_realizer.embodiment.pose import Layer, LayerKind, compose
from reactive_realizer.embodiment.quaternion import angle
from reactive_realizer.engines.animation.motion_unit import Moment, MotionPose
from reactive_realizer.engines.animation.motions.posture import PostureMotionUnit, posture_after
from reactive_realizer.engines.animation.posture.foot_planting import FootPlanting
from reactive_realizer.engines.animation.posture.posture_library import PART_JOINTS, BodyPosture, PostureLibrary
from reactive_realizer.engines.animation.posture.rest_posture import RestPosture

from .bodies import ASSET, body_in, pose, posture, without


@pytest.fixture
def rest(skeleton: Skeleton) -> RestPosture:
    return RestPosture(PostureLibrary(skeleton, ASSET))


def test_a_posture_takes_a_quarter_of_its_time_to_come_and_a_quarter_to_go(rest: RestPosture) -> None:
    unit = PostureMotionUnit(rest, None, [pose("ARMS", "ARMS_CROSSED")])
    weights = [
        unit.pose(Moment(phase, GlobalTime(0.0), rest.body)).weight for phase in (0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0)
    ]
    assert weights == pytest.approx([0.0, weights[1], 1.0, 1.0, 1.0, weights[5], 0.0])
    assert 0.0 < weights[1] < 1.0
    assert 0.0 < weights[5] < 1.0


def test_a_shift_uses_all_its_time_and_stays(rest: RestPosture) -> None:
    unit = PostureMotionUnit(rest, StanceType.SITTING, [], shift=True)
    assert unit.key_positions == {"start": 0.0, "end": 1.0}
    assert unit.pose(Moment(0.5, GlobalTime(0.0), rest.body)).weight == pytest.approx(0.5)
    assert unit.pose(Moment(1.0, GlobalTime(0.0), rest.body)).weight == 1.0
    assert unit.persists_as == "posture"


def test_the_duration_of_a_posture_depends_on_its_distance(rest: RestPosture) -> None:
    def coming(stance: StanceType | None, *poses: Pose) -> float:
        return PostureMotionUnit(rest, stance, poses).preferred_duration / 4

    fists, crossed, sitting = (
        coming(None, pose("HEAD", "LEANING_FORWARD")),
        coming(None, pose("ARMS", "ARMS_CROSSED")),
        coming(StanceType.SITTING),
    )
    assert 0.45 < fists < crossed < sitting < 2.3
    assert 0.6 < crossed < 1.0
    assert sitting > 1.4


def test_getting_up_takes_as_long_as_sitting_down_even_if_both_are_planned_at_once(skeleton: Skeleton) -> None:
    planned: list[PostureMotionUnit] = []
    rest = RestPosture(PostureLibrary(skeleton, ASSET), lambda: posture_after(BodyPosture(), planned))
    down = PostureMotionUnit(rest, StanceType.SITTING, [], shift=True)
    planned.append(down)
    up = PostureMotionUnit(rest, StanceType.STANDING, [], shift=True)
    assert up.preferred_duration == pytest.approx(down.preferred_duration)


def test_a_posture_starts_from_the_current_base_posture(rest: RestPosture) -> None:
    unit = PostureMotionUnit(rest, StanceType.SITTING, [])
    crossed = posture(ARMS="ARMS_CROSSED")
    rest.adopt(crossed, rest.in_posture(crossed))
    unit.start(rest.body)
    assert unit.posture == posture("SITTING", ARMS="ARMS_CROSSED")


def test_the_trunk_bows_on_the_way_down_and_is_upright_at_the_end(rest: RestPosture) -> None:
    unit = PostureMotionUnit(rest, StanceType.SITTING, [], shift=True)
    bends = [angle(unit.pose(Moment(phase, GlobalTime(0.0), rest.body)).rotations["vl5"]) for phase in (0.0, 0.5, 1.0)]
    assert bends[1] > bends[0] + 0.3
    assert bends[2] < 0.1


def test_a_posture_leaves_other_joints_alone(rest: RestPosture) -> None:
    unit = PostureMotionUnit(rest, None, [pose("ARMS", "ARMS_CROSSED")])
    assert unit.joints.isdisjoint(PART_JOINTS[PosePart.LEGS])
    assert unit.pose(Moment(0.5, GlobalTime(0.0), rest.body)).root is None


FINGERS = ("thumb", "index", "middle", "ring", "pinky")
LEGS = ("hip", "knee", "ankle", "midtarsal")


@pytest.mark.parametrize("parts", [LEGS, ("midtarsal",), ("eyeball", "index", "thumb"), FINGERS])
def test_a_figure_without_some_joints_takes_postures_as_far_as_possible(
    skeleton: Skeleton, parts: tuple[str, ...]
) -> None:
    lesser = without(skeleton, *parts)
    rest = RestPosture(PostureLibrary(lesser, ASSET))
    unit = PostureMotionUnit(rest, StanceType.SITTING, [pose("ARMS", "ARMS_CROSSED")])
    for phase in (0.0, 0.1, 0.5, 1.0):
        posed = unit.pose(Moment(phase, GlobalTime(0.0), rest.body))
        assert posed.rotations.keys() <= set(lesser.joints)
        layers = (Layer(LayerKind.BASE, rest.pose, root=rest.body.root), posed_layer(posed))
        compose(lesser, (*layers, *FootPlanting(lesser).layers(layers, GlobalTime(0.0))))


def posed_layer(posed: MotionPose) -> Layer:
    return Layer(LayerKind.POSTURE, posed.rotations, posed.weight, root=posed.root)


def test_a_figure_without_legs_stays_in_place(skeleton: Skeleton) -> None:
    bust = without(skeleton, *LEGS)
    assert body_in(bust, "SITTING").root == (0.0, 0.0, 0.0)


def test_legs_without_a_length_are_left_alone(skeleton: Skeleton) -> None:
    flat = Skeleton(
        skeleton.joints,
        skeleton.parents,
        tuple((0.0, 0.0, 0.0) if "knee" in j else skeleton.offset(j) for j in skeleton.joints),
    )
    body = body_in(flat, "SITTING")
    layers = (Layer(LayerKind.BASE, {}), Layer(LayerKind.POSTURE, body.pose, 0.5, root=body.root))
    assert FootPlanting(flat).layers(layers, GlobalTime(0.0)) == ()
