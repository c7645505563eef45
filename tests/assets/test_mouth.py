"""From the front, teeth of the avatars are seen between parted lips only: neither between closed ones nor in cheeks."""

import tomllib
from collections.abc import Mapping

import numpy as np
import pytest

from reactive_realizer.assembly.assets import Assets
from reactive_realizer.engines.face.expressions import Expressions
from tests.engines.speech.lip_sync.face_mesh import Array, FaceMesh

ASSETS = Assets()
EXPRESSIONS = Expressions.read(ASSETS("face/lexemes.json"), ASSETS("face/action_units.json"))
PBM: Mapping[str, float] = tomllib.loads(ASSETS("visemes/arkit.toml").read_text("utf-8"))["visemes"]["PP"]["morphs"]
SMILE, JOY = EXPRESSIONS.lexemes["SMILE"], EXPRESSIONS.lexemes["JOY"]
CLOSED: Mapping[str, Mapping[str, float]] = {
    "rest": {},
    "p, b and m": PBM,
    "half a SMILE": {morph: weight / 2 for morph, weight in SMILE.items()},
    "SMILE": SMILE,
    "JOY": JOY,
}

CELL = 0.2e-3
"""Width and height of a cell in a picture of the mouth, m."""
BESIDE, BELOW, ABOVE = 0.036, 0.034, 0.018
"""Extent of the picture from the middle of the mouth, m."""
UNSEEN = 0.3e-6
"""Area of teeth that does not matter, m²."""


@pytest.fixture(scope="module", params=["female", "male"])
def mesh(request: pytest.FixtureRequest) -> FaceMesh:
    return FaceMesh.read(ASSETS(f"avatars/{request.param}.glb"))


def depths(triangles: Array, corner: Array, shape: tuple[int, int]) -> Array:
    """The greatest z (m) of triangles (T, 3, 3) in each cell (columns, rows) of a picture, -inf where there are none.

    Args:
        triangles: corners, m.
        corner: (2,) x and y of the lower corner of the picture, m.
        shape: numbers of columns and rows.
    """
    picture = np.full(shape, -np.inf)
    at = (triangles[:, :, :2] - corner) / CELL - 0.5
    first = np.maximum(np.ceil(at.min(1)), 0).astype(int)
    last = np.minimum(np.floor(at.max(1)), np.array(shape) - 1).astype(int)
    for (a, b, c), heights, (left, low), (right, high) in zip(at, triangles[:, :, 2], first, last, strict=True):
        doubled = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        if left > right or low > high or doubled == 0.0:
            continue
        x, y = np.arange(left, right + 1)[:, None], np.arange(low, high + 1)
        of_b = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / doubled
        of_c = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / doubled
        inside = (of_b >= 0) & (of_c >= 0) & (of_b + of_c <= 1)
        z = heights[0] + of_b * (heights[1] - heights[0]) + of_c * (heights[2] - heights[0])
        cells = picture[left : right + 1, low : high + 1]
        np.maximum(cells, z, out=cells, where=inside)
    return picture


def seen_teeth(mesh: FaceMesh, weights: Mapping[str, float]) -> float:
    """The area of the teeth that are in front of all other parts of the face, m²."""
    teeth, others = (mesh.upper_teeth, mesh.lower_teeth), (mesh.skin, mesh.inside, mesh.tongue)
    corner = mesh.mouth[:2] - (BESIDE, BELOW)
    shape = (round(2 * BESIDE / CELL), round((BELOW + ABOVE) / CELL))
    front, behind = (
        np.maximum.reduce([depths(mesh.shown(part, weights)[part.triangles], corner, shape) for part in parts])
        for parts in (teeth, others)
    )
    return float((front > behind).sum() * CELL**2)


@pytest.mark.parametrize("face", CLOSED)
def test_no_teeth_are_seen_while_lips_are_closed(mesh: FaceMesh, face: str) -> None:
    assert seen_teeth(mesh, CLOSED[face]) < UNSEEN


def test_teeth_are_seen_in_an_open_mouth(mesh: FaceMesh) -> None:
    assert seen_teeth(mesh, {"jawOpen": 0.5}) > 20e-6


def test_lips_touch_at_rest(mesh: FaceMesh) -> None:
    assert mesh.opening({}) < 0.1e-3


def test_rows_of_teeth_are_as_wide_as_those_of_a_person(mesh: FaceMesh) -> None:
    for row in (mesh.upper_teeth, mesh.lower_teeth):
        assert 0.044 < np.ptp(row.positions[:, 0]) < 0.054
