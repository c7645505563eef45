"""Expresses weights of a face, also of blend shapes that it lacks, by the morph targets and expressions of its file."""

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from reactive_realizer.embodiment.avatar import SKIN_COLORS, Avatar
from reactive_realizer.embodiment.face_names import ARKIT, OCULUS, VRM, meaning, plain
from reactive_realizer.embodiment.turn_weights import turned_joint, weights_of_joint
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.file_cache import remembered

STAND_INS = "face/stand_ins.toml"
"""The asset with the table of stand-ins."""

_Weights = Mapping[str, float]
_MOST = 10.0


class BadStandIns(Fault):
    """An entry of a table of stand-ins that cannot be used."""

    code = "bad-stand-ins"
    template = "{file}: {key}: {reason}"
    file: str
    key: str
    reason: str


@dataclass(frozen=True, slots=True)
class StandIns:
    """A table of what faces can show instead of ARKit's blend shapes (assets/face/stand_ins.toml).

    Attributes:
        names: plain spelling -> meaning, of names of morph targets beside those of ARKit, Oculus and VRM.
        alternatives: blend shape -> weights at full extent, in order of preference.
    """

    names: Mapping[str, str] = field(default_factory=dict)
    alternatives: Mapping[str, Sequence[_Weights]] = field(default_factory=dict)

    @staticmethod
    @remembered
    def read(path: Path) -> "StandIns":
        """Read a table.

        Raises:
            RealizerError: "bad-stand-ins".
            OSError: the file cannot be read.
        """
        try:
            table = tomllib.loads(path.read_text(encoding="utf-8"))
        except (ValueError, RecursionError) as problem:
            raise RealizerError(BadStandIns(file=path.name, key="the file", reason=str(problem))) from problem
        for key, value in table.items():
            if key not in ("names", "stand_ins") or not isinstance(value, dict):
                raise RealizerError(
                    BadStandIns(file=path.name, key=key, reason="known are the tables names, stand_ins")
                )
        alternatives = {shape: _alternatives(path, shape, each) for shape, each in table.get("stand_ins", {}).items()}
        used = {name for each in alternatives.values() for weights in each for name in weights}
        own = {plain(name): name for name in used.difference(ARKIT, OCULUS, VRM) if not turned_joint(name)}
        return StandIns(
            own | {plain(name): meant for meant, name in _names(path, table.get("names", {}))}, alternatives
        )


def _names(path: Path, table: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    for own, names in table.items():
        if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
            raise RealizerError(BadStandIns(file=path.name, key=f"names.{own}", reason="expected a list of names"))
        yield from ((own, name) for name in names)


def _alternatives(path: Path, shape: str, value: object) -> tuple[_Weights, ...]:
    def bad(reason: str) -> RealizerError:
        return RealizerError(BadStandIns(file=path.name, key=f"stand_ins.{shape}", reason=reason))

    if shape not in ARKIT:
        raise bad("this is not a blend shape of ARKit")
    if not isinstance(value, list) or not all(isinstance(each, dict) and each for each in value):
        raise bad("expected a list of tables of weights")
    for name, weight in (pair for each in value for pair in each.items()):
        if not isinstance(weight, int | float) or not -_MOST <= weight <= _MOST:
            raise bad(f"the weight of {name} is not a number from {-_MOST:g} to {_MOST:g}")
    return tuple({name: float(weight) for name, weight in each.items()} for each in value)


NO_STAND_INS = StandIns()


class FaceMap:
    """Expresses the weights of a face by those that an avatar has.

    Args:
        avatar: with the face.
        table: of stand-ins.

    Attributes:
        own: names that move the face as they are meant: of its morph targets as the file has them, of blend shapes,
            visemes and expressions that they or the expressions of the file are, and of the colors of the skin.
        joints: of its skeleton, which faces may turn.
        stand_ins: blend shape of ARKit that it lacks -> weights of `own`, and of turns of joints.
    """

    def __init__(self, avatar: Avatar, table: StandIns = NO_STAND_INS) -> None:
        self.joints = avatar.skeleton.joints
        self._parts = _parts(avatar, table)
        self.own = tuple(dict.fromkeys((*avatar.morphs, *self._parts)))
        has = frozenset(self.own).union(*map(weights_of_joint, avatar.skeleton.joints))
        best = {
            shape: next((each for each in alternatives if each.keys() <= has), None)
            for shape, alternatives in table.alternatives.items()
            if shape not in has
        }
        self.stand_ins: Mapping[str, _Weights] = {shape: each for shape, each in best.items() if each}

    @property
    def names(self) -> tuple[str, ...]:
        """All names of weights that show in the face."""
        return (*self.own, *self.stand_ins)

    def __call__(self, weights: _Weights) -> _Weights:
        """Return weights of the avatar's morphs and of turns of joints; those of unknown names are left as they are.

        Stand-ins add up, within 0 to 1, before they become weights of morph targets.
        """
        if self.stand_ins and not self.stand_ins.keys().isdisjoint(weights):
            weights = _replaced(weights, self.stand_ins)
        if self._parts and not self._parts.keys().isdisjoint(weights):
            weights = _replaced(weights, self._parts)
        return weights


def _replaced(weights: _Weights, parts: Mapping[str, _Weights]) -> dict[str, float]:
    added: dict[str, float] = {}
    for name, weight in weights.items():
        for part, share in parts.get(name, {}).items():
            added[part] = added.get(part, 0.0) + share * weight
    kept = {name: weight for name, weight in weights.items() if name not in parts}
    for part, weight in added.items():
        kept[part] = kept.get(part, 0.0) + (weight if turned_joint(part) else min(max(weight, 0.0), 1.0))
    return kept


def _parts(avatar: Avatar, table: StandIns) -> Mapping[str, _Weights]:
    """Return the weights of morph targets that each name stands for, except the targets' own names."""
    parts: dict[str, dict[str, float]] = {}
    for morph in avatar.morphs:
        if morph not in SKIN_COLORS and (own := meaning(morph, table.names)) not in (None, morph, *avatar.morphs):
            parts.setdefault(str(own), {})[morph] = 1.0
    for name, weights in avatar.targets.expressions.items():
        for each in dict.fromkeys((meaning(name, table.names) or name, name)):
            if each in VRM or (each not in parts and each not in avatar.morphs):
                parts[each] = dict(weights)
    return parts
