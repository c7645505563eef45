"""From a binding, or from BML itself, to a keyframe animation or a capture."""

import logging

from reactive_realizer.binding.gesture_binding import numbers
from reactive_realizer.bml.twente import Keyframe
from reactive_realizer.engines.animation.actor import Actor, Wanted
from reactive_realizer.engines.animation.keyframe.clip import Clip
from reactive_realizer.engines.animation.keyframe.clip_cache import clip_in
from reactive_realizer.engines.animation.keyframe.keyframe_motion_unit import KeyframeMotionUnit
from reactive_realizer.engines.animation.keyframe.skeleton_interpolator import read_interpolator_text
from reactive_realizer.errors import error

_log = logging.getLogger(__name__)


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
        return KeyframeMotionUnit(self._of_figure(clip.mirrored() if wanted.mirror else clip, wanted), self._skeleton)

    def _clip(self, wanted: Wanted) -> Clip:
        cutoff = numbers(wanted.parameters).get("filter")
        behavior = wanted.behavior
        if isinstance(behavior, Keyframe) and behavior.interpolator is not None:
            return read_interpolator_text(behavior.interpolator, behavior.id).filtered(cutoff or 0.0)
        return clip_in(self._actor.file_of(wanted, "xml", "bvh"), self._skeleton, cutoff)

    def _of_figure(self, clip: Clip, wanted: Wanted) -> Clip:
        """What of it moves joints that are wanted and that the figure has."""
        chosen = wanted.joints or clip.joints
        there = [joint for joint in clip.joints if joint in chosen and joint in self._skeleton]
        missing = sorted(set(chosen).difference(there))
        if not there:
            raise error("no-joints", joints=", ".join(missing), element=wanted.behavior.name)
        if missing:
            _log.info("%s leaves out what it has not, or the figure has not: %s", clip.name, ", ".join(missing))
        return clip.only(there)
