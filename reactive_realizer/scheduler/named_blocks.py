"""The other blocks that a block names: it is planned after them."""

from collections.abc import Iterable
from dataclasses import dataclass

from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.bml.extensions import ParameterValueChange
from reactive_realizer.bml.names import ANTICIPATORS
from reactive_realizer.bml.references import references_of


@dataclass(frozen=True, slots=True)
class NamedBlocks:
    """Ids of the other blocks that a block names, in document order.

    Attributes:
        points: the blocks whose points its references name.
        parameters: the blocks whose parameters it changes.
    """

    points: tuple[str, ...]
    parameters: tuple[str, ...]

    @property
    def all(self) -> tuple[str, ...]:
        """Each of these ids."""
        return (*self.points, *self.parameters)


def named_blocks(block: BehaviorBlock) -> NamedBlocks:
    """The other blocks that a block names."""
    points = (ref.block for _, _, ref in references_of(block))
    changes = (behavior.target_block for behavior in block.behaviors if isinstance(behavior, ParameterValueChange))
    return NamedBlocks(_others(points, block), _others(changes, block))


def _others(ids: Iterable[str | None], block: BehaviorBlock) -> tuple[str, ...]:
    return tuple(dict.fromkeys(id_ for id_ in ids if id_ is not None and id_ not in (block.id, ANTICIPATORS)))
