"""The lexicon of body animation: the entries of a character's binding, and the poses of postures."""

from collections import deque
from collections.abc import Iterator
from functools import lru_cache

from lxml import etree

from reactive_realizer.binding.unit_spec import UnitSpec, behavior_attributes
from reactive_realizer.bml.attribute_types import Target
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.elements import ELEMENTS
from reactive_realizer.bml.names import BML, BMLT, MURML
from reactive_realizer.engine.lexicon import Changeable, LexiconEntry
from reactive_realizer.engines.animation.motion_library import MotionLibrary
from reactive_realizer.engines.animation.motion_timing import keys_of, motion_timing
from reactive_realizer.engines.animation.motion_unit import EXPRESSIVITY_RANGES, GESTURE_POINTS
from reactive_realizer.engines.animation.motions.posture import PostureMotionUnit
from reactive_realizer.engines.animation.posture.posture_library import LEXEMES
from reactive_realizer.errors import RealizerError
from reactive_realizer.limits import Limits

_FROM_BEHAVIOR = frozenset({"file", "name"})
"""Parameters that a unit without a file of its own needs."""


def example_behavior(spec: UnitSpec, target: str) -> str | None:
    """Return the XML of a minimal behavior that an entry plays.

    Args:
        spec: the entry.
        target: something to look and point at.

    Returns:
        The element, with id "example". None if the entry needs more from the behavior, such as a file, a joint or a
        description in MURML.
    """
    element = ELEMENTS.get(spec.behavior)
    attributes = element.attributes if element and element.namespace == spec.namespace else ()
    targets = {each.name: target for each in attributes if isinstance(each.type, Target)}
    values = {"id": "example", **targets, **spec.constraints}
    known = {"id", *(each.name for each in attributes)}
    missing = {each.name for each in attributes if each.required} - values.keys()
    mapped = {to for source, to in spec.parameter_map.items() if source not in values}
    if missing or mapped & _FROM_BEHAVIOR or spec.namespace == MURML:
        return None
    tree = etree.Element(f"{{{spec.namespace}}}{spec.behavior}")
    for name, value in values.items():
        if name in known or name.startswith("{"):
            tree.set(name, value)
        elif name != "stance":
            etree.SubElement(tree, f"{{{BMLT}}}parameter", name=name, value=value)
    if element and "stance" in element.children:
        etree.SubElement(tree, f"{{{BML}}}stance", type=values.get("stance", "STANDING").upper())
    return etree.tostring(tree, encoding="unicode")


_LEXEME_ATTRIBUTES = ("lexeme", "name")
"""The attributes that contain the lexeme of a behavior."""


def binding_lexicon(library: MotionLibrary, target: str) -> Iterator[LexiconEntry]:
    """Yield the entries of the binding, in order, and the poses of postures.

    Entries that need more from a behavior than a target, such as those that play any file, are left out. So are the
    parameters of expressivity, which every gesture and pointing has. An entry for a library yields the names in it,
    without their durations.

    Args:
        library: creates the motions.
        target: something to look and point at.
    """
    for spec in library.binding.specs:
        try:
            names = library.names(spec)
        except RealizerError as problem:
            yield LexiconEntry(spec.behavior, "", spec.constraints, file=spec.file, problem=problem.fault.sentence)
            continue
        if names is not None:
            yield from (
                LexiconEntry(spec.behavior, each, spec.constraints, GESTURE_POINTS, file=spec.file) for each in names
            )
        elif (text := example_behavior(spec, target)) is not None:
            yield _entry(spec, text, library)
    yield from (LexiconEntry("pose", lexeme) for lexeme in LEXEMES)


def _entry(spec: UnitSpec, text: str, library: MotionLibrary) -> LexiconEntry:
    constraints = dict(spec.constraints)
    lexeme = next((constraints.pop(name) for name in _LEXEME_ATTRIBUTES if name in constraints), "")
    try:
        behavior = _behavior(text)
        candidate = library.candidate(spec, behavior, behavior_attributes(behavior))
    except RealizerError as problem:
        return LexiconEntry(spec.behavior, lexeme, constraints, file=spec.file, problem=problem.fault.sentence)
    motion = candidate.motion
    if isinstance(motion, PostureMotionUnit):
        deque(motion.find_detour(), maxlen=0)
    timing = motion_timing(behavior, motion, keys_of(behavior, motion))
    return LexiconEntry(
        spec.behavior,
        lexeme,
        constraints,
        timing.points,
        sum(phase.duration for phase in timing.phases),
        {
            name: Changeable(motion.parameters[own], motion.ranges[own])
            for name, own in candidate.names.items()
            if own not in EXPRESSIVITY_RANGES
        },
        spec.file,
    )


@lru_cache(256)  # the characters of a process have mostly the same bindings
def _behavior(text: str) -> Behavior:
    """Parse a behavior element.

    Raises:
        RealizerError: it is invalid.
    """
    (parsed,) = parse(f'<bml xmlns="{BML}" id="lexicon">{text}</bml>', Limits())
    if parsed.problems or parsed.block is None:
        raise RealizerError(parsed.problems[0].fault)
    return parsed.block.behaviors[0]
