"""Masks of the parts of a face (lips, ears, brows and others): pictures in the head's unwrap, 0..1."""

from functools import cached_property

import numpy as np
from scipy.ndimage import gaussian_filter
from scipy.spatial import cKDTree

from reactive_realizer.bake.body import Body
from reactive_realizer.bake.characters import HairStyle
from reactive_realizer.bake.hairline import scalp
from reactive_realizer.bake.head_map import HeadMap
from reactive_realizer.bake.numeric import Array, Indices, smoothstep, value_noise

_STUBBLE_BELOW = {HairStyle.BOB: -6.0, HairStyle.CROP: -13.0}
"""Where the transition from skin to hair begins, degrees above the hairline."""


class FaceMasks:
    """The masks of one face, and the landmarks that they are laid out by (m).

    Attributes:
        points: (n, n, 3) m, the position of each texel; x is the same on both sides.
        front: the front half of the head.
        nose: (3,) its tip.
        mouth_height: y of the line between the lips.
    """

    def __init__(self, body: Body, head: HeadMap) -> None:
        self._body, self._head, self._who = body, head, body.character
        self.points = head.points
        self.x, self.y, self.z = np.abs(head.points[..., 0]), head.points[..., 1], head.points[..., 2]
        self.eye = head.eye
        self.eye_x = body.places["LeftEye"][0]
        self.front = smoothstep(self.eye[2] - 0.06, self.eye[2] - 0.02, self.z)
        self.lips = _close_mouth(head.sample(gaussian_filter(body.mask("lips"), 1.2)))
        self.ears = head.sample(gaussian_filter(body.mask("ears"), 4))
        self.lids = head.sample(gaussian_filter(body.mask("eyelids"), 2.0))
        self.nose = body.positions[np.argmax(np.where(body.weight_of("Head") > 0.5, body.positions[:, 2], -9))]
        self.mouth_height = self.y[self.lips > 0.5].mean()
        self.above_hairline = scalp(self._who.hair, head.center)(self.points)

    def spot(self, x: float, y: float, width: float, height: float) -> Array:
        """A soft spot on both sides of the face's front."""
        return np.exp(-(((self.x - x) / width) ** 2 + ((self.y - y) / height) ** 2)) * self.front

    @cached_property
    def lip_seam(self) -> Array:
        """The dark line where the lips meet."""
        seam = np.zeros(self.x.shape)
        near = (self.lips > 0.05) & (self.front > 0)
        distance = cKDTree(self._body.positions[self._head.lip_seam]).query(self.points[near])[0]
        seam[near] = 1 - smoothstep(0.0006, 0.0042, distance)
        return seam

    @cached_property
    def stubble(self) -> Array:
        """Jaw, upper lip and the way up to the ears, without lips."""
        mouth, eye, x, y, z = self.mouth_height, self.eye, self.x, self.y, self.z
        jaw = (
            smoothstep(mouth + 0.014, mouth - 0.004, y + 0.10 * (x - 0.025).clip(0))
            * smoothstep(eye[2] - 0.125, eye[2] - 0.06, z)
            * smoothstep(mouth - 0.085, mouth - 0.055, y)
        )
        sideburns = (
            np.exp(-(((x - 0.068) / 0.014) ** 2))
            * smoothstep(eye[1] + 0.01, eye[1] - 0.03, y)
            * smoothstep(mouth - 0.03, mouth, y)
            * (z > eye[2] - 0.10)
        )
        mustache = np.exp(-(((y - (mouth + 0.0135)) / 0.006) ** 2)) * smoothstep(0.034, 0.022, x) * self.front
        jaw *= 1 - 0.75 * np.exp(-(((x - 0.026) / 0.012) ** 2 + ((y - mouth + 0.012) / 0.010) ** 2))
        everywhere = np.clip(np.maximum(np.maximum(jaw, mustache * 0.9), sideburns * 0.7), 0, 1)
        return everywhere * (1 - self.lips) * (0.72 + 0.28 * value_noise(self.points * 1500))

    @cached_property
    def brows(self) -> Array:
        """Tapered arcs made of slanted strokes."""
        return np.maximum(np.maximum(np.zeros(self.x.shape), self._brow(1)), self._brow(-1))

    def _brow(self, side: int) -> Array:
        x, who = self.points[..., 0] * side, self._who
        along = (x - (self.eye_x - 0.0195)) / 0.050
        t = np.clip(along, 0, 1)
        middle = self.eye[1] + 0.0206 + who.brow_lift + 0.0062 * np.sin(t * 2.1) - 0.0056 * t**3
        height = who.brow_height * (1 - 0.70 * t**1.5) * np.clip(0.55 + 2.5 * t, 0, 1)
        across = (self.y - middle) / height
        q = (x - self.eye_x - (0.25 + 1.5 * t) * (self.y - middle)) / 0.0011
        strokes = np.sin(q * 2 * np.pi + 2.2 * value_noise(np.stack([q * 0.45, across * 0.6, 0 * q], -1)))
        brow = (
            np.exp(-(np.abs(across) ** 2.6) * 1.1)
            * smoothstep(-0.03, 0.22, along)
            * np.clip((1.05 - along) * 7, 0, 1)
            * (0.66 + 0.34 * strokes)
        )
        return brow * (self.z > self.eye[2] - 0.04) * (x > 0)

    @cached_property
    def lash_line(self) -> Array:
        """The roots of the lashes; weaker below the eye."""
        near = (np.abs(self.y - self.eye[1]) < 0.03) & (self.front > 0)
        distance = np.full(self.x.shape, 1.0)
        distance[near] = cKDTree(self._body.positions[self._lash_roots()]).query(self.points[near])[0]
        return np.exp(-((distance / 0.0016) ** 2)) * np.where(self.y > self.eye[1] - 0.004, 1, 0.35)

    def _lash_roots(self) -> Indices:
        groups = [self._body.groups[f"helper-{side}-eyelashes-{row}"] for side in "lr" for row in "12"]
        lashes = np.concatenate(groups)
        positions = self._body.positions
        from_skin = cKDTree(positions[np.unique(self._head.triangles)]).query(positions[lashes])[0]
        return lashes[from_skin < np.percentile(from_skin, 30)]

    @cached_property
    def hairline(self) -> Array:
        """A soft, stubbly transition, so that the hair does not look glued on."""
        wobble = 2.2 * value_noise(self.points * 260) + 1.2 * value_noise(self.points * 700)
        start = _STUBBLE_BELOW[self._who.hair]
        return smoothstep(start, 3.5, self.above_hairline + 0.9 * wobble) * (1 - smoothstep(0.2, 0.6, self.ears))


def _close_mouth(lips: Array) -> Array:
    """Close the gap between upper and lower lip, whose inner rim the mask leaves out."""
    closed = lips.copy()
    on = lips > 0.35
    for column in np.where(on.any(0))[0]:
        rows = np.where(on[:, column])[0]
        between = slice(rows[0], rows[-1] + 1)
        closed[between, column] = np.maximum(closed[between, column], 0.9)
    return gaussian_filter(closed, 1.2)
