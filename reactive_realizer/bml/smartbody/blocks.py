"""Behaviors of SmartBody that are several here, or one together, in a block before its behaviors are read."""

import re
from collections.abc import Callable, Container, Iterable, Iterator
from itertools import groupby, islice, pairwise
from typing import Final

from lxml import etree

from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.names import BMLA, SBM
from reactive_realizer.bml.smartbody.attributes import AT_ONCE, WITHOUT_EFFECT, drop, set_parameter, take, value_of
from reactive_realizer.bml.smartbody.gestures import AXES, UPDATE, ends
from reactive_realizer.bml.trees import Tree, name_of, namespace_of

_JOINTS: Final = "joint-range"
_WITHIN_REACH: Final = "0.4"
"""Distance from a target to which a character walks to reach it, m."""
_MOST: Final = 50
"""Limit on the behaviors that one is split into, beside those of a block."""
_NUMBER: Final = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)")
_OF_NOISE: Final = tuple(
    name for plain in ("scale", "frequency", "enable", "start", "end") for name in (plain, f"{{{SBM}}}{plain}")
)
"""Attributes that the noise of each joint has."""
_OF_EACH_WAY: Final = ("speed", "manner")
"""Attributes of a way along several points that the way to each of them has."""
_CLIPS: Final = frozenset({"animation", "states", "blend"})
_BLENDS: Final = frozenset({"states", "blend"})
_SCHEDULE: Final = "schedule-mode"
_QUEUED: Final = "queued"
_OF_ONE_FACE: Final = frozenset({"type", "au", "side", "amount"})
"""Attributes in which faces differ that are one."""


def regroup(block: Tree, source: BlockSource) -> None:
    """Rewrites the behaviors of a draft that do not correspond to one behavior here each, in place.

    - Action units with the same times become one face, so that they move the mouth together.
    - Noise of several joints becomes noise of each, and noise in the hold of a gesture a behavior of its own.
    - An update of a blend before it becomes changes of the parameters of that one.
    - A clip that is queued starts at the end of the one before it.
    - A reach with a walk becomes a walk and a reach, and a way along several points becomes several ways.
    """
    room = source.limits.behaviors_per_block
    for holder in [block, *block.iter("required")]:
        _join_faces(holder, source)
        _update_blends(holder, source)
        _queue_clips(holder, source)
        for tree in list(holder):
            split = _SPLITS.get(name_of(tree))
            if split is not None and namespace_of(tree) in {"", SBM}:
                _give_id(tree, source)
                for added in islice(split(tree, source), max(room, 0)):
                    room -= 1  # what is over the limit is refused anyway
                    source.place(added, tree)
                    _give_id(added, source)
                    tree.addprevious(added)  # behaviors are planned in this order


def _give_id(tree: Tree, source: BlockSource) -> None:
    if not tree.get("id"):
        source.ids.give(tree)


def _join_faces(holder: Tree, source: BlockSource) -> None:
    for face in holder.iterchildren("face"):
        drop(face, *WITHOUT_EFFECT)
    for times, group in groupby(list(holder), _times_of_face):
        faces = list(group)
        if times is None or len(faces) < 2:
            continue
        first = faces[0]
        whole = etree.Element("face", {**dict(times), "amount": "1"})
        source.place(whole, first)
        first.addprevious(whole)
        for face in faces:
            for name, _ in times:
                del face.attrib[name]
            face.attrib.pop("type", "")
            face.tag = "faceFacs"
            whole.append(face)  # with the text behind it
        whole.tail, faces[-1].tail = faces[-1].tail, None


def _update_blends(holder: Tree, source: BlockSource) -> None:
    """Has each update of a blend change the parameters of the last blend before it that has its name."""
    played: dict[str, Tree] = {}
    for tree in _clips(holder, _BLENDS):
        name, given = value_of(tree, "name"), {axis: value_of(tree, axis) for axis in AXES}
        if value_of(tree, "mode").lower() != UPDATE:
            played[name] = tree
        elif name in played and any(given.values()) and all(map(_NUMBER.fullmatch, filter(None, given.values()))):
            _give_id(played[name], source)
            _give_id(tree, source)
            times = _copied(tree, ("id", "start"))
            for axis in (axis for axis, value in given.items() if value):
                attributes = {"target": played[name].get("id", ""), "paramId": axis, **times}
                change = etree.Element(f"{{{BMLA}}}parametervaluechange", attributes)
                etree.SubElement(change, f"{{{BMLA}}}trajectory", {"type": "instant", "targetValue": given[axis]})
                for each in change.iter():
                    source.place(each, tree)
                tree.addprevious(change)
                times.pop("id", None)
            holder.remove(tree)


