"""Reads one file of a viseme binding, and says what is wrong with it."""

import tomllib
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from math import radians
from pathlib import Path
from typing import Any

from reactive_realizer.binding.mouth_shapes import VISEMES, Articulator, MouthShape
from reactive_realizer.embodiment.turn_weights import turn_weights, turned_joint, weights_of_joint
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.file_cache import remembered

_LONGEST = 1.0
"""Upper limit of the time constant of an articulator, s."""
_WIDEST = 45.0
"""Limit of a turn of a joint about an axis, degrees."""
_AXES = ("x", "y", "z")


class BadVisemes(Fault):
    """An entry of a viseme binding that cannot be used."""

    code = "bad-visemes"
    template = "{file}: {key}: {reason}"
    unknown = "name"
    file: str
    key: str
    reason: str
    name: str = ""
    known: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class MouthTables:
    """The tables of one file of a `VisemeBinding`; each may be empty."""

    name: str
    phonemes: Mapping[str, str]
    shapes: Mapping[str, MouthShape]
    articulators: Mapping[str, Articulator]

    def check(self, articulators: Mapping[str, Articulator]) -> None:
        """Checks the shapes of this file.

        Args:
            articulators: by name, of this file or of the next one that has any.

        Raises:
            RealizerError: "bad-visemes".
        """
        moved = set(chain.from_iterable(articulator.morphs for articulator in articulators.values()))
        for viseme, shape in self.shapes.items():
            key = f"visemes.{viseme}"
            for name in (*shape.dominance, *shape.contact):
                if name not in articulators:
                    raise _unknown(self.name, key, name, "an articulator", articulators)
            for morph in shape.morphs:
                if morph not in moved:
                    reason = f"no articulator moves '{turned_joint(morph) or morph}'"
                    raise RealizerError(BadVisemes(file=self.name, key=key, reason=reason))


def read_binding_file(
    path: Path, morphs: Collection[str], joints: Collection[str], *, shared: bool = False
) -> MouthTables:
    """Reads a file.

    Args:
        path: of the file.
        morphs: names of the avatar's morph targets.
        joints: of its skeleton.
        shared: whether the file is for many avatars; morph targets that this one does not have are then left out.

    Raises:
        RealizerError: "bad-visemes".
        OSError: the file cannot be read.
    """
    table = _read_table(path)
    reader = _Reader(path.name, morphs, joints, shared=shared)
    reader.know("the file", table, ("phonemes", "visemes", "articulators"))
    return MouthTables(
        path.name,
        reader.phonemes(reader.table("phonemes", table.get("phonemes", {}))),
        {viseme: reader.shape(viseme, own) for viseme, own in reader.section(table, "visemes", VISEMES)},
        reader.articulators(table),
    )


@remembered
def _read_table(path: Path) -> Mapping[str, Any]:
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except (ValueError, RecursionError) as problem:
        raise RealizerError(BadVisemes(file=path.name, key="the file", reason=str(problem))) from problem


