"""The entries of the gallery: every lexeme that can be played, and every motion unit."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import product

from reactive_realizer.assembly.assets import PACKAGE_ASSETS, Assets
from reactive_realizer.binding.mouth_shapes import SILENCE, VISEMES
from reactive_realizer.binding.viseme_binding import VisemeBinding
from reactive_realizer.bml.names import BML_EXT, MURML, OWN
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.engine.lexicon import LexiconEntry
from reactive_realizer.engines.face.expressions import Expressions


@dataclass(frozen=True, slots=True)
class Entry:
    """One strip.

    Attributes:
        name: of its file and of its block.
        behaviors: as BML.
        whole_body: whether the picture includes the feet.
        seconds: minimum duration, s, for motion that continues after the end of the block.
        push: force on the trunk for 0.2 s, N, one second after the start; None for no push.
        face: whether the picture shows the face only.
        mouth: whether the picture shows the mouth only.
        avatar: name of its file without the suffix.
        caption: is shown below the picture, if it is not empty.
    """

    name: str
    behaviors: str
    whole_body: bool = False
    seconds: float = 0.0
    push: tuple[float, float, float] | None = None
    face: bool = False
    mouth: bool = False
    avatar: str = "female"
    caption: str = ""

    @property
    def block(self) -> str:
        """The block that plays it."""
        namespaces = 'xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmlt="http://hmi.ewi.utwente.nl/bmlt"'
        return f'<bml {namespaces} id="{self.name}">{self.behaviors}</bml>'


def entries(lexicon: Iterable[LexiconEntry]) -> list[Entry]:
    """All strips, in order."""
    playing = [entry for entry in lexicon if entry.problem is None]
    own_modes = {entry.lexeme for entry in playing if entry.element == "gesture" and entry.constraints}
    found = [
        strip for entry in playing for strip in _strips(entry) if entry.constraints or entry.lexeme not in own_modes
    ]
    return [*found, *_action_units(), *_FACES, *_visemes(), *_expressive(), *_UNITS]


def _action_units() -> Iterator[Entry]:
    face = PACKAGE_ASSETS / "face"
    for number, unit in Expressions.read(face / "lexemes.json", face / "action_units.json").units.items():
        behavior = f'<faceFacs xmlns="{BML_EXT}" id="f" au="{number}" amount="1"/>'
        yield Entry(f"facefacs-{number:02}", behavior, face=True, caption=unit.name)


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


def _visemes() -> Iterator[Entry]:
    """Seven visemes in each strip, one in each of its pictures."""
    names = [viseme for viseme in VISEMES if viseme != SILENCE]
    for avatar, first in product(("female", "male"), (0, 7)):
        shown = names[first : first + 7]
        behavior = f'<bmlt:facekeyframe id="k">{_held(avatar, shown)}</bmlt:facekeyframe>'
        name = f"visemes-{avatar}-{'-'.join(shown[:: len(shown) - 1])}".lower()
        yield Entry(name, behavior, mouth=True, avatar=avatar, caption=f"the visemes {', '.join(shown)}")


def _held(avatar: str, visemes: Sequence[str]) -> str:
    """Keyframes in which each viseme is held in its second."""
    assets = Assets()
    binding = VisemeBinding.read((), Avatar.read(assets(f"avatars/{avatar}.glb")).morphs, assets)
    morphs = sorted({morph for viseme in visemes for morph in binding.shapes[viseme].morphs})
    rows = [
        " ".join(f"{value:g}" for value in (time, *(binding.shapes[viseme].morphs.get(each, 0) for each in morphs)))
        for second, viseme in enumerate(visemes)
        for time in (second + 0.2, second + 0.8)
    ]
    zeros = " 0" * len(morphs)
    content = "\n".join([f"0{zeros}", *rows, f"{len(visemes)}{zeros}"])
    return f'<FaceInterpolator xmlns="" parts="{" ".join(morphs)}">\n{content}\n</FaceInterpolator>'


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


_SIGH = """
<FaceInterpolator xmlns="" parts="1 26 43">
  0    0    0    0
  0.8  0.6  0.7  0.3
  1.4  0.8  0.2  0.9
  2.2  0    0    0
</FaceInterpolator>
""".strip()

_FACES = (
    Entry("facekeyframe", f'<bmlt:facekeyframe id="k" type="FACS">{_SIGH}</bmlt:facekeyframe>', face=True),
    Entry("facefap-jaw", '<bmlt:facefap id="f" fap="open_jaw" value="900"/>', face=True),
    Entry("facefap-corners", '<bmlt:facefap id="f" fap="raise_l_cornerlip raise_r_cornerlip" value="450"/>', face=True),
    Entry("facefap-brow", '<bmlt:facefap id="f" fap="raise_l_m_eyebrow raise_l_o_eyebrow" value="130"/>', face=True),
    Entry("facefap-eyes", '<bmlt:facefap id="f" fap="yaw_l_eyeball yaw_r_eyeball" value="25000"/>', face=True),
    Entry("facefap-head", '<bmlt:facefap id="f" fap="head_yaw head_roll" value="20000"/>', face=True),
    *(
        Entry(
            f"faceplutchik-{name}",
            f'<bmlt:faceplutchik id="f" angle="{angle}" activation="{activation}"/>',
            face=True,
        )
        for name, angle, activation in (
            ("serenity", 315, 3.0),
            ("ecstasy", 315, 7.0),
            ("love", 337.5, 5.0),
            ("awe", 67.5, 6.0),
            ("remorse", 157.5, 5.0),
            ("contempt", 202.5, 5.0),
        )
    ),
)

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
    Entry("locomotion", '<locomotion id="w" target="-0.9 0.6"/>', whole_body=True),
    Entry("locomotion-run", '<locomotion id="w" target="-1.2 -1" manner="RUN"/>', whole_body=True),
    Entry("locomotion-strafe", '<locomotion id="w" target="0.6 0" manner="STRAFE"/>', whole_body=True),
    Entry("idle", "", whole_body=True, seconds=12.0),
)
