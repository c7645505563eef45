"""Documents older than BML 1.0: blocks without an id, and blocks inside elements of other languages."""

from collections.abc import Iterable, Iterator
from typing import Final

from lxml import etree

from reactive_realizer.bml.block import CAST, Problem
from reactive_realizer.bml.faults import LeftOut, NoBlock
from reactive_realizer.bml.names import BLOCK, SBM
from reactive_realizer.bml.trees import Tree, name_of, namespace_of
from reactive_realizer.bml.xml_roots import Root
from reactive_realizer.errors import Fault

_ACT: Final = "act"
_WRAPPERS: Final = frozenset({"fml-apml", _ACT})
"""Elements around blocks: of Greta, with its intentions (FML) beside them, and of SmartBody."""
_DRAFTS: Final = frozenset(
    {"http://www.mindmakers.org/projects/BML", "gretaNameSpace", "GretaNameSpace", "VIBNameSpace"}
)
"""The namespaces in which Greta writes its draft of BML, and what it adds to it."""
_SMARTBODY, _SBM = "{http://ict.usc.edu}", f"{{{SBM}}}"
"""The namespace that components of the Virtual Human Toolkit declare for SmartBody's additions, and ours for them."""
_PARTICIPANT: Final = "participant"
"""The element of SmartBody that says who plays an act, and to whom it is addressed."""
_ACTOR: Final = "actor"
_PLANNED: Final = frozenset({_PARTICIPANT, "fml", "turn"})
"""Elements of an act that say who plays it, or what its blocks were planned from: SmartBody plays nothing of them."""
_CAST: Final = f"{{{CAST[0]}}}{CAST[1]}"


def rename_elements(block: Tree) -> None:
    """Rewrite the names of a draft, in place: those in capital letters, and in the namespaces of other systems."""
    if namespace_of(block) in {"", *_DRAFTS}:
        for each in block.iter("*"):
            if namespace_of(each) in _DRAFTS:
                each.tag = name_of(each)
            if each.tag.isupper():  # EMBOTS
                each.tag = each.tag.lower()
            each.tag = each.tag.replace(_SMARTBODY, _SBM)
            for name in [name for name in map(str, each.keys()) if name.startswith(_SMARTBODY)]:
                each.set(name.replace(_SMARTBODY, _SBM), each.attrib.pop(name))


class BlockNames:
    """Gives ids to the blocks of a document that have none, and their character if the document has a request for it.

    Args:
        name: of the document.
        agent: who is requested to play it; empty if nothing says so.
    """

    def __init__(self, name: str, agent: str = "") -> None:
        self._name = name
        self._agent = agent
        self._given = 0

    def give(self, block: Tree) -> None:
        """Give a block its character, and one of a draft an id if it has none."""
        if self._agent and _is_block(block):
            block.set(_CAST, self._agent)
        if namespace_of(block) or not _is_block(block) or block.get("id") is not None:
            return
        self._given += 1
        block.set("id", self._name if self._given == 1 else f"{self._name}_{self._given}")


def unwrapped(roots: Iterable[Root | Problem]) -> Iterator[Root | Problem]:
    """The top-level elements of a document, with the blocks inside a wrapper in its place."""
    for root in roots:
        if isinstance(root, Problem) or namespace_of(root.tree) or name_of(root.tree) not in _WRAPPERS:
            yield root
        else:
            yield from _inside(root)


def _inside(wrapper: Root) -> Iterator[Root | Problem]:
    """The blocks in a wrapper; the first one has the notes about what is left out."""
    wrapper = _with_block(wrapper)
    blocks = [child for child in wrapper.tree if _is_block(child)]
    participants = [child for child in wrapper.tree if name_of(child) == _PARTICIPANT]
    actor = next((each.get("id", "") for each in participants if each.get("role", _ACTOR) == _ACTOR), "")
    unplayed = _PLANNED if name_of(wrapper.tree) == _ACT else frozenset()
    others = (child for child in wrapper.tree if not _is_block(child) and name_of(child) not in unplayed)
    left_out = [child for child in others if len(child) + len(child.attrib)]
    notes: list[Fault] = []
    if left_out:
        place = wrapper.locations[left_out[0]]
        fault = LeftOut(elements=tuple(dict.fromkeys(map(name_of, left_out))), parent=name_of(wrapper.tree))
        notes.append(fault.located(place.line, place.column))
    if not blocks:
        place = wrapper.locations[wrapper.tree]
        yield Problem(NoBlock().located(place.line, place.column), BLOCK)
    for number, block in enumerate(blocks):
        if actor:
            block.set(_CAST, actor)
        yield Root(block, wrapper.locations, tuple(notes) if number == 0 else ())


def _with_block(wrapper: Root) -> Root:
    """A wrapper with a block: behaviors that stand directly in an act are moved into one."""
    tree = wrapper.tree
    behaviors = [child for child in tree if name_of(child) not in _PLANNED]
    if name_of(tree) != _ACT or not behaviors or any(map(_is_block, behaviors)):
        return wrapper
    block = etree.SubElement(tree, BLOCK)
    block.extend(behaviors)
    return Root(tree, {**wrapper.locations, block: wrapper.locations[tree]}, wrapper.notes)


def _is_block(tree: Tree) -> bool:
    return name_of(tree).lower() == "bml"
