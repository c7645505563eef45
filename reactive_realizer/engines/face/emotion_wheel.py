"""Plutchik's wheel of emotions: faces between the tabulated ones (thesis 8.8), from assets/face/emotion_wheel.json."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

from reactive_realizer.engines.face.json_table import bad_entry, read_table
from reactive_realizer.engines.face.weights import Weights, added, limited, scaled

_CIRCLE = 360.0


@dataclass(frozen=True, slots=True)
class _Emotion:
    """An emotion on the wheel: its angle, degrees; its activation; and weights of morph targets at this activation."""

    angle: float
    activation: float
    weights: Weights

    def at(self, activation: float) -> dict[str, float]:
        return scaled(self.weights, activation / self.activation)


@dataclass(frozen=True, slots=True)
class EmotionWheel:
    """The emotions in the order of their angles."""

    emotions: tuple[_Emotion, ...]

    @classmethod
    def read(cls, path: Path, lexemes: Mapping[str, Weights]) -> Self:
        """Reads the format of assets/face/emotion_wheel.json.

        Args:
            path: of the table.
            lexemes: weights of each lexeme.

        Raises:
            RealizerError: "bad-asset": the file has another format, or there is no such lexeme.
            OSError: the file cannot be read.
        """
        found = [_emotion(path, name, entry, lexemes) for name, entry in read_table(path, "emotions").items()]
        if not found:
            raise bad_entry(path, "emotions", "there are none")
        return cls(tuple(sorted(found, key=lambda emotion: emotion.angle)))

    def weights(self, angle: float, activation: float) -> dict[str, float]:
        """The face at a place of the wheel.

        It lies between the faces of the two emotions on either side, in proportion to the angle, each scaled by the
        activation in relation to that of the emotion.

        Args:
            angle: degrees, 0 to 360.
            activation: 0 to 7; 0 is a neutral face.
        """
        after = next((emotion for emotion in self.emotions if emotion.angle > angle), self.emotions[0])
        before = next((emotion for emotion in reversed(self.emotions) if emotion.angle <= angle), self.emotions[-1])
        between = (after.angle - before.angle) % _CIRCLE or _CIRCLE
        share = (angle - before.angle) % _CIRCLE / between
        return limited(added([scaled(before.at(activation), 1.0 - share), scaled(after.at(activation), share)]))


def _emotion(path: Path, name: str, entry: Any, lexemes: Mapping[str, Weights]) -> _Emotion:
    angle, activation = (entry.get(key) if isinstance(entry, dict) else None for key in ("angle", "activation"))
    if not isinstance(angle, int | float) or not isinstance(activation, int | float):
        raise bad_entry(path, name, "an emotion has an angle and an activation, which are numbers")
    if not 0.0 <= angle < _CIRCLE or not activation > 0.0:
        raise bad_entry(path, name, "the angle is from 0 to 360, and the activation above 0")
    if name not in lexemes:
        raise bad_entry(path, name, "there is no such lexeme")
    return _Emotion(angle, activation, lexemes[name])
