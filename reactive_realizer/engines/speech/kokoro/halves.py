"""Cuts the network in two: the first half predicts times and melody, the second one makes sound of them.

The first half takes a thirtieth of the time of the second one, which works on any frames of a sentence.
"""

from collections.abc import Collection, Mapping, Sequence

import onnx
from onnx import GraphProto, ModelProto, NodeProto, TensorProto, ValueInfoProto
from onnx.helper import make_graph, make_model, make_tensor_value_info

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


class NotKokoro(Exception):
    """The weights are not those of an export of Kokoro-82M v1.0; the message is for people."""


def halves(weights: bytes) -> tuple[bytes, bytes]:
    """The two halves of a network as ONNX files.

    The first one takes ``tokens``, ``style`` and ``speed``, and gives the durations and the features; the second one
    takes ``style`` and the features, and gives ``audio``.

    Raises:
        NotKokoro: the file is no network, or has other values.
    """
    try:
        model = onnx.load_from_string(weights)
    except Exception as problem:  # the parser has classes of its own for each kind of fault
        raise NotKokoro(f"it is no ONNX file: {problem}") from problem
    made = {value for node in model.graph.node for value in node.output}
    if missing := {DURATIONS, *FEATURES} - made:
        raise NotKokoro(f"its network has no value {', '.join(sorted(missing))}")
    given = {each.name: each for each in model.graph.input}
    between = {name: make_tensor_value_info(name, TensorProto.FLOAT, shape) for name, shape in FEATURES.items()}
    durations = make_tensor_value_info(DURATIONS, TensorProto.FLOAT, None)
    first = _part(model, list(given.values()), [durations, *between.values()])
    return first, _part(model, [given["style"], *between.values()], list(model.graph.output))


def _part(model: ModelProto, inputs: Sequence[ValueInfoProto], outputs: Sequence[ValueInfoProto]) -> bytes:
    """The part of a network between some of its values."""
    graph = model.graph
    nodes = _between(graph, {each.name for each in inputs}, [each.name for each in outputs])
    read = {value for node in nodes for value in node.input}
    constants = [each for each in graph.initializer if each.name in read]
    part = make_graph(nodes, graph.name, inputs, outputs, constants)
    whole = make_model(part, opset_imports=model.opset_import, ir_version=model.ir_version)
    return bytes(whole.SerializeToString())


def _between(graph: GraphProto, inputs: Collection[str], outputs: Sequence[str]) -> list[NodeProto]:
    """The nodes that compute the outputs from the inputs, in the order of the graph."""
    needed, nodes = set(outputs), []
    for node in reversed(graph.node):  # which is sorted: a node comes after those that it reads
        if needed.intersection(node.output) - set(inputs):
            nodes.append(node)
            needed.update(node.input)
    return nodes[::-1]