def _queue_clips(holder: Tree, source: BlockSource) -> None:
    """Ties the start of each clip that is queued to the end of the one before it, if that one ends of itself.

    With a start of its own, it comes after both.
    """
    for before, clip in pairwise(_clips(holder, _CLIPS)):
        if value_of(clip, _SCHEDULE).lower() == _QUEUED and ends(before):
            drop(clip, _SCHEDULE)
            _give_id(before, source)
            end = f"{before.get('id')}:end"
            if clip.get("start", "0").strip() in AT_ONCE:
                clip.set("start", end)
            elif source.holds_ref(clip, "start"):  # what is no reference is left to the reader, which refuses it
                _start_after(clip, (end, str(clip.attrib.pop("start"))), source)


def _clips(holder: Tree, names: Container[str]) -> list[Tree]:
    """The clips of a block with one of some names."""
    return [tree for tree in holder if name_of(tree) in names and namespace_of(tree) in {"", SBM}]


def _start_after(tree: Tree, references: Iterable[str], source: BlockSource) -> None:
    """Adds constraints to a block after which a behavior starts as early as possible after several points."""
    _give_id(tree, source)
    constraint = etree.Element("constraint")
    tree.addnext(constraint)
    for reference in references:
        after = etree.SubElement(constraint, "after", {"ref": reference})
        sync = etree.SubElement(after, "sync", {"ref": f"{tree.get('id')}:start"})
        for each in (constraint, after, sync):
            source.place(each, tree)


def _times_of_face(tree: Tree) -> tuple[tuple[str, str], ...] | None:
    """The attributes that action units share if they are one face; None for other behaviors, and those with an id."""
    if namespace_of(tree) or name_of(tree) != "face" or "id" in tree.attrib or "au" not in tree.attrib or len(tree):
        return None
    return tuple(sorted((str(name), str(value)) for name, value in tree.items() if name not in _OF_ONE_FACE))


def _copied(tree: Tree, names: Iterable[str]) -> dict[str, str]:
    return {name: tree.get(name, "") for name in names if name in tree.attrib}


def _split_noise(tree: Tree, source: BlockSource) -> Iterator[Tree]:
    joints = take(tree, _JOINTS).split()[:_MOST]
    for joint in joints[1:]:
        yield etree.Element(tree.tag, {**_copied(tree, _OF_NOISE), "joint": joint})
    if joints:
        tree.set("joint", joints[0])


def _split_gesture(tree: Tree, source: BlockSource) -> Iterator[Tree]:
    """The noise of some joints while the hands hold after the stroke, if they do."""
    joints, scale, frequency = take(tree, _JOINTS).split()[:_MOST], take(tree, "scale"), take(tree, "frequency")
    if joints and ("relax" in tree.attrib or "poststroke_hold" in tree.attrib):
        times = {"start": f"{tree.get('id')}:strokeEnd", "end": f"{tree.get('id')}:relax"}
        for joint in joints:
            values = {"joint": joint, "scale": scale, "frequency": frequency}
            yield etree.Element(
                f"{{{SBM}}}noise", {**times, **{name: value for name, value in values.items() if value}}
            )


def _split_reach(tree: Tree, source: BlockSource) -> Iterator[Tree]:
    """The walk to the target of a reach."""
    target = tree.get("target", "") or tree.get(f"{{{SBM}}}target-pos", "")
    if take(tree, "use-locomotion").lower() == "true" and target:
        walk = etree.Element("locomotion", {"target": target})
        source.place(walk, tree)
        set_parameter(walk, "distance", _WITHIN_REACH, source)
        if "start" in tree.attrib:
            walk.set("start", str(tree.attrib.pop("start")))
        _give_id(walk, source)
        tree.set("start", f"{walk.get('id')}:end")
        yield walk


def _split_way(tree: Tree, source: BlockSource) -> Iterator[Tree]:
    """The ways to all points of a path but the last one."""
    numbers = tree.get("target", "").split()
    if not 4 <= len(numbers) <= 2 * _MOST or len(numbers) % 2 or not all(map(_NUMBER.fullmatch, numbers)):
        return
    *points, last = (f"{x} {z}" for x, z in zip(numbers[::2], numbers[1::2], strict=True))
    tree.set("target", last)
    start = take(tree, "start")
    attributes = _copied(tree, _OF_EACH_WAY)
    for point in points:
        way = etree.Element(tree.tag, {**attributes, "target": point})
        if start:
            way.set("start", start)
        _give_id(way, source)
        start = f"{way.get('id')}:end"
        yield way
    tree.set("start", start)


_SPLITS: Final[dict[str, Callable[[Tree, BlockSource], Iterator[Tree]]]] = {
    "noise": _split_noise,
    "gesture": _split_gesture,
    "reach": _split_reach,
    "locomotion": _split_way,
}
