"""References to sync points."""

import math
import re
from collections.abc import Collection
from dataclasses import dataclass, replace
from typing import Final, Self

from reactive_realizer.bml.names import BLOCK
from reactive_realizer.errors import error
from reactive_realizer.limits import Limits

NUMBER: Final = r"(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
"""A number without its sign, as a pattern."""

BLOCK_POINTS: Final = ("start", "relax", "end")
"""The sync points of a block: it starts, all of it that goes on is in retraction, nothing of it goes on."""

_SECONDS = re.compile(rf"([+-]?)\s*({NUMBER})")
_WITH_OFFSET = re.compile(rf"(.*?)\s*([+-])\s*({NUMBER})", re.DOTALL)
_NAME = re.compile(r"[^\s:+]+")
_STROKE_NUMBER = re.compile(r"[0-9]{1,4}")
_MOST_CHARACTERS = 1_000


@dataclass(frozen=True, slots=True)
class SyncRef:
    """A point in time by name: ``[block:]behavior:sync[+offset]``, or ``[block:]offset`` from the start of a block.

    A block has sync points too (thesis 12.1.3): ``b1:relax`` is that of another block where no behavior of the block
    in which it stands is called b1, and ``b1:bml:relax`` is that of the block in any case.

    Attributes:
        block: id of another block, or "anticipators"; None for the block in which the reference stands.
        behavior: id of a behavior (of an anticipator); None for the block itself.
        sync: name of its sync point, ``stroke:2`` for the second stroke; of a block "relax", "end", or None for its
            start.
        offset: seconds from that point.
    """

    block: str | None
    behavior: str | None
    sync: str | None
    offset: float = 0.0

    @classmethod
    def parse(cls, text: str, limits: Limits, names: Collection[str] = ()) -> Self:
        """Reads a reference as BML 1.0 writes it.

        Ids may hold hyphens, so only a number after the last ``+`` or ``-`` is an offset.

        Args:
            text: what was written.
            limits: bound the offset.
            names: sync points known to exist that look like a name and an offset (``s-1``); these are names.

        Raises:
            RealizerError: ``not-a-reference``, ``only-block-start`` or ``absurd-time``.
        """
        if len(text) > _MOST_CHARACTERS:
            raise error("not-a-reference")
        *owners, last = (part.strip() for part in text.split(":"))
        absolute = _SECONDS.fullmatch(last)
        if absolute and len(owners) < 2:
            block = owners[0] if owners else None
            return cls._checked(block, None, None, _seconds(absolute[1], absolute[2], limits))
        sync, offset = _split_offset(last, limits, names)
        if len(owners) > 1 and owners[-1] == "stroke" and _STROKE_NUMBER.fullmatch(sync):
            sync = f"{owners.pop()}:{int(sync)}"
        if not 1 <= len(owners) <= 2:
            raise error("not-a-reference")
        return cls._checked(owners[0] if len(owners) == 2 else None, owners[-1], sync, offset)

    @classmethod
    def _checked(cls, block: str | None, behavior: str | None, sync: str | None, offset: float) -> Self:
        """With every name legal."""
        block = None if block == BLOCK else block
        if behavior == BLOCK:
            behavior, sync = None, _block_point(block, sync)
        for name in (block, behavior, sync and sync.removeprefix("stroke:")):
            if name is not None and not _NAME.fullmatch(name):
                raise error("not-a-reference")
        return cls(block, behavior, sync, offset)

    def read_in(self, block: str, behaviors: Collection[str]) -> Self:
        """What it names where it stands: behaviors of that block come before other blocks of the same name.

        Args:
            block: id of the block.
            behaviors: ids of its behaviors.

        Raises:
            RealizerError: ``only-block-start``.
        """
        if self.behavior is None:
            named = self.block
        elif self.block is None and self.behavior not in behaviors and self.sync in BLOCK_POINTS:
            named = self.behavior
        else:
            return self
        other = None if named == block else named
        return replace(self, block=other, behavior=None, sync=_block_point(other, self.sync))

    def __str__(self) -> str:
        if self.block is None and self.sync is None:
            return _number(self.offset)
        sync = self.sync or "start"
        point = ":".join(name for name in (self.block, self.behavior, sync) if name is not None)
        # A bare "s-1" would be read as one second before "s".
        ambiguous = _WITH_OFFSET.fullmatch(sync)
        return f"{point}{_number(self.offset, sign='+')}" if self.offset or ambiguous else point


def _block_point(block: str | None, sync: str | None) -> str | None:
    """A sync point of a block (None: the one in which the reference stands), None for its start."""
    if sync in {None, "start"}:
        return None
    if block is None or sync not in BLOCK_POINTS:
        raise error("only-block-start")
    return sync


def _split_offset(last: str, limits: Limits, names: Collection[str]) -> tuple[str, float]:
    """The name and the offset of the last part of a reference."""
    parts = None if last in names else _WITH_OFFSET.fullmatch(last)
    return (parts[1], _seconds(parts[2], parts[3], limits)) if parts else (last, 0.0)


def _seconds(sign: str, digits: str, limits: Limits) -> float:
    seconds = float(sign + digits)
    if not math.isfinite(seconds) or abs(seconds) > limits.time_seconds:
        raise error("absurd-time", limit=limits.time_seconds)
    return seconds + 0.0  # no negative zero


def _number(seconds: float, sign: str = "-") -> str:
    return f"{seconds:{sign}}".removesuffix(".0")
