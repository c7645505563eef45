"""The text of a speech and the sync points in it."""

import re
from collections.abc import Iterator
from typing import Any

from reactive_realizer.bml.attributes import attributes_of
from reactive_realizer.bml.behaviors import Mark, Speech
from reactive_realizer.bml.source import Source
from reactive_realizer.bml.trees import Tree, children_of, is_core, name_of
from reactive_realizer.errors import Fault, RealizerError


def read_speech(tree: Tree, source: Source, notes: list[Fault]) -> dict[str, Any]:
    """The fields of a speech that its ``<text>`` says: text and marks.

    Raises:
        RealizerError: there is not one text, it is too long, or a mark has no id of its own.
    """
    spoken = _only_text(tree, source)
    notes += source.unread_children(spoken, ["sync"])
    text = ""
    places: dict[str, int] = {}
    for piece in _pieces(spoken):
        if isinstance(piece, str):
            text = _joined(text, piece)
            _check_length(text, spoken, source)
        else:
            places[_new_id(piece, places, source)] = len(text)
    text = text.rstrip()
    marks = tuple(Mark(id=name, char_index=min(at, len(text))) for name, at in places.items())
    return {"text": text, "marks": marks}


def _only_text(tree: Tree, source: Source) -> Tree:
    texts = children_of(tree, "text")
    if not texts:
        raise RealizerError(source.fault(tree, "missing-element", children="<text>"))
    if len(texts) > 1:
        raise RealizerError(source.fault(texts[1], "repeated-element", parent=name_of(tree)))
    return texts[0]


def _pieces(spoken: Tree) -> Iterator[str | Tree]:
    """Text and inline sync points in their order; of other elements the text alone."""
    yield spoken.text or ""
    for child in spoken:
        yield child if is_core(child) and name_of(child) == "sync" else "".join(map(str, child.itertext()))
        yield child.tail or ""


def _joined(text: str, piece: str) -> str:
    """With single spaces, none at the beginning."""
    spaced = re.sub(r"\s+", " ", piece)
    return text + (spaced.lstrip() if not text or text.endswith(" ") else spaced)


def _check_length(text: str, spoken: Tree, source: Source) -> None:
    limit = source.limits.utterance_characters
    if len(text.rstrip()) > limit:
        raise RealizerError(source.fault(spoken, "utterance-too-long", limit=limit))


def _new_id(sync: Tree, taken: dict[str, int], source: Source) -> str:
    name = str(source.values(sync, attributes_of(Mark))["id"])
    if name in taken or name in Speech.SYNC_POINTS:
        raise RealizerError(source.fault(sync, "duplicate-id", id=name))
    return name
