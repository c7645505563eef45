"""Blend shapes beyond ARKit's: what MPEG-4's parameters move, and the visemes of Oculus.

The shapes of ears are MakeHuman's, and so are most of the nose and those of cheeks sucked in; others are made here, or
are halves of ARKit's. Displacements are (v, 3), m, in the T-pose of the head, which is that of the face units.
"""

import tomllib
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from reactive_realizer.bake.makehuman import DECIMETER, MakeHuman
from reactive_realizer.bake.numeric import Array, Indices, gaussian, smoothstep
from reactive_realizer.bake.rig import SIDES

_EARS = (
    ("earUp", "trans-up", 0.4),
    ("earDown", "trans-down", 0.4),
    ("earOut", "wing-incr", 0.7),
    ("earIn", "wing-decr", 0.7),
)
"""Shape, and how much of which of MakeHuman's targets it is."""

_NOSE = (
    ("noseTipUp", "point-up", 1.0),
    ("noseTipDown", "point-down", 0.3),
)
"""Shape, and how much of which of MakeHuman's targets it is."""

_NOSTRILS = (("nasalDilation", "flaring-incr", 0.7), ("nasalConstrict", "flaring-decr", 0.8))
"""Shape, and how much of which of MakeHuman's targets it is half of."""

_HALVED = (
    ("browInnerUp", "browInnerUp"),
    ("cheekPuff", "cheekPuff"),
    ("mouthPucker", "lipPucker"),
    ("mouthRollUpper", "lipSuckUpper"),
    ("mouthShrugLower", "mouthShrugLower"),
)
"""Blend shape of ARKit that moves both sides of the face, and the name without a side of its halves."""

_MIDDLE = 0.008
"""Distance from the plane of symmetry at which a half moves all or nothing, m."""

_LOWER_LIP = (0.3, 0.7)
"""Shares of the deepest move of the opening jaw between which the upper lip gives way to the lower one."""

_NOSE_REACH, _NOSE_MOVE = 0.026, 0.005
"""Distance from the tip of the nose from which the skin stays, and how far the tip moves, m."""

EYE_MOVE = 0.0025
"""How far an eye moves forward or backward, m."""
_LIDS, _ORBIT = 0.014, 0.034
"""Distances from the middle of an eye up to which skin moves as far as the eye, and from which it stays, m."""

_VISEMES = Path(__file__).parents[1] / "assets/visemes/arkit.toml"
_OCULUS = {"ih": "I", "oh": "O", "ou": "U"}
"""Names of the visemes of Oculus in files of avatars, where they differ from those of the table."""


def parameter_shapes(
    data: MakeHuman, positions: Array, groups: Mapping[str, Indices], places: Mapping[str, Array]
) -> dict[str, Array]:
    """The shapes for MPEG-4's parameters that move the base mesh, by name.

    Args:
        data: with MakeHuman's targets.
        positions: (v, 3) of the base mesh, m.
        groups: vertices by name.
        places: of the joints, m.
    """
    shapes: dict[str, Array] = {}
    for name, target, amount in _EARS:
        for side, _ in SIDES:
            moves = data.target(f"ears/{side[0].lower()}-ear-{target}", len(positions))
            shapes[name + side] = amount * DECIMETER * moves
    for side, _ in SIDES:
        near = smoothstep(_ORBIT, _LIDS, np.linalg.norm(positions - places[side + "Eye"], axis=1))
        for name, move in (("eyeThrust", EYE_MOVE), ("eyeSink", -EYE_MOVE)):
            shapes[name + side] = near[:, None] * (0.0, 0.0, move)
        thinner = data.target(f"cheek/{side[0].lower()}-cheek-volume-decr", len(positions))
        shapes["cheekSuck" + side] = DECIMETER * thinner
    for name, target, amount in _NOSE:
        shapes[name] = amount * DECIMETER * data.target(f"nose/nose-{target}", len(positions))
    for name, target, amount in _NOSTRILS:
        shapes |= _halves(name, amount * DECIMETER * data.target(f"nose/nose-{target}", len(positions)), positions)
    skin = groups["body"]
    face = positions[skin]
    between = (np.abs(face[:, 0]) < 0.01) & (np.abs(face[:, 1] - places["LeftEye"][1] + 0.035) < 0.025)
    tip = face[between][face[between, 2].argmax()]
    near = smoothstep(_NOSE_REACH, 0.0, np.linalg.norm(face - tip, axis=1))
    for side, sign in SIDES:
        shapes["noseTip" + side] = np.zeros(positions.shape)
        shapes["noseTip" + side][skin, 0] = sign * _NOSE_MOVE * near
    tongue = groups["helper-tongue"]
    for name, moved in _tongue_shapes(positions[tongue]).items():
        shapes[name] = np.zeros(positions.shape)
        shapes[name][tongue] = moved
    return shapes


