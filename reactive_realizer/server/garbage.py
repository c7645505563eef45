"""Keeping the garbage collector out of ticks."""

import gc

_YOUNG = 50_000
"""Objects that come before any are looked through: a plan of some hundred behaviors."""


def keep_from_ticks() -> None:
    """What is there stays as long as the scene does, and to look through it for garbage takes most of a tick.

    What has ended frees itself, for nothing that is played leads back to itself: only failures, whose traces do, and
    behaviors that are dropped while they are planned leave something to be found.
    """
    gc.collect()
    gc.freeze()
    gc.set_threshold(_YOUNG)
