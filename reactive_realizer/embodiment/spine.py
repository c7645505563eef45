"""Spines with fewer joints than that of H-Anim: the rotations of missing vertebrae pass to their neighbors."""

from collections.abc import Collection, Iterable, Mapping
from typing import Final

_REGIONS: Final = (
    tuple(f"vl{number}" for number in range(5, 0, -1)),
    tuple(f"vt{number}" for number in range(12, 0, -1)),
    tuple(f"vc{number}" for number in range(7, 0, -1)),
)
"""The vertebrae from the lowest up, lumbar, thoracic and cervical (ISO/IEC 19774)."""

_VERTEBRAE: Final = frozenset(joint for region in _REGIONS for joint in region)


def folded_spine(joints: Iterable[str], known: Collection[str]) -> Mapping[str, tuple[str, ...]]:
    """The vertebrae among some joints, by the one of a figure that turns in their place.

    A vertebra that the figure lacks passes its rotation to the nearest one of the same region, and of two such to the
    lower one. Others, and regions that the figure lacks altogether, are left out.

    Args:
        joints: that turn.
        known: joints of the figure.

    Returns:
        Joint of the figure -> those whose rotations it has, one after another: from the lowest up.
    """
    turned = set(joints)
    folded: dict[str, tuple[str, ...]] = {}
    if _VERTEBRAE.isdisjoint(turned):  # as in most gestures
        return folded
    for region in _REGIONS:
        present = [number for number, joint in enumerate(region) if joint in known]
        for number, joint in enumerate(region):
            if joint in turned and present:
                _, nearest = min((abs(other - number), other) for other in present)
                folded[region[nearest]] = (*folded.get(region[nearest], ()), joint)
    return folded
