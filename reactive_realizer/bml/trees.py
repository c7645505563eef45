"""Small readings of lxml trees, and quotations from them."""

from collections.abc import Collection, Iterable, Mapping
from types import MappingProxyType
from typing import Final

from lxml import etree

from reactive_realizer.bml.names import BML, BML_EXT, CONTINUOUS

Tree = etree._Element
"""An element with what is inside it."""

PARAMETER: Final = "parameter"
"""The element that tells a value to what plays a behavior (thesis C.1.1)."""

_MOST_QUOTED: Final = 60
_MOST_LISTED: Final = 20


def shown(text: str) -> str:
    """A text of the document as a message quotes it: on one line, cut where it is long."""
    line = " ".join(text.split())
    return line if len(line) <= _MOST_QUOTED else f"{line[:_MOST_QUOTED]}..."


def listed(names: Iterable[str]) -> str:
    """Names as a message lists them, cut where there are many."""
    distinct = list(dict.fromkeys(names))
    more = ["..."] if len(distinct) > _MOST_LISTED else []
    return ", ".join([*map(shown, distinct[:_MOST_LISTED]), *more]) or "none"


def name_of(tree: Tree) -> str:
    """Its local name."""
    return tree.tag.rpartition("}")[2]  # a tag is in Clark notation, and a QName of it costs ten times as much


def namespace_of(tree: Tree) -> str:
    """Its namespace, empty where there is none."""
    return tree.tag[1:].rpartition("}")[0]


def is_core(tree: Tree) -> bool:
    """Whether the element is BML's own, or of no namespace."""
    return namespace_of(tree) in {"", BML, BML_EXT}


def is_continuous(tree: Tree) -> bool:
    """Whether the element is of continuous interaction: BMLA's or BMLT's."""
    return namespace_of(tree) in CONTINUOUS


def is_part(child: Tree, tree: Tree) -> bool:
    """Whether a child is of the language of its parent: core, or of continuous interaction as its parent is.

    A parameter is BMLT's, and may stand in any behavior.
    """
    if name_of(child) == PARAMETER:
        return is_continuous(child) or is_continuous(tree)
    return is_core(child) or (is_continuous(child) and is_continuous(tree))


def children_of(tree: Tree, *names: str) -> list[Tree]:
    """The parts of these names directly inside."""
    return [child for child in tree if is_part(child, tree) and name_of(child) in names]


def stray_text_of(tree: Tree) -> str:
    """The text directly inside an element where none is meant."""
    return " ".join(f"{tree.text or ''} {' '.join(child.tail or '' for child in tree)}".split())


def names_in(tree: Tree) -> list[str]:
    """The names of the attributes that have no namespace, in order of writing."""
    return [name for name in map(str, tree.keys()) if name[0] != "{"]


def attributes_in(tree: Tree) -> dict[str, str]:
    """The attributes that have no namespace, in order of writing."""
    return {name: tree.get(name, "") for name in names_in(tree)}


def extensions_of(tree: Tree, known: Collection[str] = ()) -> Mapping[tuple[str, str], str]:
    """The attributes that have a namespace, but for some in Clark notation: (namespace, local name) to value."""
    names = [name for name in map(str, tree.keys()) if name[0] == "{" and name not in known]
    return MappingProxyType({_parts(name): tree.get(name, "") for name in names})


def _parts(name: str) -> tuple[str, str]:
    namespace, _, local = name[1:].rpartition("}")
    return namespace, local
