"""BML before 1.0: rewrites documents without a namespace as BML 1.0 before they are read.

One tolerant reading serves the draft of the thesis (van Welbergen 2011, chapter 6), the Vienna draft that SmartBody
reads, and what Greta and EMBOTS write. Nothing is guessed: what this module does not know stays as it is, and the
reader of BML 1.0 reports it.
"""

import re
from collections.abc import Callable, Collection, Mapping
from types import MappingProxyType
from typing import Final

from reactive_realizer.bml.behaviors import REFERENCE
from reactive_realizer.bml.block import CAST
from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.draft_speech import modernize_speech
from reactive_realizer.bml.names import BMLA, BMLT
from reactive_realizer.bml.sync_ref import DRAFT_SPELLINGS
from reactive_realizer.bml.trees import PARAMETER, Tree, children_of, name_of, stray_text_of
from reactive_realizer.bml.value_faults import UnknownWord
from reactive_realizer.bml.vocabulary import Composition
from reactive_realizer.errors import Fault, RealizerError

_AXES: Final = {"X": "NOD", "Y": "SHAKE", "Z": "TILT"}
_HANDS: Final = {"LEFT": "LEFT_HAND", "RIGHT": "RIGHT_HAND", "BOTH": "BOTH_HANDS"}
_PARTS: Final = {"LOWER": "LEGS", "UPPER": "ARMS"}
_BODY: Final = {"torso": "WHOLEBODY", "body": "WHOLEBODY", "shoulder": "ARMS"}
_LEANINGS: Final = {
    "FORWARD": "LEANING_FORWARD",
    "BACKWARD": "LEANING_BACKWARD",
    "NEUTRAL": "WHOLEBODY_NEUTRAL",
}
_ASIDE: Final = "ASIDE"
_PART: Final = re.compile(r"0?\.[0-9]+")
_SIDED: Final = re.compile("([0-9]+)_(left|right|both)", re.IGNORECASE)
_AHEAD: Final = "viewer"
"""The target of a gaze that names none."""
_BEFORE: Final = re.compile(r"-[0-9]*\.?[0-9]+")
"""A start before that of the block, which Greta writes for what accompanies the first word."""
_WRITTEN_BY_GRETA: Final = "Greta"
_BLEND: Final = "blend"
_UNSET: Final = {"reaction_type": "none", "reaction_duration": "none", "social_attitude": "neutral"}
"""Attributes of Greta's blocks -> the value that asks for nothing."""
_FACES: Final = {"FACS": "faceFacs", "LEXICALIZED": "faceLexeme"}


def modernize_block(tree: Tree) -> None:
    """Rewrites the attributes of a block, or of a use of a procedure, as BML 1.0 and BMLA, in place.

    ``scheduling`` is the composition, and ``character`` (Greta) and ``agent`` (EMBOTS) name the character. Greta writes
    its own name for any character: the first one of a scene stands in for that.
    """
    _rename_points(tree)
    if tree.get("character") == _WRITTEN_BY_GRETA:
        tree.set(f"{{{CAST[0]}}}{CAST[1]}", _take(tree, "character"))
    for name in ("character", "agent"):
        _rename(tree, name, "characterId")
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
    if _BEFORE.fullmatch(tree.get("start", "").strip()):
        tree.set("start", "0")
    for parameter in children_of(tree, "param"):
        parameter.tag = f"{{{BMLT}}}{PARAMETER}"
    for description in children_of(tree, "description"):
        _rename(description, "level", "priority")
        if "priority" not in description.attrib:
            description.set("priority", "0")
    if name_of(tree) == "speech":
        return modernize_speech(tree, source)
    rewrite = _REWRITES.get(name_of(tree))
    if rewrite is not None:
        rewrite(tree, source)
    return []


def _head(tree: Tree, source: BlockSource) -> None:
    _check(tree, "action", ["ROTATION"], source)
    _rename(tree, "rotation", "lexeme", _AXES)
    _rename(tree, "type", "lexeme")
    _name_by_reference(tree)
    if "lexeme" in tree.attrib:
        lexeme = tree.get("lexeme", "")
        _refer(tree, lexeme, _direction(lexeme))
        tree.set("lexeme", _direction(lexeme))
    _rename(tree, "repeats", "repetition")
    if _PART.fullmatch(tree.get("repetition", "")):
        tree.set("repetition", "1")  # of SmartBody: a part of a nod


def _direction(lexeme: str) -> str:
    """A word for a direction of the head without what it adds to those known here: Down_Aside_Right is DOWN_RIGHT."""
    words = re.split("[_-]", lexeme.upper())
    return "_".join(word for word in words if word != _ASIDE) if _ASIDE in words else lexeme


def _gesture(tree: Tree, source: BlockSource) -> None:
    _rename(tree, "hand", "mode", _HANDS)
    kind = tree.get("type", "").upper()
    if kind == "POINT":
        tree.tag = "pointing"
    if kind in {"POINT", "LEXICALIZED"}:
        del tree.attrib["type"]
    _rename(tree, "type", "lexeme")
    _name_by_reference(tree)


