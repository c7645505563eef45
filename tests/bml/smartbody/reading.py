"""Reads acts of SmartBody."""

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.block import BehaviorBlock, Parsed
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.references import check_references
from reactive_realizer.limits import Limits


def read(text: str) -> Parsed:
    (parsed,) = parse(text, Limits(), "document1")
    return parsed


def block(text: str) -> BehaviorBlock:
    """The block of a document, which has no problems."""
    parsed = read(text)
    assert parsed.block is not None
    assert parsed.problems == ()
    assert check_references(parsed.block) == ()
    return parsed.block


def only(inside: str) -> Behavior:
    """The only behavior of an act, which has no problems."""
    (behavior,) = block(f"<act><bml>{inside}</bml></act>").behaviors
    return behavior


def told(inside: str) -> list[str]:
    return [each.fault.sentence for each in read(f"<act><bml>{inside}</bml></act>").problems]


def behaviors(inside: str) -> tuple[Behavior, ...]:
    return block(f"<act><bml>{inside}</bml></act>").behaviors
