"""Which joints take part in a gaze, and how much each (the keys of SmartBody's gaze: EYES up to BACK)."""

from collections.abc import Mapping
from functools import lru_cache
from types import MappingProxyType

from reactive_realizer.bml.words import Influence
from reactive_realizer.engines.animation.motion_unit import AMOUNT_RANGE
from reactive_realizer.planunit.parameter import Range

EYES = "eyes"

JOINTS: Mapping[str, Mapping[str, float]] = MappingProxyType(
    {
        "back": {"vl5": 1.0},
        "chest": {"vt10": 0.4, "vt6": 0.6},
        "neck": {"vc4": 1.0},
        "head": {"skullbase": 1.0},
    }
)
"""Group of joints, from below -> joint -> its part of what the group does."""

HEAD_WEIGHTS: Mapping[str, Range] = MappingProxyType(dict.fromkeys(JOINTS, AMOUNT_RANGE))
"""The parameters of a turn of the head: each group's part of it; together they make no more than all of it."""

WEIGHTS: Mapping[str, Range] = MappingProxyType({**HEAD_WEIGHTS, EYES: AMOUNT_RANGE})
"""The parameters of a gaze: of the eyes it is the part that they go of the way from straight ahead to the target."""

_HEAD = {"neck": 0.43, "head": 0.57, EYES: 1.0}
_SHOULDER = {"chest": 0.26, "neck": 0.32, "head": 0.42, EYES: 1.0}
_WAIST = {"back": 0.17, "chest": 0.24, "neck": 0.26, "head": 0.33, EYES: 1.0}

_USUAL: Mapping[Influence, Mapping[str, float]] = {
    Influence.EYES: {EYES: 1.0},
    Influence.HEAD: _HEAD,
    Influence.SHOULDER: _SHOULDER,
    Influence.WAIST: _WAIST,
    # Feet stay where they stand: what would turn the legs is locomotion.
    Influence.WHOLE: _WAIST,
}


def usual_weights(influence: Influence) -> dict[str, float]:
    """What every group does, 0 to 1, where nobody says anything else."""
    return {group: _USUAL[influence].get(group, 0.0) for group in WEIGHTS}


def joint_weights(weights: Mapping[str, float]) -> Mapping[str, float]:
    """Joint -> its part of the head's turn, of those that have one."""
    return _joint_weights(*(weights[group] for group in JOINTS))


@lru_cache
def _joint_weights(*weights: float) -> Mapping[str, float]:
    parts = {
        joint: weight * part
        for weight, joints in zip(weights, JOINTS.values(), strict=True)
        for joint, part in joints.items()
        if weight > 0.0
    }
    return MappingProxyType(parts)
