"""References to sync points."""

import math
import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Final, Self

from reactive_realizer.bml.names import BLOCK
from reactive_realizer.bml.value_faults import AbsurdTime, NotAReference, OnlyBlockStart
from reactive_realizer.errors import RealizerError
from reactive_realizer.limits import Limits

NUMBER: Final = r"(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
"""Pattern of a number without a sign."""

OWN_BLOCK_POINTS: Final = ("ready", "strokeStart", "stroke", "strokeEnd")
"""The sync points of a block that it may define by points of its behaviors (thesis 12.1.3)."""

BLOCK_POINTS: Final = ("start", *OWN_BLOCK_POINTS, "relax", "end")
"""The sync points of a block; at its relax, all of its behaviors that still play are in retraction."""

DRAFT_SPELLINGS: Final[Mapping[str, str]] = MappingProxyType({"stroke_start": "strokeStart", "stroke_end": "strokeEnd"})
"""Names of sync points in the drafts before BML 1.0, to their names in BML 1.0."""

SPEECH_POINTS: Final[Mapping[str, str]] = MappingProxyType(
    {"ready": "start", "strokeStart": "start", "stroke": "start", "strokeEnd": "end", "relax": "end"}
)
"""Sync points that a speech of SmartBody has, to those that it has in BML 1.0."""

_STROKE: Final = "stroke"
FIRST_STROKE: Final = "stroke:1"

_SECONDS = re.compile(rf"([+-]?)\s*({NUMBER})")
_WITH_OFFSET = re.compile(rf"(.*?)\s*([+-])\s*({NUMBER})", re.DOTALL)
_NAME = re.compile(r"[^\s:+]+")
_STROKE_NUMBER = re.compile(r"[0-9]{1,4}")
_MOST_CHARACTERS = 1_000


@dataclass(frozen=True, slots=True)
class SyncRef:
    """A reference to a point in time: ``[block:]behavior:sync[+offset]``, or ``[block:]offset`` from a block's start.

    A block has sync points too (thesis 12.1.3). ``b1:relax`` names a behavior b1 of the block in which it stands or, if
    there is none, block b1; ``b1:bml:relax`` always names the block.

    Attributes:
        block: id of another block, or "anticipators"; None for the block in which the reference stands.
        behavior: id of a behavior, or of an anticipator; None for the block itself.
        sync: name of its sync point, ``stroke:2`` for the second stroke; of a block one of `BLOCK_POINTS`, or None for
            its start.
        offset: seconds after that point.
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
            text: the reference.
            limits: limit the offset.
            names: known names of sync points; one that looks like a name with an offset (``s-1``) is read as a name,
                and so is a number after the id of a behavior (``speech1:2``).

        Raises:
            RealizerError: ``not-a-reference``, ``only-block-start`` or ``absurd-time``.
        """
        if len(text) > _MOST_CHARACTERS:
            raise RealizerError(NotAReference())
        *owners, last = (part.strip() for part in text.split(":"))
        absolute = None if owners and last in names else _SECONDS.fullmatch(last)
        if absolute and len(owners) < 2:
            block = owners[0] if owners else None
            return cls._checked(block, None, None, _seconds(absolute[1], absolute[2], limits))
        sync, offset = _split_offset(last, limits, names)
        if len(owners) > 1 and owners[-1] == "stroke" and _STROKE_NUMBER.fullmatch(sync):
            sync = f"{owners.pop()}:{int(sync)}"
        if not 1 <= len(owners) <= 2:
            raise RealizerError(NotAReference())
        return cls._checked(owners[0] if len(owners) == 2 else None, owners[-1], sync, offset)

    @classmethod
    def _checked(cls, block: str | None, behavior: str | None, sync: str | None, offset: float) -> Self:
        """A reference whose names are all legal."""
        block = None if block == BLOCK else block
        if behavior == BLOCK:
            behavior, sync = None, _block_point(block, sync)
        for name in (block, behavior, sync and sync.removeprefix("stroke:")):
            if name is not None and not _NAME.fullmatch(name):
                raise RealizerError(NotAReference())
        return cls(block, behavior, sync, offset)

    def read_in(self, block: str, behaviors: Collection[str]) -> Self:
        """The same reference as read in a block, whose behaviors take precedence over other blocks with the same id.

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
        # Without an offset, "s-1" would be read as one second before "s".
        ambiguous = _WITH_OFFSET.fullmatch(sync)
        return f"{point}{_number(self.offset, sign='+')}" if self.offset or ambiguous else point


def named_point(sync: str, points: Collection[str]) -> str:
    """The one of some points that a name denotes: the stroke of a behavior with several strokes is the first."""
    return FIRST_STROKE if sync == _STROKE and sync not in points and FIRST_STROKE in points else sync


def _block_point(block: str | None, sync: str | None) -> str | None:
    """A sync point of a block, None for its start; block None is the one in which the reference stands."""
    if sync in {None, "start"}:
        return None
    if block is None or sync not in BLOCK_POINTS:
        raise RealizerError(OnlyBlockStart(known=BLOCK_POINTS))
    return sync


def _split_offset(last: str, limits: Limits, names: Collection[str]) -> tuple[str, float]:
    """The name and the offset of the last part of a reference."""
    parts = None if last in names else _WITH_OFFSET.fullmatch(last)
    return (parts[1], _seconds(parts[2], parts[3], limits)) if parts else (last, 0.0)


def _seconds(sign: str, digits: str, limits: Limits) -> float:
    seconds = float(sign + digits)
    if not math.isfinite(seconds) or abs(seconds) > limits.time_seconds:
        raise RealizerError(AbsurdTime(limit=limits.time_seconds))
    return seconds + 0.0  # no negative zero


def _number(seconds: float, sign: str = "-") -> str:
    return f"{seconds:{sign}}".removesuffix(".0")
