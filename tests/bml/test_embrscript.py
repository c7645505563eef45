"""EMBRScript: what its scripts mean in BML, and what is wrong with them."""

from dataclasses import replace

import pytest

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import FaceLexeme, Gesture
from reactive_realizer.bml.block import CAST, BehaviorBlock, Parsed
from reactive_realizer.bml.block_writer import document
from reactive_realizer.bml.dialects import BML_DIALECT, Dialects
from reactive_realizer.bml.embr.reader import DIALECT, read
from reactive_realizer.bml.extensions import FaceKeyframe, Keyframe
from reactive_realizer.bml.idle_change import IdleChange, IdleParameter
from reactive_realizer.bml.key_poses import KeyPoses, LookAtGoal, OrientationGoal, PoseGoal, PositionGoal, SwivelGoal
from reactive_realizer.bml.vocabulary import BodyAxis, BodyGroup, Composition, FacePart, WarpKind
from reactive_realizer.bml.weight_shift import WeightShift
from reactive_realizer.bml.writer import written
from reactive_realizer.limits import Limits


def script(*poses: str, sequence: str = "START:asap") -> str:
    inside = "\n".join(f"BEGIN K_POSE\n{pose}\nEND" for pose in poses)
    return f"BEGIN K_POSE_SEQUENCE\n{sequence}\n{inside}\nEND\n"


def parsed(text: str) -> Parsed:
    (found,) = read(text, Limits(), "document1")
    return found


def block(text: str) -> BehaviorBlock:
    found = parsed(text)
    assert found.problems == ()
    assert found.block is not None
    return found.block


def key_poses(text: str) -> KeyPoses:
    (behavior,) = block(text).behaviors
    assert isinstance(behavior, KeyPoses)
    return behavior


def problems(text: str) -> list[tuple[int | None, str]]:
    return [(each.fault.line, each.fault.sentence) for each in parsed(text).problems]


def start_of(behavior: Behavior) -> str:
    return str(behavior.syncs["start"])


def position(target: str = "-0.2;-0.3;0.1", group: str = "rarm", more: str = "") -> str:
    lines = [
        "BEGIN POSITION_CONSTRAINT",
        f"BODY_GROUP:{group}",
        f"TARGET:{target}",
        "JOINT:rhand",
        *filter(None, [more]),
        "END",
    ]
    return "\n".join(lines)


def looking(target: str = "0;-1;0.6") -> str:
    return f"BEGIN LOOK_AT_CONSTRAINT\nBODY_GROUP:headNeck\nTARGET:{target}\nEND"


@pytest.mark.parametrize(
    "text",
    ["BEGIN K_POSE_SEQUENCE\nEND", "# a\n\n  TIME_RESET\n", "#\nBEGIN NUCLEUS # b\nEND", "BEGIN\nK_POSE_SEQUENCE"],
)
def test_a_script_is_recognized_by_its_first_words(text: str) -> None:
    assert DIALECT.recognizes(text)


@pytest.mark.parametrize("text", ["", "<bml/>", "BEGIN K_POSE", "TIME_RESETS", "# TIME_RESET"])
def test_nothing_else_is_recognized(text: str) -> None:
    assert not DIALECT.recognizes(text)


def test_times_are_milliseconds_relative_to_the_sequence_or_to_the_script() -> None:
    relative = key_poses(script(f"TIME_POINT:+200\nHOLD:100\n{position()}", f"TIME_POINT:+800\n{position()}"))
    assert start_of(relative) == "0"
    assert [(pose.time, pose.hold) for pose in relative.poses] == [(0.2, 0.1), (0.8, 0.0)]
    absolute = key_poses(script(f"TIME_POINT:1719\nHOLD:320\n{position()}", sequence="START:1000"))
    assert start_of(absolute) == "1"
    assert [(pose.time, pose.hold) for pose in absolute.poses] == [(0.719, 0.32)]
    assert start_of(key_poses(script(f"TIME_POINT:+500\n{position()}", sequence="START:+300"))) == "0.3"


