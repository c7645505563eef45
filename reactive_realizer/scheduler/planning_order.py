"""The order in which blocks are planned: a block after those that it names."""

from collections.abc import Callable, Hashable, Iterable
from dataclasses import dataclass
from typing import TypeVar

from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.bml.extensions import ParameterValueChange
from reactive_realizer.bml.names import ANTICIPATORS
from reactive_realizer.bml.references import references_of

T = TypeVar("T", bound=Hashable)


@dataclass(frozen=True, slots=True)
class NamedBlocks:
    """Ids of the other blocks that a block names, in document order.

    Attributes:
        points: the blocks whose points its references name.
        parameters: the blocks whose parameters it changes.
    """

    points: tuple[str, ...]
    parameters: tuple[str, ...]


def named_blocks(block: BehaviorBlock) -> NamedBlocks:
    """The other blocks that a block names."""
    points = (ref.block for _, _, ref in references_of(block))
    changes = (behavior.target_block for behavior in block.behaviors if isinstance(behavior, ParameterValueChange))
    return NamedBlocks(_others(points, block), _others(changes, block))


def dependency_order(items: Iterable[T], dependencies: Callable[[T], Iterable[T]]) -> list[T]:
    """Items and all that they depend on, directly or not: each after its dependencies, else in the order given.

    In a circle, the item that depends on the one that was visited first comes first.

    Args:
        items: in order.
        dependencies: of one item, in order.
    """
    done: dict[T, None] = {}
    for each in items:
        path = {} if each in done else {each: iter(dependencies(each))}
        while path:
            last, ahead = next(reversed(path.items()))
            following = next((other for other in ahead if other not in done and other not in path), None)
            if following is None:
                done[last] = None
                del path[last]
            else:
                path[following] = iter(dependencies(following))
    return list(done)


def _others(ids: Iterable[str | None], block: BehaviorBlock) -> tuple[str, ...]:
    return tuple(dict.fromkeys(id_ for id_ in ids if id_ is not None and id_ not in (block.id, ANTICIPATORS)))
