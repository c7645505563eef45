"""From a binding, or from BML itself, to a keyframe animation or a capture."""

import logging
from collections.abc import Callable
from functools import lru_cache, partial
from pathlib import Path

from reactive_realizer.bml.twente import Keyframe
from reactive_realizer.engines.animation.actor import Actor, Wanted
from reactive_realizer.engines.animation.keyframe.clip import Clip
from reactive_realizer.engines.animation.keyframe.clip_cache import clip_in, read_ahead
from reactive_realizer.engines.animation.keyframe.keyframe_motion_unit import FILTER, KeyframeMotionUnit
from reactive_realizer.engines.animation.keyframe.skeleton_interpolator import read_interpolator_text
from reactive_realizer.engines.animation.values import values_of
from reactive_realizer.errors import error
from reactive_realizer.planunit.parameter import Range

_log = logging.getLogger(__name__)

_RANGES = {FILTER: Range(0.0, 1e6)}


class KeyframeMaker:
    """Makes motions of keys that stand in BML, else of a file.

    Parameters are `mirror`, then `joints`, a selection (thesis C.1.2), and `filter`, Hz, a low-pass (3.2.2.2).
    """

    def __init__(self, actor: Actor) -> None:
        self._actor = actor
        self._skeleton = actor.humanoid.avatar.skeleton

    def __call__(self, wanted: Wanted) -> KeyframeMotionUnit:
        """As every maker."""
        clip = self._clip(wanted)
        clip = clip.mirrored() if wanted.mirror else clip
        chosen = wanted.joints or frozenset(clip.joints)
        there = [joint for joint in clip.joints if joint in chosen and joint in self._skeleton]
        lacking = chosen.difference(there)
        if not there:
            raise error("no-joints", joints=", ".join(sorted(lacking)), element=wanted.behavior.name)
        if lacking:
            _tell(clip.name, ", ".join(sorted(lacking)))
        return KeyframeMotionUnit(clip.only(there), self._skeleton, lacking)

    def reading(self, wanted: Wanted) -> Callable[[], object] | None:
        """As `SlowMaker`; what stands in BML is short."""
        return None if _said(wanted) else partial(read_ahead, self._file(wanted), self._skeleton, _cutoff(wanted))

    def _clip(self, wanted: Wanted) -> Clip:
        if said := _said(wanted):
            return read_interpolator_text(said, wanted.behavior.id).filtered(_cutoff(wanted) or 0.0)
        return clip_in(self._file(wanted), self._skeleton, _cutoff(wanted))

    def _file(self, wanted: Wanted) -> Path:
        return self._actor.file_of(wanted, "xml", "bvh")


@lru_cache
def _tell(clip: str, lacking: str) -> None:
    """Once, however often it is played."""
    _log.warning("%s leaves out what it has not, or the figure has not: %s", clip, lacking)


def _said(wanted: Wanted) -> str | None:
    """The animation that stands in the behavior itself."""
    return wanted.behavior.interpolator if isinstance(wanted.behavior, Keyframe) else None


def _cutoff(wanted: Wanted) -> float | None:
    return values_of(wanted.parameters, _RANGES).get(FILTER)