def test_a_target_is_from_the_pelvis_with_y_to_the_back_and_z_up() -> None:
    (pose,) = key_poses(script(f"TIME_POINT:+200\n{position(more='OFFSET:0.1;0.2;0.3')}")).poses
    (goal,) = pose.goals
    assert isinstance(goal, PositionGoal)
    assert goal.target == (-0.2, 0.1, 0.3)
    assert goal.offset == (0.1, 0.3, -0.2)
    assert goal.joint == "r_wrist"


@pytest.mark.parametrize(
    ("written", "axis", "direction"),
    [
        ("DIRECTION:0;-1;0", BodyAxis.PALM, (0, 0, 1)),
        ("NORMAL:Zaxis\nDIRECTION:0;0;-1", BodyAxis.PALM, (0, 1, 0)),
        ("NORMAL:YAxis\nDIRECTION:0;0;1", BodyAxis.FINGERS, (0, 1, 0)),
        ("NORMAL:Xaxis\nDIRECTION:1;0;0", BodyAxis.THUMB, (-1, 0, 0)),
        ("NORMAL:-1;-0.5;0", BodyAxis.PALM, (-1, 0, 0.5)),
    ],
)
def test_an_orientation_directs_an_axis_of_the_hand(
    written: str, axis: BodyAxis, direction: tuple[float, float, float]
) -> None:
    pose = f"TIME_POINT:+200\nBEGIN ORIENTATION_CONSTRAINT\nBODY_GROUP:rarm\nJOINT:rhand\n{written}\nEND"
    (goal,) = key_poses(script(pose)).poses[0].goals
    assert isinstance(goal, OrientationGoal)
    assert (goal.axis, goal.direction) == (axis, direction)


@pytest.mark.parametrize(
    ("written", "group", "axis", "direction", "joint"),
    [
        ("spine\nNORMAL:Zaxis", BodyGroup.TRUNK, BodyAxis.CHEST, (1, 3, -2), None),
        ("upperBodyNoArms\nJOINT:spine4", BodyGroup.TRUNK, BodyAxis.CHEST, (1, 3, -2), None),
        ("spine\nJOINT:spine1\nNORMAL:Yaxis", BodyGroup.TRUNK, BodyAxis.SPINE, (1, 3, -2), "vl5"),
        ("spine\nNORMAL:Xaxis", BodyGroup.TRUNK, BodyAxis.LEFT_SIDE, (1, 3, -2), None),
        ("shoulders\nNORMAL:Yaxis", BodyGroup.SHOULDERS, BodyAxis.SHOULDER, (1, 3, -2), None),
        ("shoulders\nJOINT:rclavicle", BodyGroup.SHOULDERS, BodyAxis.SHOULDER, (1, 3, -2), "r_sternoclavicular"),
        ("eyes", BodyGroup.EYES, BodyAxis.SIGHT, (1, 3, -2), None),
        ("leye\nJOINT:leye\nNORMAL:Yaxis", BodyGroup.LEFT_EYE, BodyAxis.SIGHT, (1, 3, -2), None),
        ("headNeck\nJOINT:head\nNORMAL:Yaxis", BodyGroup.HEAD_NECK, BodyAxis.CROWN, (1, 3, -2), None),
        ("rarm\nNORMAL:Xaxis", BodyGroup.RIGHT_ARM, BodyAxis.THUMB, (-1, -3, 2), None),
        ("rarm\nJOINT:rradius", BodyGroup.RIGHT_ARM, BodyAxis.PALM, (1, 3, -2), "r_elbow"),
    ],
)
def test_an_orientation_directs_an_axis_of_its_group(
    written: str, group: BodyGroup, axis: BodyAxis, direction: tuple[float, float, float], joint: str | None
) -> None:
    pose = f"TIME_POINT:+200\nBEGIN ORIENTATION_CONSTRAINT\nBODY_GROUP:{written}\nDIRECTION:1;2;3\nEND"
    found = key_poses(script(pose))
    (goal,) = found.poses[0].goals
    assert isinstance(goal, OrientationGoal)
    assert (found.group, goal.axis, goal.direction, goal.joint) == (group, axis, direction, joint)


def test_an_axis_that_a_group_does_not_have_is_named() -> None:
    pose = "TIME_POINT:+200\nBEGIN ORIENTATION_CONSTRAINT\nBODY_GROUP:eyes\nNORMAL:Zaxis\nDIRECTION:0;-1;0\nEND"
    assert problems(script(pose)) == [(7, "there is no NORMAL Zaxis; known are Yaxis; did you mean 'Yaxis'?")]


