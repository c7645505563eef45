"""The JSON chunk of a binary glTF 2.0 file (Khronos; chapter "Binary glTF Layout")."""

import json
import struct
from pathlib import Path
from typing import Any

from reactive_realizer.errors import error

_HEADER = struct.Struct("<4sII")
_CHUNK = struct.Struct("<I4s")


def read_glb(path: Path) -> dict[str, Any]:
    """The scene description of a GLB file; meshes and pictures stay unread.

    Raises:
        RealizerError: "bad-avatar", the file is no binary glTF 2.
    """
    with path.open("rb") as file:
        header = file.read(_HEADER.size + _CHUNK.size)
        if len(header) < _HEADER.size + _CHUNK.size:
            raise error("bad-avatar", file=path.name, reason="too short for a GLB file")
        magic, version, size = _HEADER.unpack_from(header)
        length, kind = _CHUNK.unpack_from(header, _HEADER.size)
        if magic != b"glTF" or version != 2 or kind != b"JSON" or length > size:
            raise error("bad-avatar", file=path.name, reason="not a binary glTF 2 file")
        text = file.read(length)
    try:
        scene = json.loads(text)
    except ValueError as problem:
        raise error("bad-avatar", file=path.name, reason=f"its JSON chunk cannot be read: {problem}") from problem
    if not isinstance(scene, dict):
        raise error("bad-avatar", file=path.name, reason="its JSON chunk is no object")
    return scene
