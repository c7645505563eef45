"""Writes docs/support.md from the parser's tables, the engines of the default scene, and its bindings."""

import asyncio
from collections.abc import Iterable, Mapping
from pathlib import Path

from reactive_realizer.assembly.scene import Scene, SceneOptions, open_scene
from reactive_realizer.bml.attribute_types import Enumeration, Float, Integer
from reactive_realizer.bml.attributes import Attribute, attributes_of
from reactive_realizer.bml.behavior import Behavior, Description
from reactive_realizer.bml.behaviors import Pose, Stance
from reactive_realizer.bml.block import BehaviorBlock, DefineProc, UseProc
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.elements import ELEMENTS, Element
from reactive_realizer.bml.embr.syntax import CHILDREN as EMBR_CHILDREN
from reactive_realizer.bml.embr.syntax import PARAMETERS as EMBR_PARAMETERS
from reactive_realizer.bml.extensions import BehaviorParameter, Trajectory
from reactive_realizer.bml.key_poses import GOALS, KeyPose
from reactive_realizer.bml.murml.description import Slot
from reactive_realizer.bml.murml.parts import SYMMETRIES
from reactive_realizer.bml.murml.symbols import SYMBOLS
from reactive_realizer.bml.names import BML, BML_EXT, BMLA, BMLT, MURML, OWN
from reactive_realizer.bml.speech import Mark
from reactive_realizer.engine.lexicon import lexicon_of
from reactive_realizer.limits import Limits
from reactive_realizer.scheduler.block_planner import NotSupported

PAGE = Path(__file__).with_name("support.md")

_CHILDREN = {
    "speech": "<text>Hello.</text>",
    "face": '<faceLexeme lexeme="CLOSE_EYES"/>',
    "faceShift": '<faceLexeme lexeme="CLOSE_EYES"/>',
    "posture": '<stance type="STANDING"/>',
    "postureShift": '<stance type="STANDING"/>',
    "parametervaluechange": '<trajectory type="linear" targetValue="1"/>',
    "keyPoses": '<keyPose time="1"><lookAt target="0 0 1"/></keyPose>',
    "murmlgesture": f'<murml-description xmlns="{MURML}"><static slot="HandShape" value="ASLa"/></murml-description>',
    "murmlface": f'<murml-description xmlns="{MURML}"><dynamic><keyframing><phase><frame ftime="1">'
    "<posture>Humanoid (jawOpen 1 50)</posture></frame></phase></keyframing></dynamic></murml-description>",
}
"""Minimal content of elements that cannot be empty."""

_INSIDE: tuple[tuple[str, type, bool], ...] = (
    ("sync of a speech's text", Mark, True),
    ("stance of a posture", Stance, True),
    ("pose of a posture", Pose, True),
    ("description of any behavior", Description, True),
    ("trajectory of a parametervaluechange", Trajectory, True),
    ("parameter of any behavior, of BMLT", BehaviorParameter, True),
    ("keyPose of keyPoses", KeyPose, True),
    *((f"{kind.ELEMENT} of a keyPose", kind, True) for kind in GOALS),
)
"""Elements inside of behaviors: title, class that declares the attributes, and whether it is realized."""

_PREFIXES = {BML_EXT: "ext:", BMLA: "bmla:", BMLT: "bmlt:", OWN: "rr:", MURML: "murml:"}

