"""The kinds of motions that a binding may name."""

from collections.abc import Callable, Mapping
from types import MappingProxyType

from reactive_realizer.engines.animation.actor import Actor, Maker
from reactive_realizer.engines.animation.arms.gesture_maker import GestureMaker
from reactive_realizer.engines.animation.gaze.gaze_maker import GazeMaker
from reactive_realizer.engines.animation.procedural.proc_motion_maker import ProcMotionMaker

MAKERS: Mapping[str, Callable[[Actor], Maker]] = MappingProxyType(
    {
        "ProcAnimation": ProcMotionMaker,
        "Gesture": GestureMaker,
        "gaze": GazeMaker,
    }
)
"""Id of a kind of motion -> what makes such motions for an actor."""
