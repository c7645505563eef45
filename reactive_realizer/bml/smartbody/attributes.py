"""Attributes of SmartBody: read, taken out of elements, and written as those of BML 1.0 and its extensions."""

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Final

from lxml import etree

from reactive_realizer.bml.attribute_types import Float
from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.names import BMLT, SBM
from reactive_realizer.bml.smartbody.faults import FadeTooLong, NoCounterpart
from reactive_realizer.bml.sync_ref import SyncRef
from reactive_realizer.bml.trees import PARAMETER, Tree, name_of
from reactive_realizer.errors import Fault, RealizerError

WITHOUT_EFFECT: Final = ("group", "priority", "participant")
"""Attributes that make no difference in SmartBody's motion either: they are for its tools and for generators."""
OTHER_POINTS: Final = ("ready", "strokeStart", "stroke", "strokeEnd", "relax", "stroke_start", "stroke_end")
"""Sync points of behaviors of SmartBody that are read as behaviors with a start and an end only."""
AT_ONCE: Final = frozenset({"0", "0.0"})
"""The time of the start of a block, as scripts write it where they ask for no time."""
_PREFIX: Final = f"{{{SBM}}}"


def value_of(tree: Tree, name: str) -> str:
    """The text of an attribute, written with SmartBody's prefix or without; empty if it is not written."""
    return str(tree.get(_PREFIX + name, "")).strip() or str(tree.get(name, "")).strip()


def take(tree: Tree, name: str) -> str:
    """Removes an attribute, written with SmartBody's prefix or without; its text, empty if it is not written."""
    value = value_of(tree, name)
    for each in (name, _PREFIX + name):
        tree.attrib.pop(each, "")
    return value


def take_number(tree: Tree, name: str, source: BlockSource, low: float, high: float) -> float | None:
    """Removes an attribute that is a number from `low` to `high`; None if it is not written.

    Raises:
        RealizerError: ``bad-attribute``: it is not such a number.
    """
    text = take(tree, name)
    if not text:
        return None
    try:
        return Float(low, high).read(text, source.limits)
    except RealizerError as refused:
        raise source.bad_attribute(tree, name, text, refused) from None


def take_time(tree: Tree, name: str, source: BlockSource, longest: float) -> float | None:
    """Removes an attribute that is a time, s; None if it is not written, or is -1, which is none in SmartBody, or 0.

    Raises:
        RealizerError: ``bad-attribute``: it is not a number from -1 to `longest`.
    """
    time = take_number(tree, name, source, -1.0, longest)
    return time if time is not None and time > 0.0 else None


def give_back(tree: Tree, name: str, value: str) -> None:
    """Writes an attribute again whose value is unknown, so that `left_out` names it."""
    tree.set(f"{_PREFIX}{name}", value)


def drop(tree: Tree, *names: str) -> None:
    """Removes attributes that make no difference here."""
    for name in names:
        take(tree, name)


def rename(tree: Tree, old: str, new: str, words: Mapping[str, str] = MappingProxyType({})) -> None:
    """Writes the value of an attribute of SmartBody as that of another attribute, unless this one exists too."""
    value = take(tree, old)
    if value and new not in tree.attrib:
        tree.set(new, words.get(value.upper(), value))


def set_parameter(tree: Tree, name: str, value: str, source: BlockSource) -> None:
    """Gives a value to a parameter of the motion that plays a behavior."""
    child = etree.SubElement(tree, f"{{{BMLT}}}{PARAMETER}", {"name": name, "value": value})
    source.place(child, tree)


def tie(tree: Tree, point: str, other: str, seconds: float) -> None:
    """Ties a point of a behavior to another one, unless it is tied already.

    Args:
        tree: the behavior, which has an id.
        point: name of the point.
        other: name of the other one.
        seconds: from the other one to the point.
    """
    if point not in tree.attrib:
        tree.set(point, f"{tree.get('id', '')}:{other}{seconds:+g}")


def fade_out(tree: Tree, name: str, seconds: float, source: BlockSource) -> list[Fault]:
    """Ties the relax of a behavior before its end, unless it is tied already; the fault of a fade that is too long.

    It is tied to what the end is tied to, so that if they conflict the end keeps its time.

    Args:
        tree: the behavior, which has an end.
        name: of the attribute with the time of the fade.
        seconds: from the relax to the end.
        source: its block.

    Raises:
        RealizerError: ``bad-attribute``: its start or end is no reference.
    """
    if "relax" in tree.attrib:
        return []
    start = source.ref(tree, "start") if "start" in tree.attrib else SyncRef(None, None, None)
    end = source.ref(tree, "end")
    relax = replace(end, offset=end.offset - seconds)
    if replace(relax, offset=start.offset) == start and relax.offset <= start.offset:
        return [source.located(tree, FadeTooLong(element=name_of(tree), attribute=name, fade=seconds))]
    tree.set("relax", str(relax))
    return []


def left_out(tree: Tree, source: BlockSource, *names: str) -> list[Fault]:
    """One fault for the attributes that have no counterpart here, which are removed.

    Args:
        tree: their element.
        source: its block.
        names: of those without SmartBody's prefix; all with it count.
    """
    plain = [name for name in names if tree.attrib.pop(name, "")]
    own = [name for name in map(str, tree.keys()) if name.startswith(_PREFIX)]
    for name in own:
        del tree.attrib[name]
    attributes = (*plain, *(f"sbm:{name.removeprefix(_PREFIX)}" for name in own))
    return [source.located(tree, NoCounterpart(element=name_of(tree), attributes=attributes))] if attributes else []


def limit_amount(tree: Tree) -> float:
    """Limits an amount to 1, as SmartBody does, and returns it; what is no number is left to the reader."""
    try:
        amount = float(tree.get("amount", "0"))
    except ValueError:
        return 0.0
    if amount > 1.0:
        tree.set("amount", "1")
    return amount
