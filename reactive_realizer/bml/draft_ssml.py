"""SSML among the words of a speech, as SmartBody reads it. In BML 1.0, it stands in a description of the speech."""

from copy import deepcopy
from typing import Final

from lxml import etree

from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.ssml_elements import SSML
from reactive_realizer.bml.trees import Tree, name_of

_ABOUT_WORDS: Final = ("break", "emphasis", "prosody", "say-as", "sub", "phoneme", "p", "s")
_NAMES: Final = {"text": "speak", "sync": "mark", "tm": "mark"}
"""Elements of a text -> those of SSML that mean the same."""


def describe_ssml(tree: Tree, text: Tree, source: BlockSource) -> None:
    """Describes a speech with the SSML among its words, if there is any; the words and marks of its text stay.

    Args:
        tree: the speech.
        text: its element with the words and marks.
        source: its block.
    """
    if next(text.iter(*_ABOUT_WORDS), None) is None:
        return
    speak = deepcopy(text)
    speak.tail = None
    for copy, written in zip(list(speak.iter("*")), text.iter("*"), strict=True):
        source.place(copy, written)
        name = _NAMES.get(name_of(copy), name_of(copy))
        copy.tag = f"{{{SSML}}}{name}"
        if "id" in copy.attrib and name == "mark":
            copy.set("name", str(copy.attrib.pop("id")))
    source.insert(tree, "description", {"priority": "0", "type": "application/ssml+xml"}).append(speak)
    etree.strip_tags(text, *_ABOUT_WORDS)