_NOTES = {
    "bml composition": "in any case, with `-`, `_` or no separator; the last two equal `appendAfter` and `chunkAfter`",
    "bml appendAfter": "starts when these blocks have ended",
    "bml chunkAfter": "starts when these blocks subside: only retractions continue",
    "bml prependBefore": "these blocks, not yet started, start when it has ended",
    "bml chunkBefore": "these blocks, not yet started, start when it subsides",
    "bml interrupt": "interrupts these blocks on its arrival",
    "bml onStart": "activates these preplanned blocks when it starts",
    "bml preplan": "is planned, and waits for its activation",
    "bml allowexternalrefs": "needed in drafts only",
    "useproc procid": "the procedure",
    "useproc bmlid": "the id of the new block",
    "gesture mode": "by default, the right hand, or the left one if that is busy",
    "pointing target": "as for a gaze; a moving target is followed",
    "pointing mode": "by default, the hand on the side of the target, or the other one if that is busy or cannot reach",
    "faceShift overshoot": "no effect, because a shift has no attack peak",
    "facefap fap": "numbers or names of [MPEG-4](face.md#mpeg-4-parameters)",
    "facefap value": "in the unit of the parameter; not of the first two",
    "facefap viseme_select1": "required for the parameter `viseme`",
    "facefap viseme_select2": "0 is none",
    "facefap viseme_blend": "share of the first viseme, in 63rds",
    "facefap expression_select1": "required for the parameter `expression`",
    "facefap expression_select2": "0 is none",
    "facekeyframe name": "of a file, `NAME.xml` ([FaceInterpolator](face.md#animations)); otherwise, keys inside",
    "faceplutchik angle": "on [the wheel of emotions](face.md#the-wheel-of-emotions), degrees",
    "head amount": "1 is the maximum",
    "gaze target": "an object of the world, a character, or a joint such as `alice:l_wrist`",
    "locomotion target": "as for a gaze, or [coordinates](walking.md#where-to); without one, parameters say where",
    "locomotion manner": "WALK, RUN or STRAFE",
    "gaze influence": "by default, HEAD; `NECK` means HEAD, `TORSO` means WAIST; WHOLE does not move the feet",
    "procanimation name": "of an entry of the binding, otherwise of a file without its suffix",
    "procanimation mode": "for animations that the binding has for several hands",
    "keyframe name": "of a file, `NAME.xml` (SkeletonInterpolator), `NAME.bvh`, `NAME.skm`, `NAME.skmb` or "
    "[`NAME.blend.xml`](binding.md#blends); otherwise, keys inside",
    "noise type": "perlin",
    "audiofile filename": "of [a file among the assets](audio.md); `fileName` is read too",
    "transition class": "SlerpTransition, HermiteTransition",
    "parameter of any behavior name": "of [the motion that plays it](binding.md#kinds-of-motion)",
    "pose of a posture lexeme": "a lexeme of `pose` (see below), or of [your own file](human.md#postures)",
    "emit event": "its content, of any kind, is for planners",
    "glance left": "degrees, as the character sees it",
    "glance up": "degrees",
    "release mode": "the hands that let go of what they carry or [hold on to](bml.md#hands-that-go-to-their-target)",
    "idleChange parameter": "times per minute, at most 120, or 30 for the weight; depths relative to the usual, at \
most 5 for breaths, 1 for blinks and 2 for the weight",
    "idleChange value": "reached at the end, evenly, and kept until another change",
    "weightShift side": "the foot that supports a standing character: -1 the right one, 1 the left one",
    "keyPoses group": "the part of the body that moves; only arms have `position` and `swivel`, only heads and eyes \
`lookAt`, and eyes no `pose`",
    "keyPoses fadeIn": "time in which it takes over the joints",
    "keyPoses fadeOut": "time in which it releases them, from `relax` to `end`",
    "keyPoses warp": "[time warp](embrscript.md#time-warps) of the ways; without one, as hands reach",
    "keyPose of keyPoses id": "makes it a sync point",
    "keyPose of keyPoses power": "of the way to it: [straighter, and beyond the pose](expressivity.md#key-poses)",
    "keyPose of keyPoses tension": "of the [curve](embrscript.md#key-poses-in-bml) past it without a stop; 1 stops",
    "keyPose of keyPoses continuity": "of that curve; other numbers than 0 make a corner",
    "keyPose of keyPoses bias": "of that curve; 1 goes beyond the pose, -1 turns before it",
    "keyPose of keyPoses time": "after the start of the sequence, at its preferred duration",
    "position of a keyPose target": "from the pelvis: to the left, up, ahead, m",
    "position of a keyPose joint": "of the hand; by default, the wrist",
    "position of a keyPose offset": "from the joint, in its axes, m",
    "orientation of a keyPose direction": "to the left, up, ahead",
    "orientation of a keyPose axis": "of arms PALM, FINGERS, THUMB; of heads FACE, CROWN, LEFT_EAR; of the trunk \
CHEST, SPINE, LEFT_SIDE; of shoulders SHOULDER; of eyes SIGHT",
    "orientation of a keyPose joint": "of a trunk one of the spine, by default the uppermost; of shoulders one of \
them, by default both, of which the direction is the left one's",
    "swivel of a keyPose angle": "of the elbow, degrees, away from the body",
    "lookAt of a keyPose target": "from the pelvis: to the left, up, ahead, m",
    "pose of a keyPose name": "of a file, `NAME.xml` (SkeletonPose), `NAME.bvh`, `NAME.skm` or `NAME.skmb`",
    "pose of a keyPose influence": "share of the way from the rest pose",
    "wait duration": "never stretched",
    "wait max-wait": "the duration without other constraints; limits a wait for an event or for a time from outside",
    "wait event": "ends it; it takes no `end` and no `duration`",
}

