"""Every element of BML 1.0 and of continuous interaction with every attribute."""

from collections.abc import Callable

import pytest

from reactive_realizer.bml.behavior import Behavior, ForeignBehavior
from reactive_realizer.bml.behaviors import (
    Face,
    FaceFacs,
    FaceLexeme,
    FaceShift,
    Gaze,
    GazeShift,
    Gesture,
    Head,
    HeadDirectionShift,
    Locomotion,
    Pointing,
    Pose,
    Posture,
    PostureShift,
    Wait,
)
from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.bml.elements import ELEMENTS
from reactive_realizer.bml.extensions import (
    Activate,
    AudioFile,
    Controller,
    Emit,
    FaceFap,
    FaceKeyframe,
    FaceMorph,
    FacePlutchik,
    Interrupt,
    Keyframe,
    Noise,
    ParameterValueChange,
    ProcAnimation,
    ProcAnimationGesture,
    Trajectory,
    Transition,
)
from reactive_realizer.bml.glance import Glance
from reactive_realizer.bml.idle_change import IdleChange, IdleParameter
from reactive_realizer.bml.key_poses import KeyPoses
from reactive_realizer.bml.murml.behaviors import MurmlFace, MurmlGesture
from reactive_realizer.bml.names import BML, BML_EXT, BMLA, BMLT, MURML, OWN, Location
from reactive_realizer.bml.release import Release
from reactive_realizer.bml.speech import Mark, Speech
from reactive_realizer.bml.vocabulary import (
    BodyGroup,
    Influence,
    InterruptSpeech,
    Mode,
    OffsetDirection,
    PosePart,
    Side,
    StanceType,
    WarpKind,
)
from reactive_realizer.bml.weight_shift import WeightShift

Block = Callable[[str], BehaviorBlock]

STROKE = ("start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end")
HOLD = ("start", "ready", "relax", "end")
FACE = ("start", "attackPeak", "relax", "end")
SHIFT = ("start", "end")
PARTS = '<faceLexeme lexeme="OPEN_MOUTH" amount="1"/><ext:faceFacs au="12" side="LEFT"/>'
STANCE = '<stance type="SITTING"/><pose part="ARMS" lexeme="ARMS_OPEN"/><pose part="LEGS" lexeme="LEGS_CROSSED"/>'
CHANGE = '<bmla:trajectory type="linear" initialValue="-0.5" targetValue="90"/>'
PREFIXES = {BML: "", BML_EXT: "ext:", BMLA: "bmla:", BMLT: "bmlt:", OWN: "rr:", MURML: "murml:"}

FRAMES = (
    f'<murml-description xmlns="{MURML}"><dynamic><keyframing><phase><frame ftime="1"><posture>Humanoid (vc4 3 1 2 3)'
    "</posture></frame></phase></keyframing></dynamic></murml-description>"
)
POSE = '<keyPose time="1"><lookAt target="0 0 1"/></keyPose>'

