"""Stances and poses: files, their words, and how a body stands on the ground in them."""

import math
import shutil
from itertools import pairwise
from pathlib import Path

import pytest

from reactive_realizer.assembly.assets import Assets
from reactive_realizer.bml.words import PosePart, StanceType
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import Layer, LayerKind, compose
from reactive_realizer.embodiment.quaternion import angle, difference, rotate
from reactive_realizer.embodiment.skeleton import Skeleton
from reactive_realizer.embodiment.vector import UP, distance, subtract, unit
from reactive_realizer.engines.animation.motion_unit import Moment, Posed
from reactive_realizer.engines.animation.posture.body_posture import BodyPosture
from reactive_realizer.engines.animation.posture.expectation import posture_after
from reactive_realizer.engines.animation.posture.footing import Footing
from reactive_realizer.engines.animation.posture.parts import JOINTS
from reactive_realizer.engines.animation.posture.posture_library import LEXEMES, PostureLibrary
from reactive_realizer.engines.animation.posture.posture_motion_unit import PostureMotionUnit
from reactive_realizer.engines.animation.posture.rest import Rest
from reactive_realizer.errors import RealizerError, error

from .resting import ASSET, body_in, pose, posture

SOLES = ("l_ankle", "r_ankle", "l_midtarsal", "r_midtarsal")
POSSIBLE = [(stance.value, lexeme) for stance in StanceType for lexeme in LEXEMES]
POSSIBLE.remove(("CROUCHING", "LEGS_CROSSED"))
PARTS = {"ARMS": "ARMS", "LEGS": "LEGS", "LEANING": "WHOLEBODY"}


def part_of(lexeme: str) -> str:
    return PARTS[lexeme.partition("_")[0]]


def apart(a: Body, b: Body, joint: str) -> float:
    """The angle between two bodies' rotations of a joint, rad."""
    return angle(difference(a.rotation(joint), b.rotation(joint)))


def height(body: Body, joint: str) -> float:
    return body.place(joint).position[1]


def slope(body: Body, start: str, end: str) -> float:
    """How far the way from one joint to another is from level, degrees."""
    return math.degrees(math.asin(unit(subtract(body.place(end).position, body.place(start).position))[1]))


# --- stances


def test_who_stands_has_the_pelvis_where_it_is_in_the_default_pose(skeleton):
    assert body_in(skeleton).root == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)


def test_who_sits_has_level_thighs_upright_shanks_and_an_upright_trunk(skeleton):
    body = body_in(skeleton, "SITTING")
    for side in "lr":
        assert abs(slope(body, f"{side}_hip", f"{side}_knee")) < 6.0
        assert slope(body, f"{side}_knee", f"{side}_ankle") < -80.0
    assert slope(body, "HumanoidRoot", "vc4") > 80.0


def test_who_sits_has_the_hands_on_the_thighs(skeleton):
    body = body_in(skeleton, "SITTING")
    for side in "lr":
        wrist, hip, knee = (body.place(f"{side}_{joint}").position for joint in ("wrist", "hip", "knee"))
        assert hip[2] < wrist[2] < knee[2]
        assert 0.03 < wrist[1] - hip[1] < 0.2
        assert abs(wrist[0] - hip[0]) < 0.08


@pytest.mark.parametrize("stance", ["STANDING", "SITTING", "CROUCHING"])
def test_a_figure_on_its_feet_has_both_soles_flat_on_the_ground_under_the_same_place(skeleton, stance):
    body, default = body_in(skeleton, stance), Body(skeleton)
    for joint in SOLES:
        assert height(body, joint) == pytest.approx(height(default, joint), abs=0.02)
    for side in "lr":
        assert rotate(body.place(f"{side}_ankle").rotation, UP)[1] > math.cos(math.radians(8.0))
    middle = [sum(each) / 2 for each in zip(*(body.place(s).position for s in SOLES[:2]), strict=True)]
    assert middle[0] == pytest.approx(0.0, abs=0.02)
    assert middle[2] == pytest.approx(default.place("l_ankle").position[2], abs=0.01)


def test_who_crouches_is_lower_than_who_sits_and_has_bent_knees(skeleton):
    crouching, sitting = body_in(skeleton, "CROUCHING"), body_in(skeleton, "SITTING")
    assert height(crouching, "skullbase") < height(sitting, "skullbase")
    assert angle(crouching.rotation("l_knee")) > math.radians(100.0)