_HEAD = """\
# What is supported

`make docs` generates this page from the parser and the engines. The realizer *reads* and checks the whole BML 1.0 core,
`faceFacs` of the core extensions, and the parts of BMLA and BMLT for continuous interaction and motion: ids, references
and values. A *realized* feature can be seen or heard. A feature that is read but not realized is dropped with one
warning, and the rest of the block plays.
"""

_BLOCK_POINTS = """
The attributes `ready`, `strokeStart`, `stroke` and `strokeEnd` name the sync point of one of its behaviors, which is
also that sync point of the block. The attribute `start` names a sync point of another block or of an anticipator;
`start="b1:end"` equals `appendAfter="b1"`, and `start="b1:relax"` equals `chunkAfter="b1"`. An extension of BML 1.0
(thesis 12.1.3).
"""

_SYNC_POINTS = """\

Every sync point is an attribute that can refer to another sync point. A `head` with a `repetition` n above 1 has
`stroke:1` to `stroke:n`, and `stroke` denotes the first. A `speech` has its inline `<sync id="..."/>` elements between
`start` and `end`. Blocks have the sync points `start`, `relax` and `end`, and those that they define: `b1:relax`
refers to the block b1 unless a behavior of the same block is named b1, and `b1:bml:relax` always refers to the block.

An attribute without a namespace that is not in these tables is ignored with a warning (`PARSING_FAILURE`). An attribute
with an unreadable value drops its behavior with the same warning.
"""

_LEXEMES = """\

## Lexemes

Lexemes are read in upper or lower case, with `_` or `-`. An unknown lexeme drops its behavior with a warning
(`CANNOT_CREATE_BEHAVIOR`). The lexemes of `gesture`, `head` and `procanimation` are entries of a
[binding](binding.md), and you can [add more](gesture.md); those of `pose` are [files](human.md#postures).
`reactive-realizer lexicon` lists them with their hands, sync points and parameters, and the
[gallery](gallery/README.md) shows them.

"""

