"""Parameters of motions: reading their values, and finding parameters without effect."""

from collections.abc import Iterable, Mapping

from reactive_realizer.binding.spec_reader import finite_numbers
from reactive_realizer.binding.unit_spec import ASKED_OF_BEHAVIOR, UnitSpec
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.engine.faults import UnknownParameter
from reactive_realizer.engines.animation.faults import BadParameter, JointsLeftOut
from reactive_realizer.engines.animation.motion_unit import FILE, NAME, MotionUnit
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.planunit.parameter import Range


def parameter_values(texts: Mapping[str, str], ranges: Mapping[str, Range]) -> dict[str, float]:
    """Read the values of parameters.

    Args:
        texts: name -> text; may contain other names.
        ranges: name -> valid values.

    Raises:
        RealizerError: "bad-parameter": a value is not a number, or not within its range.
    """
    found = finite_numbers(texts)
    given = {name: found.get(name, texts[name]) for name in ranges if name in texts}
    check_ranges(given, ranges)
    return {name: found[name] for name in given}


def check_ranges(values: Mapping[str, float | str], ranges: Mapping[str, Range]) -> None:
    """Check that values are within their ranges.

    Raises:
        RealizerError: "bad-parameter": a value is not.
    """
    for name, value in values.items():
        if value not in ranges[name]:
            given = value if isinstance(value, str) else f"{value:g}"
            raise RealizerError(BadParameter(name=name, value=given, low=ranges[name].low, high=ranges[name].high))


REPLACEMENT_GROUP = "replacementgroup"
"""A parameter of every entry, for the binding itself: motions of a group may replace each other (thesis 8.7.5)."""


def missing_joints_fault(spec: UnitSpec, behavior: Behavior, motion: MotionUnit) -> Fault | None:
    """Return a fault about joints that a motion cannot turn, if the behavior chose the file; None if there are none.

    Missing joints of an entry's own file are only logged. Otherwise every gesture of a figure without fingers would
    give a warning.
    """
    if spec.file is not None or not motion.lacking:
        return None
    return JointsLeftOut(joints=listed(motion.lacking), element=behavior.name)


def unused_behavior_parameters(spec: UnitSpec, behavior: Behavior, motion: MotionUnit) -> Fault | None:
    """Return a fault about `bmlt:parameter`s of a behavior that have no effect; None if all have one.

    Args:
        spec: the entry that plays it; parameters that it constrains have an effect.
        behavior: as written.
        motion: of the entry.
    """
    if not behavior.parameters:
        return None
    known = motion.parameter_names | {REPLACEMENT_GROUP}
    heard = {*known, *spec.constraints, *(name for name, own in spec.parameter_map.items() if own in known)}
    names = behavior.parameters.keys() - heard
    if not names:
        return None
    known_names = tuple(sorted(_bml_names(known, spec)))
    return UnknownParameter(names=tuple(sorted(names)), element=behavior.name, known=known_names)


def unused_entry_parameters(spec: UnitSpec, motion: MotionUnit) -> set[str]:
    """Return the parameters of an entry that its motion does not have.

    An entry whose file comes from the behavior may play many motions, so its parameters are not checked.
    """
    if spec.file is None and motion.parameter_names & {FILE, NAME}:
        return set()
    return (
        {*spec.defaults, *spec.parameter_map.values()}
        - motion.parameter_names
        - ASKED_OF_BEHAVIOR
        - {REPLACEMENT_GROUP}
    )


def _bml_names(names: Iterable[str], spec: UnitSpec) -> set[str]:
    """Return parameters by the names that a behavior uses."""
    given = {own: name for name, own in spec.parameter_map.items()}
    return {given.get(own, own) for own in names}


def listed(names: Iterable[str]) -> str:
    """Join names for a message."""
    return ", ".join(sorted(names))
