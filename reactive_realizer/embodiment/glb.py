"""Reads and writes the container of binary glTF 2.0 files, GLB and VRM (Khronos, chapter "Binary glTF Layout")."""

import json
import struct
from collections.abc import Mapping
from pathlib import Path
from typing import Any, BinaryIO

from reactive_realizer.errors import Fault, RealizerError

_HEADER = struct.Struct("<4sII")
_CHUNK = struct.Struct("<I4s")
_ALIGNED = 4
_MIB = 1024 * 1024
_LARGEST_FILE = 256 * _MIB
"""Size limit of a file, bytes. Avatars for browsers have 2 to 30 MiB, the largest of VRM about 100."""
_LONGEST_SCENE = 16 * _MIB
"""Size limit of the JSON chunk, bytes. That of a detailed avatar has less than one MiB."""


class BadAvatar(Fault):
    """A GLB file that cannot be used as an avatar."""

    code = "bad-avatar"
    template = "{file} cannot be used as an avatar: {reason}"
    file: str
    reason: str


def read_scene(path: Path) -> dict[str, Any]:
    """Return the scene description of a file, its JSON chunk; meshes and images are not read.

    Raises:
        RealizerError: "bad-avatar": the file is not binary glTF 2, is cut off or exceeds a limit.
    """
    with _opened(path) as file:
        return _scene(path, file)


def read_binary(path: Path) -> tuple[dict[str, Any], bytes]:
    """Return the scene description and the data of its first buffer, the BIN chunk; empty if there is none.

    Raises:
        RealizerError: as for `read_scene`.
    """
    with _opened(path) as file:
        scene, header = _scene(path, file), file.read(_CHUNK.size)
        if len(header) < _CHUNK.size:
            return scene, b""
        length, kind = _CHUNK.unpack(header)
        return scene, file.read(length) if kind == b"BIN\0" else b""


def write_binary(path: Path, scene: Mapping[str, Any], data: bytes) -> None:
    """Write a file with a scene description and the data of its first buffer."""
    text = json.dumps(scene, ensure_ascii=False, separators=(",", ":")).encode()
    chunks = _chunk(b"JSON", text, b" ") + (_chunk(b"BIN\0", data, b"\0") if data else b"")
    path.write_bytes(_HEADER.pack(b"glTF", 2, _HEADER.size + len(chunks)) + chunks)


def _chunk(kind: bytes, content: bytes, padding: bytes) -> bytes:
    content += padding * (-len(content) % _ALIGNED)
    return _CHUNK.pack(len(content), kind) + content


def _opened(path: Path) -> BinaryIO:
    if path.exists() and not path.is_file():
        raise _bad(path, "not a file")  # a pipe would have to be waited for
    return path.open("rb")


def _scene(path: Path, file: BinaryIO) -> dict[str, Any]:
    header = file.read(_HEADER.size + _CHUNK.size)
    if len(header) < _HEADER.size + _CHUNK.size:
        raise _bad(path, "too short for a GLB file")
    magic, version, size = _HEADER.unpack_from(header)
    length, kind = _CHUNK.unpack_from(header, _HEADER.size)
    if magic != b"glTF" or version != 2 or kind != b"JSON" or length > size:
        raise _bad(path, "not a binary glTF 2 file")
    if length > _LONGEST_SCENE:
        raise _bad(path, f"its JSON chunk is over {_LONGEST_SCENE} bytes")
    found = path.stat().st_size
    if max(size, found) > _LARGEST_FILE:
        raise _bad(path, f"it has {max(size, found) / _MIB:.0f} MiB; at most {_LARGEST_FILE // _MIB} are read")
    if found < size:
        raise _bad(path, f"it is cut off: {found} of {size} bytes are there")
    try:
        scene = json.loads(file.read(length))
    except (ValueError, RecursionError) as problem:
        raise _bad(path, f"its JSON chunk cannot be read: {problem}") from problem
    if not isinstance(scene, dict):
        raise _bad(path, "its JSON chunk is not an object")
    return scene


def _bad(path: Path, reason: str) -> RealizerError:
    return RealizerError(BadAvatar(file=path.name, reason=reason))
