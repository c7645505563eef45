"""Hands of SmartBody that go to a target: reaches, grabs, and constraints of a hand."""

from typing import Final

from reactive_realizer.bml.behaviors import REACH
from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.names import OWN, SBM
from reactive_realizer.bml.smartbody.attributes import (
    OTHER_POINTS,
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
from reactive_realizer.bml.smartbody.faults import LeftToPlugins
from reactive_realizer.bml.smartbody.joints import joint_named, target_named
from reactive_realizer.bml.trees import Tree
from reactive_realizer.bml.vocabulary import Mode, Reach
from reactive_realizer.errors import Fault, quoted

_ACTIONS: Final = {"touch": Reach.TOUCH, "pick-up": Reach.TAKE, "put-down": Reach.PUT}
_POINTS: Final = "point-at"
_HANDS: Final = {"left": Mode.LEFT_HAND, "l": Mode.LEFT_HAND, "right": Mode.RIGHT_HAND, "r": Mode.RIGHT_HAND}
_OF_HANDS: Final = ("wrist", "hand", "thumb", "index", "middle", "ring", "pinky")
"""Beginnings of the names of joints that a constraint moves by the hand."""
_PLACE: Final = "pos"
_HOLD: Final = "postStrokeHoldDuration"
_LONGEST: Final = 600.0
_MOMENT: Final = "0.1"
"""Duration of a behavior that does nothing, s."""


def adapt_reach(tree: Tree, source: BlockSource) -> list[Fault]:
    """Rewrites a reach, in place, and returns the faults of what is left out.

    A hand comes back by itself, so a reach that only ends another one does nothing; if it puts something down, the hand
    lets go of it.
    """
    rename(tree, "target-pos", "target")
    action = take(tree, "action").lower()
    finishes = take(tree, "reach-finish").lower() == "true"
    if action and action not in (*_ACTIONS, _POINTS):
        give_back(tree, "action", action)
    drop(tree, "handle", "foot-ik")
    if finishes or "target" not in tree.attrib:
        released = _ACTIONS.get(action) is Reach.PUT
        _choose_hand(tree, "reach-type", "reach-arm")
        return _release(tree, source) if released else _nothing(tree, source)
    hold = take_number(tree, "reach-duration", source, -1.0, _LONGEST)
    if hold is not None and hold >= 0.0:
        set_parameter(tree, _HOLD, f"{hold:g}", source)
    _choose_hand(tree, "reach-type", "reach-arm")
    return _go(tree, "" if action == _POINTS else _ACTIONS.get(action, Reach.TOUCH), source)


def adapt_grab(tree: Tree, source: BlockSource) -> list[Fault]:
    """Rewrites a grab, in place: the hand takes its target, if it has one, or lets go of what it carries."""
    releases = take(tree, "release-pawn").lower() == "true"
    drop(tree, "handle", "grab-state")
    _choose_hand(tree, "grab-type")
    if "target" not in tree.attrib:
        return _release(tree, source) if releases else _nothing(tree, source)
    return _go(tree, Reach.TAKE, source)


def adapt_constraint(tree: Tree, source: BlockSource) -> list[Fault]:
    """Rewrites a constraint of the place of a hand, in place; one without a target releases the hand from another one.

    It persists without an end.
    """
    drop(tree, "handle", "effector-root", "root", "constraint-type")
    _choose_hand(tree, "effector")
    fades = {name: take_time(tree, name, source, _LONGEST) for name in ("fade-in", "fade-out")}
    if "target" not in tree.attrib:
        return _release(tree, source)
    if fade_in := fades["fade-in"]:
        tie(tree, "ready", "start", fade_in)
    if {"relax", "end"} & set(tree.keys()):
        tree.set("start", tree.get("start", "0"))  # the hand stays at its target meanwhile
    faults: list[Fault] = []
    if "end" in tree.attrib and (time := fades["fade-out"]):
        faults = fade_out(tree, "fade-out", time, source)
    return [*faults, *_go(tree, Reach.HOLD, source)]


def is_of_hand(constraint: Tree) -> bool:
    """Return whether a constraint of SmartBody keeps a hand at a place, or ends others, whatever their hand is."""
    if not {"effector", "target"} & set(constraint.keys()):
        return _kind(constraint) == _PLACE
    side, _, joint = joint_named(constraint.get("effector", "")).partition("_")
    return side in _HANDS and joint.startswith(_OF_HANDS) and _kind(constraint) == _PLACE


def left_to_plugins(constraint: Tree, source: BlockSource) -> list[Fault]:
    """The fault of a constraint that keeps something else, or keeps a hand turned."""
    kind, effector = _kind(constraint), constraint.get("effector", "").strip()
    quantity = "place" if kind == _PLACE else f"'{quoted(kind)}'"
    named = f"'{quoted(effector)}'" if effector else "no effector"
    return [source.located(constraint, LeftToPlugins(quantity=quantity, effector=named))]


def _kind(constraint: Tree) -> str:
    """Return the word for what a constraint keeps fixed: the place of its effector, its rotation, or both."""
    return str(constraint.get(f"{{{SBM}}}constraint-type", constraint.get("constraint-type", _PLACE))).lower()


def _choose_hand(tree: Tree, *attributes: str) -> None:
    """Writes the hand that the first of some attributes names, by its side or by a joint such as ``r_wrist``."""
    for name in reversed(attributes):
        named = take(tree, name)
        hand = _HANDS.get(joint_named(named).lower().partition("_")[0])
        if hand is not None:
            tree.set("mode", hand)
        elif named:
            give_back(tree, name, named)


def _go(tree: Tree, action: str, source: BlockSource) -> list[Fault]:
    tree.set("target", target_named(tree.get("target", "")))
    faults = left_out(tree, source, *"xyz")
    tree.tag = "pointing"
    if action:
        tree.set(f"{{{REACH[0]}}}{REACH[1]}", action)
    return faults


def _release(tree: Tree, source: BlockSource) -> list[Fault]:
    """Rewrites the behavior of hands, all unless one is chosen, as one in which they let go of what they carry."""
    faults = left_out(tree, source)
    drop(tree, "target", *OTHER_POINTS)
    tree.set("mode", tree.get("mode", Mode.BOTH_HANDS))
    tree.tag = f"{{{OWN}}}release"
    return faults


def _nothing(tree: Tree, source: BlockSource) -> list[Fault]:
    faults = left_out(tree, source)
    drop(tree, "target", "mode", *OTHER_POINTS)
    tree.tag = "wait"
    tree.set("duration", _MOMENT)
    return faults
