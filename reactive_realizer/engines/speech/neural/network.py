"""A network that speaks, and what it predicts of a sentence."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float32]


class UnusableNetwork(Exception):
    """A network is not the one that is expected; the message is for people."""


@dataclass(frozen=True, slots=True)
class Predicted:
    """What a network predicts of a sentence.

    Attributes:
        durations: frames of each token, with those of the silence at both ends.
        features: of its frames, which are in the last axis; a feature may have several values for each frame.
        constants: what it needs for any of the frames.
    """

    durations: list[int]
    features: Mapping[str, Floats]
    constants: Mapping[str, Floats]

    def part(self, first: int, last: int) -> dict[str, Floats]:
        """What the network needs to speak some frames: the first one, and the one after the last one."""
        frames = sum(self.durations)
        each = {name: feature.shape[-1] // frames for name, feature in self.features.items()}
        parts = {name: self.features[name][..., first * n : last * n] for name, n in each.items()}
        return {**self.constants, **parts}


class SpeakingNetwork(Protocol):
    """A network with one or more voices, which has spoken something already: the first time takes longer.

    Attributes:
        hello: what the realizer is told of it, with the names of its ``voices``.
    """

    hello: Mapping[str, Any]

    def predict(self, tokens: Sequence[int], voice: str, rate: float) -> Predicted:
        """The times and the melody of a sentence.

        Args:
            tokens: without those for the silence at both ends.
            voice: one of its voices.
            rate: how many times as fast as usual it is.
        """
        ...

    def speak(self, predicted: Predicted, first: int, last: int) -> bytes:
        """The sound of some frames of a sentence: mono int16 PCM.

        Args:
            predicted: of the sentence.
            first: index of the first frame.
            last: index after the last frame.
        """
        ...