def test_who_lies_lies_on_the_back_with_the_face_up(skeleton):
    body = body_in(skeleton, "LYING")
    assert max(height(body, joint) for joint in ("HumanoidRoot", "vt6", "skullbase", "l_wrist", "r_wrist")) < 0.3
    assert rotate(body.place("skullbase").rotation, (0.0, 0.0, 1.0))[1] > 0.9


@pytest.mark.parametrize(("stance", "lexeme"), POSSIBLE)
def test_in_no_stance_and_pose_is_anything_below_the_ground(skeleton, stance, lexeme):
    body = body_in(skeleton, stance, **{part_of(lexeme): lexeme})
    lowest = min(skeleton.joints, key=lambda joint: height(body, joint))
    # Of the default pose the toes are lowest.
    assert height(body, lowest) > min(height(Body(skeleton), joint) for joint in SOLES) - 0.015, lowest


# --- poses


def test_crossed_arms_have_each_hand_at_the_other_arm_in_front_of_the_chest(skeleton):
    body = body_in(skeleton, ARMS="ARMS_CROSSED")
    for side, other in ("lr", "rl"):
        wrist, elbow, shoulder = (
            body.place(joint).position for joint in (f"{side}_wrist", f"{other}_elbow", f"{side}_shoulder")
        )
        assert wrist[0] * shoulder[0] < 0.0
        assert wrist[2] > body.place("vt6").position[2] + 0.08
        assert distance(body.place(f"{side}_middle1").position, elbow) < 0.18
    assert height(body, "r_wrist") > height(body, "l_wrist")


def test_arms_akimbo_have_the_hands_at_the_hips_and_the_elbows_outside(skeleton):
    body = body_in(skeleton, ARMS="ARMS_AKIMBO")
    for side in "lr":
        wrist, elbow, hip = (body.place(f"{side}_{joint}").position for joint in ("wrist", "elbow", "hip"))
        assert distance(wrist, hip) < 0.19
        assert abs(elbow[0]) > abs(wrist[0]) + 0.1


def test_hands_stay_at_the_hips_while_the_trunk_leans(skeleton):
    upright = body_in(skeleton, ARMS="ARMS_AKIMBO")
    leaning = body_in(skeleton, ARMS="ARMS_AKIMBO", WHOLEBODY="LEANING_FORWARD")
    for wrist in ("l_wrist", "r_wrist"):
        assert distance(upright.place(wrist).position, leaning.place(wrist).position) < 0.02
    assert distance(upright.place("vc4").position, leaning.place("vc4").position) > 0.05


@pytest.mark.parametrize(("lexeme", "way"), [("LEANING_FORWARD", 1.0), ("LEANING_BACKWARD", -1.0)])
def test_who_leans_has_the_head_in_front_or_behind_and_looks_straight_ahead(skeleton, lexeme, way):
    body = body_in(skeleton, WHOLEBODY=lexeme)
    assert way * (body.place("skullbase").position[2] - body_in(skeleton).place("skullbase").position[2]) > 0.03
    assert rotate(body.place("skullbase").rotation, UP)[1] > math.cos(math.radians(6.0))


def test_open_legs_are_apart_with_flat_soles_and_a_lower_pelvis(skeleton):
    body, standing = body_in(skeleton, LEGS="LEGS_OPEN"), body_in(skeleton)
    left, right = (body.place(ankle).position for ankle in SOLES[:2])
    assert left[0] - right[0] > 1.4 * (2 * standing.place("l_ankle").position[0])
    assert body.root[1] < -0.01
    assert rotate(body.place("l_ankle").rotation, UP)[1] > 0.999


@pytest.mark.parametrize("stance", ["STANDING", "SITTING"])
def test_crossed_legs_have_one_foot_in_front_of_the_other_on_its_other_side(skeleton, stance):
    body = body_in(skeleton, stance, LEGS="LEGS_CROSSED")
    left, right = (body.place(ankle).position for ankle in SOLES[:2])
    assert right[0] > left[0] - 0.05
    assert right[2] > left[2]


