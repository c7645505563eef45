"""Faces of drafts of BML: action units, words, and feelings."""

import re
from typing import Final

from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.draft_attributes import check, name_by_reference
from reactive_realizer.bml.trees import Tree, children_of

_FACES: Final = {"FACS": "faceFacs", "LEXICALIZED": "faceLexeme"}
_FEELINGS: Final = {
    "HAPPY": "JOY",
    "SAD": "SADNESS",
    "ANGRY": "ANGER",
    "AFRAID": "FEAR",
    "DISGUSTED": "DISGUST",
    "SURPRISED": "SURPRISE",
    "SCEPTICAL": "RAISE_LEFT_BROW",
    "NEUTRAL": "NEUTRAL",
}
"""Types of faces (EMBOTS) -> lexemes."""
_SIDED: Final = re.compile("([0-9]+)_(left|right|both)", re.IGNORECASE)


def modernize_face(tree: Tree, source: BlockSource) -> None:
    """Rewrites a face as one of BML 1.0, in place.

    Raises:
        RealizerError: ``bad-attribute``: its type is unknown.
    """
    for lexeme in children_of(tree, "lexeme"):
        lexeme.tag = _FACES["LEXICALIZED"]
    parts = children_of(tree, *_FACES.values())
    for part in parts or (tree,):
        _split_side(part)
    if parts:
        return
    feeling = _FEELINGS.get(tree.get("type", "").upper())
    if feeling:
        tree.set("type", "LEXICALIZED")
        tree.set("lexeme", feeling)
    kind = check(tree, "type", _FACES, source) or ("FACS" if "au" in tree.attrib else "LEXICALIZED")
    tree.tag = _FACES[kind]
    if kind == "LEXICALIZED":
        name_by_reference(tree)


def _split_side(tree: Tree) -> None:
    """Rewrites an action unit with a side, such as ``1_left``."""
    found = _SIDED.fullmatch(tree.get("au", ""))
    if found is not None and "side" not in tree.attrib:
        tree.set("au", found[1])
        tree.set("side", found[2])
