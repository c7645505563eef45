"""Lids go up and down with their eyes: else an eye that looks up is all white."""

import math
from collections.abc import Mapping

from reactive_realizer.embodiment.joints import EYES
from reactive_realizer.embodiment.quaternion import Quat, rotate
from reactive_realizer.embodiment.vector import FORWARD
from reactive_realizer.engines.animation.gaze.eyes import EYE_RANGE, EYE_RANGE_UP

_HIGHEST = math.sin(EYE_RANGE_UP)
"""Of an eye that looks up as far as it goes: there its lid is as high as it goes."""

_SIDES = dict(zip(EYES, ("Left", "Right"), strict=True))


def with_lids(turns: Mapping[str, Quat], blinks: Mapping[str, float]) -> dict[str, float]:
    """Morph weights of the lids over eyes that are turned so.

    The upper lid follows the eye through all of its range: W. Becker and A. F. Fuchs, "Lid-eye coordination during
    vertical gaze changes in man and monkey" (Journal of Neurophysiology 60, 1988). A lid that blinks is closed,
    wherever the eye looks.

    Args:
        turns: eye joint -> rotation in the head.
        blinks: morph weights of a blink.
    """
    weights = dict(blinks)
    for eye, turn in turns.items():
        side = _SIDES[eye]
        open_ = 1.0 - blinks.get(f"eyeBlink{side}", 0.0)
        height = rotate(turn, FORWARD)[1]
        if height > 0.0:
            # A lid that is raised shows more of the eye than the morph for looking up alone does.
            raised = open_ * min(1.0, height / _HIGHEST)
            weights |= {f"eyeLookUp{side}": raised, f"eyeWide{side}": raised}
        elif height < 0.0:
            weights[f"eyeLookDown{side}"] = -open_ * height / EYE_RANGE
    return weights
