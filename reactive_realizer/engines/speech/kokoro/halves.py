"""Cuts the network in two: the first half predicts times and melody, the second one makes sound of them.

The first half takes a thirtieth of the time of the second one, which works on any frames of a sentence.
"""

from collections.abc import Mapping, Sequence

from onnx import TensorProto
from onnx.helper import make_tensor_value_info

from reactive_realizer.engines.speech.neural.network import UnusableNetwork
from reactive_realizer.engines.speech.neural.onnx_network import part_of, read_network

DURATIONS = "/encoder/Clip_output_0"
"""The value within the graph that is the number of frames of each token."""
ENERGY = "/encoder/Reshape_1_output_0"
"""The loudness of each half of a frame, on the scale of the network."""
FEATURES: Mapping[str, Sequence[int | str]] = {
    "/encoder/MatMul_1_output_0": (1, 512, "frames"),
    "/encoder/Reshape_output_0": (1, "half frames"),
    ENERGY: (1, "half frames"),
}
"""The values between the halves, with their shapes: the sounds of each frame, and the pitch and energy of each half."""


def halves(weights: bytes) -> tuple[bytes, bytes]:
    """The two halves of a network as ONNX files.

    The first one takes ``tokens``, ``style`` and ``speed``, and gives the durations and the features; the second one
    takes ``style`` and the features, and gives ``audio``.

    Raises:
        UnusableNetwork: the file is not a network, or not an export of Kokoro-82M v1.0.
    """
    model = read_network(weights)
    made = {value for node in model.graph.node for value in node.output}
    given = {each.name: each for each in model.graph.input}
    if missing := ({DURATIONS, *FEATURES} - made) | ({"tokens", "style", "speed"} - given.keys()):
        raise UnusableNetwork(f"its network has no value {', '.join(sorted(missing))}")
    between = {name: make_tensor_value_info(name, TensorProto.FLOAT, shape) for name, shape in FEATURES.items()}
    durations = make_tensor_value_info(DURATIONS, TensorProto.FLOAT, None)
    first = part_of(model, list(given.values()), [durations, *between.values()])
    return first, part_of(model, [given["style"], *between.values()], list(model.graph.output))
