"""Avatar files in the forms of other tools: the bones of the default avatar under other names, axes and sizes."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.glb import write_binary
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, conjugate, from_axis_angle, multiply, rotate
from reactive_realizer.embodiment.vector import Vec3, add, scale, subtract, unit

OWN = Avatar.read(Path(str(files("reactive_realizer"))) / "assets" / "avatars" / "female.glb")
Z, Y = (0.0, 0.0, 1.0), (0.0, 1.0, 0.0)


@dataclass(frozen=True)
class Rig:
    """How a rig differs from that of the default avatar.

    Attributes:
        name: from the joint to the name of its bone; None leaves the bone out.
        size: of the figure.
        lowered: angle of the arms below the T-pose, rad.
        heading: of the figure in the file, rad.
        rotated: whether bones have rotations at rest.
        units: scale of the node above the hips, which is turned by a quarter about x too unless it is 1.
    """

    name: Callable[[str], str | None] = lambda joint: joint
    size: float = 1.0
    lowered: float = 0.0
    heading: float = 0.0
    rotated: bool = False
    units: float = 1.0

    def scene(self) -> dict[str, Any]:
        """Return the glTF scene."""
        kept = [i for i, bone in enumerate(OWN.bones) if self.name(bone.joint or "") is not None]
        above = IDENTITY if self.units == 1.0 else from_axis_angle((1.0, 0.0, 0.0), -0.5 * math.pi)
        places = {-1: ((0.0, 0.0, 0.0), above)}
        nodes: list[dict[str, Any]] = [{"name": "Armature", "rotation": _xyzw(above), "scale": [self.units] * 3}]
        index = {-1: 0}
        for i in kept:
            bone = OWN.bones[i]
            parent = bone.parent
            while parent not in index:
                parent = OWN.bones[parent].parent
            turn = from_axis_angle(unit((1.0 + i % 3, i % 5 - 2.0, 1.0)), 0.3 * (i % 9 + 1)) if self.rotated else above
            at, held = places[parent]
            way = rotate(conjugate(held), scale(subtract(self._at(i), at), 1.0 / self.units))
            nodes[index[parent]].setdefault("children", []).append(len(nodes))
            index[i], places[i] = len(nodes), (self._at(i), turn)
            local = _xyzw(multiply(conjugate(held), turn))
            nodes.append({"name": self.name(bone.joint or ""), "translation": way, "rotation": local})
        return {"nodes": nodes, "skins": [{"joints": [*range(1, len(nodes))]}], "meshes": []}

    def _at(self, index: int) -> Vec3:
        bone = OWN.bones[index]
        at = OWN.rest_position(bone.joint or "") or (0.0, 0.0, 0.0)
        side = (bone.joint or "")[:2]
        part = (bone.joint or "")[2:]
        if side in ("l_", "r_") and (part in ("elbow", "wrist") or part[-1] in "123"):
            pivot = OWN.rest_position(f"{side}shoulder") or at
            down = from_axis_angle(Z, -self.lowered if side == "l_" else self.lowered)
            at = add(pivot, rotate(down, subtract(at, pivot)))
        return scale(rotate(from_axis_angle(Y, self.heading), at), self.size)


def write(path: Path, scene: Mapping[str, Any]) -> Path:
    """Write a GLB file without meshes."""
    write_binary(path, scene, b"")
    return path


def bone_places(scene: Mapping[str, Any], avatar: Avatar, root: Vec3, rotations: NDArray[Any]) -> dict[str, Vec3]:
    """Return where a renderer shows the joints: it sets the root's position in the world and the local rotations."""
    nodes, bones = scene["nodes"], [bone.name for bone in avatar.bones]
    frames = np.asarray(avatar.bone_rotations(rotations))
    found: dict[str, Vec3] = {}

    def walk(node: int, at: Vec3, turn: Quat, size: float) -> None:
        own = nodes[node]
        x, y, z, w = own.get("rotation", (0.0, 0.0, 0.0, 1.0))
        local = (w, x, y, z)
        place = add(at, scale(rotate(turn, own.get("translation", (0.0, 0.0, 0.0))), size))
        if own["name"] in bones:
            i = bones.index(own["name"])
            local = tuple(frames[i].tolist())
            place = root if i == 0 else place
            found[avatar.bones[i].joint or own["name"]] = place
        for child in own.get("children", ()):
            walk(child, place, multiply(turn, local), size * own.get("scale", [1.0])[0])

    walk(0, (0.0, 0.0, 0.0), IDENTITY, 1.0)
    return found


def _xyzw(q: Quat) -> list[float]:
    w, x, y, z = q
    return [x, y, z, w]
