"""What the binding of a character says, tried: its entries as words of a lexicon."""

from collections.abc import Iterator

from reactive_realizer.binding.asking import asking
from reactive_realizer.binding.seen import seen
from reactive_realizer.binding.unit_spec import UnitSpec
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.names import BML
from reactive_realizer.engine.lexicon import Changeable, Word
from reactive_realizer.engines.animation.animation_unit import keys_of, motion_timing
from reactive_realizer.engines.animation.motion_library import MotionLibrary
from reactive_realizer.engines.animation.posture.posture_library import LEXEMES
from reactive_realizer.errors import RealizerError
from reactive_realizer.limits import Limits

_WORDS = ("lexeme", "name")
"""The attributes that hold the word of a behavior."""


def binding_words(library: MotionLibrary, target: str) -> Iterator[Word]:
    """The entries of its binding, in order, and the poses of postures.

    An entry that a behavior has to complete by more than a target, such as one that plays any file, is no word.

    Args:
        library: what makes the motions.
        target: something to look and point at.
    """
    for spec in library.binding.specs:
        text = asking(spec, target)
        if text is not None:
            yield _word(spec, text, library)
    yield from (Word("pose", lexeme) for lexeme in LEXEMES)


def _word(spec: UnitSpec, text: str, library: MotionLibrary) -> Word:
    said = dict(spec.constraints)
    lexeme = next((said.pop(name) for name in _WORDS if name in said), "")
    try:
        behavior = _behavior(text)
        choice = library.choice(spec, behavior, seen(behavior))
    except RealizerError as problem:
        return Word(spec.behavior, lexeme, said, file=spec.file, problem=problem.fault.sentence)
    motion = choice.motion
    timing = motion_timing(behavior, motion, keys_of(behavior, motion))
    return Word(
        spec.behavior,
        lexeme,
        said,
        timing.points,
        sum(phase.duration for phase in timing.phases),
        {name: Changeable(motion.parameters[own], motion.ranges[own]) for name, own in choice.names.items()},
        spec.file,
    )


def _behavior(text: str) -> Behavior:
    """The behavior of an element.

    Raises:
        RealizerError: it is none.
    """
    (parsed,) = parse(f'<bml xmlns="{BML}" id="lexicon">{text}</bml>', Limits())
    if parsed.problems or parsed.block is None:
        raise RealizerError(parsed.problems[0].fault)
    return parsed.block.behaviors[0]
