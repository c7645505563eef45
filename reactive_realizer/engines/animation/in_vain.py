"""What a behavior, its binding or a file says to a motion that cannot do it."""

from collections.abc import Iterable

from reactive_realizer.binding.class_names import ASKED_OF_BEHAVIOR
from reactive_realizer.binding.unit_spec import UnitSpec
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.engines.animation.motion_unit import FILE, NAME, MotionUnit
from reactive_realizer.errors import Fault

GROUP = "replacementgroup"
"""The parameter that is the binding's own, whatever plays: who gives way to whom (thesis 8.7.5)."""


def left_out(spec: UnitSpec, behavior: Behavior, motion: MotionUnit) -> Fault | None:
    """The joints that a motion cannot turn for a behavior that says which file is played; None where it turns all.

    Of a file that an entry names its author learns by the log: to a planner every gesture of a figure without fingers
    would complain.
    """
    if spec.file is not None or not motion.lacking:
        return None
    return Fault("joints-left-out", {"joints": listed(motion.lacking), "element": behavior.name})


def said_in_vain(spec: UnitSpec, behavior: Behavior, motion: MotionUnit) -> Fault | None:
    """The `bmlt:parameter`s of a behavior that have no effect; None where all have one.

    Args:
        spec: the entry of the binding that plays it; what it chooses by has an effect.
        behavior: as it was said.
        motion: what the entry has for it.
    """
    if not behavior.parameters:
        return None
    known = motion.known | {GROUP}
    heard = {*known, *spec.constraints, *(name for name, own in spec.parameter_map.items() if own in known)}
    names = behavior.parameters.keys() - heard
    details = {"names": listed(names), "element": behavior.name, "known": listed(_as_said(known, spec))}
    return Fault("unknown-parameter", details) if names else None


def named_in_vain(spec: UnitSpec, motion: MotionUnit) -> set[str]:
    """The parameters that an entry names and its motion has not.

    Nothing is wrong with an entry whose file the behavior says: it is for many motions.
    """
    if spec.file is None and motion.known & {FILE, NAME}:
        return set()
    return {*spec.defaults, *spec.parameter_map.values()} - motion.known - ASKED_OF_BEHAVIOR - {GROUP}


def _as_said(names: Iterable[str], spec: UnitSpec) -> set[str]:
    """Parameters as a behavior calls them."""
    said = {own: name for name, own in spec.parameter_map.items()}
    return {said.get(own, own) for own in names}


def listed(names: Iterable[str]) -> str:
    """Names for people."""
    return ", ".join(sorted(names))
