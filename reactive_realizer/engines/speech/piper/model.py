"""The network: from tokens to the duration of each token, and to sound. Only the worker imports this.

Piper (Hansen, 2023) is a family of VITS networks (Kim, Kong and Son, 2021), each with a text encoder, a duration
predictor and a HiFi-GAN decoder.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from reactive_realizer.engines.speech.neural.network import Predicted, SpeakingNetwork, UnusableNetwork
from reactive_realizer.engines.speech.neural.onnx_network import open_networks
from reactive_realizer.engines.speech.piper.halves import halves
from reactive_realizer.engines.speech.piper.voice_file import END, PAD, START, VoiceFile

_WARMING = 20
"""Frames that are spoken to warm up the network."""
_NOISE = 0.0
"""Scale of the noise in durations and sound: with noise, the same text would not always give the same bytes."""


class PiperModel(SpeakingNetwork):
    """A loaded network.

    Args:
        file: of the voice.

    Raises:
        UnusableNetwork: the file cannot be used.
    """

    def __init__(self, file: VoiceFile) -> None:
        self._file = file
        try:
            self._halves = halves(file.path.read_bytes())
            self._predictor, self._synthesizer = open_networks(self._halves.first, self._halves.second)
            self.hello = {
                "voices": list(file.speakers),
                "language": file.language,
                "ids": file.ids,
                "rate": file.rate,
                "frame": self._frame(),
            }
        except OSError as problem:
            raise UnusableNetwork(f"{file.path}: {problem.strerror}") from problem
        except UnusableNetwork as problem:
            raise UnusableNetwork(f"{file.path}: {problem}") from problem

    def predict(self, tokens: Sequence[int], voice: str, rate: float) -> Predicted:
        """See `SpeakingNetwork.predict`. A token includes the padding after it."""
        ids = self._file.ids
        padded = [number for token in tokens for number in (token, ids[PAD])]
        given = np.array([[ids[START], ids[PAD], *padded, ids[END]]], np.int64)
        inputs: dict[str, Any] = {
            "input": given,
            "input_lengths": np.array([given.size], np.int64),
            "scales": np.array([_NOISE, self._file.slowness / rate, _NOISE], np.float32),
        }
        speaker = self._file.speakers[voice]
        if speaker is not None:
            inputs["sid"] = np.array([speaker], np.int64)
        durations, sounds, *constants = self._predictor.run(None, inputs)
        frames = durations.ravel().astype(int).tolist()
        pairs = [a + b for a, b in zip(frames[:-1:2], frames[1:-1:2], strict=True)]
        named = {} if self._halves.speaker is None else {self._halves.speaker: constants[0]}
        return Predicted([*pairs, frames[-1]], {self._halves.sounds: sounds}, named)

    def speak(self, predicted: Predicted, first: int, last: int) -> bytes:
        """See `SpeakingNetwork.speak`."""
        (audio,) = self._synthesizer.run(None, predicted.part(first, last))
        return bytes((np.clip(audio.ravel(), -1.0, 1.0) * 32767).astype("<i2").tobytes())

    def _frame(self) -> int:
        """The length of a frame, samples.

        The network is given all characters and the last speaker for this, so that a number that it does not know is
        found now.
        """
        try:
            predicted = self.predict(sorted(self._file.ids.values()), [*self._file.speakers][-1], 1.0)
            spoken = self.speak(predicted, 0, _WARMING)
        except Exception as problem:  # onnxruntime raises classes of its own for each kind of fault
            raise UnusableNetwork(f"its network fails: {problem}") from problem
        return len(spoken) // 2 // _WARMING
