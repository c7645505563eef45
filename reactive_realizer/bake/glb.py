"""Writes binary glTF 2.0 (Khronos): one buffer, views and accessors into it, textures, and the JSON around them."""

import json
import struct
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.bake.numeric import Array

Json: TypeAlias = dict[str, Any]

_FLOAT = 5126
_COMPONENTS = {"float32": _FLOAT, "uint8": 5121, "uint16": 5123}
_SHAPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}
VERTICES, INDICES = 34962, 34963
"""Buffer view targets."""

REPEAT, CLAMP = 0, 1
"""Samplers."""

_LINEAR, _LINEAR_MIPMAP_LINEAR = 9729, 9987
_WRAPS = (10497, 33071)
_MAGIC, _JSON_CHUNK, _BINARY_CHUNK = 0x46546C67, 0x4E4F534A, 0x004E4942


class Glb:
    """A file that is being written."""

    def __init__(self) -> None:
        self._buffer = bytearray()
        self._views: list[Json] = []
        self._accessors: list[Json] = []
        self._images: list[Json] = []
        self._textures: list[Json] = []

    def accessor(
        self, values: NDArray[Any], target: int | None = None, *, bounds: bool = False, normalized: bool = False
    ) -> int:
        """Store values, (n,) or (n, components), as their type is; returns the accessor's index.

        Args:
            values: float32, uint8 or uint16.
            target: `VERTICES`, `INDICES` or neither.
            bounds: whether to store the minimum and maximum, which positions require.
            normalized: integers stand for 0..1.
        """
        accessor: Json = {
            "bufferView": self._view(values.tobytes(), target),
            "componentType": _COMPONENTS[values.dtype.name],
            "count": len(values),
            "type": _SHAPES[1 if values.ndim == 1 else values.shape[1]],
        }
        if normalized:
            accessor["normalized"] = True
        if bounds:
            accessor |= {"min": values.min(0).tolist(), "max": values.max(0).tolist()}
        return self._add(accessor)

    def zeros(self, count: int) -> int:
        """An accessor of count zero vectors, which takes no room."""
        bounds = {"min": [0, 0, 0], "max": [0, 0, 0]}
        return self._add({"componentType": _FLOAT, "count": count, "type": "VEC3", **bounds})

    def sparse(self, vectors: Array, threshold: float) -> int:
        """An accessor of vectors (n, 3) that stores only those with a component above the threshold."""
        index = np.where(np.abs(vectors).max(1) > threshold)[0]
        values = vectors[index].astype("f4")
        low, high = values.min(0), values.max(0)
        if len(index) < len(vectors):
            low, high = np.minimum(low, 0), np.maximum(high, 0)
        return self._add(
            {
                "componentType": _FLOAT,
                "count": len(vectors),
                "type": "VEC3",
                "min": low.tolist(),
                "max": high.tolist(),
                "sparse": {
                    "count": len(index),
                    "indices": {
                        "bufferView": self._view(index.astype("u2").tobytes()),
                        "componentType": _COMPONENTS["uint16"],
                    },
                    "values": {"bufferView": self._view(values.tobytes())},
                },
            }
        )

    def texture(self, picture: bytes, sampler: int = REPEAT) -> Json:
        """Store a PNG or JPEG file; returns what a material refers to it by."""
        mime = "image/png" if picture.startswith(b"\x89PNG") else "image/jpeg"
        self._images.append({"bufferView": self._view(picture), "mimeType": mime})
        self._textures.append({"source": len(self._images) - 1, "sampler": sampler})
        return {"index": len(self._textures) - 1}

    def _view(self, data: bytes, target: int | None = None) -> int:
        self._pad()
        view: Json = {"buffer": 0, "byteOffset": len(self._buffer), "byteLength": len(data)}
        if target is not None:
            view["target"] = target
        self._buffer += data
        self._views.append(view)
        return len(self._views) - 1

    def _add(self, accessor: Json) -> int:
        self._accessors.append(accessor)
        return len(self._accessors) - 1

    def _pad(self) -> None:
        self._buffer += b"\0" * (-len(self._buffer) % 4)

    def save(self, path: Path, document: Json) -> None:
        """Write the file: the document, completed by what was stored, and the buffer."""
        self._pad()
        stored: Json = {
            "images": self._images,
            "textures": self._textures,
            "samplers": [
                {"magFilter": _LINEAR, "minFilter": _LINEAR_MIPMAP_LINEAR, "wrapS": wrap, "wrapT": wrap}
                for wrap in _WRAPS
            ],
            "accessors": self._accessors,
            "bufferViews": self._views,
            "buffers": [{"byteLength": len(self._buffer)}],
        }
        text = json.dumps(document | stored, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        chunks = ((text, _JSON_CHUNK), (bytes(self._buffer), _BINARY_CHUNK))
        body = b"".join(struct.pack("<II", len(data), kind) + data for data, kind in chunks)
        path.write_bytes(struct.pack("<III", _MAGIC, 2, 12 + len(body)) + body)