WRITTEN: dict[str, tuple[type[Behavior], dict[str, object], tuple[str, ...]]] = {
    '<speech id="x"><text>Hi</text></speech>': (Speech, {"text": "Hi", "marks": ()}, SHIFT),
    '<gesture id="x" lexeme="BEAT"/>': (Gesture, {"lexeme": "BEAT", "mode": None}, STROKE),
    '<gesture id="x" lexeme="WAVE" mode="LEFT_HAND"/>': (Gesture, {"lexeme": "WAVE", "mode": Mode.LEFT_HAND}, STROKE),
    '<pointing id="x" target="box"/>': (Pointing, {"target": "box", "mode": None}, STROKE),
    '<pointing id="x" target="box" mode="BOTH_HANDS"/>': (Pointing, {"mode": Mode.BOTH_HANDS}, STROKE),
    '<head id="x" lexeme="NOD"/>': (Head, {"lexeme": "NOD", "repetition": 1, "amount": 0.5}, STROKE),
    '<head id="x" lexeme="SHAKE" repetition="2" amount="0.8"/>': (
        Head,
        {"lexeme": "SHAKE", "repetition": 2, "amount": 0.8},
        ("start", "ready", "strokeStart", "stroke:1", "stroke:2", "strokeEnd", "relax", "end"),
    ),
    '<headDirectionShift id="x" target="box"/>': (HeadDirectionShift, {"target": "box"}, SHIFT),
    '<gaze id="x" target="box"/>': (
        Gaze,
        {"target": "box", "influence": None, "offset_angle": 0.0, "offset_direction": OffsetDirection.RIGHT},
        HOLD,
    ),
    '<gaze id="x" target="box" influence="SHOULDER" offsetAngle="-12.5" offsetDirection="UPLEFT"/>': (
        Gaze,
        {"influence": Influence.SHOULDER, "offset_angle": -12.5, "offset_direction": OffsetDirection.UPLEFT},
        HOLD,
    ),
    '<gazeShift id="x" target="box" influence="EYES" offsetAngle="5" offsetDirection="DOWN"/>': (
        GazeShift,
        {
            "target": "box",
            "influence": Influence.EYES,
            "offset_angle": 5.0,
            "offset_direction": OffsetDirection.DOWN,
        },
        SHIFT,
    ),
    f'<face id="x">{PARTS}</face>': (Face, {"amount": 0.5, "overshoot": 0.0}, FACE),
    f'<face id="x" amount="0.9" overshoot="0.1">{PARTS}</face>': (Face, {"amount": 0.9, "overshoot": 0.1}, FACE),
    f'<faceShift id="x" amount="0.9" overshoot="0.1">{PARTS}</faceShift>': (
        FaceShift,
        {"amount": 0.9, "overshoot": 0.1},
        SHIFT,
    ),
    '<faceLexeme id="x" lexeme="RAISE_BROWS"/>': (
        FaceLexeme,
        {"lexeme": "RAISE_BROWS", "amount": 0.5, "overshoot": 0.0},
        FACE,
    ),
    '<faceLexeme id="x" lexeme="OPEN_LIPS" amount="1" overshoot="0.2"/>': (
        FaceLexeme,
        {"amount": 1.0, "overshoot": 0.2},
        FACE,
    ),
    '<ext:faceFacs id="x" au="1"/>': (FaceFacs, {"au": 1, "side": Side.BOTH, "amount": 0.5}, FACE),
    '<ext:faceFacs id="x" au="12" side="LEFT" amount="0"/>': (
        FaceFacs,
        {"au": 12, "side": Side.LEFT, "amount": 0.0},
        FACE,
    ),
    f'<posture id="x">{STANCE}</posture>': (
        Posture,
        {
            "stance": StanceType.SITTING,
            "poses": (
                Pose(part=PosePart.ARMS, lexeme="ARMS_OPEN"),
                Pose(part=PosePart.LEGS, lexeme="LEGS_CROSSED"),
            ),
        },
        HOLD,
    ),
    '<postureShift id="x"><pose part="HEAD" lexeme="LEANING_FORWARD"/></postureShift>': (
        PostureShift,
        {"stance": None, "poses": (Pose(part=PosePart.HEAD, lexeme="LEANING_FORWARD"),)},
        SHIFT,
    ),
    '<locomotion id="x" target="door"/>': (Locomotion, {"target": "door", "manner": "WALK"}, SHIFT),
    '<locomotion id="x" target="door" manner="RUN"/>': (Locomotion, {"manner": "RUN"}, SHIFT),
    '<wait id="x"/>': (Wait, {"duration": None, "max_wait": None}, SHIFT),
    '<wait id="x" event="go" max-wait="3"/>': (Wait, {"event": "go", "max_wait": 3.0}, SHIFT),
    '<wait id="x" duration="1.5" max-wait="3"/>': (Wait, {"duration": 1.5, "max_wait": 3.0}, SHIFT),
    '<bmla:activate id="x" target="b1"/>': (Activate, {"target": "b1"}, SHIFT),
    '<bmla:interrupt id="x" target="b1"/>': (
        Interrupt,
        {"target": "b1", "include": (), "exclude": (), "speech": InterruptSpeech.NOW},
        SHIFT,
    ),
    '<bmla:interrupt id="x" target="b1" include="a, b" exclude="c" speech="WORD"/>': (
        Interrupt,
        {"include": ("a", "b"), "exclude": ("c",), "speech": InterruptSpeech.WORD},
        SHIFT,
    ),
    f'<bmla:parametervaluechange id="x" target="b1:s" paramId="volume">{CHANGE}</bmla:parametervaluechange>': (
        ParameterValueChange,
        {
            "target": "b1:s",
            "target_block": "b1",
            "target_behavior": "s",
            "parameter": "volume",
            "trajectory": Trajectory(type="linear", target_value=90.0, initial_value=-0.5),
        },
        ("start", "stroke", "end"),
    ),
    '<bmla:emit id="x" event=" go-on "/>': (Emit, {"event": "go-on", "content": ""}, SHIFT),
    '<bmla:emit id="x" event="go">a &lt; b<!-- no --> c</bmla:emit>': (Emit, {"content": "a &lt; b c"}, SHIFT),
    '<bmlt:procanimation id="x"/>': (ProcAnimation, {"animation": None, "file_name": None, "mode": None}, SHIFT),
    '<bmlt:procanimation id="x" name="row" fileName="sports/row.xml" mode="BOTH_HANDS"/>': (
        ProcAnimation,
        {"animation": "row", "file_name": "sports/row.xml", "mode": Mode.BOTH_HANDS},
        SHIFT,
    ),
    '<bmlt:procanimationgesture id="x" fileName="sports/row.xml"/>': (
        ProcAnimationGesture,
        {"animation": None, "file_name": "sports/row.xml"},
        STROKE,
    ),
    '<bmlt:keyframe id="x" name="walk"/>': (Keyframe, {"animation": "walk", "interpolator": None}, SHIFT),
    '<bmlt:noise id="x" type="perlin" joint="vl5"/>': (Noise, {"type": "perlin", "joint": "vl5"}, SHIFT),
    '<bmlt:facefap id="x" fap="12 raise_r_cornerlip" value="-200"/>': (
        FaceFap,
        {"fap": "12 raise_r_cornerlip", "value": -200.0},
        FACE,
    ),
    '<bmlt:facefap id="x" fap="viseme" viseme_select1="1" viseme_select2="14" viseme_blend="21"/>': (
        FaceFap,
        {"value": None, "viseme_select1": 1, "viseme_select2": 14, "viseme_blend": 21},
        FACE,
    ),
    '<bmlt:facefap id="x" fap="2" expression_select1="6" expression_intensity1="9" expression_select2="1" '
    'expression_intensity2="0"/>': (
        FaceFap,
        {
            "expression_select1": 6,
            "expression_intensity1": 9,
            "expression_select2": 1,
            "expression_intensity2": 0,
        },
        FACE,
    ),
    '<bmlt:facekeyframe id="x" name="laugh" type="FAPS"/>': (
        FaceKeyframe,
        {"animation": "laugh", "type": "FAPS", "interpolator": None},
        SHIFT,
    ),
    '<bmlt:faceplutchik id="x" angle="315" activation="5.4" intensity="0.7"/>': (
        FacePlutchik,
        {"angle": 315.0, "activation": 5.4, "intensity": 0.7},
        FACE,
    ),
    '<bmlt:facemorph id="x" targetname="grin" intensity="0.4"/>': (
        FaceMorph,
        {"targetname": "grin", "intensity": 0.4},
        FACE,
    ),
    '<bmlt:audiofile id="x" filename="sounds/clap.wav"/>': (AudioFile, {"file_name": "sounds/clap.wav"}, SHIFT),
    '<bmlt:audiofile id="x" fileName="clap.wav" filename="bell.wav"/>': (AudioFile, {"file_name": "bell.wav"}, SHIFT),
    '<bmlt:transition id="x" class="SlerpTransition"/>': (Transition, {"kind": "SlerpTransition"}, SHIFT),
    '<bmlt:controller id="x" class="BalanceController"/>': (
        Controller,
        {"kind": "BalanceController", "controller": None, "persistent": True},
        SHIFT,
    ),
    '<bmlt:controller id="x" class="CompoundController" name="limp" end="3"/>': (
        Controller,
        {"kind": "CompoundController", "controller": "limp", "persistent": False},
        SHIFT,
    ),
    f'<rr:keyPoses id="x" group="HEAD" fadeIn="0.2" fadeOut="0.3" warp="EXP" steepness="3">{POSE}</rr:keyPoses>': (
        KeyPoses,
        {"group": BodyGroup.HEAD, "fade_in": 0.2, "fade_out": 0.3, "warp": WarpKind.EXP, "steepness": 3.0},
        ("start", "relax", "end"),
    ),
    '<rr:glance id="x" left="5" up="-2.5"/>': (Glance, {"left": 5.0, "up": -2.5}, SHIFT),
    '<rr:release id="x" mode="BOTH_HANDS"/>': (Release, {"mode": Mode.BOTH_HANDS}, SHIFT),
    '<rr:idleChange id="x" parameter="BLINK_RATE" value="9"/>': (
        IdleChange,
        {"parameter": IdleParameter.BLINK_RATE, "value": 9.0},
        SHIFT,
    ),
    '<rr:weightShift id="x" side="-0.5"/>': (WeightShift, {"side": -0.5}, SHIFT),
    f'<murml:murmlgesture id="x">{FRAMES}</murml:murmlgesture>': (MurmlGesture, {}, STROKE),
    f'<murml:murmlface id="x">{FRAMES}</murml:murmlface>': (MurmlFace, {}, FACE),
}