class _Reader:
    """Reads the tables of a file; every mistake names its key."""

    def __init__(self, file: str, morphs: Collection[str], joints: Collection[str], *, shared: bool) -> None:
        self._file = file
        self._morphs = morphs
        self._joints = joints
        self._shared = shared

    def phonemes(self, table: Mapping[str, Any]) -> dict[str, str]:
        self.know("phonemes", table, VISEMES)
        bound: dict[str, str] = {}
        for viseme, listed in table.items():
            for letters in self._names(f"phonemes.{viseme}", listed):
                if not 1 <= len(letters) <= 2:
                    raise self._bad(f"phonemes.{viseme}", f"{letters!r} is not one letter or two")
                if bound.setdefault(letters, viseme) != viseme:
                    raise self._bad(f"phonemes.{viseme}", f"{letters!r} is also listed under {bound[letters]}")
        return bound

    def shape(self, viseme: str, table: Mapping[str, Any]) -> MouthShape:
        key = f"visemes.{viseme}"
        self.know(key, table, ("morphs", "joints", "dominance", "contact"))
        morphs = self._numbers(f"{key}.morphs", table.get("morphs", {}), 0.0)
        dominance = self._numbers(f"{key}.dominance", table.get("dominance", {}), 1e-3)
        used = self._of_avatar(f"{key}.morphs", morphs)
        contact = self._names(f"{key}.contact", table.get("contact", []))
        turned = self._turns(f"{key}.joints", table.get("joints", {}))
        return MouthShape({morph: morphs[morph] for morph in used} | turned, dominance, contact)

    def articulators(self, table: Mapping[str, Any]) -> dict[str, Articulator]:
        found: dict[str, Articulator] = {}
        owner: dict[str, str] = {}
        for name, own in self.section(table, "articulators"):
            key = f"articulators.{name}"
            self.know(key, own, ("morphs", "joints", "before", "after"))
            morphs = self._of_avatar(f"{key}.morphs", self._names(f"{key}.morphs", own.get("morphs", [])))
            joints = self._names(f"{key}.joints", own.get("joints", []))
            if not own.keys() & {"morphs", "joints"}:
                raise self._bad(key, "it has neither morphs nor joints")
            for part, moved in (("morphs", morphs), ("joints", joints)):
                for each in moved:
                    if owner.setdefault(each, name) != name:
                        raise self._bad(f"{key}.{part}", f"'{each}' also belongs to {owner[each]}")
            self._check_joints(f"{key}.joints", joints)
            morphs += tuple(chain.from_iterable(map(weights_of_joint, joints)))
            times = (self._number(f"{key}.{side}", own.get(side), 1e-3, _LONGEST) for side in ("before", "after"))
            found[name] = Articulator(morphs, *times)
        return found

    def section(
        self, table: Mapping[str, Any], name: str, known: Sequence[str] | None = None
    ) -> list[tuple[str, Mapping[str, Any]]]:
        """The tables in a table of the file, by name."""
        tables = self.table(name, table.get(name, {}))
        if known is not None:
            self.know(name, tables, known)
        return [(own, self.table(f"{name}.{own}", entry)) for own, entry in tables.items()]

    def table(self, key: str, value: object) -> Mapping[str, Any]:
        if not isinstance(value, dict):
            raise self._bad(key, "expected a table")
        return value

    def know(self, key: str, table: Mapping[str, Any], known: Sequence[str]) -> None:
        for name in table:
            if name not in known:
                raise _unknown(self._file, key, name, "known", known)

    def _of_avatar(self, key: str, names: Collection[str]) -> tuple[str, ...]:
        """The morph targets that the avatar has; in a file of its own, these have to be all."""
        for name in names:
            if name not in self._morphs and not self._shared:
                raise _unknown(self._file, key, name, "a morph target of the avatar", self._morphs)
        return tuple(name for name in names if name in self._morphs)

    def _turns(self, key: str, value: object) -> dict[str, float]:
        """The weights for rotation vectors of joints, degrees."""
        weights: dict[str, float] = {}
        table = self.table(key, value)
        self._check_joints(key, table)
        for joint, vector in table.items():
            if not isinstance(vector, list) or len(vector) != len(_AXES):
                raise self._bad(f"{key}.{joint}", "expected degrees about x, y and z")
            x, y, z = (radians(self._number(f"{key}.{joint}", each, -_WIDEST, _WIDEST)) for each in vector)
            weights |= turn_weights(joint, (x, y, z))
        return weights

    def _check_joints(self, key: str, joints: Iterable[str]) -> None:
        for joint in joints:
            if joint not in self._joints:
                raise _unknown(self._file, key, joint, "a joint of the avatar", self._joints)

    def _numbers(self, key: str, value: object, least: float) -> dict[str, float]:
        return {name: self._number(f"{key}.{name}", each, least, 1.0) for name, each in self.table(key, value).items()}

    def _number(self, key: str, value: object, least: float, most: float) -> float:
        if not isinstance(value, int | float) or isinstance(value, bool) or not least <= value <= most:
            raise self._bad(key, f"{value!r} is not a number from {least:g} to {most:g}")
        return float(value)

    def _names(self, key: str, value: object) -> tuple[str, ...]:
        if not isinstance(value, list) or not all(isinstance(each, str) for each in value):
            raise self._bad(key, "expected a list of names")
        return tuple(value)

    def _bad(self, key: str, reason: str) -> RealizerError:
        return RealizerError(BadVisemes(file=self._file, key=key, reason=reason))


def _unknown(file: str, key: str, name: str, kind: str, known: Collection[str]) -> RealizerError:
    reason = f"'{name}' is not {kind}"
    return RealizerError(BadVisemes(file=file, key=key, reason=reason, name=name, known=tuple(known)))
