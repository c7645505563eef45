"""What is wrong with the skin of a GLB file, by its description alone: accessors that say more than there is."""

from collections.abc import Iterator, Mapping
from typing import Any

_SIZES = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}
"""Component type -> bytes (Khronos, glTF 2.0, chapter "Accessor Data Types")."""

_COLUMNS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
_PLACED = ("POSITION", "JOINTS_0", "WEIGHTS_0")
"""Attributes of a vertex without which it cannot be placed."""

_Scene = Mapping[str, Any]


def skin_faults(scene: _Scene) -> tuple[str, ...]:
    """Return what is wrong with the skins of a scene, as sentences. Its figure moves, but may not look as it should."""
    return tuple(dict.fromkeys(_all(scene)))


def _all(scene: _Scene) -> Iterator[str]:
    for node in scene["nodes"]:
        if "mesh" not in node or "skin" not in node:
            continue
        try:
            yield from _of_node(scene, node)
        except (LookupError, TypeError, AttributeError) as problem:
            yield f"the skin of the node {_name(node, 'node', node['mesh'])} cannot be read ({problem!r})"


def _of_node(scene: _Scene, node: _Scene) -> Iterator[str]:
    skin, mesh = scene["skins"][node["skin"]], scene["meshes"][node["mesh"]]
    if "inverseBindMatrices" in skin:
        number, bones = skin["inverseBindMatrices"], len(skin["joints"])
        yield from _too_long(scene, number, f"the inverse bind matrices of the skin {node['skin']}")
        if (found := scene["accessors"][number]["count"]) < bones:
            yield f"the skin {node['skin']} has {bones} bones, but {found} inverse bind matrices (accessor {number})"
    else:
        yield (
            f"the skin {node['skin']} has no inverse bind matrices, so its vertices are taken to be in the axes of "
            "their bones"
        )
    for part in mesh["primitives"]:
        yield from _of_part(scene, part, _name(mesh, "mesh", node["mesh"]))


def _of_part(scene: _Scene, part: _Scene, mesh: str) -> Iterator[str]:
    attributes = part["attributes"]
    for name in _PLACED:
        if name not in attributes:
            yield f"the mesh {mesh} has vertices without {name}"
            return
        yield from _too_long(scene, attributes[name], f"{name} of the mesh {mesh}")
    counts = {name: scene["accessors"][attributes[name]]["count"] for name in _PLACED}
    if len(set(counts.values())) > 1:
        listed = ", ".join(f"{count} {name} (accessor {attributes[name]})" for name, count in counts.items())
        yield f"the vertices of the mesh {mesh} are not as many everywhere: {listed}"
    if "indices" in part:
        yield from _too_long(scene, part["indices"], f"the indices of the mesh {mesh}")


def _too_long(scene: _Scene, number: int, what: str) -> Iterator[str]:
    """Yield that an accessor has more elements than its buffer view, if it does."""
    accessor = scene["accessors"][number]
    if "bufferView" not in accessor:
        return
    view = scene["bufferViews"][accessor["bufferView"]]
    item = _SIZES[accessor["componentType"]] * _COLUMNS[accessor["type"]]
    start, stride = accessor.get("byteOffset", 0), view.get("byteStride", item)
    room = max(0, (view["byteLength"] - start - item) // stride + 1)
    if accessor["count"] > room:
        yield (
            f"the accessor {number}, {what}, has {accessor['count']} elements; "
            f"its buffer view {accessor['bufferView']} has room for {room}"
        )


def _name(described: _Scene, kind: str, number: int) -> str:
    return str(described.get("name", f"{kind} {number}"))