def test_eyes_look_at_places() -> None:
    look = "TIME_POINT:+200\nBEGIN LOOK_AT_CONSTRAINT\nBODY_GROUP:eyes\nTARGET:-1;-2;0.5\nEND"
    found = key_poses(script(look))
    (goal,) = found.poses[0].goals
    assert (found.group, type(goal)) == (BodyGroup.EYES, LookAtGoal)


def test_the_angle_of_a_swivel_may_be_its_target() -> None:
    swivel = "BEGIN SWIVEL_CONSTRAINT\nBODY_GROUP:rarm\nTARGET:40\nJOINT:rhumerus\nEND"
    (goal,) = key_poses(script(f"TIME_POINT:+200\n{swivel}")).poses[0].goals
    assert isinstance(goal, SwivelGoal)
    assert goal.angle == 40.0


def test_all_constraints_of_a_body_group_are_one_behavior() -> None:
    fist = "BEGIN POSE_TARGET\nBODY_GROUP:rhand\nPOSE_KEY:hands_fist\nINFLUENCE:0.5\nEND"
    swivel = "BEGIN SWIVEL_CONSTRAINT\nBODY_GROUP:rarm\nSWIVEL_ANGLE:30\nEND"
    arm, hand, head = block(script(f"TIME_POINT:+200\n{position()}\n{fist}\n{swivel}\n{looking()}")).behaviors
    assert isinstance(arm, KeyPoses)
    assert isinstance(hand, KeyPoses)
    assert isinstance(head, KeyPoses)
    assert [each.group for each in (arm, hand, head)] == [
        BodyGroup.RIGHT_ARM,
        BodyGroup.RIGHT_HAND,
        BodyGroup.HEAD_NECK,
    ]
    assert [type(goal) for goal in arm.poses[0].goals] == [PositionGoal, SwivelGoal]
    (goal,) = hand.poses[0].goals
    assert isinstance(goal, PoseGoal)
    assert (goal.pose, goal.influence) == ("hands_fist", 0.5)


def test_a_group_holds_its_pose_until_the_next_pose_of_the_sequence_that_moves_it() -> None:
    arm = key_poses(script(f"TIME_POINT:+200\nHOLD:100\n{position()}", f"TIME_POINT:+1000\n{position()}"))
    assert arm.poses[0].hold == pytest.approx(0.1)
    both = block(
        script(f"TIME_POINT:+200\n{position()}", f"TIME_POINT:+600\n{looking()}", f"TIME_POINT:+900\n{position()}")
    )
    assert isinstance(both.behaviors[0], KeyPoses)
    assert both.behaviors[0].poses[0].hold == pytest.approx(0.4)


def test_time_warps_apply_to_a_sequence_a_pose_or_a_constraint() -> None:
    warped = "TIME_WARP:EXP;5"
    arm = key_poses(
        script(
            f"TIME_POINT:+200\n{position()}",
            f"TIME_POINT:+400\n{position(more=warped)}",
            f"TIME_POINT:+600\nTIME_WARP:TAN;0.5\n{position()}",
            sequence="TIME_WARP:EXP;3\nFADE_IN:200\nFADE_OUT:300",
        )
    )
    assert (arm.warp, arm.steepness, arm.fade_in, arm.fade_out) == (WarpKind.EXP, 3.0, 0.2, 0.3)
    assert [(pose.warp, pose.steepness) for pose in arm.poses[1:]] == [(WarpKind.EXP, 5.0), (WarpKind.TAN, 0.5)]


def test_a_feedback_id_is_a_sync_point() -> None:
    arm = key_poses(script(f"TIME_POINT:+200\n{position(more='FEEDBACK_ID:there')}"))
    assert arm.poses[0].id == "there"