def test_a_pose_of_one_arm_leaves_the_other_alone(skeleton):
    body, both, rest = (
        body_in(skeleton, LEFT_ARM="ARMS_CROSSED"),
        body_in(skeleton, ARMS="ARMS_CROSSED"),
        body_in(skeleton),
    )
    assert all(apart(body, rest, joint) < 1e-9 for joint in JOINTS[PosePart.RIGHT_ARM])
    assert all(apart(body, both, joint) < 1e-9 for joint in JOINTS[PosePart.LEFT_ARM])


def test_a_word_may_be_written_in_small_letters_and_with_hyphens(skeleton):
    assert body_in(skeleton, ARMS="arms-crossed").pose == body_in(skeleton, ARMS="ARMS_CROSSED").pose


def test_a_neutral_part_is_as_in_the_stance_alone(skeleton):
    arms = body_in(skeleton, "SITTING", ARMS="ARMS_CROSSED", RIGHT_ARM="ARMS_NEUTRAL")
    sitting = body_in(skeleton, "SITTING")
    assert all(apart(arms, sitting, joint) < 1e-9 for joint in JOINTS[PosePart.RIGHT_ARM])
    assert apart(arms, sitting, "l_shoulder") > 0.1


def test_a_word_without_a_file_is_refused_by_naming_the_known_ones(skeleton):
    with pytest.raises(RealizerError) as refused:
        body_in(skeleton, ARMS="ARMS_WINGED")
    assert refused.value.fault.code == "no-posture"
    assert "ARMS_WINGED" in refused.value.fault.sentence
    assert "ARMS_AKIMBO, ARMS_CROSSED" in refused.value.fault.sentence


def test_a_pose_that_a_stance_does_not_know_is_refused_in_it(skeleton):
    with pytest.raises(RealizerError, match="no pose 'LEGS_CROSSED' of the LEGS for one who is CROUCHING") as refused:
        body_in(skeleton, "CROUCHING", LEGS="LEGS_CROSSED")
    _, _, known = refused.value.fault.sentence.partition("there are ")
    assert "LEGS_OPEN" in known
    assert "LEGS_CROSSED" not in known
    assert "ARMS_CROSSED" not in known


@pytest.mark.parametrize("lexeme", ["/etc/passwd", "", "a/b", "\x00"])
def test_what_is_no_word_has_no_file(skeleton, lexeme):
    with pytest.raises(RealizerError) as refused:
        body_in(skeleton, ARMS=lexeme)
    assert refused.value.fault.code == "no-posture"


def test_no_word_leads_out_of_the_assets(skeleton):
    with pytest.raises(RealizerError, match="it may not leave the folders"):
        body_in(skeleton, ARMS="../humans/default")


def test_only_where_there_is_no_file_for_a_stance_the_file_for_all_is_taken(skeleton):
    def asset(name: str) -> Path:
        if name == "postures/sitting/arms_crossed.xml":
            raise error("two-assets", name=name, known="this, that")
        return ASSET(name)

    library = PostureLibrary(skeleton, asset)
    assert library.body(posture(ARMS="ARMS_CROSSED"))
    with pytest.raises(RealizerError, match="this, that"):
        library.body(posture("SITTING", ARMS="ARMS_CROSSED"))


def test_a_word_that_says_nothing_about_a_part_is_refused_for_it(skeleton):
    with pytest.raises(RealizerError, match="arms_crossed"):
        body_in(skeleton, LEGS="ARMS_CROSSED")


@pytest.mark.parametrize("lexeme", [lexeme for lexeme in LEXEMES if not lexeme.endswith("NEUTRAL")])
def test_every_word_that_ships_has_its_file_and_does_something(skeleton, lexeme):
    body, rest = body_in(skeleton, **{part_of(lexeme): lexeme}), body_in(skeleton)
    assert max(apart(body, rest, joint) for joint in skeleton.joints) > 0.05


# --- files of the user


@pytest.fixture
def own(tmp_path) -> Path:
    """A folder of assets in which a user keeps postures."""
    (tmp_path / "postures").mkdir()
    return tmp_path


def test_a_file_of_the_user_is_a_new_word(skeleton, own):
    shutil.copy(ASSET("postures/arms_akimbo.xml"), own / "postures" / "hands_up.xml")
    library = PostureLibrary(skeleton, Assets((own,)))
    assert library.body(posture(ARMS="HANDS_UP")).pose == body_in(skeleton, ARMS="ARMS_AKIMBO").pose


