"""Writes docs/support.md from the parser's tables, the engines of the default scene, and its bindings."""

import asyncio
from collections.abc import Iterable, Mapping
from pathlib import Path

from reactive_realizer.assembly.scene import Scene, SceneOptions, open_scene
from reactive_realizer.bml.attribute_types import Integer
from reactive_realizer.bml.attributes import Attribute, attributes_of
from reactive_realizer.bml.behavior import Behavior, Description
from reactive_realizer.bml.behaviors import Mark
from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.bml.continuous import Trajectory
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.elements import ELEMENTS, Element
from reactive_realizer.bml.names import BML, BML_EXT, BMLA, BMLT
from reactive_realizer.bml.posture import Pose, Stance
from reactive_realizer.bml.procedure import DefineProc, UseProc
from reactive_realizer.bml.twente import Parameter
from reactive_realizer.engine.lexicon import words_of
from reactive_realizer.errors import ERRORS
from reactive_realizer.limits import Limits

PAGE = Path(__file__).with_name("support.md")

_CHILDREN = {
    "speech": "<text>Hello.</text>",
    "face": '<faceLexeme lexeme="CLOSE_EYES"/>',
    "faceShift": '<faceLexeme lexeme="CLOSE_EYES"/>',
    "posture": '<stance type="STANDING"/>',
    "postureShift": '<stance type="STANDING"/>',
    "parametervaluechange": '<trajectory type="linear" targetValue="1"/>',
}
"""What an element needs inside to be read."""

_INSIDE: tuple[tuple[str, type, bool], ...] = (
    ("sync of a speech's text", Mark, True),
    ("stance of a posture", Stance, True),
    ("pose of a posture", Pose, True),
    ("description of any behavior", Description, True),
    ("trajectory of a parametervaluechange", Trajectory, True),
    ("parameter of any behavior, of BMLT", Parameter, True),
)
"""Elements inside of behaviors: their title, what is read from them, and whether that is realized."""

_PREFIXES = {BML_EXT: "ext:", BMLA: "bmla:", BMLT: "bmlt:"}

_NOTES = {
    "bml composition": "in any case, with `-`, `_` or nothing between; the last two are `appendAfter` and `chunkAfter`",
    "bml appendAfter": "it starts when these have ended",
    "bml chunkAfter": "it starts when these subside: all that goes on of them is in retraction",
    "bml prependBefore": "these, which have not started, start when it has ended",
    "bml chunkBefore": "these, which have not started, start when it subsides",
    "bml interrupt": "these are interrupted when it comes in",
    "bml onStart": "these, which were planned ahead, start when it starts",
    "bml preplan": "it is planned, and waits to be activated",
    "bml allowexternalrefs": "only a draft has to say it",
    "useproc procid": "the procedure",
    "useproc bmlid": "the block that it becomes",
    "gesture mode": "without it: the right hand, or the left one if that is busy",
    "pointing target": "as that of a gaze; it is followed while it moves",
    "pointing mode": "without it: the hand on the side of the target, or the other one if that is busy or cannot",
    "head amount": "1 is the most there is",
    "gaze target": "a name of the world, a character, or its joint: `alice:l_wrist`",
    "gaze influence": "without it: HEAD; `NECK` is HEAD, `TORSO` is WAIST; WHOLE leaves the feet where they stand",
    "procanimation name": "that of an entry of the binding, else of its file without suffix",
    "procanimation mode": "of an animation that the binding has for several hands",
    "keyframe name": "of a file, `NAME.xml` (SkeletonInterpolator) or `NAME.bvh` (a capture), else keys stand inside",
    "noise type": "perlin",
    "transition class": "SlerpTransition, HermiteTransition",
    "parameter of any behavior name": "of [what plays it](binding.md#kinds-of-motions)",
    "pose of a posture lexeme": "a word of a `pose`, below, or of [a file of your own](human.md#postures)",
    "wait duration": "nothing stretches it",
    "wait max-wait": "how long it lasts where nothing else says it, and the most that it is stretched to",
}

_HEAD = """\
# What is supported

This page is made by `make docs` from the code that reads BML and the engines that play it. Everything of the BML 1.0
core, `faceFacs` of the core extensions, and what BMLA and BMLT add for continuous interaction and for motions is *read*
and checked: ids, references, values. *Realized* means that it is seen or heard. What is read and not realized is left
out with one warning, and the rest of the block plays.
"""

