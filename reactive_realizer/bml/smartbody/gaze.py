"""Gazes of SmartBody: which joints turn, in which direction from the target, and how fast."""

import re
from typing import Final

from reactive_realizer.bml.attribute_types import Float
from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.smartbody.attributes import (
    drop,
    fade_out,
    give_back,
    left_out,
    rename,
    set_parameter,
    take,
    take_number,
    take_time,
    tie,
)
from reactive_realizer.bml.smartbody.joints import target_named
from reactive_realizer.bml.sync_ref import NUMBER
from reactive_realizer.bml.trees import Tree
from reactive_realizer.bml.vocabulary import Influence, OffsetDirection
from reactive_realizer.errors import Fault, RealizerError

_KEYS: Final = {
    "BACK": "back",
    "LUMBAR": "back",
    "CHEST": "chest",
    "THORAX": "chest",
    "NECK": "neck",
    "CERVICAL": "neck",
    "HEAD": "head",
    "SKULL": "head",
    "CRANIAL": "head",
    "EYES": "eyes",
    "OPTICAL": "eyes",
}
"""Joints that SmartBody turns to a target, and the groups of joints of a gaze here."""
_INFLUENCES: Final = {
    "back": Influence.WAIST,
    "chest": Influence.SHOULDER,
    "neck": Influence.HEAD,
    "head": Influence.HEAD,
    "eyes": Influence.EYES,
}
"""Groups of joints, from the bottom to the top, and the part of the body that turns if they are the lowest."""
_AROUND: Final = (
    OffsetDirection.UP,
    OffsetDirection.UPRIGHT,
    OffsetDirection.RIGHT,
    OffsetDirection.DOWNRIGHT,
    OffsetDirection.DOWN,
    OffsetDirection.DOWNLEFT,
    OffsetDirection.LEFT,
    OffsetDirection.UPLEFT,
)
"""Directions from the target, clockwise, each 45 degrees from the one before."""
_POLAR: Final = re.compile(rf"POLAR\s+([-+]?{NUMBER})", re.IGNORECASE)
_USUAL_ANGLE: Final = "30"
_FASTEST: Final = 10_000.0
_MOST_ROLL: Final = 45.0
_LONGEST: Final = 60.0


def adapt_gaze(tree: Tree, source: BlockSource) -> list[Fault]:
    """Rewrites a gaze, in place, and returns the faults of what is left out.

    A later gaze replaces one that persists, whatever their handles are. Turns are always smooth.
    """
    _choose_joints(tree, source)
    _offset(tree)
    rename(tree, "target-pos", "target")
    if "target" in tree.attrib:
        tree.set("target", target_named(tree.get("target", "")))
    faults = _tie_times(tree, source)
    _limit_speed(tree, source)
    roll = take_number(tree, "roll", source, -_MOST_ROLL, _MOST_ROLL)
    if roll:
        set_parameter(tree, "roll", f"{roll:g}", source)
    drop(tree, "handle", "joint-smooth", "speed-smoothing")
    return [*faults, *left_out(tree, source)]


def _tie_times(tree: Tree, source: BlockSource) -> list[Fault]:
    """Ties the points of a gaze as its fades say; the fault of a fade that is too long.

    A fade out takes the gaze back before its end or, without a target, to the viewer. Without an end, a gaze at a
    target persists; SmartBody would fade it out while it comes.
    """
    aimed = "target" in tree.attrib
    for name in ("time-hint", "fade-in") if aimed else ("fade-out",):
        if time := take_time(tree, name, source, _LONGEST):
            tie(tree, "ready", "start", time)
    if aimed and "end" in tree.attrib and (time := take_time(tree, "fade-out", source, _LONGEST)):
        return fade_out(tree, "fade-out", time, source)
    return []


def _choose_joints(tree: Tree, source: BlockSource) -> None:
    """From the lowest to the highest of the joints that are named, as SmartBody does.

    The highest one points at the target, which is also the priority joint of SmartBody unless it says otherwise.
    """
    keys, priority = take(tree, "joint-range").upper().split(), take(tree, "priority-joint")
    named = [_KEYS[key] for key in keys if key in _KEYS]
    if keys and not named:
        give_back(tree, "joint-range", " ".join(keys))
    if priority and _KEYS.get(priority.upper()) != max(named or _INFLUENCES, key=list(_INFLUENCES).index):
        give_back(tree, "priority-joint", priority)
    if not named or "influence" in tree.attrib:
        return
    groups = list(_INFLUENCES)
    places = [groups.index(group) for group in named]
    tree.set("influence", _INFLUENCES[groups[min(places)]])
    for group in groups[max(places) + 1 :]:
        set_parameter(tree, group, "0", source)


def _limit_speed(tree: Tree, source: BlockSource) -> None:
    """The first number is the speed of the head, of two the second one that of the eyes; of three, two of the head."""
    text = take(tree, "joint-speed")
    if not text:
        return
    try:
        speeds = [Float(0.0, _FASTEST).read(speed, source.limits) for speed in text.split()]
    except RealizerError as refused:
        raise source.bad_attribute(tree, "sbm:joint-speed", text, refused) from None
    head = sum(speeds[: max(1, len(speeds) - 1)])
    if head > 0.0:
        set_parameter(tree, "speed", f"{min(max(head, 1.0), _FASTEST):g}", source)


def _offset(tree: Tree) -> None:
    direction, angle = take(tree, "direction"), take(tree, "angle")
    if not direction:
        return
    polar = _POLAR.fullmatch(direction)
    tree.set("offsetDirection", _AROUND[round(float(polar[1]) % 360.0 / 45.0) % 8] if polar else direction)
    tree.set("offsetAngle", angle or _USUAL_ANGLE)
