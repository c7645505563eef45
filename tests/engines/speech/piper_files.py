"""Writes voices in the format of Piper whose network is tiny: each sound is a tone, and all else is silent."""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np
from onnx import TensorProto
from onnx.helper import make_graph, make_model, make_node, make_opsetid, make_tensor_value_info
from onnx.numpy_helper import from_array

RATE: Final = 16_000
_FRAME: Final = 256
"""Length of a frame, samples."""
_FRAMES: Final = 4.0
"""Duration of each character, frames; that of the padding after it, and of the ends of a sentence, is one frame."""

_STOPS: Final = "_^$ .,?!:;"
_SIGNS: Final = "\u02c8\u02cc\u02d0\u0303\u0329"
_VOWELS: Final = "aeiouy\u00e6\u0250\u0251\u0252\u0254\u0259\u025a\u025b\u025c\u026a\u0268\u028a\u028c"
_CONSONANTS: Final = "bcdfhjklmnpqrstvwxz\u00e7\u00f0\u014b\u0261\u0279\u027e\u0283\u0292\u03b8"
IDS: Final = {each: [number] for number, each in enumerate(_STOPS + _SIGNS + _VOWELS + _CONSONANTS)}
CONFIG: Final[Mapping[str, Any]] = {
    "audio": {"sample_rate": RATE},
    "espeak": {"voice": "en-us"},
    "phoneme_type": "espeak",
    "phoneme_id_map": IDS,
}


def write_voice(
    folder: Path, name: str = "tones", speakers: Sequence[str] = (), changes: Mapping[str, Any] | None = None
) -> Path:
    """Writes a voice, and returns the file of its network; of several speakers, each one is half as loud as the last.

    Args:
        folder: for its two files.
        name: of the files.
        speakers: of a network with several.
        changes: of the JSON file; None leaves a key out.
    """
    network = folder / f"{name}.onnx"
    network.write_bytes(tiny_network(len(speakers)))
    several = {"num_speakers": len(speakers), "speaker_id_map": {each: n for n, each in enumerate(speakers)}}
    config = {**CONFIG, **(several if speakers else {}), **(changes or {})}
    written = {key: value for key, value in config.items() if value is not None}
    network.with_name(f"{network.name}.json").write_text(json.dumps(written))
    return network


def tiny_network(speakers: int = 0, opset: int = 15) -> bytes:
    """A network with the inputs, the outputs and the names of weights of Piper's."""
    durations = np.array([1.0 if each in "_^$" else _FRAMES for each in IDS], np.float32)
    levels = np.array([0.0 if each in _STOPS + _SIGNS else 1.0 for each in IDS], np.float32)
    tone = (0.5 * np.sin(2 * np.pi * np.arange(_FRAME) / 32)).astype(np.float32)
    louder = (0.5 ** np.arange(max(speakers, 1), dtype=np.float32)).reshape(-1, 1, 1)
    constants = {
        "durations": durations,
        "levels": levels,
        "dec.conv_pre.weight": np.ones((1, 1, 1), np.float32),
        "dec.cond.weight": np.ones((1, 1, 1), np.float32),
        "tone": tone.reshape(1, 1, _FRAME),
        "emb_g": louder,
        "zero": np.array(0, np.int64),
        "one": np.array(1, np.int64),
        "last": np.array([1], np.int64),
        "first": np.array([0], np.int64),
        "shape": np.array([1, 1, -1], np.int64),
    }
    nodes = [
        make_node("Squeeze", ["input", "first"], ["ids"]),
        make_node("Slice", ["scales", "last", "two"], ["slowness"]),
        make_node("Gather", ["durations", "ids"], ["usual"]),
        make_node("Mul", ["usual", "slowness"], ["exact"]),
        make_node("Ceil", ["exact"], ["frames of ids"]),
        make_node("CumSum", ["frames of ids", "zero"], ["ends"]),
        make_node("ReduceMax", ["ends"], ["end"], keepdims=0),
        make_node("Cast", ["end"], ["count"], to=TensorProto.INT64),
        make_node("Range", ["zero", "count", "one"], ["frames"]),
        make_node("Cast", ["frames"], ["times"], to=TensorProto.FLOAT),
        make_node("Unsqueeze", ["ends", "last"], ["each end"]),
        make_node("GreaterOrEqual", ["times", "each end"], ["passed"]),
        make_node("Cast", ["passed"], ["passed ids"], to=TensorProto.INT64),
        make_node("ReduceSum", ["passed ids", "first"], ["place"], keepdims=0),
        make_node("Gather", ["ids", "place"], ["id of frame"]),
        make_node("Gather", ["levels", "id of frame"], ["level of frame"]),
        make_node("Reshape", ["level of frame", "shape"], ["sounds"]),
        make_node("Conv", ["sounds", "dec.conv_pre.weight"], ["decoded"]),
        *(
            [
                make_node("Gather", ["emb_g", "sid"], ["speaker"]),
                make_node("Conv", ["speaker", "dec.cond.weight"], ["volume"]),
                make_node("Mul", ["decoded", "volume"], ["heard"]),
            ]
            if speakers
            else [make_node("Identity", ["decoded"], ["heard"])]
        ),
        make_node("ConvTranspose", ["heard", "tone"], ["output"], strides=[_FRAME]),
    ]
    constants["two"] = np.array([2], np.int64)
    inputs = [
        make_tensor_value_info("input", TensorProto.INT64, (1, "phonemes")),
        make_tensor_value_info("input_lengths", TensorProto.INT64, (1,)),
        make_tensor_value_info("scales", TensorProto.FLOAT, (3,)),
        *([make_tensor_value_info("sid", TensorProto.INT64, (1,))] if speakers else []),
    ]
    outputs = [make_tensor_value_info("output", TensorProto.FLOAT, (1, 1, "time"))]
    weights = [from_array(array, name) for name, array in constants.items()]
    graph = make_graph(nodes, "tiny", inputs, outputs, weights)
    return bytes(make_model(graph, opset_imports=[make_opsetid("", opset)], ir_version=8).SerializeToString())
