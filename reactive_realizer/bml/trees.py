"""Names, children and attributes of lxml elements."""

from collections.abc import Collection, Mapping
from types import MappingProxyType
from typing import Final

from lxml import etree

from reactive_realizer.bml.names import BML, BML_EXT, CONTINUOUS, MURML, OWN

Tree = etree._Element
"""An element with its content."""

PARAMETER: Final = "parameter"
"""Name of the element that gives a value to the engine of a behavior (thesis C.1.1)."""


def name_of(tree: Tree) -> str:
    """Its local name."""
    return tree.tag.rpartition("}")[2]  # the tag is in Clark notation; making a QName takes ten times as long


def namespace_of(tree: Tree) -> str:
    """Its namespace; empty if there is none."""
    return tree.tag[1:].rpartition("}")[0]


def is_core(tree: Tree) -> bool:
    """Whether the element is in a namespace of BML 1.0, or in none."""
    return namespace_of(tree) in {"", BML, BML_EXT}


def is_continuous(tree: Tree) -> bool:
    """Whether the element is in a namespace of continuous interaction: BMLA or BMLT."""
    return namespace_of(tree) in CONTINUOUS


def is_part(child: Tree, tree: Tree) -> bool:
    """Whether a child is in the language of its parent: BML 1.0; or continuous interaction, MURML, our own as that is.

    A parameter is in BMLT, and any behavior may contain it.
    """
    if name_of(child) == PARAMETER:
        return is_continuous(child) or is_continuous(tree)
    own = namespace_of(child) == namespace_of(tree) in (MURML, OWN)
    return is_core(child) or own or (is_continuous(child) and is_continuous(tree))


def children_of(tree: Tree, *names: str) -> list[Tree]:
    """The children with these names that are in the language of the element."""
    return [child for child in tree if is_part(child, tree) and name_of(child) in names]


def stray_text_of(tree: Tree) -> str:
    """The text directly inside an element that should have none."""
    return " ".join(f"{tree.text or ''} {' '.join(child.tail or '' for child in tree)}".split())


def names_in(tree: Tree) -> list[str]:
    """The names of the attributes without a namespace, in the order of writing."""
    return [name for name in map(str, tree.keys()) if name[0] != "{"]


def attributes_in(tree: Tree) -> dict[str, str]:
    """The attributes without a namespace, name to value, in the order of writing."""
    return {name: tree.get(name, "") for name in names_in(tree)}


def extensions_of(tree: Tree, known: Collection[str] = ()) -> Mapping[tuple[str, str], str]:
    """The attributes in a namespace, (namespace, local name) to value, except those known by their Clark names."""
    names = [name for name in map(str, tree.keys()) if name[0] == "{" and name not in known]
    return MappingProxyType({_parts(name): tree.get(name, "") for name in names})


def _parts(name: str) -> tuple[str, str]:
    namespace, _, local = name[1:].rpartition("}")
    return namespace, local
