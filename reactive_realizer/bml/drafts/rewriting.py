"""What the drafts wrote otherwise, element by element."""

from collections.abc import Callable, Collection, Mapping
from types import MappingProxyType
from typing import Final

from lxml import etree

from reactive_realizer.bml.drafts.spelling import SYNC_POINTS
from reactive_realizer.bml.source import Source
from reactive_realizer.bml.trees import Tree, children_of, name_of, stray_text_of
from reactive_realizer.errors import error

_Words = Mapping[str, str]

_AXES: Final = {"X": "NOD", "Y": "SHAKE", "Z": "TILT"}
_HANDS: Final = {"LEFT": "LEFT_HAND", "RIGHT": "RIGHT_HAND", "BOTH": "BOTH_HANDS"}
_PARTS: Final = {"LOWER": "LEGS", "UPPER": "ARMS"}
_FACES: Final = {"FACS": "faceFacs", "LEXICALIZED": "faceLexeme"}


def modernize(tree: Tree, source: Source) -> None:
    """Rewrite a behavior or constraint of a draft as BML 1.0, in place.

    Raises:
        RealizerError: ``bad-attribute``: it asks for something that BML 1.0 cannot say.
    """
    for old, new in SYNC_POINTS.items():
        _rename(tree, old, new)
    rewrite = _REWRITES.get(name_of(tree))
    if rewrite is not None:
        rewrite(tree, source)


def _head(tree: Tree, source: Source) -> None:
    _check(tree, "action", ["ROTATION"], source)
    _rename(tree, "rotation", "lexeme", _AXES)
    _rename(tree, "type", "lexeme")
    _rename(tree, "repeats", "repetition")


def _gesture(tree: Tree, source: Source) -> None:
    _rename(tree, "hand", "mode", _HANDS)
    kind = tree.get("type", "").upper()
    if kind == "POINT":
        tree.tag = "pointing"
    if kind in {"POINT", "LEXICALIZED"}:
        del tree.attrib["type"]
    _rename(tree, "type", "lexeme")


def _gaze(tree: Tree, source: Source) -> None:
    _check(tree, "type", ["AT"], source)
    _rename(tree, "modality", "influence", {"LEGS": "WHOLE"})


def _face(tree: Tree, source: Source) -> None:
    if children_of(tree, *_FACES.values()):
        return
    kind = _check(tree, "type", _FACES, source) or ("FACS" if "au" in tree.attrib else "LEXICALIZED")
    tree.tag = _FACES[kind]


def _posture(tree: Tree, source: Source) -> None:
    if "stance" in tree.attrib:
        _add(tree, "stance", {"type": _take(tree, "stance")}, source)
    if "shape" in tree.attrib:
        part = _take(tree, "part", "WHOLEBODY").upper()
        part, shape = _PARTS.get(part, part), _take(tree, "shape").upper()
        lexeme = f"{part}_{shape}" if part in _PARTS.values() else shape
        _add(tree, "pose", {"part": part, "lexeme": lexeme}, source)


def _speech(tree: Tree, source: Source) -> None:
    if tree.get("type", "").lower() == "text/plain":
        del tree.attrib["type"]
    for holder in (tree, *children_of(tree, "text")):
        for mark in children_of(holder, "tm"):
            mark.tag = "sync"
    if not children_of(tree, "text") and (stray_text_of(tree) or children_of(tree, "sync")):
        _wrap_text(tree, source)


def _wrap_text(tree: Tree, source: Source) -> None:
    """Put what is said and the sync points in it into a ``<text>``."""
    inside = [child for child in tree if name_of(child) != "description"]
    said, tree.text = tree.text, None
    text = _add(tree, "text", {}, source)
    text.text = said
    text.extend(inside)


def _synchronize(tree: Tree, source: Source) -> None:
    if "ref" in tree.attrib:
        _add(tree, "sync", {"ref": _take(tree, "ref")}, source)


_REWRITES: Final[Mapping[str, Callable[[Tree, Source], None]]] = {
    "head": _head,
    "gesture": _gesture,
    "gaze": _gaze,
    "face": _face,
    "posture": _posture,
    "speech": _speech,
    "synchronize": _synchronize,
}


def _rename(tree: Tree, old: str, new: str, words: _Words = MappingProxyType({})) -> None:
    """Have an attribute bear its name of BML 1.0, unless that is there too: then the reader names the old one."""
    if old in tree.attrib and new not in tree.attrib:
        value = _take(tree, old)
        tree.set(new, words.get(value.upper(), value))


def _take(tree: Tree, name: str, default: str = "") -> str:
    return str(tree.attrib.pop(name, default))


def _check(tree: Tree, name: str, words: Collection[str], source: Source) -> str:
    """Take out an attribute whose other words BML 1.0 has nothing for; its word, or nothing where it is not written."""
    value = _take(tree, name)
    if value and value.upper() not in words:
        raise source.bad(tree, name, value, error("unknown-word", known=", ".join(words)))
    return value.upper()


def _add(tree: Tree, name: str, attributes: dict[str, str], source: Source) -> Tree:
    """A new first child that stands where its parent does."""
    child = etree.Element(name, attributes)
    tree.insert(0, child)
    source.place(child, tree)
    return child