def test_a_stance_of_the_user_takes_the_place_of_ours_and_may_say_where_the_pelvis_is(skeleton, own):
    (own / "postures" / "sitting.xml").write_text(
        '<ProcAnimation prefDuration="1">'
        '<EndEffector target="HumanoidRoot" local="true" translation="0;-0.2;0.1"/>'
        '<Rotation target="l_knee" rotation="1;0;0"/></ProcAnimation>'
    )
    library = PostureLibrary(skeleton, Assets((own,)))
    for body in (library.body(posture("SITTING")), library.body(posture("SITTING", ARMS="ARMS_CROSSED"))):
        assert body.root == pytest.approx((0.0, -0.2, 0.1))
        assert angle(body.rotation("l_knee")) == pytest.approx(1.0)


def test_a_file_that_was_saved_anew_is_read_anew(skeleton, own):
    file = own / "postures" / "arms_up.xml"
    text = '<ProcAnimation prefDuration="1"><Rotation target="l_elbow" rotation="{};0;0"/></ProcAnimation>'
    library = PostureLibrary(skeleton, Assets((own,)))
    seen = []
    for bend in (-0.5, -1.5):
        file.write_text(text.format(bend))
        seen.append(angle(library.body(posture(ARMS="ARMS_UP")).rotation("l_elbow")))
    assert seen == pytest.approx([0.5, 1.5])


def test_a_file_that_is_broken_is_refused_by_its_line(skeleton, own):
    (own / "postures" / "arms_up.xml").write_text('<ProcAnimation prefDuration="1">\n<Rotation target="l_elbow"/>')
    with pytest.raises(RealizerError) as refused:
        PostureLibrary(skeleton, Assets((own,))).body(posture(ARMS="ARMS_UP"))
    assert refused.value.fault.code == "bad-asset"


REST_POSE = """<SkeletonPose rotationEncoding="axisangles" parts="HumanoidRoot r_shoulder l_shoulder" encoding="T1R">
0 1.9 0 1 0 0 0 0 0 1 -0.4 0 0 1 0.4</SkeletonPose>"""


def test_a_binding_may_say_how_a_stance_rests_and_the_feet_stay_on_the_ground(skeleton, own):
    (own / "mine.xml").write_text(REST_POSE)
    library = PostureLibrary(skeleton, Assets((own,)), {"STANDING": "mine.xml"})
    body = library.body(BodyPosture())
    assert angle(body.rotation("l_shoulder")) == pytest.approx(0.4)
    assert body.root == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)
    assert apart(body, body_in(skeleton), "l_elbow") < 1e-9


def test_a_rest_pose_that_is_not_there_is_logged_and_ours_is_taken(skeleton, caplog):
    library = PostureLibrary(skeleton, ASSET, {"SITTING": "nowhere.xml"})
    said = ["the rest pose of SITTING is our own: no file 'nowhere.xml' among the assets"]
    assert [record.getMessage() for record in caplog.records] == said, "before anybody sits"
    assert library.body(posture("SITTING")).pose == body_in(skeleton, "SITTING").pose
    assert len(caplog.records) == 1


# --- words joined


def test_who_sits_down_with_crossed_arms_has_crossed_arms():
    before = posture(ARMS="ARMS_CROSSED")
    assert before.changed(StanceType.SITTING, ()) == posture("SITTING", ARMS="ARMS_CROSSED")


def test_a_pose_takes_the_place_of_poses_of_the_same_joints():
    before = posture(LEFT_ARM="ARMS_OPEN", LEGS="LEGS_OPEN")
    assert before.changed(None, [pose("ARMS", "ARMS_CROSSED")]) == posture(LEGS="LEGS_OPEN", ARMS="ARMS_CROSSED")
    assert before.changed(None, [pose("WHOLEBODY", "LEANING_FORWARD")]) == posture(WHOLEBODY="LEANING_FORWARD")


def test_a_pose_of_one_arm_keeps_what_the_other_does(skeleton):
    after = posture(ARMS="ARMS_CROSSED").changed(None, [pose("LEFT_ARM", "ARMS_AKIMBO")])
    body, crossed = PostureLibrary(skeleton, ASSET).body(after), body_in(skeleton, ARMS="ARMS_CROSSED")
    assert apart(body, crossed, "r_shoulder") < 1e-9
    assert apart(body, body_in(skeleton, ARMS="ARMS_AKIMBO"), "l_shoulder") < 1e-9