_AROUND = """\

## Constraints and other elements

| element | realized | notes |
|---|---|---|
| `required` | yes | its contents must succeed; otherwise the block ends as FAILED and stops |
| `constraint`, `synchronize` | yes | its `<sync ref="..."/>` sync points coincide; an absolute time fixes them |
| `constraint`, `before`, `after` | yes | also while the block plays; `smartbody` drops them with a warning |
| `description` | yes | by priority; of a `speech` also [audio](audio.md), [SSML](voices.md#ssml); of gestures and \
faces also [MURML](murml.md) |

## Other namespaces

| feature | realized | notes |
|---|---|---|
| `dynamic="true"` of `http://hmi.ewi.utwente.nl/bmlt` on `gaze` and its shifts | yes | follows a moving target |
| `voice="NAME"` of `http://hmi.ewi.utwente.nl/bmlt` on `speech` | yes | another [voice](voices.md) |
| `words="true"` of `urn:reactive-realizer:1` on `speech` | yes | each word is a sync point `wordN`, counted from 0 |
| `rigid="true"` of `urn:reactive-realizer:1` on `speech` | yes | it is not [stretched](voices.md#stretching) |
| `liveliness="0.5"` of `urn:reactive-realizer:1` on `speech` | yes | how much the speaker moves of itself, 0 to 1 \
([liveliness](liveliness.md)) |
| `generatefiller="true"` of `http://www.asap-project.org/bmlis` on `speech` | yes | fillers \
[hold the floor](planners.md#holding-the-floor) after it |
| `cast="Amber"` of `urn:reactive-realizer:1` on `bml` | yes | its character, if the scene has one of this name; \
otherwise the first one |
| `accompanies="b1"` of `urn:reactive-realizer:1` on `bml` | yes | its behaviors \
[give way](liveliness.md#accompanying-blocks) to all others, and end with `b1` |
| other attributes | no | warning `CUSTOM_ATTRIBUTE_NOT_SUPPORTED`; their behavior plays |
| `setImage`, `addImage`, `addAnimationXML` and `addAnimationDir` of `http://hmi.ewi.utwente.nl/pictureengine` \
| with the engine `picture` | [characters shown as pictures](pictures.md#the-binding) |
| other elements, including those of BMLA and BMLT without a table above | no | warning \
`CUSTOM_BEHAVIOUR_NOT_SUPPORTED` |

`blinkemitter` and `breathingemitter` of BMLT with `avgwaitingtime` (s) and without an `end` are read as an
[`idleChange`](#idlechange) of BLINK_RATE and BREATHING_RATE; their `range` has no effect. Other emitters are left to
plug-ins.

`keyPoses`, `glance`, `release`, `idleChange` and `weightShift` are in the namespace `urn:reactive-realizer:1`
([key poses in BML](embrscript.md#key-poses-in-bml)). `murmlgesture` and `murmlface` are in the namespace
`http://www.techfak.uni-bielefeld.de/ags/soa/murml` ([MURML](murml.md)).

`procanimation`, `procanimationgesture`, `keyframe`, `noise`, `transition` and `audiofile` are in the namespace
`http://hmi.ewi.utwente.nl/bmlt`. The motion of such an element, or of a `gesture` or `head`, can have additional sync
points, such as the beats of a conducting pattern. Constraints and the attributes of BMLT elements can name these.

`activate`, `interrupt`, `parametervaluechange` and `emit` are in the namespace `http://www.asap-project.org/bmla` or
`http://hmi.ewi.utwente.nl/bmlt`; so are the block attributes above, `defineproc` and `useproc`. Their `id` is optional;
the default is the first free one, such as `activate1`.
"""

