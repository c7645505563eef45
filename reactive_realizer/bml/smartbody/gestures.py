"""Gestures of SmartBody: clips by name, and classes of gestures with a type, which its gesture maps make clips of."""

from typing import Final

from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.names import BMLT, SBM
from reactive_realizer.bml.smartbody.attributes import (
    AT_ONCE,
    OTHER_POINTS,
    drop,
    left_out,
    set_parameter,
    take,
    take_number,
    take_time,
    tie,
    value_of,
)
from reactive_realizer.bml.smartbody.faults import PlaysOver
from reactive_realizer.bml.smartbody.joints import joint_named
from reactive_realizer.bml.trees import Tree, name_of
from reactive_realizer.errors import Fault

_CLASSES: Final = frozenset({"ADAPTOR", "BEAT", "DEICTIC", "EMBLEM", "ICONIC", "METAPHORIC"})
_LEXEMES: Final = {
    "RHYTHM": "BEAT",
    "CONTRAST": "BEAT",
    "QUESTION": "BEAT",
    "INTENSIFIER_POSITIVE": "BEAT",
    "HERE": "BEAT",
    "CENTER": "BEAT",
    "OBLIGATION": "CHOP",
    "YOU": "OFFER",
    "UNCERTAINTY": "OFFER",
    "INDIFFERENCE": "OFFER",
    "ME": "SELF",
    "WE": "CONDUIT",
    "INCLUSIVITY": "CONTAINER",
    "SURROUND": "CONTAINER",
    "ASIDE": "FLICK",
    "NEGATION": "REFUSE",
    "EMPTY": "REFUSE",
    "STOP": "REFUSE",
    "GREETING": "GREET",
}
"""Types of SmartBody's gesture maps (BehaviorSetGestures), and the lexemes here that are most like their clips."""
_CLIP: Final = f"{{{BMLT}}}keyframe"
_OF_CLIPS: Final = ("style", "emotion", "overlay", "prestroke_hold_idlemotion", "poststroke_hold_idlemotion")
"""Attributes for the choice of clips, and for tracks of motion."""
_AS_HERE: Final = {"overlay": "false", "mode": "schedule", "schedule-mode": "now"}
"""Attributes of clips, and the values with which they ask for what happens here anyway."""
UPDATE: Final = "update"
"""The mode of a blend that changes the mixture of the one that plays."""
_ANIMATION: Final = "animation"
"""The clips that are played once by default; states and blends are loops."""
AXES: Final = "xyz"
"""Parameters of blends."""
_FARTHEST: Final = 1e6
_DURATIONS: Final = (0.01, 600.0)
_NO_DURATION: Final = frozenset({"-1", "-1.0"})
"""The duration that stands for none in SmartBody."""
_SPEEDS: Final = (0.05, 20.0)
_EARLY_POINTS: Final = ("ready", "stroke_start", "strokeStart", "stroke")
_HOLDS: Final = {"prestroke_hold": ("ready", "strokeStart"), "poststroke_hold": ("strokeEnd", "relax")}
_LONGEST_HOLD: Final = 60.0


def adapt_gesture(tree: Tree, source: BlockSource) -> list[Fault]:
    """Rewrites a gesture, in place, and returns the faults of what is left out."""
    _start_as_early_as_possible(tree)
    if "name" in tree.attrib:
        _mix(tree, source)
    faults = left_out(tree, source, *_OF_CLIPS, *AXES)
    if "name" in tree.attrib:
        drop(tree, "lexeme", "type", "mode")
        tree.tag = _CLIP
        return faults
    if tree.get("lexeme", "").upper() in _CLASSES and "type" in tree.attrib:
        kind = take(tree, "type")
        tree.set("lexeme", _LEXEMES.get(kind.upper(), kind))
    for name, (first, last) in _HOLDS.items():
        if hold := take_time(tree, name, source, _LONGEST_HOLD):
            tie(tree, last, first, hold)
    return faults


def adapt_clip(tree: Tree, source: BlockSource) -> list[Fault]:
    """Rewrites an animation, a state or a blend, in place: the clip, or the mix of clips, of its name."""
    _start_as_early_as_possible(tree)
    speed = take_number(tree, "speed", source, *_SPEEDS)
    if speed is not None and speed != 1.0:
        set_parameter(tree, "speed", f"{speed:g}", source)
    for name, value in _AS_HERE.items():
        if value in {tree.get(name, "").lower(), tree.get(f"{{{SBM}}}{name}", "").lower()}:
            drop(tree, name)
    if value_of(tree, "duration") in _NO_DURATION:
        drop(tree, "duration")
    duration = take_number(tree, "duration", source, *_DURATIONS)
    if duration is not None:
        tie(tree, "end", "start", duration)
    _group(tree, source)
    if partial := take(tree, "partial-joint"):
        set_parameter(tree, "below", joint_named(partial), source)
    if loops(tree):
        set_parameter(tree, "loop", "true", source)
    drop(tree, "wrap-mode", "loop")
    _mix(tree, source)
    updates = [_update(tree, source)] if value_of(tree, "mode").lower() == UPDATE else []
    faults = left_out(tree, source, *_OF_CLIPS, "mode")
    tree.tag = _CLIP
    return [*updates, *faults]


def _group(tree: Tree, source: BlockSource) -> None:
    """Has a state or blend of the whole body play over the one before it, as SmartBody plays one at a time."""
    whole = not value_of(tree, "partial-joint") and not _adds(tree)
    if name_of(tree) != _ANIMATION and whole:
        set_parameter(tree, "replacementgroup", "blends", source)


def _update(tree: Tree, source: BlockSource) -> Fault:
    """The fault of a blend that is to change the mixture of one that plays, and which its block does not contain."""
    drop(tree, "mode")
    return source.located(tree, PlaysOver())


def loops(tree: Tree) -> bool:
    """Return whether a clip is played over and over, as states and blends are by default."""
    wrap, loop = (value_of(tree, name).lower() for name in ("wrap-mode", "loop"))
    if wrap or loop:
        return wrap == "loop" or loop == "true"
    return name_of(tree) != _ANIMATION and not set(OTHER_POINTS).intersection(tree.keys())


def ends(tree: Tree) -> bool:
    """Return whether a clip ends by itself: it is no loop, or has an end or a duration."""
    return not loops(tree) or bool({"end", "relax"} & set(tree.keys())) or _has_duration(tree)


def _has_duration(tree: Tree) -> bool:
    """Return whether a clip has a duration that can be read."""
    shortest, longest = _DURATIONS
    try:
        return shortest <= float(value_of(tree, "duration")) <= longest
    except ValueError:
        return False


def _mix(tree: Tree, source: BlockSource) -> None:
    """Makes parameters of what says how clips are mixed, and whether they are added to other motion."""
    if _adds(tree):
        set_parameter(tree, "additive", "true", source)
    drop(tree, "blend-mode", "additive")
    for name in AXES:
        value = take_number(tree, name, source, -_FARTHEST, _FARTHEST)
        if value is not None:
            set_parameter(tree, name, f"{value:g}", source)


def _adds(tree: Tree) -> bool:
    """Return whether a clip is added to other motion."""
    return value_of(tree, "blend-mode").lower() == "additive" or value_of(tree, "additive").lower() not in ("", "false")


def _start_as_early_as_possible(tree: Tree) -> None:
    """Unties points at 0 behind a start that is not tied: SmartBody shifts such a block until it starts at 0."""
    if "start" not in tree.attrib:
        for point in _EARLY_POINTS:
            if tree.get(point, "").strip() in AT_ONCE:
                del tree.attrib[point]
