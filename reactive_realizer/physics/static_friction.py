"""Static friction of feet: MuJoCo's friction is regularized, so that a figure would creep over the floor."""

from collections.abc import Collection

import mujoco

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
        self._places: dict[int, tuple[float, float]] = {}

    def act(self, data: mujoco.MjData, touching: Collection[int]) -> None:
        """Add the forces to those on the bodies, N, in MuJoCo's world.

        Args:
            data: the state.
            touching: indices of the geoms that touch the floor.
        """
        for foot, geom in self._geoms.items():
            if geom not in touching:
                self._places.pop(foot, None)
                continue
            x, y, _ = data.geom_xpos[geom].tolist()
            at = self._places.get(foot)
            if at is None or max(abs(at[0] - x), abs(at[1] - y)) > _SLIP:
                self._places[foot] = x, y
            else:
                data.xfrc_applied[foot, 0] += _STIFFNESS * (at[0] - x)
                data.xfrc_applied[foot, 1] += _STIFFNESS * (at[1] - y)