_SYNC_POINTS = """\

Every sync point is an attribute that may be tied to another point. `head` with a `repetition` n above 1 has `stroke:1`
to `stroke:n` in the place of `stroke`; `speech` has its inline `<sync id="..."/>` between `start` and `end`. A block
has sync points too: `b1:relax` is that of the block b1 where no behavior beside it is called b1, and `b1:bml:relax` in
any case; so with `start` and `end`.

An attribute without a namespace that is not in these tables is passed over with a warning (`PARSING_FAILURE`); one
whose value cannot be read drops its behavior, with the same warning.
"""

_LEXEMES = """\

## Lexemes

Words are read in any case, with `_` or `-`. One that is not in this table drops its behavior with a warning
(`CANNOT_CREATE_BEHAVIOR`). Those of `gesture`, `head` and `procanimation` are entries of a [binding](binding.md), to
which [others can be added](gesture.md); those of a `pose` are [files](human.md#postures). `reactive-realizer lexicon`
lists them with their hands, sync points and parameters, and the [gallery](gallery/README.md) shows them.

"""

_AROUND = """\

## Around behaviors

| element | realized | |
|---|---|---|
| `required` | yes | what is inside must succeed, or the block ends FAILED and nothing of it plays on |
| `constraint`, `synchronize` | yes | the points of its `<sync ref="..."/>` are one; an absolute one pins them |
| `constraint`, `before`, `after` | yes | also while it plays; the strategy `smartbody` keeps none and says so |
| `description` | yes | the one with the highest priority whose behavior can be made is played |

## Other namespaces

| what | realized | |
|---|---|---|
| `dynamic="true"` of `http://hmi.ewi.utwente.nl/bmlt` on `gaze` and its shifts | yes | it follows a target that moves |
| other attributes | no | warning `CUSTOM_ATTRIBUTE_NOT_SUPPORTED`; what they stand on plays |
| elements, those of BMLA and BMLT among them that have no table above | no | warning `CUSTOM_BEHAVIOUR_NOT_SUPPORTED` |

`procanimation`, `procanimationgesture`, `keyframe`, `noise` and `transition` are of
`http://hmi.ewi.utwente.nl/bmlt`. What plays a `gesture`, a `head` or one of them may have further sync points, such as
the beats of a conducting pattern: constraints name them as any other, and in BMLT's elements attributes do, too.

`activate`, `interrupt` and `parametervaluechange` are of `http://www.asap-project.org/bmla` or
`http://hmi.ewi.utwente.nl/bmlt`, whichever; so are the attributes of a block above, `defineproc` and `useproc`.
Elements of either may do without an id: they get the first free one, `activate1`.
"""

_DRAFTS = """
## Documents without a namespace

They are read as drafts of BML, that of van Welbergen's thesis or that of Vienna, in one tolerant way: all of the above,
and what the drafts wrote otherwise. Nothing is guessed: what has no place in this table gets its warning.

| what a draft writes | read as |
|---|---|
| `bml scheduling="append"` | `composition` |
| `bml start="b1:end"`, `start="b1:relax"` | `appendAfter="b1"`, `chunkAfter="b1"` |
| `head action="ROTATION" rotation="NOD"`, `head type="NOD"` | `lexeme`; a rotation X is NOD, Y is SHAKE, Z is TILT |
| `head repeats` | `repetition` |
| `gesture type="BEAT"`, `type="LEXICALIZED" lexeme="..."` | `lexeme` |
| `gesture type="POINT" target="..."` | `pointing` |
| `gesture hand="LEFT"` | `mode="LEFT_HAND"` |
| `gaze type="AT"`, `gaze modality` | nothing more, `influence`; LEGS is WHOLE |
| `face type="FACS" au="..."`, `type="LEXICALIZED" lexeme="..."` | `faceFacs`, `faceLexeme` |
| `posture stance="standing" shape="open" part="lower"` | `stance` and `pose`, here LEGS and LEGS_OPEN |
| text directly in `speech`, `<tm id="..."/>` | `text`, `sync` |
| `synchronize ref="..."` | one more `sync` in it |
| `stroke_start`, `stroke_end` | `strokeStart`, `strokeEnd` |

A `gaze` or `posture` of which nothing says when it ends [persists](semantics.md#what-persists-and-what-lasts).
A reference to a behavior of another block wants `allowexternalrefs="true"`.
"""


def page() -> str:
    """The page as Markdown."""
    return asyncio.run(_page())


