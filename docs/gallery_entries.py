"""The entries of the gallery: every lexeme that can be played, and every motion unit."""

from collections.abc import Iterable, Iterator
from itertools import product

from gallery_entry import Entry
from gallery_faces import face_strips

from reactive_realizer.bml.names import MURML, OWN
from reactive_realizer.engine.lexicon import LexiconEntry


def entries(lexicon: Iterable[LexiconEntry]) -> list[Entry]:
    """All strips, in order."""
    playing = [entry for entry in lexicon if entry.problem is None]
    own_modes = {entry.lexeme for entry in playing if entry.element == "gesture" and entry.constraints}
    found = [
        strip for entry in playing for strip in _strips(entry) if entry.constraints or entry.lexeme not in own_modes
    ]
    return [*found, *face_strips(), *_expressive(), *_UNITS]


def _expressive() -> Iterator[Entry]:
    """A gesture for each of the four numbers of expressivity, with -1, 0 and 1, at the same moments."""
    shown = (
        ("spatialExtent", "CONTAINER", "BOTH_HANDS", 2.0),
        ("temporalExtent", "OFFER", "RIGHT_HAND", 3.2),
        ("power", "CHOP", "RIGHT_HAND", 2.4),
        ("fluidity", "OFFER", "RIGHT_HAND", 2.8),
    )
    for (name, lexeme, mode, seconds), value in product(shown, (-1, 0, 1)):
        parameter = f'<bmlt:parameter name="{name}" value="{value}"/>'
        behavior = f'<gesture id="g" lexeme="{lexeme}" mode="{mode}">{parameter}</gesture>'
        yield Entry(f"expressivity-{name.lower()}-{value + 2}", behavior, seconds=seconds)


def _strips(entry: LexiconEntry) -> Iterator[Entry]:
    constraints = "".join(f' {name}="{value}"' for name, value in entry.constraints.items())
    name = "-".join([entry.element, entry.lexeme, *entry.constraints.values()]).lower().replace("_", "-")
    match entry.element:
        case "faceLexeme":
            yield Entry(name, f'<faceLexeme id="f" lexeme="{entry.lexeme}" amount="1"/>', face=True)
        case "head":
            yield Entry(name, f'<head id="h" lexeme="{entry.lexeme}" amount="1"/>')
        case "gesture":
            yield Entry(name, f'<gesture id="g" lexeme="{entry.lexeme}"{constraints}/>')
        case "pose":
            yield Entry(name, f'<posture id="p">{_pose(entry.lexeme)}</posture>', whole_body=True)
        case "procanimation":
            yield Entry(name, f'<bmlt:procanimation id="a" name="{entry.lexeme}"{constraints}/>')
        case _:
            pass  # elements without lexemes


def _pose(lexeme: str) -> str:
    part = {"ARMS": "ARMS", "LEGS": "LEGS"}.get(lexeme.partition("_")[0], "WHOLEBODY")
    return f'<stance type="STANDING"/><pose part="{part}" lexeme="{lexeme}"/>'


_CLIP = """
<SkeletonInterpolator xmlns="" rotationEncoding="axisangles" parts="skullbase r_elbow" encoding="R">
  0    0 1 0 0     1 0 0 -0.2
  0.7  0 1 0 0.7   1 0 0 -1.5
  1.4  0 1 0 -0.7  1 0 0 -0.6
  2    0 1 0 0     1 0 0 -0.2
</SkeletonInterpolator>
""".strip()

_MURML_POSE = """
<murml-description>
  <parallel>
    <static slot="HandLocation" scope="right_arm" value="LocShoulder LocCenterRight LocNorm"/>
    <static slot="ExtFingerOrientation" scope="right_arm" value="DirU"/>
    <static slot="PalmOrientation" scope="right_arm" value="DirA"/>
    <static slot="HandShape" scope="right_arm" value="BSflat"/>
  </parallel>
</murml-description>
""".strip()

_MURML_PLACE = _MURML_POSE.replace("LocShoulder LocCenterRight LocNorm", "-0.25 0.42 0.28")

_MURML_HANDS = """
<murml-description>
  <symmetrical dominant="right_arm" symmetry="SymMS">
    <parallel>
      <dynamic slot="HandLocation">
        <dynamicElement type="linear">
          <value type="start" name="LocLowerChest LocCenterRight LocNorm"/>
          <value type="end" name="LocStomach LocPeripheryRight LocFar"/>
        </dynamicElement>
      </dynamic>
      <static slot="ExtFingerOrientation" value="DirA"/>
      <static slot="PalmOrientation" value="PalmU"/>
      <static slot="HandShape" value="BSflat"/>
    </parallel>
  </symmetrical>
</murml-description>
""".strip()

_KEY_POSES = f"""
<rr:keyPoses xmlns:rr="{OWN}" id="arm" group="RIGHT_ARM" fadeOut="0.6" start="0">
  <rr:keyPose time="0.7" hold="0.6">
    <rr:position target="-0.25 0.42 0.28" joint="r_wrist"/>
    <rr:orientation direction="0 1 0" axis="FINGERS"/>
    <rr:orientation direction="0 0 1"/>
  </rr:keyPose>
</rr:keyPoses>
<rr:keyPoses xmlns:rr="{OWN}" id="hand" group="RIGHT_HAND" fadeOut="0.6" start="0">
  <rr:keyPose time="0.7" hold="0.6"><rr:pose name="hands_open-straight"/></rr:keyPose>
</rr:keyPoses>
""".strip()