def test_an_element_becomes_its_behavior(block: Block, subtests: pytest.Subtests) -> None:
    for xml, (kind, values, sync_points) in WRITTEN.items():
        with subtests.test(xml):
            (behavior,) = block(xml).behaviors
            assert type(behavior) is kind
            assert {name: getattr(behavior, name) for name in values} == values
            assert behavior.sync_points == sync_points
            assert (behavior.id, behavior.required, behavior.order) == ("x", False, 0)
            assert behavior.namespace == kind.NAMESPACE
            assert xml.startswith(f"<{PREFIXES[kind.NAMESPACE]}{behavior.name} ")


def test_these_tests_cover_every_element_and_attribute_of_the_table() -> None:
    assert {kind for kind, _, _ in WRITTEN.values()} == {element.behavior for element in ELEMENTS.values()}
    written = " ".join(WRITTEN)
    for element in ELEMENTS.values():
        for attribute in element.attributes:
            assert f" {attribute.name}=" in written, f"{attribute.name} of <{element.name}>"


def test_the_table_has_names_types_defaults_and_sync_points() -> None:
    gaze = ELEMENTS["gaze"]
    assert (gaze.name, gaze.namespace, gaze.behavior, gaze.sync_points) == ("gaze", BML, Gaze, HOLD)
    assert [(each.name, each.field, each.required, each.default) for each in gaze.attributes] == [
        ("id", "id", True, None),
        ("target", "target", True, None),
        ("influence", "influence", False, None),
        ("offsetAngle", "offset_angle", False, 0.0),
        ("offsetDirection", "offset_direction", False, OffsetDirection.RIGHT),
    ]
    assert gaze.attributes[2].type.description == "EYES, HEAD, SHOULDER, WAIST, WHOLE"
    assert gaze.attributes[3].type.description == "number, -360 to 360"
    assert ELEMENTS["posture"].children == ("stance", "pose")