async def _page() -> str:
    async with open_scene(SceneOptions(voice="text")) as scene:
        engines = {name: _engine(element, scene) for name, element in ELEMENTS.items()}
        lexemes = _lexemes(scene)
    attributes = [_own_table(each, engines[name] is not None) for name, each in ELEMENTS.items()]
    inside = [_attributes(title, attributes_of(data), realized) for title, data, realized in _INSIDE]
    parts = [_block(), _elements(engines), _SYNC_POINTS, *attributes, *inside, _LEXEMES, lexemes, _AROUND, _DRAFTS]
    return "".join([_HEAD, *parts])


def _block() -> str:
    attributes = attributes_of(BehaviorBlock)
    return "".join(
        [
            "\n## The block\n\n",
            _attribute_table("bml", [each for each in attributes if not each.continuous], True),
            _attributes("bml, of BMLA or BMLT", [each for each in attributes if each.continuous], True),
            _attributes("defineproc", attributes_of(DefineProc), True),
            "\nIt stands beside blocks and holds what a block holds; nothing of it plays until it is used.\n",
            _attributes("useproc", attributes_of(UseProc), True),
            "\nIt becomes a block and may have all other attributes of one; `scheduling` is its `composition` too.\n",
        ]
    )


def _engine(element: Element, scene: Scene) -> str | None:
    """The engine that says it supports the behavior."""
    behavior = _example(element)
    (character,) = scene.realizer.characters.values()
    return next((engine.name.partition("/")[2] for engine in character.engines if engine.supports(behavior)), None)


def _example(element: Element) -> Behavior:
    """The behavior of the least that can be written of an element."""
    name = f"{_PREFIXES.get(element.namespace, '')}{element.name}"
    needed = " ".join(f'{each.name}="{_sample(each)}"' for each in element.attributes if each.required)
    written = f"<{name} {needed}>{_CHILDREN.get(element.name, '')}</{name}>"
    namespaces = f'xmlns="{BML}" xmlns:ext="{BML_EXT}" xmlns:bmla="{BMLA}" xmlns:bmlt="{BMLT}"'
    (parsed,) = parse(f'<bml {namespaces} id="b">{written}</bml>', Limits())
    if parsed.block is None or not parsed.block.behaviors:
        raise ValueError(f"{written} is no example of {element.name}: {parsed.problems}")
    return parsed.block.behaviors[0]


def _sample(attribute: Attribute) -> str:
    return "1" if isinstance(attribute.type, Integer) else "example"


def _elements(engines: Mapping[str, str | None]) -> str:
    rows = (_element_row(element, engines[name]) for name, element in ELEMENTS.items())
    return "\n## Behaviors\n\n" + _table(("element", "realized by the engine", "warning", "sync points"), rows)


def _element_row(element: Element, engine: str | None) -> tuple[str, ...]:
    warning = "" if engine else f"`{ERRORS['not-supported'].warning}`"
    return f"`{element.name}`", engine or "none", warning, ", ".join(element.sync_points)


def _own_table(element: Element, realized: bool) -> str:
    return _attributes(element.name, element.attributes, realized)


def _attributes(title: str, attributes: Iterable[Attribute], realized: bool) -> str:
    return f"\n### {title}\n\n" + _attribute_table(title.partition(",")[0], attributes, realized)


def _attribute_table(element: str, attributes: Iterable[Attribute], realized: bool) -> str:
    rows = (_attribute_row(element, each, realized) for each in attributes)
    return _table(("attribute", "value", "default", "realized", ""), rows)


def _attribute_row(element: str, attribute: Attribute, realized: bool) -> tuple[str, ...]:
    default = "must be written" if attribute.required else _default(attribute.default)
    note = _NOTES.get(f"{element} {attribute.name}", "")
    return f"`{attribute.name}`", attribute.type.description, default, "yes" if realized else "no", note


def _default(value: object) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, tuple):
        return ", ".join(value)
    return f"{value:g}" if isinstance(value, float) else str(value)


def _lexemes(scene: Scene) -> str:
    """Words that play in the default scene."""
    (character,) = scene.realizer.characters.values()
    found: dict[str, set[str]] = {}
    for word in words_of(character.engines):
        if word.lexeme and word.problem is None:
            found.setdefault(word.element, set()).add(word.lexeme)
    rows = ((f"`{element}`", ", ".join(sorted(words))) for element, words in sorted(found.items()))
    return _table(("element", "words of the default scene"), rows)


def _table(head: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> str:
    return "".join(f"| {' | '.join(cells)} |\n" for cells in (head, ("---",) * len(head), *rows))


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
