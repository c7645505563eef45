"""A network that speaks, and what it predicts of a sentence."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float32]


class UnusableNetwork(Exception):
    """A network is not the expected one; the message is shown to the user."""


@dataclass(frozen=True, slots=True)
class Predicted:
    """What a network predicts for a sentence.

    Attributes:
        durations: number of frames of each token, with the silence at both ends.
        features: arrays with the frames along the last axis; a feature may have several values for each frame.
        constants: arrays that the network needs for any of the frames.
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
    """A network with one or more voices, which has been warmed up: the first sentence takes longer.

    Attributes:
        hello: its properties, for the realizer, among them the names of its ``voices``.
    """

    hello: Mapping[str, Any]

    def predict(self, tokens: Sequence[int], voice: str, rate: float) -> Predicted:
        """The times and the melody of a sentence.

        Args:
            tokens: without those for the silence at both ends.
            voice: one of its voices.
            rate: as a multiple of the usual one.
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