def _gaze(tree: Tree, source: BlockSource) -> None:
    _check(tree, "type", ["AT", "GAZE"], source)
    _rename(tree, "modality", "influence", {"LEGS": "WHOLE"})
    if "target" not in tree.attrib:
        tree.set("target", _AHEAD)


def _face(tree: Tree, source: BlockSource) -> None:
    for lexeme in children_of(tree, "lexeme"):
        lexeme.tag = _FACES["LEXICALIZED"]
    parts = children_of(tree, *_FACES.values())
    for part in parts or (tree,):
        _split_side(part)
    if parts:
        return
    kind = _check(tree, "type", _FACES, source) or ("FACS" if "au" in tree.attrib else "LEXICALIZED")
    tree.tag = _FACES[kind]
    if kind == "LEXICALIZED":
        _name_by_reference(tree)


def _split_side(tree: Tree) -> None:
    """Rewrites an action unit with a side, such as ``1_left``."""
    found = _SIDED.fullmatch(tree.get("au", ""))
    if found is not None and "side" not in tree.attrib:
        tree.set("au", found[1])
        tree.set("side", found[2])


def _name_by_reference(tree: Tree) -> None:
    """Takes the word of a behavior from the reference in its description (Greta), such as ``beat=Circle``.

    Beside a lexeme, it is a reference: of several movements with this lexeme, it selects one.
    """
    references = ((each.text or "").strip() for each in tree.iterfind("description/reference"))
    reference = next(filter(None, references), "")
    word = reference.rpartition("=")[2].strip()
    if word and "lexeme" not in tree.attrib:
        tree.set("lexeme", word)
    if word:
        _refer(tree, reference, tree.get("lexeme", ""))


def _refer(tree: Tree, reference: str, lexeme: str) -> None:
    """Writes a reference that says more than the lexeme, unless there is one."""
    name = f"{{{REFERENCE[0]}}}{REFERENCE[1]}"
    if reference.lower() != lexeme.lower() and name not in tree.attrib:
        tree.set(name, reference)


def _part_of_body(tree: Tree, source: BlockSource) -> None:
    """Rewrites a behavior of the trunk or the shoulders, or a posture of SmartBody, as a posture."""
    part = _BODY[name_of(tree)]
    _rename(tree, "posture", "lexeme")
    _name_by_reference(tree)
    tree.tag = "posture"
    lexeme = _take(tree, "lexeme")
    if lexeme:
        known = _LEANINGS.get(lexeme.upper(), lexeme)
        _refer(tree, lexeme, known)
        source.insert(tree, "pose", {"part": part, "lexeme": known})


def _posture(tree: Tree, source: BlockSource) -> None:
    if "stance" in tree.attrib:
        source.insert(tree, "stance", {"type": _take(tree, "stance")})
    if "shape" in tree.attrib:
        part = _take(tree, "part", "WHOLEBODY").upper()
        part, shape = _PARTS.get(part, part), _take(tree, "shape").upper()
        lexeme = f"{part}_{shape}" if part in _PARTS.values() else shape
        source.insert(tree, "pose", {"part": part, "lexeme": lexeme})


def _synchronize(tree: Tree, source: BlockSource) -> None:
    if "ref" in tree.attrib:
        source.insert(tree, "sync", {"ref": _take(tree, "ref")})


def _event(tree: Tree, source: BlockSource) -> None:
    """SmartBody's event: the first word of its message is the name, as on its message bus, and the rest the content."""
    name, _, content = (_take(tree, "message") or stray_text_of(tree)).partition(" ")
    tree.tag = f"{{{BMLA}}}emit"
    _rename(tree, "stroke", "start")
    if name:
        tree.set("event", name)
        tree.text = content


_REWRITES: Final[Mapping[str, Callable[[Tree, BlockSource], None]]] = {
    "head": _head,
    "gesture": _gesture,
    "gaze": _gaze,
    "gazeShift": _gaze,
    "face": _face,
    "posture": _posture,
    "synchronize": _synchronize,
    "event": _event,
    **dict.fromkeys(_BODY, _part_of_body),
}


def _rename_points(tree: Tree) -> None:
    for old, new in DRAFT_SPELLINGS.items():
        _rename(tree, old, new)


def _rename(tree: Tree, old: str, new: str, words: Mapping[str, str] = MappingProxyType({})) -> None:
    """Renames an attribute and its word; if the new attribute exists too, the reader reports the old one."""
    if old in tree.attrib and new not in tree.attrib:
        value = _take(tree, old)
        tree.set(new, words.get(value.upper(), value))


def _take(tree: Tree, name: str, default: str = "") -> str:
    return str(tree.attrib.pop(name, default))


def _check(tree: Tree, name: str, words: Collection[str], source: BlockSource) -> str:
    """Removes an attribute that BML 1.0 does not have; returns its word in capitals, empty if it is not written.

    Raises:
        RealizerError: ``bad-attribute``: none of the words.
    """
    value = _take(tree, name)
    if value and value.upper() not in words:
        raise source.bad_attribute(tree, name, value, RealizerError(UnknownWord(word=value, known=tuple(words))))
    return value.upper()