def test_every_default_sync_point_is_an_attribute_with_a_reference(block: Block, subtests: pytest.Subtests) -> None:
    for element in ELEMENTS.values():
        with subtests.test(element.name):
            needed = {
                "text": "<text>Hi</text>",
                "faceLexeme": PARTS,
                "stance": STANCE,
                "trajectory": CHANGE,
                "keyPose": POSE,
                "murml-description": FRAMES,
            }
            inside = "".join(needed.get(child, "") for child in element.children)
            prefix = PREFIXES[element.namespace]
            values = {"event": "go", "lexeme": "NOD", "target": "box", "au": "1", "paramId": "volume"}
            values |= {
                "type": "perlin",
                "joint": "vl5",
                "class": "SlerpTransition",
                "left": "5",
                "up": "1",
                "side": "1",
            }
            values["mode"] = "LEFT_HAND"
            values |= {"filename": "clap.wav", "group": "HEAD", "parameter": "BLINK_RATE"}
            values |= {
                "targetname": "grin",
                "intensity": "0.5",
                "fap": "3",
                "value": "1",
                "angle": "0",
                "activation": "1",
            }
            attributes = "".join(
                f' {each.name}="{values[each.name]}"' for each in element.attributes[1:] if each.required
            )
            ties = "".join(f' {point}="other:h:start+{number}"' for number, point in enumerate(element.sync_points))
            xml = f'<{prefix}{element.name} id="x"{attributes}{ties}>{inside}</{prefix}{element.name}>'
            (behavior,) = block(xml).behaviors
            assert {point: str(ref) for point, ref in behavior.syncs.items()} == {
                point: "other:h:start" + (f"+{number}" if number else "")
                for number, point in enumerate(element.sync_points)
            }


