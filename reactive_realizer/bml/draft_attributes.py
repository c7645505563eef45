"""Attributes of drafts of BML, rewritten as those of BML 1.0."""

from collections.abc import Collection, Mapping
from types import MappingProxyType

from reactive_realizer.bml.behaviors import REFERENCE
from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.trees import Tree
from reactive_realizer.bml.value_faults import UnknownWord
from reactive_realizer.errors import RealizerError


def rename(tree: Tree, old: str, new: str, words: Mapping[str, str] = MappingProxyType({})) -> None:
    """Renames an attribute and its word; if the new attribute exists too, the reader reports the old one."""
    if old in tree.attrib and new not in tree.attrib:
        value = take(tree, old)
        tree.set(new, words.get(value.upper(), value))


def take(tree: Tree, name: str, default: str = "") -> str:
    """Removes an attribute, and returns its value."""
    return str(tree.attrib.pop(name, default))


def check(tree: Tree, name: str, words: Collection[str], source: BlockSource) -> str:
    """Removes an attribute that BML 1.0 does not have; returns its word in capitals, empty if it is not written.

    Raises:
        RealizerError: ``bad-attribute``: none of the words.
    """
    value = take(tree, name)
    if value and value.upper() not in words:
        raise source.bad_attribute(tree, name, value, RealizerError(UnknownWord(word=value, known=tuple(words))))
    return value.upper()


def name_by_reference(tree: Tree) -> None:
    """Takes the word of a behavior from the reference in its description (Greta), such as ``beat=Circle``.

    Beside a lexeme, it is a reference: of several movements with this lexeme, it selects one.
    """
    references = ((each.text or "").strip() for each in tree.iterfind("description/reference"))
    reference = next(filter(None, references), "")
    word = reference.rpartition("=")[2].strip()
    if word and "lexeme" not in tree.attrib:
        tree.set("lexeme", word)
    if word:
        refer(tree, reference, tree.get("lexeme", ""))


def refer(tree: Tree, reference: str, lexeme: str) -> None:
    """Writes a reference that says more than the lexeme, unless there is one."""
    name = f"{{{REFERENCE[0]}}}{REFERENCE[1]}"
    if reference.lower() != lexeme.lower() and name not in tree.attrib:
        tree.set(name, reference)