_DRAFTS = """
## Documents without a namespace

Documents without a namespace, or in `http://www.mindmakers.org/projects/BML` (Greta), are read as [drafts of
BML](dialects.md#drafts-of-bml): that of van Welbergen's thesis, the Vienna draft, or what Greta and EMBOTS write. One
tolerant reader accepts everything above and the different spellings of the drafts. It does not guess: anything outside
this table causes a warning.

| draft | read as |
|---|---|
| `bml scheduling="append"` | `composition` |
| `bml character="..."` | `characterId`; in a scene without `Greta`, its first character |
| `bml agent="..."` | the character; in a scene without it, its first one |
| `bml composition="blend"` | `MERGE` |
| `bml reaction_type="NONE"`, `reaction_duration="NONE"`, `social_attitude="neutral"` | ignored |
| `start="-0.5"`, `ready="-0.2"` | `start="0"`; other points before 0 come as early as possible |
| `bml` and behaviors without `id` | an `id` such as `document1`, `head1` |
| `head action="ROTATION" rotation="NOD"`, `head type="NOD"` | `lexeme`; a rotation X is NOD, Y is SHAKE, Z is TILT |
| `head lexeme="Down_Aside_Right"` | `DOWN_RIGHT`, and the [reference](binding.md#gestures-of-greta) as written |
| `head repeats` | `repetition`; a part of one is 1 |
| `gesture type="BEAT"`, `type="LEXICALIZED" lexeme="..."` | `lexeme` |
| `gesture type="POINT" target="..."` | `pointing` |
| `gesture hand="LEFT"` | `mode="LEFT_HAND"` |
| `gaze type="AT"`, `gaze modality` | ignored, and `influence`; LEGS means WHOLE |
| `gaze` without `target` | `target="viewer"` |
| `face type="FACS" au="..."`, `type="LEXICALIZED" lexeme="..."` | `faceFacs`, `faceLexeme` |
| `face type="HAPPY"`, or `SAD`, `ANGRY`, `AFRAID`, `DISGUSTED`, `SURPRISED`, `SCEPTICAL`, `NEUTRAL` | `faceLexeme`: \
JOY and so on; SCEPTICAL is RAISE_LEFT_BROW |
| `face stroke_start="..." stroke_end="..."` | `attackPeak`, and `relax` if that is not tied |
| `face au="1_left"` | `au="1" side="left"` |
| `lexeme` in a `face` | `faceLexeme` |
| `posture stance="standing" shape="open" part="lower"` | `stance` and `pose`, here LEGS and LEGS_OPEN |
| `torso lexeme="..."`, `body posture="..."`, `shoulder lexeme="..."` | `posture` with a `pose` of WHOLEBODY or ARMS |
| text directly in `speech`, `<tm id="..."/>`, `<mark name="..."/>` | `text`, `sync` |
| a mark with the name of an earlier one of its speech | left out: the first one counts, as in Greta |
| `<break>`, `<emphasis>`, `<prosody>` and so on in a `speech` | [SSML](voices.md#ssml) in a description |
| `speech text="..."` | `text`, if there is no other |
| `speech ref="..."` | a [recording](audio.md#recorded-speech) |
| `speech language`, `voice`, `type`, and points of gestures | ignored: the voice of the character speaks |
| `<pitchaccent>`, `<boundary>` in a `speech` | [SSML](voices.md#ssml): emphasis on the words, a break |
| `<reference>beat=Circle</reference>` in a description | the `lexeme`, if there is no other, and the reference |
| `<param name="..." value="..."/>` in a behavior | [`bmlt:parameter`](#parameter-of-any-behavior-of-bmlt) |
| `description level="..."`, or without `priority` | `priority`, or 0 |
| `<lips>`, `<curves>` | nothing beside a speech: the lips follow its sound; otherwise left out with one warning |
| `synchronize ref="..."` | an additional `sync` in it |
| `event message="NAME content" stroke="..."` | `bmla:emit event="NAME" start="..."` with the content |
| other elements and attributes of SmartBody | [see there](smartbody.md#how-everything-is-read) |
| `stroke_start`, `stroke_end` | `strokeStart`, `strokeEnd` |
| names of elements in capital letters, or of Greta's namespaces | in lowercase, without a namespace |

A `gaze` or `posture` without a constraint on its end [persists](semantics.md#persistent-behaviors-and-shifts).
A reference to a behavior of another block requires `allowexternalrefs="true"`.
"""


_EMBR_NOTES = {
    "K_POSE_SEQUENCE": "a behavior for each body group, weight and clip",
    "K_POSE": "a `keyPose` of each",
    "ANIMATION": "`bmlt:keyframe`",
    "NUCLEUS": "[other places, times and holds](embrscript.md#expressivity) of its poses, and the curves past them",
    "POSITION_CONSTRAINT": "`position`",
    "ORIENTATION_CONSTRAINT": "`orientation`",
    "SWIVEL_CONSTRAINT": "`swivel`, kept for the `HOLD` of its pose",
    "LOOK_AT_CONSTRAINT": "`lookAt`; a `JOINT` has no effect",
    "POSE_TARGET": "`pose`",
    "MORPH_TARGET": "`bmlt:facekeyframe`",
    "SHADER": "`bmlt:facekeyframe`; `blushing` and `paling`",
    "AUTONOMOUS_BEHAVIOR": "`idleChange`, or a movement: [the keys](embrscript.md#autonomous-behaviors); a TIME_WARP \
and a FEEDBACK_ID have no effect. Behaviors of your own are in the \
[human file](human.md#autonomous-behaviors), as they are in EMBR's character files",
}
"""Element of EMBRScript -> what it is read as."""