def test_weights_of_the_face_are_keyframes() -> None:
    blink = "BEGIN MORPH_TARGET\nMORPH_KEY:ModBlinkRight\nMORPH_VALUE:{}\nFEEDBACK_ID:{}\nEND"
    blush = "BEGIN SHADER\nSHADER_KEY:blushing\nSHADER_VALUE:1\nEND"
    poses = (
        f"TIME_POINT:+500\nHOLD:100\n{blink.format(1, 'shut')}\n{blush}",
        f"TIME_POINT:+900\n{blink.format(0, 'open')}",
    )
    lid, skin = block(script(*poses)).behaviors
    assert isinstance(lid, FaceKeyframe)
    assert lid.type is FacePart.FACS
    assert lid.interpolator is not None
    rows = [tuple(map(float, line.split())) for line in lid.interpolator.splitlines()[1:-1]]
    assert rows == [(0, 0), (0.5, 1), (0.6, 1), (0.9, 0)]
    assert 'id="shut" time="0.5"' in lid.interpolator
    assert isinstance(skin, FaceKeyframe)
    assert "skinBlush" in (skin.interpolator or "")


def test_a_weight_beyond_its_range_is_named_and_limited() -> None:
    def shaped(kind: str, key: str, value: float) -> str:
        return f"BEGIN {kind}_TARGET\n{kind}_KEY:{key}\n{kind}_VALUE:{value}\nEND".replace("SHADER_TARGET", "SHADER")

    poses = [f"TIME_POINT:+500\n{shaped('MORPH', 'ExpSmileClosed', 7)}\n{shaped('SHADER', 'blushing', -0.5)}"]
    texts = [text for _, text in problems(script(*poses))]
    assert texts == ["MORPH_VALUE is at most 1 here, not 7.00", "SHADER_VALUE is at least 0 here, not -0.50"]
    limited = parsed(script(*poses)).block
    assert limited is not None
    for face in limited.behaviors:
        assert isinstance(face, FaceKeyframe)
        weights = [float(word) for line in (face.interpolator or "").splitlines()[1:-1] for word in line.split()[1:]]
        assert all(0.0 <= weight <= 1.0 for weight in weights)


def test_a_clip_is_stretched_to_its_time_point_and_fades() -> None:
    clip = "BEGIN ANIMATION\nTIME_POINT:10000\nANIMATION_CLIP:idle\nBODY_GROUP:larm\nEND"
    (found,) = block(f"BEGIN K_POSE_SEQUENCE\nSTART:2000\nFADE_IN:2000\n{clip}\nEND").behaviors
    assert isinstance(found, Keyframe)
    assert found.animation == "idle"
    assert {sync: str(ref) for sync, ref in found.syncs.items()} == {"start": "2", "end": "10"}
    assert found.parameters == {"fadeIn": "0.25", "group": "LEFT_ARM", "replacementgroup": "LEFT_ARM"}


def test_a_time_reset_replaces_everything_and_each_character_has_a_block() -> None:
    one, two = (script(f"TIME_POINT:+200\n{position()}", sequence=f"CHARACTER:{name}") for name in ("Amber", "Alfonse"))
    found = read(f"{one}TIME_RESET\n{one}{two}", Limits(), "d")
    blocks = [each.block for each in found if each.block is not None]
    assert [each.id for each in blocks] == ["d", "d_2", "d_3"]
    assert [each.composition for each in blocks] == [Composition.MERGE, Composition.REPLACE, Composition.REPLACE]
    assert [each.extensions.get(CAST) for each in blocks] == ["Amber", "Amber", None]
    assert [each.character for each in blocks] == [None, None, "Alfonse"]
    assert [each.played_by(["alice", "Alfonse"]) for each in blocks] == ["alice", "alice", "Alfonse"]
    assert blocks[0].played_by(["alice", "Amber"]) == "Amber"


GOOD = script(f"TIME_POINT:+200\n{position()}")

BAD = [
    ("TIME_POINT:+0.2s\n" + position(), 4, "+0.2s: it must be a number"),
    (position(), 3, "K_POSE needs TIME_POINT"),
    ("TIME_POINT:+200\n" + position(target="1;2"), 7, "a vector is X;Y;Z"),
    ("TIME_POINT:+200\n" + position(group="rleg"), 6, "there is no BODY_GROUP rleg"),
    ("TIME_POINT:+200\n" + position().replace("rhand", "rhamd"), 8, "did you mean 'rhand'?"),
    ("TIME_POINT:+200\n" + position(more="TARGETS:1"), 9, "POSITION_CONSTRAINT has no TARGETS"),
    ("TIME_POINT:+200\nBEGIN POSITION\nEND", 5, "K_POSE has no POSITION"),
    ("TIME_POINT:+200\nBEGIN SHADER\nSHADER_KEY:glow\nSHADER_VALUE:1\nEND", 6, "there is no SHADER_KEY glow"),
    ("TIME_POINT:+200\nplease\n" + position(), 5, "'please' is not TIME_RESET"),
]


