"""Names of the points in time on the board."""

from typing import NamedTuple

ANTICIPATORS = "anticipators"
"""Takes the place of the block id in the name of a predicted point."""


class BlockKey(NamedTuple):
    """The name of a block: its character and its id."""

    character: str
    block: str


class PegKey(NamedTuple):
    """The name of a sync point of a behavior, a block (behavior None) or an anticipator (block ``anticipators``)."""

    character: str
    block: str
    behavior: str | None
    sync: str

    @property
    def block_key(self) -> BlockKey:
        """The block it belongs to."""
        return BlockKey(self.character, self.block)

    def __str__(self) -> str:
        point = self.sync if self.behavior is None else f"{self.behavior}:{self.sync}"
        return f"{self.block}:{point}"


def anticipator_key(anticipator: str, sync: str) -> PegKey:
    """The name of a predicted point; anticipators belong to no character."""
    return PegKey("", ANTICIPATORS, anticipator, sync)