_EMBR = """
## EMBRScript

The elements of [EMBRScript](embrscript.md), their parameters, and what they are read as. `TIME_RESET` is read as
`composition="REPLACE"`. Time warps of other families than TAN and EXP are not known. What is not realized is named once
for a script.

"""


def _embr() -> str:
    names = {*EMBR_PARAMETERS, *(name for known in EMBR_CHILDREN.values() for name in known)}
    if names != _EMBR_NOTES.keys():
        raise ValueError(f"notes and elements of EMBRScript differ: {sorted(names ^ _EMBR_NOTES.keys())}")
    rows = ((f"`{name}`", ", ".join(EMBR_PARAMETERS[name]), note) for name, note in _EMBR_NOTES.items())
    return _EMBR + _table(("element", "parameters", "read as"), rows)


_MURML = """
## MURML

The symbols of [MURML](murml.md). Directions of fingers and palms have any letters of `L`, `R`, `U`, `D`, `A` (away
from the body) and `T` (toward it) after `Dir` or `Palm`, and each letter counts: `DirALAA`
is ahead and a little to the left.

"""


def _murml() -> str:
    symbols = SYMBOLS
    rows = (
        ("height of a `HandLocation`", "0 pelvis, 1 shoulders, 2 eyes", symbols.heights),
        ("direction of a `HandLocation`", "degrees to the left", symbols.directions),
        ("distance of a `HandLocation`", "lengths of the arm, ahead", symbols.distances),
        ("`distance` of a movement", "lengths of the arm", symbols.ways),
        ("`extent` of a curve", "lengths of its chord", symbols.extents),
        ("`roundness` of a curve", "-1 broad, 1 pointed", symbols.roundnesses),
        ("`skewedness` of a curve", "-1 highest toward its start, 1 toward its end", symbols.skewednesses),
        ("`HandShape`", "stored pose", symbols.hand_shapes),
    )
    listed = (
        (kind, unit, ", ".join(f"`{name}` {value}" for name, value in table.items())) for kind, unit, table in rows
    )
    others = (("slot", "", ", ".join(map(_code, Slot))), ("`symmetry`", "", ", ".join(map(_code, SYMMETRIES))))
    return _MURML + _table(("symbols of", "meaning", "symbols"), [*listed, *others])


def _code(word: str) -> str:
    return f"`{word}`"


def page() -> str:
    """The page as Markdown."""
    return asyncio.run(_page())


async def _page() -> str:
    async with open_scene(SceneOptions(voice="text")) as scene:
        engines = {name: _engine(element, scene) for name, element in ELEMENTS.items()}
        lexemes = _lexemes(scene)
    attributes = [_own_table(each, engines[name] is not None) for name, each in ELEMENTS.items()]
    inside = [_attributes(title, attributes_of(data), realized) for title, data, realized in _INSIDE]
    parts = [
        _block(),
        _elements(engines),
        _SYNC_POINTS,
        *attributes,
        *inside,
        _LEXEMES,
        lexemes,
        _AROUND,
        _DRAFTS,
        _embr(),
        _murml(),
    ]
    return "".join([_HEAD, *parts])


def _block() -> str:
    attributes = attributes_of(BehaviorBlock)
    return "".join(
        [
            "\n## The block\n\n",
            _attribute_table("bml", [each for each in attributes if not each.continuous], True),
            _BLOCK_POINTS,
            _attributes("bml, of BMLA or BMLT", [each for each in attributes if each.continuous], True),
            _attributes("defineproc", attributes_of(DefineProc), True),
            "\nIt is written beside blocks and has the contents of a block. It does not play until it is used.\n",
            _attributes("useproc", attributes_of(UseProc), True),
            "\nIt creates a block and accepts its other attributes. `scheduling` is another name for `composition`.\n",
        ]
    )


