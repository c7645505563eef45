"""The arrays of a binary glTF 2.0 file: its accessors (Khronos, chapter "Accessors")."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.embodiment.glb import read_binary

_TYPES = {5121: "u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
"""Component types that positions, joints, weights and indices use."""

_COLUMNS = {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}

_MOST = 10_000_000
"""Most elements of an array. Accessors without data of their own may claim any number."""


class GlbArrays:
    """The scene of a GLB file, and its arrays.

    Attributes:
        scene: its description.
    """

    def __init__(self, path: Path) -> None:
        self.scene, self._data = read_binary(path)

    def __getitem__(self, number: int) -> NDArray[Any]:
        """Return an accessor's array, (N, C): its elements, each with its components as they are stored.

        Raises:
            LookupError, TypeError, ValueError: it is not valid, or compressed.
        """
        accessor = self.scene["accessors"][number]
        kind, count, columns = accessor["componentType"], accessor["count"], _COLUMNS[accessor["type"]]
        if count > _MOST:
            raise ValueError(f"an accessor has {count} elements; at most {_MOST} are read")
        if "bufferView" in accessor:
            found = self._view(accessor, kind, count, columns)
        else:
            found = np.zeros((count, columns), _TYPES[kind])
        if (sparse := accessor.get("sparse")) is not None:
            changed, indices, values = sparse["count"], sparse["indices"], sparse["values"]
            rows = self._view(indices, indices["componentType"], changed, 1)[:, 0]
            found = found.copy()
            found[rows] = self._view(values, kind, changed, columns)
        return found

    def _view(self, part: Mapping[str, Any], kind: int, count: int, columns: int) -> NDArray[Any]:
        view = self.scene["bufferViews"][part["bufferView"]]
        start, item = view.get("byteOffset", 0) + part.get("byteOffset", 0), np.dtype(_TYPES[kind])
        stride = view.get("byteStride", columns * item.itemsize)
        return np.ndarray((count, columns), item, self._data, start, (stride, item.itemsize))
