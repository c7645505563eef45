"""Static friction of feet: MuJoCo's friction is regularized, so that a figure would creep over the floor."""

import mujoco
import numpy as np

from reactive_realizer.physics.rotations import Array

_STIFFNESS = 4000.0
"""Of the spring between a foot and the place where it stands, N/m."""

_SLIP = 0.02
"""A foot that is further away from its place has slipped, m; it stands at another place from then on."""


class StaticFriction:
    """Holds feet where they stand, by springs along the floor, which act while a foot touches it.

    This is the elastic part of bristle models of friction (C. Canudas de Wit et al., "A new model for control of
    systems with friction", IEEE Transactions on Automatic Control 40, 1995).

    Args:
        model: of the figure.
        feet: indices of the bodies of the feet.
    """

    def __init__(self, model: mujoco.MjModel, feet: list[int]) -> None:
        self._geoms = {foot: int(model.body_geomadr[foot]) for foot in feet}
        self._places: dict[int, Array] = {}

    def act(self, data: mujoco.MjData) -> None:
        """Add the forces to those on the bodies, N, in MuJoCo's world."""
        touching = set(data.contact.geom.ravel().tolist())
        for foot, geom in self._geoms.items():
            if geom not in touching:
                self._places.pop(foot, None)
                continue
            now = data.geom_xpos[geom, :2]
            place = self._places.get(foot)
            if place is None or float(np.abs(place - now).max()) > _SLIP:
                self._places[foot] = now.copy()
            else:
                data.xfrc_applied[foot, :2] += _STIFFNESS * (place - now)