# --- the motion


@pytest.fixture
def rest(skeleton) -> Rest:
    return Rest(PostureLibrary(skeleton, ASSET))


def test_a_posture_is_there_in_a_quarter_of_its_time_and_leaves_in_the_last(rest):
    unit = PostureMotionUnit(rest, None, [pose("ARMS", "ARMS_CROSSED")])
    weights = [unit.pose(Moment(phase, 0.0, rest.body)).weight for phase in (0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0)]
    assert weights == pytest.approx([0.0, weights[1], 1.0, 1.0, 1.0, weights[5], 0.0])
    assert 0.0 < weights[1] < 1.0
    assert 0.0 < weights[5] < 1.0


def test_a_shift_comes_all_its_time_and_stays(rest):
    unit = PostureMotionUnit(rest, StanceType.SITTING, [], shift=True)
    assert unit.key_positions == {"start": 0.0, "end": 1.0}
    assert unit.pose(Moment(0.5, 0.0, rest.body)).weight == pytest.approx(0.5)
    assert unit.pose(Moment(1.0, 0.0, rest.body)).weight == 1.0
    assert unit.lasts == "posture"


def test_how_long_it_takes_follows_from_how_far_it_is(rest):
    def coming(stance, *poses) -> float:
        return PostureMotionUnit(rest, stance, poses).preferred_duration / 4

    fists, crossed, sitting = (
        coming(None, pose("HEAD", "LEANING_FORWARD")),
        coming(None, pose("ARMS", "ARMS_CROSSED")),
        coming(StanceType.SITTING),
    )
    assert 0.45 < fists < crossed < sitting < 2.3
    assert 0.6 < crossed < 1.0
    assert sitting > 1.4


def test_getting_up_takes_as_long_as_sitting_down_even_if_both_are_planned_at_once(skeleton):
    planned: list[PostureMotionUnit] = []
    rest = Rest(PostureLibrary(skeleton, ASSET), lambda: posture_after(BodyPosture(), planned))
    down = PostureMotionUnit(rest, StanceType.SITTING, [], shift=True)
    planned.append(down)
    up = PostureMotionUnit(rest, StanceType.STANDING, [], shift=True)
    assert up.preferred_duration == pytest.approx(down.preferred_duration)


def test_it_begins_from_the_base_posture_of_then(rest):
    unit = PostureMotionUnit(rest, StanceType.SITTING, [])
    crossed = posture(ARMS="ARMS_CROSSED")
    rest.take(crossed, rest.in_posture(crossed))
    unit.start(rest.body)
    assert unit.posture == posture("SITTING", ARMS="ARMS_CROSSED")


def test_the_trunk_bows_on_the_way_down_and_is_upright_again_below(rest):
    unit = PostureMotionUnit(rest, StanceType.SITTING, [], shift=True)
    bends = [angle(unit.pose(Moment(phase, 0.0, rest.body)).rotations["vl5"]) for phase in (0.0, 0.5, 1.0)]
    assert bends[1] > bends[0] + 0.3
    assert bends[2] < 0.1


def test_what_it_does_not_change_stays_with_others(rest):
    unit = PostureMotionUnit(rest, None, [pose("ARMS", "ARMS_CROSSED")])
    assert unit.joints.isdisjoint(JOINTS[PosePart.LEGS])
    assert unit.pose(Moment(0.5, 0.0, rest.body)).root is None


# --- figures that lack something


def without(skeleton: Skeleton, *parts: str) -> Skeleton:
    """A skeleton without joints in whose names a part occurs."""
    kept = [joint for joint in skeleton.joints if not any(part in joint for part in parts)]
    parents = [skeleton.parent(joint) for joint in kept]
    indices = [-1 if parent is None else kept.index(parent) for parent in parents]
    return Skeleton(tuple(kept), tuple(indices), tuple(map(skeleton.offset, kept)))


FINGERS = ("thumb", "index", "middle", "ring", "pinky")
LEGS = ("hip", "knee", "ankle", "midtarsal")