@pytest.mark.parametrize(("pose", "line", "problem"), BAD)
def test_what_is_wrong_is_named_by_line_and_the_rest_plays(pose: str, line: int, problem: str) -> None:
    text = script(pose, f"TIME_POINT:+900\n{looking()}")
    found = parsed(text)
    assert found.block is not None
    assert [group for each in found.block.behaviors if isinstance(each, KeyPoses) for group in [each.group]][-1] == (
        BodyGroup.HEAD_NECK
    )
    ((where, sentence),) = problems(text)
    assert where == line
    assert problem in sentence


def test_a_time_that_goes_back_comes_after_the_pose_before_it() -> None:
    text = script(f"TIME_POINT:+900\nHOLD:100\n{position()}", f"TIME_POINT:+500\n{position()}")
    ((line, sentence),) = problems(text)
    assert (line, "0.50 s, before the end of the pose before it at 1.00 s" in sentence) == (13, True)
    found = parsed(text).block
    assert found is not None
    (arm,) = found.behaviors
    assert isinstance(arm, KeyPoses)
    assert [pose.time for pose in arm.poses] == [0.9, 1.04]


def test_what_is_complete_of_a_truncated_script_plays() -> None:
    text = GOOD + script(f"TIME_POINT:+200\n{position()}").rpartition("JOINT")[0]
    assert len((parsed(text).block or block(GOOD)).behaviors) == 2
    assert [sentence.partition(";")[0] for _, sentence in problems(text)] == [
        f"the script ends inside this {name}" for name in ("K_POSE_SEQUENCE", "K_POSE", "POSITION_CONSTRAINT")
    ]


def test_what_is_not_realized_is_named_once() -> None:
    text = script(*(f"TIME_POINT:+{time}\nTIME_WARP:SIN;2\n{position()}" for time in (200, 900)))
    ((line, sentence),) = problems(text)
    assert (line, sentence.partition(" has")[0]) == (5, "TIME_WARP:SIN")


def autonomous(key: str, value: float, more: str = "") -> str:
    return f"BEGIN AUTONOMOUS_BEHAVIOR\nBEHAVIOR_KEY:{key}\nBEHAVIOR_VALUE:{value}\n{more}END"


def test_autonomous_behaviors_change_the_parameters_of_idle_animation() -> None:
    changes = {
        "breathingFrequency": (0.4, IdleParameter.BREATHING_RATE, 24.0),
        "breathingAmplitude": (0.3, IdleParameter.BREATHING_DEPTH, 3.0),
        "blinkProbability": (3000, IdleParameter.BLINK_RATE, 20.0),
        "blinkIntensity": (0.5, IdleParameter.BLINK_DEPTH, 0.5),
        "weightShiftFrequency": (0.2, IdleParameter.WEIGHT_SHIFT_RATE, 12.0),
        "weightShiftAmplitude": (1.5, IdleParameter.WEIGHT_SHIFT_DEPTH, 1.5),
    }
    inside = "\n".join(autonomous(key, value) for key, (value, _, _) in changes.items())
    found = block(script(f"TIME_POINT:+500\n{inside}", f"TIME_POINT:+900\n{inside}"))
    idle = [each for each in found.behaviors if isinstance(each, IdleChange)]
    expected = [(parameter, amount) for _, parameter, amount in changes.values()]
    assert [(each.parameter, each.value) for each in idle] == 2 * expected
    assert {sync: str(ref) for sync, ref in idle[-1].syncs.items()} == {"start": "0.5", "end": "0.9"}