def parts_of_units(units: Mapping[str, Array], positions: Array) -> dict[str, Array]:
    """The halves of ARKit's shapes that move both sides, and the pucker of each lip alone, by name.

    Args:
        units: blend shapes of ARKit by name.
        positions: (v, 3) of the base mesh, m.
    """
    shapes: dict[str, Array] = {}
    for unit, name in _HALVED:
        shapes |= _halves(name, units[unit], positions)
    pucker, falls = units["mouthPucker"], -units["jawOpen"][:, 1]
    lips = np.linalg.norm(pucker, axis=1) > 0.8 * np.linalg.norm(pucker, axis=1).max()
    lower = smoothstep(*_LOWER_LIP, falls / falls[lips].max())[:, None]
    return shapes | {"lipPuckerLower": lower * pucker, "lipPuckerUpper": (1.0 - lower) * pucker}


def _halves(name: str, moves: Array, positions: Array) -> dict[str, Array]:
    """Both halves of a shape, with names that end in the side."""
    return {name + side: smoothstep(-_MIDDLE, _MIDDLE, sign * positions[:, 0])[:, None] * moves for side, sign in SIDES}


def tongue_out(unit: Array, positions: Array, tongue: Indices) -> Array:
    """ARKit's tongueOut with a tongue that passes over the lower teeth and lip of an open jaw; MakeHuman's cuts them.

    Args:
        unit: MakeHuman's, (v, 3).
        positions: (v, 3) of the base mesh, m.
        tongue: its vertices.
    """
    points = positions[tongue]
    behind = points[:, 2].max() - points[:, 2]
    out, lift = smoothstep(0.050, 0.0, behind), smoothstep(0.045, 0.012, behind)
    tip = smoothstep(0.012, 0.0, behind)
    line = np.polyval(np.polyfit(behind, points[:, 1], 2), behind)
    moved = unit.copy()
    moved[tongue, 0] = 0.0
    moved[tongue, 1] = 0.010 * lift - 0.005 * tip - 0.3 * lift * (points[:, 1] - line)
    moved[tongue, 2] = 0.040 * out
    return moved


def visemes(units: Mapping[str, Array]) -> dict[str, Array]:
    """The fifteen visemes of Oculus by name: sums of face units, as lip-sync shows them."""
    table = tomllib.loads(_VISEMES.read_text(encoding="utf-8"))["visemes"]
    nothing = np.zeros(units["jawOpen"].shape)
    return {
        f"viseme_{_OCULUS.get(name, name)}": sum(
            (weight * units[unit] for unit, weight in entry.get("morphs", {}).items()), nothing
        )
        for name, entry in table.items()
    }


def _tongue_shapes(tongue: Array) -> dict[str, Array]:
    """Displacements (n, 3) of the points of a tongue (n, 3)."""
    behind = tongue[:, 2].max() - tongue[:, 2]
    tip, blade = smoothstep(0.032, 0.0, behind), smoothstep(0.050, 0.004, behind)
    middle = gaussian(behind, 0.026, 0.018)
    beside = tongue[:, 0] / np.abs(tongue[:, 0]).max()
    none = np.zeros(len(tongue))
    return {
        "tongueUp": np.stack([none, 0.008 * middle, none], 1),
        "tongueDown": np.stack([none, -0.004 * middle, none], 1),
        "tongueLeft": np.stack([0.010 * tip, none, none], 1),
        "tongueRight": np.stack([-0.010 * tip, none, none], 1),
        "tongueTipUp": np.stack([none, 0.009 * tip, -0.003 * tip], 1),
        "tongueTipDown": np.stack([none, -0.005 * tip, -0.001 * tip], 1),
        "tongueRoll": np.stack([-0.35 * tongue[:, 0] * blade, 0.009 * beside**2 * blade, none], 1),
    }
