"""Which other blocks a block names."""

from collections.abc import Iterable
from dataclasses import dataclass

from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.bml.continuous import ParameterValueChange
from reactive_realizer.bml.names import ANTICIPATORS
from reactive_realizer.bml.references import references_of


@dataclass(frozen=True, slots=True)
class Mentions:
    """Ids of other blocks that stand in one, in document order.

    Attributes:
        points: of those whose points its references name.
        parameters: of those whose parameters it changes.
    """

    points: tuple[str, ...]
    parameters: tuple[str, ...]


def mentions_of(block: BehaviorBlock) -> Mentions:
    """The other blocks that a block names."""
    points = (ref.block for _, _, ref in references_of(block))
    changes = (behavior.target_block for behavior in block.behaviors if isinstance(behavior, ParameterValueChange))
    return Mentions(_others(points, block), _others(changes, block))


def _others(ids: Iterable[str | None], block: BehaviorBlock) -> tuple[str, ...]:
    return tuple(dict.fromkeys(id_ for id_ in ids if id_ is not None and id_ not in (block.id, ANTICIPATORS)))
