"""The lids of a frame, from expressions, gaze and blinks."""

from collections.abc import Mapping

_SIDES = ("Left", "Right")
_RAISED_OR_LOWERED = ("eyeLookUp", "eyeLookDown", "eyeWide")


def with_lids(face: Mapping[str, float], gaze: Mapping[str, float], blink: Mapping[str, float]) -> dict[str, float]:
    """Return the weights of a face with its lids.

    A blink closes what the expression leaves open, so it opens the lids again as far as the expression had them open,
    and no further. As far as they are closed, lids neither follow the gaze nor are wide.

    Args:
        face: weights of morph targets, of expressions and speech.
        gaze: those by which the lids follow the eyes, added to the face.
        blink: of eyeBlinkLeft and eyeBlinkRight, 0 to 1.
    """
    weights = {morph: face.get(morph, 0.0) + gaze.get(morph, 0.0) for morph in {**face, **gaze}}
    for side in _SIDES:
        own = min(max(weights.get(f"eyeBlink{side}", 0.0), 0.0), 1.0)
        opened = (1.0 - own) * (1.0 - blink.get(f"eyeBlink{side}", 0.0))
        if opened < 1.0:
            weights[f"eyeBlink{side}"] = 1.0 - opened
            weights |= {
                f"{morph}{side}": opened * weights[f"{morph}{side}"]
                for morph in _RAISED_OR_LOWERED
                if f"{morph}{side}" in weights
            }
    return weights