_EMBRSCRIPT = """
BEGIN K_POSE_SEQUENCE
  FADE_OUT:600
  BEGIN K_POSE
    TIME_POINT:+700
    HOLD:600
    BEGIN POSITION_CONSTRAINT
      BODY_GROUP:rarm
      JOINT:rhand
      TARGET:-0.25;-0.28;0.42
    END
    BEGIN ORIENTATION_CONSTRAINT
      BODY_GROUP:rarm
      JOINT:rhand
      NORMAL:Yaxis
      DIRECTION:0;0;1
    END
    BEGIN ORIENTATION_CONSTRAINT
      BODY_GROUP:rarm
      JOINT:rhand
      NORMAL:Zaxis
      DIRECTION:0;1;0
    END
    BEGIN POSE_TARGET
      BODY_GROUP:rhand
      POSE_KEY:hands_open-straight
    END
  END
END
""".strip()

_BALANCE = """
<bmlt:controller id="b" class="BalanceController" start="0"/>
<bmlt:controller id="l" class="CompoundController" name="leftarmhang" start="0"/>
<bmlt:controller id="r" class="CompoundController" name="rightarmhang" start="0"/>
""".strip()

_UNITS = (
    *(
        Entry(
            f"gaze-{influence.lower()}",
            f'<gaze id="z" target="greensphere" influence="{influence}" start="0" end="3"/>',
        )
        for influence in ("EYES", "HEAD", "SHOULDER", "WAIST", "WHOLE")
    ),
    Entry("gaze-offset", '<gaze id="z" target="camera" offsetAngle="20" offsetDirection="UPLEFT" start="0" end="3"/>'),
    Entry(
        "gaze-while-nodding",
        '<gaze id="z" target="bluebox" start="0" end="3"/><head id="n" lexeme="NOD" repetition="3"/>',
    ),
    Entry("gazeshift", '<gazeShift id="z" target="greensphere"/>', seconds=2.0),
    Entry("headdirectionshift", '<headDirectionShift id="z" target="bluebox"/>', seconds=2.0),
    *(
        Entry(f"pointing-{mode.lower().replace('_', '-')}", f'<pointing id="p" target="{target}" mode="{mode}"/>', True)
        for mode, target in (("RIGHT_HAND", "bluebox"), ("LEFT_HAND", "greensphere"), ("BOTH_HANDS", "camera"))
    ),
    *(
        Entry(
            f"stance-{stance.lower()}", f'<posture id="p" start="0" end="5"><stance type="{stance}"/></posture>', True
        )
        for stance in ("SITTING", "CROUCHING", "LYING")
    ),
    Entry(
        "postureshift-and-beat",
        '<postureShift id="p"><pose part="ARMS" lexeme="ARMS_CROSSED"/></postureShift>'
        '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND" start="p:end+0.3"/>',
        whole_body=True,
    ),
    Entry("procanimationgesture", '<bmlt:procanimationgesture id="a" name="offer_both" stroke="1.5"/>'),
    Entry("keyframe", f'<bmlt:keyframe id="k">{_CLIP}</bmlt:keyframe>'),
    *(
        Entry(f"murmlgesture-{name}", f'<murmlgesture xmlns="{MURML}" id="g">{inside}</murmlgesture>')
        for name, inside in (("static", _MURML_POSE), ("symmetrical", _MURML_HANDS))
    ),
    Entry(
        "noise",
        '<bmlt:noise id="n" type="perlin" joint="vl5" end="4"><bmlt:parameter name="basefreqx" value="0.5"/>'
        '<bmlt:parameter name="baseamplitudex" value="0.2"/></bmlt:noise>',
    ),
    Entry(
        "transition",
        '<bmlt:transition id="t" class="HermiteTransition" start="0" end="1">'
        '<bmlt:parameter name="joints" value="r_shoulder r_elbow r_wrist l_shoulder l_elbow l_wrist"/>'
        '</bmlt:transition><bmlt:procanimation id="a" name="3-beat" start="t:end"/>',
    ),
    Entry(
        "controller",
        '<bmlt:controller id="b" class="BalanceController" start="0.5"/>'
        '<bmlt:controller id="l" class="CompoundController" name="leftarmhang" start="0.5"/>'
        '<bmlt:procanimation id="c" name="conduct-3-beat" mode="RIGHT_HAND" start="1" end="3"/>'
        '<gesture id="g" lexeme="OFFER" mode="LEFT_HAND" start="2"/>',
        whole_body=True,
        seconds=6.0,
    ),
    Entry("controller-pushed", _BALANCE, whole_body=True, seconds=3.0, push=(0.0, 0.0, 110.0)),
    Entry("controller-falling", _BALANCE, whole_body=True, seconds=3.0, push=(0.0, 0.0, -250.0)),
    Entry(
        "liveliness",
        f'<speech id="s" xmlns:rr="{OWN}" rr:liveliness="0.5">'
        "<text>Hello, I am very glad that you came. It is not the red house, but the blue one over there. "
        "Would you like to see it?</text></speech>",
        face=True,
    ),
    Entry("language-bml", _KEY_POSES),
    Entry("language-embrscript", "", script=_EMBRSCRIPT),
    Entry("language-murml", f'<murmlgesture xmlns="{MURML}" id="g">\n{_MURML_PLACE}\n</murmlgesture>'),
    Entry("locomotion", '<locomotion id="w" target="-0.8 -0.1"/>', whole_body=True),
    Entry("locomotion-run", '<locomotion id="w" target="-1.2 -1" manner="RUN"/>', whole_body=True),
    Entry("locomotion-strafe", '<locomotion id="w" target="0.6 0" manner="STRAFE"/>', whole_body=True),
    Entry("idle", "", whole_body=True, seconds=12.0),
)