def test_constrained_sync_points_are_in_the_order_of_writing(block: Block) -> None:
    (gesture,) = block('<gesture relax="3" id="g" start="1" lexeme="BEAT" stroke="2"/>').behaviors
    assert list(gesture.syncs) == ["relax", "start", "stroke"]


SPELLINGS = ["LEFT_HAND", "left_hand", "Left-Hand", "lefthand", " LEFT_HAND "]


def test_words_of_closed_vocabularies_may_be_in_any_case_and_with_any_hyphen(
    block: Block, subtests: pytest.Subtests
) -> None:
    for word in SPELLINGS:
        with subtests.test(word):
            (gesture,) = block(f'<gesture id="g" lexeme="BEAT" mode="{word}"/>').behaviors
            assert isinstance(gesture, Gesture)
            assert gesture.mode is Mode.LEFT_HAND


def test_words_of_open_vocabularies_are_not_changed(block: Block) -> None:
    (head,) = block('<head id="h" lexeme="tilt-Left"/>').behaviors
    assert isinstance(head, Head)
    assert head.lexeme == "tilt-Left"


def test_influence_takes_the_words_of_other_realizers(block: Block, subtests: pytest.Subtests) -> None:
    for word, influence in [("NECK", Influence.HEAD), ("torso", Influence.WAIST)]:
        with subtests.test(word):
            (gaze,) = block(f'<gaze id="g" target="box" influence="{word}"/>').behaviors
            assert isinstance(gaze, Gaze)
            assert gaze.influence is influence


TEXTS: dict[str, tuple[str, dict[str, int]]] = {
    "Hello  world": ("Hello world", {}),
    "\n  Hello\n\tworld  ": ("Hello world", {}),
    "": ("", {}),
    '<sync id="a"/>Hello': ("Hello", {"a": 0}),
    ' <sync id="a"/> Hello': ("Hello", {"a": 0}),
    'Hello <sync id="a"/>world': ("Hello world", {"a": 6}),
    'Hello <sync id="a"/> world': ("Hello world", {"a": 6}),
    'Hello<sync id="a"/> world': ("Hello world", {"a": 5}),
    'Hello world<sync id="a"/>': ("Hello world", {"a": 11}),
    'Hello world <sync id="a"/> ': ("Hello world", {"a": 11}),
    'One<sync id="a"/><sync id="b"/>two': ("Onetwo", {"a": 3, "b": 3}),
    "R&amp;D &lt;3 <![CDATA[<b>]]> <!-- not said -->é": ("R&D <3 <b> é", {}),
}


def test_a_text_has_single_spaces_and_its_marks_have_the_indices_of_characters(
    block: Block, subtests: pytest.Subtests
) -> None:
    for inside, (text, marks) in TEXTS.items():
        with subtests.test(inside):
            (speech,) = block(f'<speech id="s"><text>{inside}</text></speech>').behaviors
            assert isinstance(speech, Speech)
            assert speech.text == text
            assert speech.marks == tuple(Mark(id=name, char_index=index) for name, index in marks.items())
            assert speech.sync_points == ("start", *marks, "end")


