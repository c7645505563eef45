"""The morph targets of a glTF scene by name, and the expressions of VRM files, which are weights of them."""

import math
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from reactive_realizer.embodiment.face_names import VRM_0

_MOST = 1_000
_LARGEST_WEIGHT = 10.0
_PERCENT = 100.0


class MorphTarget(NamedTuple):
    """A morph target: the index of its mesh in the file, and its own in the mesh."""

    mesh: int
    target: int


@dataclass(frozen=True, slots=True)
class MorphTargets:
    """The morph targets of a file.

    Attributes:
        named: name -> what moves by it. Targets of one name move together, unless an expression moves some of them.
        unnamed: those of `named` that a loader of glTF does not find by the `targetNames` of meshes.
        expressions: name -> weights of `named`. Presets of VRM 0 have the names of VRM 1.
        notes: what is wrong with expressions, as sentences.
    """

    named: Mapping[str, tuple[MorphTarget, ...]] = field(default_factory=dict)
    unnamed: frozenset[str] = frozenset()
    expressions: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


def morph_targets_of(scene: Mapping[str, Any]) -> MorphTargets:
    """Return the morph targets of a scene.

    Names are those of the extras of a mesh (`targetNames`), of its first primitive, or of each target, as exporters of
    VRM 0 write them. A target without a name is `MESH.INDEX`. A bind of an expression that is not usable is left out,
    with a note.

    Raises:
        ValueError: there are too many; the message says so.
        LookupError, TypeError, AttributeError: the meshes are not valid glTF.
    """
    meshes: Sequence[Mapping[str, Any]] = scene.get("meshes", ())
    names = {MorphTarget(i, k): name for i, mesh in enumerate(meshes) for k, name in enumerate(_names(mesh, i))}
    if len(names) > _MOST:
        raise ValueError(f"it has more than {_MOST} morph targets")
    expressions = _Expressions(scene, names)
    names |= _split(names, [*expressions.bound.values()], meshes)
    named: defaultdict[str, list[MorphTarget]] = defaultdict(list)
    for target, name in names.items():
        named[name].append(target)
    found: defaultdict[str, list[MorphTarget]] = defaultdict(list)
    for i, mesh in enumerate(meshes):
        for k, name in enumerate(_listed(mesh)):
            found[name].append(MorphTarget(i, k))
    weights = {
        name: {names[target]: weight for target, weight in bound.items()} for name, bound in expressions.bound.items()
    }
    return MorphTargets(
        {name: tuple(targets) for name, targets in named.items()},
        frozenset(name for name, targets in named.items() if targets != found[name]),
        weights,
        tuple(expressions.notes),
    )


def _listed(mesh: Mapping[str, Any]) -> list[str]:
    """Return the names in the extras of a mesh; loaders ignore them if there are not as many as targets."""
    names = [*map(str, (mesh.get("extras") or {}).get("targetNames") or ())]
    return names if len(names) == len(mesh["primitives"][0].get("targets", ())) else []


def _names(mesh: Mapping[str, Any], index: int) -> list[str]:
    primitive = mesh["primitives"][0]
    targets = primitive.get("targets", ())
    names = _listed(mesh) or [*map(str, (primitive.get("extras") or {}).get("targetNames") or ())]
    names += [str((target.get("extras") or {}).get("name") or "") for target in targets[len(names) :]]
    prefix = mesh.get("name") or f"mesh {index}"
    return [name or f"{prefix}.{k}" for k, name in enumerate(names[: len(targets)])]


def _split(
    names: Mapping[MorphTarget, str], bound: Sequence[Mapping[MorphTarget, float]], meshes: Sequence[Mapping[str, Any]]
) -> dict[MorphTarget, str]:
    """Return other names for targets of one name that an expression does not move together."""
    sizes = Counter(names.values())
    apart = set()
    for weights in bound:
        together: defaultdict[str, list[float]] = defaultdict(list)
        for target, weight in weights.items():
            together[names[target]].append(weight)
        apart |= {name for name, each in together.items() if len(each) < sizes[name] or len(set(each)) > 1}
    return {
        target: f"{meshes[target.mesh].get('name') or f'mesh {target.mesh}'}.{name}"
        for target, name in names.items()
        if name in apart
    }


class _Expressions:
    """The expressions of a VRM file.

    Attributes:
        bound: name -> weight of each target.
        notes: what is left out.
    """

    def __init__(self, scene: Mapping[str, Any], names: Mapping[MorphTarget, str]) -> None:
        self._nodes, self._meshes = scene.get("nodes", ()), scene.get("meshes", ())
        self._names = names
        self.bound: dict[str, dict[MorphTarget, float]] = {}
        self.notes: list[str] = []
        for name, entry, version in self._entries(scene.get("extensions") or {}):
            try:
                self._take(name, entry, version)
            except (LookupError, TypeError, ValueError, AttributeError) as problem:
                self.notes.append(f"the expression '{name}' cannot be read ({problem!r})")

    def _entries(self, extensions: Mapping[str, Any]) -> Iterator[tuple[str, Any, int]]:
        try:
            if "VRMC_vrm" in extensions:
                kinds = extensions["VRMC_vrm"].get("expressions") or {}
                for kind in ("preset", "custom"):
                    yield from ((name, entry, 1) for name, entry in (kinds.get(kind) or {}).items())
            elif "VRM" in extensions:
                for entry in (extensions["VRM"].get("blendShapeMaster") or {}).get("blendShapeGroups") or ():
                    preset = VRM_0.get(str(entry.get("presetName", "")).lower())
                    yield preset or str(entry.get("name", "")), entry, 0
        except (TypeError, AttributeError) as problem:
            self.notes.append(f"its expressions cannot be read ({problem!r})")

    def _take(self, name: str, entry: Mapping[str, Any], version: int) -> None:
        if name in self.bound:
            self.notes.append(f"there are two expressions '{name}'; the first is used")
            return
        bound: dict[MorphTarget, float] = {}
        for bind in entry.get("morphTargetBinds" if version else "binds") or ():
            place = self._nodes[bind["node"]].get("mesh", -1) if version else bind["mesh"]
            target = MorphTarget(int(place), int(bind["index"]))
            weight = float(bind.get("weight", 1.0)) / (1.0 if version else _PERCENT)
            if target not in self._names:
                self.notes.append(f"the expression '{name}' moves {self._missing(target)}; this is left out")
            elif not math.isfinite(weight) or abs(weight) > _LARGEST_WEIGHT:
                self.notes.append(f"the expression '{name}' has a weight of {weight:g}; this is left out")
            else:
                bound[target] = bound.get(target, 0.0) + weight
        if bound:
            self.bound[name] = bound

    def _missing(self, target: MorphTarget) -> str:
        if not 0 <= target.mesh < len(self._meshes):
            return f"mesh {target.mesh}, which does not exist"
        name = self._meshes[target.mesh].get("name") or target.mesh
        return f"the morph target {target.target} of the mesh '{name}', which does not exist"