def test_a_key_pose_triggers_a_blink_a_breath_and_a_shift_of_the_weight() -> None:
    inside = (autonomous("blinking", 0.8), autonomous("breathing", 1), autonomous("weightShift", -0.6))
    blink, breath, shift = block(script("TIME_POINT:+2000\n" + "\n".join(inside))).behaviors
    assert (type(blink), getattr(blink, "lexeme", ""), getattr(blink, "amount", 0)) == (FaceLexeme, "BLINK", 0.8)
    assert (type(breath), getattr(breath, "lexeme", ""), breath.parameters) == (Gesture, "BREATHE", {"amount": "1"})
    assert (type(shift), getattr(shift, "side", 0)) == (WeightShift, -0.6)
    points = [{sync: str(ref) for sync, ref in each.syncs.items()} for each in (blink, breath, shift)]
    assert points == [{"start": "2"}, {"stroke": "2"}, {"start": "0", "end": "2"}]


def test_what_a_body_does_not_do_by_itself_is_named_with_its_limit() -> None:
    inside = (
        autonomous("breathingAmplitude", 1.0),
        autonomous("weightShiftFrequency", 2),
        autonomous("blinkProbability", 100),
        autonomous("weightShift", 1.5),
        autonomous("sweating", 1),
        autonomous("sweating", 1),
    )
    text = script("TIME_POINT:+500\n" + "\n".join(inside))
    assert [(line, sentence.partition(";")[0].partition(": known")[0]) for line, sentence in problems(text)] == [
        (7, "breathingAmplitude is at most 0.5 here, not 1.00"),
        (11, "weightShiftFrequency is at most 0.5 here, not 2.00"),
        (15, "blinkProbability is at least 500 here, not 100.00"),
        (19, "BEHAVIOR_VALUE:1.5: it must be a number from -1 to 1"),
        (21, "AUTONOMOUS_BEHAVIOR sweating has no effect"),
    ]
    found = parsed(text).block
    assert found is not None
    assert [getattr(each, "value", None) for each in found.behaviors] == [5.0, 30.0, 120.0]


def test_what_an_autonomous_behavior_does_not_have_is_named() -> None:
    inside = autonomous("breathingAmplitude", 0.2, "TIME_WARP:EXP;2\nFEEDBACK_ID:deep\n")
    assert [sentence.partition(" has")[0] for _, sentence in problems(script(f"TIME_POINT:+500\n{inside}"))] == [
        "TIME_WARP of AUTONOMOUS_BEHAVIOR",
        "FEEDBACK_ID of AUTONOMOUS_BEHAVIOR",
    ]


def test_a_parameter_or_a_nucleus_that_is_given_twice_is_named_and_the_last_one_counts() -> None:
    nucleus = "BEGIN NUCLEUS\nNUCLEUS_ID:1\nPOWER:{}\nEND\n"
    pose = f"TIME_POINT:+500\nHOLD:100\nHOLD:300\n{position(more='TARGET:0;0;0')}"
    text = nucleus.format(0.5) + nucleus.format(0.2) + script(pose)
    assert problems(text) == [
        (6, "the NUCLEUS 1 is given twice; this one counts"),
        (14, "HOLD is given twice; this one counts"),
        (19, "TARGET is given twice; this one counts"),
    ]
    found = parsed(text).block
    assert found is not None
    (arm,) = found.behaviors
    assert isinstance(arm, KeyPoses)
    assert arm.poses[0].hold == 0.3


def test_a_stray_end_is_named() -> None:
    assert problems(GOOD + "END") == [(12, "this END closes nothing")]


def test_a_script_of_nothing_is_refused() -> None:
    assert [sentence for _, sentence in problems("# TIME_RESET")] == ["the script has no K_POSE_SEQUENCE"]
    assert parsed("# TIME_RESET").block is None


def test_a_time_reset_alone_ends_what_plays() -> None:
    alone = block("TIME_RESET\n")
    assert (alone.composition, alone.behaviors) == (Composition.REPLACE, ())
    first, last = read(GOOD + "TIME_RESET", Limits(), "d")
    assert first.block is not None
    assert first.block.behaviors
    assert last.block is not None
    assert (last.block.composition, last.block.behaviors) == (Composition.REPLACE, ())