@pytest.mark.parametrize("parts", [LEGS, ("midtarsal",), ("eyeball", "index", "thumb"), FINGERS])
def test_a_figure_that_lacks_joints_takes_postures_as_far_as_it_can(skeleton, parts):
    lesser = without(skeleton, *parts)
    rest = Rest(PostureLibrary(lesser, ASSET))
    unit = PostureMotionUnit(rest, StanceType.SITTING, [pose("ARMS", "ARMS_CROSSED")])
    for phase in (0.0, 0.1, 0.5, 1.0):
        posed = unit.pose(Moment(phase, 0.0, rest.body))
        assert posed.rotations.keys() <= set(lesser.joints)
        layers = (Layer(LayerKind.BASE, rest.pose, root=rest.body.root), posed_layer(posed))
        compose(lesser, (*layers, *Footing(lesser).layers(layers)))


def posed_layer(posed: Posed) -> Layer:
    return Layer(LayerKind.POSTURE, posed.rotations, posed.weight, root=posed.root)


def test_a_figure_without_legs_stays_where_it_is(skeleton):
    bust = without(skeleton, *LEGS)
    assert body_in(bust, "SITTING").root == (0.0, 0.0, 0.0)


def test_legs_of_no_length_are_left_alone(skeleton):
    flat = Skeleton(
        skeleton.joints,
        skeleton.parents,
        tuple((0.0, 0.0, 0.0) if "knee" in j else skeleton.offset(j) for j in skeleton.joints),
    )
    body = body_in(flat, "SITTING")
    layers = (Layer(LayerKind.BASE, {}), Layer(LayerKind.POSTURE, body.pose, 0.5, root=body.root))
    assert Footing(flat).layers(layers) == ()


# --- feet


def walking(skeleton: Skeleton, way: float, share: float) -> Body:
    """A figure that has gone a share of a way straight ahead, m."""
    below, goal = Layer(LayerKind.BASE, {}), Layer(LayerKind.POSTURE, {}, share, root=(0.0, 0.0, way))
    return compose(skeleton, (below, goal, *Footing(skeleton).layers((below, goal)))).shown


def test_who_goes_far_sets_one_foot_before_the_other_and_keeps_the_pelvis_up_between_them(skeleton):
    bodies = [walking(skeleton, 3.0, i / 300) for i in range(301)]
    leads = [
        [body.place(ankle).position[2] - body.place("l_hip").position[2] for ankle in ("l_ankle", "r_ankle")]
        for body in bodies
    ]
    assert max(abs(lead) for pair in leads for lead in pair) < 0.4
    assert sum((a[0] > a[1]) != (b[0] > b[1]) for a, b in pairwise(leads)) >= 4, "one passes the other"
    assert min(body.root[1] for body in bodies) > -0.08
    assert height(bodies[-1], "l_ankle") == pytest.approx(height(bodies[0], "l_ankle"), abs=1e-6)


def test_a_foot_is_in_the_air_or_does_not_slide(skeleton):
    bodies = [walking(skeleton, 3.0, i / 300) for i in range(301)]
    for ankle in ("l_ankle", "r_ankle"):
        ground = height(bodies[0], ankle)
        for a, b in pairwise(bodies):
            if max(height(a, ankle), height(b, ankle)) < ground + 1e-3:
                assert distance(a.place(ankle).position, b.place(ankle).position) < 0.03


def test_for_feet_that_it_has_left_behind_the_pelvis_does_not_sink_far(skeleton):
    pushed = Layer(LayerKind.ADDITIVE, {}, root=(1.5, 0.0, 0.0))
    lowered, _ = Footing(skeleton).layers((Layer(LayerKind.BASE, {}), pushed))
    assert lowered.root == pytest.approx((0.0, -0.25, 0.0))


def test_a_file_that_takes_the_root_out_of_sight_is_no_posture(skeleton, own):
    (own / "postures" / "arms_up.xml").write_text(
        '<ProcAnimation prefDuration="1"><EndEffector target="HumanoidRoot" local="true" translation="0;0;1e300"/>'
        '<Rotation target="l_elbow" rotation="1;0;0"/></ProcAnimation>'
    )
    with pytest.raises(RealizerError, match="HumanoidRoot's place"):
        PostureLibrary(skeleton, Assets((own,))).body(posture(WHOLEBODY="ARMS_UP"))
