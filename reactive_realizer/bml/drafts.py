"""BML before 1.0: rewrites documents without a namespace as BML 1.0 before they are read.

One tolerant reading serves the draft of the thesis (van Welbergen 2011, chapter 6), the Vienna draft that SmartBody
reads, and what Greta and EMBOTS write. Nothing is guessed: what this module does not know stays as it is, and the
reader of BML 1.0 reports it.
"""

import re
from collections.abc import Callable, Mapping
from typing import Final

from reactive_realizer.bml.block import CAST
from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.draft_attributes import check, name_by_reference, refer, rename, take
from reactive_realizer.bml.draft_faces import modernize_face
from reactive_realizer.bml.draft_speech import modernize_speech
from reactive_realizer.bml.names import BMLA, BMLT
from reactive_realizer.bml.sync_ref import DRAFT_SPELLINGS
from reactive_realizer.bml.trees import PARAMETER, Tree, children_of, name_of, stray_text_of
from reactive_realizer.bml.vocabulary import Composition
from reactive_realizer.errors import Fault

_AXES: Final = {"X": "NOD", "Y": "SHAKE", "Z": "TILT"}
_HANDS: Final = {"LEFT": "LEFT_HAND", "RIGHT": "RIGHT_HAND", "BOTH": "BOTH_HANDS"}
_PARTS: Final = {"LOWER": "LEGS", "UPPER": "ARMS"}
_BODY: Final = {"torso": "WHOLEBODY", "body": "WHOLEBODY", "shoulder": "ARMS"}
_LEANINGS: Final = {
    "FORWARD": "LEANING_FORWARD",
    "BODYLEAN": "LEANING_FORWARD",
    "BACKWARD": "LEANING_BACKWARD",
    "BODYRECLINE": "LEANING_BACKWARD",
    "NEUTRAL": "WHOLEBODY_NEUTRAL",
}
_ASIDE: Final = "ASIDE"
_PART: Final = re.compile(r"0?\.[0-9]+")
_AHEAD: Final = "viewer"
"""The target of a gaze that names none."""
_BEFORE: Final = re.compile(r"-[0-9]*\.?[0-9]+")
"""A time before the start of the block, which Greta writes for what accompanies the first word."""
_INNER: Final = ("ready", "strokeStart", "stroke", "strokeEnd", "relax")
"""Points of which one before the start of the block comes as early as it can."""
_WRITTEN_BY_GRETA: Final = "Greta"
_BLEND: Final = "blend"
_UNSET: Final = {"reaction_type": "none", "reaction_duration": "none", "social_attitude": "neutral"}
"""Attributes of Greta's blocks -> the value that asks for nothing."""


def modernize_block(tree: Tree) -> None:
    """Rewrites the attributes of a block, or of a use of a procedure, as BML 1.0 and BMLA, in place.

    ``scheduling`` is the composition, and ``character`` (Greta) and ``agent`` (EMBOTS) name the character. If a scene
    has no ``agent`` of that name, or not the one whose name Greta writes for any character, its first one stands in.
    """
    _rename_points(tree)
    written_for_any = "character" if tree.get("character") == _WRITTEN_BY_GRETA else "agent"
    rename(tree, written_for_any, f"{{{CAST[0]}}}{CAST[1]}")
    rename(tree, "character", "characterId")
    if tree.get("composition", "").lower() == _BLEND:
        tree.set("composition", Composition.MERGE)
    for name in _UNSET:
        if tree.get(name, "").lower() == _UNSET[name]:
            del tree.attrib[name]
    if "scheduling" in tree.attrib and "composition" not in tree.attrib:
        tree.set("composition", str(tree.attrib.pop("scheduling")))


def modernize(tree: Tree, source: BlockSource) -> list[Fault]:
    """Rewrites a behavior or constraint as BML 1.0, in place, and returns the faults of what is left out.

    Raises:
        RealizerError: ``bad-attribute``: BML 1.0 has no equivalent.
    """
    _rename_points(tree)
    if _is_before(tree, "start"):
        tree.set("start", "0")
    for point in _INNER:
        if _is_before(tree, point):
            del tree.attrib[point]
    for parameter in children_of(tree, "param"):
        parameter.tag = f"{{{BMLT}}}{PARAMETER}"
    for description in children_of(tree, "description"):
        rename(description, "level", "priority")
        if "priority" not in description.attrib:
            description.set("priority", "0")
    if name_of(tree) == "speech":
        return modernize_speech(tree, source)
    rewrite = _REWRITES.get(name_of(tree))
    if rewrite is not None:
        rewrite(tree, source)
    return []


