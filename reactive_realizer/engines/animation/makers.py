"""The kinds of motions that a binding may name."""

from collections.abc import Callable, Mapping
from functools import partial
from types import MappingProxyType

from reactive_realizer.bml.words import Influence
from reactive_realizer.engines.animation.actor import Actor, Maker
from reactive_realizer.engines.animation.arms.gesture_maker import GestureMaker
from reactive_realizer.engines.animation.arms.pointing_maker import PointingMaker
from reactive_realizer.engines.animation.gaze.gaze_maker import GazeMaker, HeadDirectionMaker
from reactive_realizer.engines.animation.keyframe.keyframe_maker import KeyframeMaker
from reactive_realizer.engines.animation.noise_maker import NoiseMaker
from reactive_realizer.engines.animation.posture.posture_maker import PostureMaker
from reactive_realizer.engines.animation.procedural.proc_motion_maker import ProcMotionMaker
from reactive_realizer.engines.animation.sequence.sequence_maker import SequenceMaker
from reactive_realizer.engines.animation.transition.transition_maker import TransitionMaker

MAKERS: Mapping[str, Callable[[Actor], Maker]] = MappingProxyType(
    {
        "ProcAnimation": ProcMotionMaker,
        "Gesture": GestureMaker,
        "gaze": GazeMaker,
        "dynamic-gaze": partial(GazeMaker, follow=True),
        "eye-gaze": partial(GazeMaker, influence=Influence.EYES),
        "gaze-shift": GazeMaker,
        "rest-gaze": partial(GazeMaker, follow=True),
        "head-direction": HeadDirectionMaker,
        "pointing": PointingMaker,
        "Keyframe": KeyframeMaker,
        "noise": NoiseMaker,
        "transition": TransitionMaker,
        "posture": PostureMaker,
        "posture-shift": PostureMaker,
    }
)
"""Id of a kind of motion -> what makes such motions for an actor."""


def makers_of(actor: Actor) -> Mapping[str, Maker]:
    """What makes motions for an actor, by the id of their kind; sequences are made of what the others make."""
    makers: dict[str, Maker] = {kind: maker(actor) for kind, maker in MAKERS.items()}
    makers["Sequence"] = SequenceMaker(actor, makers)
    return makers
