"""Cuts the network in two: the first half predicts times and melody, the second one makes sound of them.

Exports of Piper differ in the names of values, but not in those of weights. So the places are found by their neighbors.
"""

from typing import NamedTuple

from onnx import ModelProto, TensorProto
from onnx.helper import make_tensor_value_info

from reactive_realizer.engines.speech.neural.network import UnusableNetwork
from reactive_realizer.engines.speech.neural.onnx_network import part_of, read_network

_INPUTS = {"input", "input_lengths", "scales"}
_SPEAKER = "sid"
_DECODER = "dec.conv_pre.weight"
"""Weights of the first node of the second half, HiFi-GAN."""
_SPEAKER_OF_DECODER = "dec.cond.weight"
"""Weights of the node that tells the second half of the speaker."""


class Halves(NamedTuple):
    """The two halves of a network.

    Attributes:
        first: an ONNX file: from all inputs to the durations of the ids, in frames, the sounds, and the speaker.
        second: an ONNX file: from the sounds and the speaker to the audio.
        sounds: the name of the value with the sounds of each frame: (1, size, frames).
        speaker: the name of the value that describes the speaker; None if the network has only one.
    """

    first: bytes
    second: bytes
    sounds: str
    speaker: str | None


def halves(file: bytes) -> Halves:
    """Cuts a network.

    Args:
        file: in the ONNX format.

    Raises:
        UnusableNetwork: the file is not a network, or not one of Piper.
    """
    model = read_network(file)
    inputs = {each.name for each in model.graph.input}
    rounded = [node.output[0] for node in model.graph.node if node.op_type == "Ceil"]
    sounds = _read_with(model, _DECODER)
    if inputs - {_SPEAKER} != _INPUTS or len(rounded) != 1 or sounds is None:
        raise UnusableNetwork("its network is not one of Piper")
    speaker = _read_with(model, _SPEAKER_OF_DECODER)
    between = [make_tensor_value_info(name, TensorProto.FLOAT, None) for name in (sounds, speaker) if name is not None]
    durations = make_tensor_value_info(rounded[0], TensorProto.FLOAT, None)
    first = part_of(model, list(model.graph.input), [durations, *between])
    return Halves(first, part_of(model, between, list(model.graph.output)), sounds, speaker)


def _read_with(model: ModelProto, weights: str) -> str | None:
    """The value that a node reads together with some weights."""
    return next((node.input[0] for node in model.graph.node if weights in node.input[1:]), None)
