"""Behaviors that go on until something else takes their place (thesis 6.3)."""

from collections.abc import Iterable, Iterator
from dataclasses import replace

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Gaze, GazeShift
from reactive_realizer.bml.constraint import Constraint, Synchronize
from reactive_realizer.bml.posture import Posture, PostureShift

_ENDING = frozenset({"relax", "end"})


def persisting(behaviors: Iterable[Behavior], constraints: Iterable[Constraint]) -> Iterator[Behavior]:
    """Those behaviors of a draft that have no end: gazes and postures of which nothing says when they relax or end.

    Args:
        behaviors: as they were read.
        constraints: of their block.
    """
    tied = (ref for tie in constraints if isinstance(tie, Synchronize) for ref in tie.refs)
    ended = {ref.behavior for ref in tied if ref.block is None and ref.sync in _ENDING}
    for behavior in behaviors:
        if not isinstance(behavior, Gaze | Posture) or isinstance(behavior, GazeShift | PostureShift):
            continue
        if behavior.id not in ended and not _ENDING & set(behavior.syncs):
            yield replace(behavior, persistent=True)
