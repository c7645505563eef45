"""The units of MPEG-4's facial animation parameters (FAPU), measured on the face of an avatar."""

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.face_map import FaceMap
from reactive_realizer.embodiment.face_mesh import FaceMesh
from reactive_realizer.embodiment.joints import EYES

_PER_UNIT = 1024.0
"""A unit is this part of a distance in the face."""

_MIDDLE = 0.05
"""Vertices nearer than this share of the eyes' distance to the plane of symmetry are in the profile."""

_BESIDE = 0.002
"""Difference of height up to which points of a profile hide each other, m."""

_SKIN = 0.004
"""A point that lies deeper behind another one belongs to the inside of the mouth, m."""


@dataclass(frozen=True, slots=True)
class Fapu:
    """Units of facial animation parameters, m (ISO/IEC 14496-2, table C.2).

    The standard takes them from feature points, which avatars do not mark. Here the eyes are their joints, a corner of
    the mouth is the vertex that stretched lips move furthest to its side, the lids are as far apart as a blink moves
    the upper one, and the nose ends below where the profile between its tip and the upper lip is deepest.

    Attributes:
        ES: of the distance between the eyes.
        ENS: of the height of the eyes over the lower end of the nose.
        MNS: of the height of the lower end of the nose over the mouth.
        MW: of the width of the mouth.
        IRISD: of the distance between upper and lower lid.
    """

    ES: float
    ENS: float
    MNS: float
    MW: float
    IRISD: float

    @classmethod
    def measured(cls, avatar: Avatar, mesh: FaceMesh, face: FaceMap) -> Self:
        """Measure a face.

        Args:
            avatar: with the face.
            mesh: of the face.
            face: what the avatar shows of ARKit's blend shapes.

        Raises:
            LookupError: it has no eyes, or lacks a morph target that the measurement uses.
            ValueError: its profile has no nose.
        """
        left, right = (np.array(_position(avatar, eye)) for eye in EYES)
        eyes, apart = (left + right) / 2.0, float(np.linalg.norm(left - right))
        corners = [
            mesh.vertices[mesh.furthest(face({f"mouthStretch{side}": 1.0}), (toward, 0.0, 0.0))]
            for side, toward in (("Left", 1.0), ("Right", -1.0))
        ]
        mouth = (corners[0] + corners[1]) / 2.0
        nose = _end_of_nose(mesh.vertices, eyes, mouth, _MIDDLE * apart)
        blinks = (mesh.displacement(face({f"eyeBlink{side}": 1.0})) for side in ("Left", "Right"))
        lids = max(-blink[:, 1].min() for blink in blinks)
        distances = (apart, eyes[1] - nose, nose - mouth[1], np.linalg.norm(corners[0] - corners[1]), lids)
        if min(distances) <= 0.0:
            raise ValueError("eyes, nose and mouth are not above each other")
        return cls(*(float(distance) / _PER_UNIT for distance in distances))


def _position(avatar: Avatar, eye: str) -> tuple[float, float, float]:
    position = avatar.rest_position(eye)
    if position is None:
        raise LookupError(eye)
    return position


def _end_of_nose(
    vertices: NDArray[np.float64], eyes: NDArray[np.float64], mouth: NDArray[np.float64], middle: float
) -> float:
    """Return the height of the lower end of the nose, m.

    Args:
        vertices: (V, 3).
        eyes: the point between them.
        mouth: the point between its corners.
        middle: distance to the plane of symmetry up to which vertices belong to the profile, m.
    """
    between = (vertices[:, 1] > mouth[1]) & (vertices[:, 1] < eyes[1]) & (vertices[:, 2] > mouth[2])
    profile = vertices[between & (np.abs(vertices[:, 0] - mouth[0]) < middle)][:, 1:]
    profile = _outermost(profile)
    tip = profile[profile[:, 1].argmax()]
    below = profile[profile[:, 0] < tip[0]]
    lip = below[below[:, 0] < (tip[0] + mouth[1]) / 2.0]
    lip = lip[lip[:, 1].argmax()]
    inside = below[below[:, 0] > lip[0]]
    height, depth = tip - lip
    distances = (inside[:, 0] - lip[0]) * depth - (inside[:, 1] - lip[1]) * height
    return float(inside[distances.argmax(), 0])


def _outermost(profile: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the points of a profile, height and depth (P, 2), m, without those behind others, such as teeth."""
    heights, depths = profile.T
    beside = np.abs(heights[:, None] - heights) < _BESIDE
    front = np.where(beside, depths, -np.inf).max(axis=1)
    return np.compress(depths > front - _SKIN, profile, axis=0)
