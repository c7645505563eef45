"""The collars of the default avatars lie on the neck while the arms hang, as they mostly do."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from reactive_realizer.embodiment.glb_arrays import GlbArrays

AVATARS = Path(__file__).resolve().parents[2] / "reactive_realizer" / "assets" / "avatars"
HANGING = np.deg2rad(72)
REACH = 0.16
"""Depth of a neckline below the joint of the neck, m."""

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Hanging:
    """An avatar whose arms hang."""

    arrays: GlbArrays
    places: dict[str, Array]

    @classmethod
    def read(cls, path: Path) -> "Hanging":
        arrays = GlbArrays(path)
        skin = arrays.scene["skins"][0]
        names = [arrays.scene["nodes"][joint]["name"] for joint in skin["joints"]]
        binds = arrays[skin["inverseBindMatrices"]]
        return cls(arrays, dict(zip(names, -binds[:, 12:15].astype(float), strict=True)))

    def points(self, primitive: dict[str, Any]) -> Array:
        """The vertices of a part, m."""
        attributes = primitive["attributes"]
        place, joints, shares = (self.arrays[attributes[name]] for name in ("POSITION", "JOINTS_0", "WEIGHTS_0"))
        weights = shares / shares.sum(axis=1, keepdims=True)
        turns, moves = self._motion()
        turned = np.einsum("vkij,vj->vki", turns[joints], place.astype(float)) + moves[joints]
        points: Array = np.einsum("vk,vki->vi", weights, turned)
        return points

    def _motion(self) -> tuple[Array, Array]:
        turns, moves = np.tile(np.eye(3), (len(self.places), 1, 1)), np.zeros((len(self.places), 3))
        for joint, name in enumerate(self.places):
            side = name[: 4 if name.startswith("Left") else 5]
            if name.startswith((f"{side}Arm", f"{side}ForeArm", f"{side}Hand")) and side in ("Left", "Right"):
                angle = -HANGING if side == "Left" else HANGING
                c, s = np.cos(angle), np.sin(angle)
                turns[joint] = [[c, -s, 0], [s, c, 0], [0, 0, 1]]
                moves[joint] = self.places[f"{side}Arm"] - turns[joint] @ self.places[f"{side}Arm"]
        return turns, moves

    def primitives(self, mesh: str) -> list[dict[str, Any]]:
        found = next(each for each in self.arrays.scene["meshes"] if each["name"] == mesh)
        primitives: list[dict[str, Any]] = found["primitives"]
        return primitives

    def skin(self) -> Array:
        """Points all over the skin of head, neck and body, some millimeters apart."""
        parts = [self.primitives("Face")[0], *self.primitives("Body")]
        shares = np.array([(i, j, 12 - i - j) for i in range(13) for j in range(13 - i)]) / 12
        corners = [self.points(part)[self.arrays[part["indices"]].reshape(-1, 3)] for part in parts]
        return np.vstack([np.einsum("sk,tki->tsi", shares, each).reshape(-1, 3) for each in corners])

    def collar(self) -> Array:
        """The vertices of the collar: near the neck, and not of the color of the shirt."""
        shirt = self.primitives("Top")[0]
        points, colors = self.points(shirt), self.arrays[shirt["attributes"]["COLOR_0"]]
        _, kind, counts = np.unique(colors, axis=0, return_inverse=True, return_counts=True)
        x, y, _ = (points - self.places["Neck"]).T
        found: Array = points[(kind.ravel() != counts.argmax()) & (y > -REACH) & (np.abs(x) < REACH)]
        return found


@pytest.fixture(params=["female", "male"], scope="module")
def hanging(request: pytest.FixtureRequest) -> Hanging:
    return Hanging.read(AVATARS / f"{request.param}.glb")


def test_no_part_of_a_collar_stands_off(hanging: Hanging) -> None:
    collar = hanging.collar()
    gaps, (x, _, z) = cKDTree(hanging.skin()).query(collar)[0], (collar - hanging.places["Neck"]).T
    sector = np.round(np.arctan2(x, z - 0.02) / np.deg2rad(10)) % 36
    inner = [gaps[sector == each].min() for each in range(36)]
    assert max(inner) < 0.0035
