"""Mouth shapes: the fifteen visemes, the parts of the mouth that move on their own, and the shape of each viseme."""

from collections.abc import Mapping
from dataclasses import dataclass, field

SILENCE = "sil"
"""The viseme of a mouth at rest."""

VISEMES = (SILENCE, "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "ih", "oh", "ou")
"""The visemes of the Oculus set."""


@dataclass(frozen=True, slots=True)
class Articulator:
    """A part of the mouth that sounds move independently of the others, such as the jaw.

    Attributes:
        morphs: names of the weights that move it: of morph targets, and of turns of joints (`turn_weights`).
        before: time constant of the dominance of a sound before it begins, s: how early the part moves towards it.
        after: that after the sound has ended, s.
    """

    morphs: tuple[str, ...]
    before: float
    after: float


@dataclass(frozen=True, slots=True)
class MouthShape:
    """The mouth of a viseme.

    Attributes:
        morphs: weights of morph targets and of turns of joints, 0..1; all others are 0.
        dominance: of the sound over its neighbors, above 0 and up to 1, for each articulator; 1 if it is not listed.
        contact: articulators that neighbors do not change, because lips or teeth touch; none for most visemes.
    """

    morphs: Mapping[str, float] = field(default_factory=dict)
    dominance: Mapping[str, float] = field(default_factory=dict)
    contact: tuple[str, ...] = ()
