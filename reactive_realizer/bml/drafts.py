"""BML before 1.0: rewrites documents without a namespace as BML 1.0 before they are read.

One tolerant reading serves the draft of the thesis (van Welbergen 2011, chapter 6) and the Vienna draft that SmartBody
reads. Nothing is guessed: what this module does not know stays as it is, and the reader of BML 1.0 reports it.
"""

from collections.abc import Callable, Collection, Mapping
from types import MappingProxyType
from typing import Final

from lxml import etree

from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.faults import UnknownWord
from reactive_realizer.bml.names import BMLA
from reactive_realizer.bml.sync_ref import DRAFT_SPELLINGS
from reactive_realizer.bml.trees import Tree, children_of, name_of, stray_text_of
from reactive_realizer.errors import RealizerError

_AXES: Final = {"X": "NOD", "Y": "SHAKE", "Z": "TILT"}
_HANDS: Final = {"LEFT": "LEFT_HAND", "RIGHT": "RIGHT_HAND", "BOTH": "BOTH_HANDS"}
_PARTS: Final = {"LOWER": "LEGS", "UPPER": "ARMS"}
_FACES: Final = {"FACS": "faceFacs", "LEXICALIZED": "faceLexeme"}


def modernize_block(tree: Tree) -> None:
    """Rewrites the attributes of a block, or of a use of a procedure, as BML 1.0 and BMLA, in place.

    ``scheduling`` is the composition.
    """
    _rename_points(tree)
    if "scheduling" in tree.attrib and "composition" not in tree.attrib:
        tree.set("composition", str(tree.attrib.pop("scheduling")))


def modernize(tree: Tree, source: BlockSource) -> None:
    """Rewrites a behavior or constraint as BML 1.0, in place.

    Raises:
        RealizerError: ``bad-attribute``: BML 1.0 has no equivalent.
    """
    _rename_points(tree)
    rewrite = _REWRITES.get(name_of(tree))
    if rewrite is not None:
        rewrite(tree, source)


def _head(tree: Tree, source: BlockSource) -> None:
    _check(tree, "action", ["ROTATION"], source)
    _rename(tree, "rotation", "lexeme", _AXES)
    _rename(tree, "type", "lexeme")
    _rename(tree, "repeats", "repetition")


def _gesture(tree: Tree, source: BlockSource) -> None:
    _rename(tree, "hand", "mode", _HANDS)
    kind = tree.get("type", "").upper()
    if kind == "POINT":
        tree.tag = "pointing"
    if kind in {"POINT", "LEXICALIZED"}:
        del tree.attrib["type"]
    _rename(tree, "type", "lexeme")


def _gaze(tree: Tree, source: BlockSource) -> None:
    _check(tree, "type", ["AT"], source)
    _rename(tree, "modality", "influence", {"LEGS": "WHOLE"})


def _face(tree: Tree, source: BlockSource) -> None:
    if children_of(tree, *_FACES.values()):
        return
    kind = _check(tree, "type", _FACES, source) or ("FACS" if "au" in tree.attrib else "LEXICALIZED")
    tree.tag = _FACES[kind]


def _posture(tree: Tree, source: BlockSource) -> None:
    if "stance" in tree.attrib:
        _add(tree, "stance", {"type": _take(tree, "stance")}, source)
    if "shape" in tree.attrib:
        part = _take(tree, "part", "WHOLEBODY").upper()
        part, shape = _PARTS.get(part, part), _take(tree, "shape").upper()
        lexeme = f"{part}_{shape}" if part in _PARTS.values() else shape
        _add(tree, "pose", {"part": part, "lexeme": lexeme}, source)


def _speech(tree: Tree, source: BlockSource) -> None:
    if tree.get("type", "").lower() == "text/plain":
        del tree.attrib["type"]
    for holder in (tree, *children_of(tree, "text")):
        for mark in children_of(holder, "tm"):
            mark.tag = "sync"
    if not children_of(tree, "text") and (stray_text_of(tree) or children_of(tree, "sync")):
        _wrap_text(tree, source)


def _wrap_text(tree: Tree, source: BlockSource) -> None:
    """Moves the text and its sync points into a ``<text>`` element."""
    inside = [child for child in tree if name_of(child) != "description"]
    written, tree.text = tree.text, None
    text = _add(tree, "text", {}, source)
    text.text = written
    text.extend(inside)


def _synchronize(tree: Tree, source: BlockSource) -> None:
    if "ref" in tree.attrib:
        _add(tree, "sync", {"ref": _take(tree, "ref")}, source)


def _event(tree: Tree, source: BlockSource) -> None:
    """SmartBody's event: the first word of its message is the name, as on its message bus, and the rest the content."""
    name, _, content = _take(tree, "message").partition(" ")
    tree.tag = f"{{{BMLA}}}emit"
    _rename(tree, "stroke", "start")
    if name:
        tree.set("event", name)
        tree.text = content


_REWRITES: Final[Mapping[str, Callable[[Tree, BlockSource], None]]] = {
    "head": _head,
    "gesture": _gesture,
    "gaze": _gaze,
    "face": _face,
    "posture": _posture,
    "speech": _speech,
    "synchronize": _synchronize,
    "event": _event,
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


def _add(tree: Tree, name: str, attributes: dict[str, str], source: BlockSource) -> Tree:
    """A new first child, with the location of its parent."""
    child = etree.Element(name, attributes)
    tree.insert(0, child)
    source.place(child, tree)
    return child
