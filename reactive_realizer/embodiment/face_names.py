"""Names of ARKit's blend shapes and some others, of the visemes of Oculus and of VRM's expressions, in any spelling."""

import re
from collections.abc import Iterator, Mapping
from functools import lru_cache

_BOTH = "browDown browOuterUp cheekSquint eyeBlink eyeLookDown eyeLookIn eyeLookOut eyeLookUp eyeSquint eyeWide"
_BOTH += " mouthDimple mouthFrown mouthLowerDown mouthPress mouthSmile mouthStretch mouthUpperUp noseSneer"
_WHOLE = "browInnerUp cheekPuff jawForward jawLeft jawOpen jawRight mouthClose mouthFunnel mouthLeft mouthPucker"
_WHOLE += " mouthRight mouthRollLower mouthRollUpper mouthShrugLower mouthShrugUpper tongueOut"

ARKIT = (*(f"{name}{side}" for name in _BOTH.split() for side in ("Left", "Right")), *_WHOLE.split())
"""The 52 blend shapes of ARKit (`ARFaceAnchor.BlendShapeLocation`)."""

_SIDED = "earUp earDown earOut earIn eyeConstrict eyeDilation eyeThrust eyeSink noseTip nasalDilation nasalConstrict"
_SIDED += " browInnerUp cheekPuff cheekSuck lipPucker lipSuckUpper mouthShrugLower"
_SINGLE = "noseTipUp noseTipDown lipPuckerUpper lipPuckerLower"
_TONGUE = "tongueUp tongueDown tongueLeft tongueRight tongueTipUp tongueTipDown tongueRoll"

BEYOND_ARKIT = (
    *(f"{name}{side}" for name in _SIDED.split() for side in ("Left", "Right")),
    *_SINGLE.split(),
    *_TONGUE.split(),
)
"""Shapes that MPEG-4's parameters move and ARKit lacks, or has for both sides only.

Their names are those of Unified Expressions (of VRCFaceTracking), where these have such a shape.
"""

_SOUNDS = ("sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "I", "O", "U")

OCULUS = tuple(f"viseme_{sound}" for sound in _SOUNDS)
"""The 15 visemes of Oculus, by their names in avatars of Ready Player Me."""

VRM = (
    *("happy", "angry", "sad", "relaxed", "surprised", "neutral"),
    *("aa", "ih", "ou", "ee", "oh"),
    *("blink", "blinkLeft", "blinkRight"),
    *("lookUp", "lookDown", "lookLeft", "lookRight"),
)
"""The preset expressions of VRM 1."""

VRM_0: Mapping[str, str] = {
    "joy": "happy",
    "angry": "angry",
    "sorrow": "sad",
    "fun": "relaxed",
    "neutral": "neutral",
    "a": "aa",
    "i": "ih",
    "u": "ou",
    "e": "ee",
    "o": "oh",
    "blink": "blink",
    "blink_l": "blinkLeft",
    "blink_r": "blinkRight",
    "lookup": "lookUp",
    "lookdown": "lookDown",
    "lookleft": "lookLeft",
    "lookright": "lookRight",
}
"""Preset of VRM 0 -> that of VRM 1 with the same meaning."""

_SIDES = {"l": "left", "r": "right"}
_OCULUS_VOWELS = {"I": "ih", "O": "oh", "U": "ou"}


@lru_cache(4096)
def plain(name: str) -> str:
    """Return a name without case and punctuation; an `L` or `R` at its end that stands alone is written out."""
    low = name.lower()
    if re.search(r"[\W_][lr]$", low):
        low = low[:-1] + _SIDES[low[-1]]
    return re.sub(r"[\W_]", "", low)


def _spellings() -> Iterator[tuple[str, str]]:
    yield from ((plain(name), name) for name in (*ARKIT, *BEYOND_ARKIT))
    for sound, name in zip(_SOUNDS, OCULUS, strict=True):
        for spelled in (sound, _OCULUS_VOWELS.get(sound, sound)):
            yield from ((plain(prefix + spelled), name) for prefix in ("viseme_", "v_"))


_SPELLED = dict(_spellings())
_SPELLED_VRM = {plain(name): name for name in VRM}


def meaning(name: str, others: Mapping[str, str]) -> str | None:
    """Return what a file means by the name of a morph target or an expression.

    This is one of `ARKIT`, `BEYOND_ARKIT`, `OCULUS` or `VRM`. Case and punctuation do not matter; nor does what comes
    before a punctuation mark, except in names of VRM.

    Args:
        name: in the file.
        others: plain spelling -> meaning, of further names.
    """
    if (whole := _SPELLED_VRM.get(plain(name))) is not None:
        return whole
    for start in (0, *(mark.end() for mark in re.finditer(r"[\W_]", name))):
        rest = plain(name[start:])
        if rest in _SPELLED or rest in others:
            return _SPELLED.get(rest) or others[rest]
    return None
