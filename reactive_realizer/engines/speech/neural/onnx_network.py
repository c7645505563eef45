"""Reads, cuts and opens networks in the ONNX format. Only workers import this."""

import os
from collections.abc import Collection, Sequence

import onnx
import onnxruntime
from onnx import GraphProto, ModelProto, NodeProto, ValueInfoProto
from onnx.helper import make_graph, make_model

from reactive_realizer.engines.speech.neural.network import UnusableNetwork


def open_networks(*files: bytes) -> tuple[onnxruntime.InferenceSession, ...]:
    """Loads networks.

    Args:
        files: in the ONNX format.

    Raises:
        UnusableNetwork: a file cannot be used.
    """
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = os.cpu_count() or 1
    options.inter_op_num_threads = 1
    # Threads that wait for work by spinning would take the processors from the realizer.
    options.add_session_config_entry("session.intra_op.allow_spinning", "0")
    try:
        return tuple(onnxruntime.InferenceSession(file, options, providers=["CPUExecutionProvider"]) for file in files)
    except Exception as problem:  # onnxruntime raises classes of its own for each kind of fault
        raise UnusableNetwork(str(problem)) from problem


def read_network(file: bytes) -> ModelProto:
    """The network in an ONNX file.

    Raises:
        UnusableNetwork: the file is not in the ONNX format.
    """
    try:
        return onnx.load_from_string(file)
    except Exception as problem:  # the parser has classes of its own for each kind of fault
        raise UnusableNetwork(f"it is not an ONNX file: {problem}") from problem


def part_of(model: ModelProto, inputs: Sequence[ValueInfoProto], outputs: Sequence[ValueInfoProto]) -> bytes:
    """The part of a network between some of its values, as an ONNX file."""
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