def _is_before(tree: Tree, point: str) -> bool:
    return _BEFORE.fullmatch(tree.get(point, "").strip()) is not None


def _head(tree: Tree, source: BlockSource) -> None:
    check(tree, "action", ["ROTATION"], source)
    rename(tree, "rotation", "lexeme", _AXES)
    rename(tree, "type", "lexeme")
    name_by_reference(tree)
    if "lexeme" in tree.attrib:
        lexeme = tree.get("lexeme", "")
        refer(tree, lexeme, _direction(lexeme))
        tree.set("lexeme", _direction(lexeme))
    rename(tree, "repeats", "repetition")
    if _PART.fullmatch(tree.get("repetition", "")):
        tree.set("repetition", "1")  # of SmartBody: a part of a nod


def _direction(lexeme: str) -> str:
    """A word for a direction of the head without what it adds to those known here: Down_Aside_Right is DOWN_RIGHT."""
    words = re.split("[_-]", lexeme.upper())
    return "_".join(word for word in words if word != _ASIDE) if _ASIDE in words else lexeme


def _gesture(tree: Tree, source: BlockSource) -> None:
    rename(tree, "hand", "mode", _HANDS)
    kind = tree.get("type", "").upper()
    if kind == "POINT":
        tree.tag = "pointing"
    if kind in {"POINT", "LEXICALIZED"}:
        del tree.attrib["type"]
    rename(tree, "type", "lexeme")
    name_by_reference(tree)


def _gaze(tree: Tree, source: BlockSource) -> None:
    check(tree, "type", ["AT", "GAZE"], source)
    rename(tree, "modality", "influence", {"LEGS": "WHOLE"})
    if "target" not in tree.attrib:
        tree.set("target", _AHEAD)


def _part_of_body(tree: Tree, source: BlockSource) -> None:
    """Rewrites a behavior of the trunk or the shoulders, or a posture of SmartBody, as a posture."""
    part = _BODY[name_of(tree)]
    rename(tree, "posture", "lexeme")
    name_by_reference(tree)
    tree.tag = "posture"
    lexeme = take(tree, "lexeme")
    if lexeme:
        known = _LEANINGS.get(lexeme.upper(), lexeme)
        refer(tree, lexeme, known)
        source.insert(tree, "pose", {"part": part, "lexeme": known})


def _posture(tree: Tree, source: BlockSource) -> None:
    if "stance" in tree.attrib:
        source.insert(tree, "stance", {"type": take(tree, "stance")})
    if "shape" in tree.attrib:
        part = take(tree, "part", "WHOLEBODY").upper()
        part, shape = _PARTS.get(part, part), take(tree, "shape").upper()
        lexeme = f"{part}_{shape}" if part in _PARTS.values() else shape
        source.insert(tree, "pose", {"part": part, "lexeme": lexeme})


def _synchronize(tree: Tree, source: BlockSource) -> None:
    if "ref" in tree.attrib:
        source.insert(tree, "sync", {"ref": take(tree, "ref")})


def _event(tree: Tree, source: BlockSource) -> None:
    """SmartBody's event: the first word of its message is the name, as on its message bus, and the rest the content."""
    name, _, content = (take(tree, "message") or stray_text_of(tree)).partition(" ")
    tree.tag = f"{{{BMLA}}}emit"
    rename(tree, "stroke", "start")
    if name:
        tree.set("event", name)
        tree.text = content


_REWRITES: Final[Mapping[str, Callable[[Tree, BlockSource], None]]] = {
    "head": _head,
    "gesture": _gesture,
    "gaze": _gaze,
    "gazeShift": _gaze,
    "face": modernize_face,
    "posture": _posture,
    "synchronize": _synchronize,
    "event": _event,
    **dict.fromkeys(_BODY, _part_of_body),
}


def _rename_points(tree: Tree) -> None:
    for old, new in DRAFT_SPELLINGS.items():
        rename(tree, old, new)