def test_the_parts_of_a_face_need_no_ids(block: Block) -> None:
    (face,) = block(f'<face id="f">{PARTS}</face>').behaviors
    assert isinstance(face, Face)
    smile, wink = face.parts
    assert isinstance(smile, FaceLexeme)
    assert isinstance(wink, FaceFacs)
    assert (smile.lexeme, smile.amount, wink.au, wink.side) == ("OPEN_MOUTH", 1.0, 12, Side.LEFT)


def test_descriptions_have_priority_type_and_content(block: Block) -> None:
    (speech,) = block(
        '<speech id="s"><text>Hi</text>'
        '<description priority="2" type="application/ssml+xml">'
        '<speak xmlns="http://www.w3.org/2001/10/synthesis">Hi &amp; <b/>bye</speak></description>'
        '<description priority="1" type="audiofile"/></speech>'
    ).behaviors
    first, second = speech.descriptions
    assert (first.priority, first.type) == (2, "application/ssml+xml")
    assert first.content.startswith("<speak")
    assert first.content.endswith("Hi &amp; <b/>bye</speak>")
    assert (second.priority, second.type, second.content) == (1, "audiofile", "")


def test_a_behavior_has_its_location_its_source_and_the_attributes_of_other_namespaces(block: Block) -> None:
    one, two = block('\n  <wait id="w"/>\n <head id="h" lexeme="NOD" bmla:mood="calm"/> ').behaviors
    assert (one.order, one.location, two.order, two.location) == (0, Location(2, 3), 1, Location(3, 2))
    assert two.extensions == {(BMLA, "mood"): "calm"}
    assert two.source.startswith("<head xmlns=")
    assert two.source.endswith('id="h" lexeme="NOD" bmla:mood="calm"/>')


def test_a_keyframe_animation_has_the_interpolator_inside_it(block: Block) -> None:
    keys = '<SkeletonInterpolator xmlns="" parts="skullbase">0 1 0 0 0</SkeletonInterpolator>'
    (keyframe,) = block(f'<bmlt:keyframe id="k">{keys}</bmlt:keyframe>').behaviors
    assert isinstance(keyframe, Keyframe)
    assert keyframe.interpolator is not None
    assert keyframe.interpolator.endswith(">0 1 0 0 0</SkeletonInterpolator>")


WITH_PARAMETERS = [
    '<head id="x" lexeme="NOD">{}</head>',
    '<speech id="x"><text>Hi</text>{}</speech>',
    '<bmlt:noise id="x" type="perlin" joint="vl5">{}</bmlt:noise>',
]


def test_any_behavior_may_have_parameters_for_its_engine(block: Block, subtests: pytest.Subtests) -> None:
    for xml in WITH_PARAMETERS:
        with subtests.test(xml):
            parameters = '<bmlt:parameter name="a" value="0.5"/><bmlt:parameter name="joints" value="vl5 vt6"/>'
            assert block(xml.format(parameters)).behaviors[0].parameters == {"a": "0.5", "joints": "vl5 vt6"}
            assert block(xml.format("")).behaviors[0].parameters == {}


def test_elements_of_bmlt_are_not_elements_of_bmla(block: Block) -> None:
    assert isinstance(block('<bmla:noise id="n" type="perlin" joint="vl5"/>').behaviors[0], ForeignBehavior)


def test_a_behavior_of_another_namespace_is_kept_as_a_foreign_behavior(block: Block) -> None:
    (motor,) = block(
        '<bmlt:motor id="n" joint="vl5" start="s1:start" end="4" bmla:x="1"><bmlt:parameter/>text</bmlt:motor>'
    ).behaviors
    assert isinstance(motor, ForeignBehavior)
    assert (motor.namespace, motor.name, motor.id) == (BMLT, "motor", "n")
    assert motor.attributes == {"joint": "vl5"}
    assert {name: str(ref) for name, ref in motor.syncs.items()} == {"start": "s1:start", "end": "4"}
    assert motor.sync_points == ("start", "end")
    assert motor.extensions == {(BMLA, "x"): "1"}
    assert motor.children.startswith("<bmlt:parameter")
    assert motor.children.endswith("/>text")