def test_a_parameter_without_a_value_does_not_take_the_next_line_for_it() -> None:
    empty = block(script(f"TIME_POINT: +500\n{looking()}", sequence="CHARACTER:\nSTART:+700"))
    assert start_of(empty.behaviors[0]) == "0.7"
    assert CAST not in empty.extensions
    assert problems(script("TIME_POINT:\nHOLD:100"))[0] == (4, "K_POSE needs TIME_POINT")
    assert (1, "K_POSE_SEQUENCE needs START") in problems("BEGIN K_POSE_SEQUENCE START:")


def test_a_mark_of_the_encoding_does_not_hide_a_script() -> None:
    for text in (GOOD.encode("utf-8-sig"), "\ufeff" + GOOD):
        (found,) = Dialects({"embrscript": DIALECT}).read(text, Limits(), "d")
        assert found.block is not None
        assert found.problems == ()


def test_characters_that_xml_does_not_have_are_replaced() -> None:
    morph = "BEGIN MORPH_TARGET\nMORPH_KEY:jaw\x01\ud800\nMORPH_VALUE:1\nEND"
    text = script(f"TIME_POINT:500\n{morph}", sequence="CHARACTER:A\x00mber")
    found = parsed(text)
    assert found.block is not None
    assert 'id="document1"' in document([found.block])
    assert "jaw\ufffd\ufffd" in document([found.block])


def test_a_long_comment_takes_no_time_to_read() -> None:
    assert key_poses(GOOD + "#" * 900_000).poses


def test_of_ten_thousand_key_poses_the_first_ones_play_and_the_first_one_too_many_is_named() -> None:
    text = script(*(f"TIME_POINT:+{20 * number}\n{looking()}" for number in range(1, 10_001)))
    (found,) = read(text, Limits(bml_bytes=10_000_000), "d")
    assert found.block is not None
    (head,) = found.block.behaviors
    assert isinstance(head, KeyPoses)
    assert len(head.poses) == 1000
    line = text.splitlines().index("TIME_POINT:+20020")
    told = "this K_POSE and all after it are left out: at most 1000 goals are played (goals_per_behavior)"
    assert [(each.fault.line, each.fault.sentence) for each in found.problems] == [(line, told)]


def test_each_body_group_and_each_weight_has_the_limit_of_goals_for_itself() -> None:
    smile = "BEGIN MORPH_TARGET\nMORPH_KEY:ExpSmileClosed\nMORPH_VALUE:1\nEND"
    both = f"{position()}\nBEGIN SWIVEL_CONSTRAINT\nBODY_GROUP:rarm\nSWIVEL_ANGLE:3\nEND\n{looking()}\n{smile}"
    text = script(*(f"TIME_POINT:+{200 * number}\n{both}" for number in range(1, 6)))
    (found,) = read(text, Limits(goals_per_behavior=4), "d")
    assert found.block is not None
    arm, head, face = found.block.behaviors
    assert isinstance(arm, KeyPoses)
    assert isinstance(head, KeyPoses)
    assert isinstance(face, FaceKeyframe)
    assert [len(each.poses) for each in (arm, head)] == [2, 4]
    assert face.interpolator is not None
    assert [line.split()[0] for line in face.interpolator.strip().splitlines()[1:-1]] == [
        "0",
        "0.2",
        "0.4",
        "0.6",
        "0.8",
    ]
    assert len(found.problems) == 3


def test_key_poses_are_written_once_for_all_feedback() -> None:
    (head,) = block(script(f"TIME_POINT:+500\n{looking()}")).behaviors
    assert head.source == written(replace(head, source=""))


def test_a_script_over_the_limits_is_refused() -> None:
    (found,) = read(GOOD, Limits(bml_bytes=10), "d")
    assert "the limit is 10" in found.problems[0].fault.sentence
    (found,) = read(GOOD + GOOD, Limits(behaviors_per_block=1), "d")
    assert "2 behaviors; the limit is 1" in found.problems[0].fault.sentence


def test_a_file_is_read_by_its_media_type_or_its_content() -> None:
    dialects = Dialects({"embrscript": DIALECT, "bml": BML_DIALECT})
    for media_type in ("application/vnd.embr", ""):
        (found,) = dialects.read(GOOD.encode(), Limits(), "d", media_type)
        assert found.block is not None
        assert len(found.block.behaviors) == 1