def _engine(element: Element, scene: Scene) -> str | None:
    """The name of the engine that supports the behavior of an element; None if there is none."""
    behavior = _example(element)
    (character,) = scene.realizer.characters.values()
    return next((engine.name.partition("/")[2] for engine in character.engines if engine.supports(behavior)), None)


def _example(element: Element) -> Behavior:
    """The behavior of a minimal element."""
    name = f"{_PREFIXES.get(element.namespace, '')}{element.name}"
    needed = " ".join(f'{each.name}="{_sample(each)}"' for each in element.attributes if each.required)
    written = f"<{name} {needed}>{_CHILDREN.get(element.name, '')}</{name}>"
    own = f'xmlns:bmla="{BMLA}" xmlns:bmlt="{BMLT}" xmlns:rr="{OWN}" xmlns:murml="{MURML}"'
    namespaces = f'xmlns="{BML}" xmlns:ext="{BML_EXT}" {own}'
    (parsed,) = parse(f'<bml {namespaces} id="b">{written}</bml>', Limits())
    if parsed.block is None or not parsed.block.behaviors:
        raise ValueError(f"{written} is not a valid {element.name}: {parsed.problems}")
    return parsed.block.behaviors[0]


def _sample(attribute: Attribute) -> str:
    if isinstance(attribute.type, Enumeration):
        return str(next(iter(attribute.type.words)))
    return "1" if isinstance(attribute.type, Integer | Float) else "example"


def _elements(engines: Mapping[str, str | None]) -> str:
    rows = (_element_row(element, engines[name]) for name, element in ELEMENTS.items())
    return "\n## Behaviors\n\n" + _table(("element", "realized by the engine", "warning", "sync points"), rows)


def _element_row(element: Element, engine: str | None) -> tuple[str, ...]:
    warning = "" if engine else f"`{NotSupported.warning}`"
    return f"`{element.name}`", engine or "none", warning, ", ".join(element.sync_points)


def _own_table(element: Element, realized: bool) -> str:
    return _attributes(element.name, element.attributes, realized)


def _attributes(title: str, attributes: Iterable[Attribute], realized: bool) -> str:
    return f"\n### {title}\n\n" + _attribute_table(title.partition(",")[0], attributes, realized)


def _attribute_table(element: str, attributes: Iterable[Attribute], realized: bool) -> str:
    rows = (_attribute_row(element, each, realized) for each in attributes)
    return _table(("attribute", "value", "default", "realized", "notes"), rows)


def _attribute_row(element: str, attribute: Attribute, realized: bool) -> tuple[str, ...]:
    default = "required" if attribute.required else _default(attribute.default)
    note = _NOTES.get(f"{element} {attribute.name}", "")
    return f"`{attribute.name}`", attribute.type.description, default, "yes" if realized else "no", note


def _default(value: object) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, tuple):
        return (" " if value and isinstance(value[0], float) else ", ").join(map(_default, value))
    return f"{value:g}" if isinstance(value, float) else str(value)


def _lexemes(scene: Scene) -> str:
    """The table of lexemes that can be played in the default scene."""
    (character,) = scene.realizer.characters.values()
    found: dict[str, set[str]] = {}
    for entry in lexicon_of(character.engines):
        if entry.lexeme and entry.problem is None:
            found.setdefault(entry.element, set()).add(entry.lexeme)
    rows = ((f"`{element}`", ", ".join(sorted(lexemes))) for element, lexemes in sorted(found.items()))
    return _table(("element", "lexemes of the default scene"), rows)


def _table(head: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> str:
    return "".join(f"| {' | '.join(cells)} |\n" for cells in (head, ("---",) * len(head), *rows))


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
