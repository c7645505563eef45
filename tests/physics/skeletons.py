"""Skeletons with parts missing."""

from collections.abc import Collection

import numpy as np

from reactive_realizer.embodiment.body import Body, Skeleton


def without(skeleton: Skeleton, joints: Collection[str]) -> Skeleton:
    """A skeleton that lacks some joints, whose descendants are connected to the joint above."""
    names = [joint for joint in skeleton.joints if joint not in joints]
    body = Body(skeleton)
    parents = [next((name for name in reversed(skeleton.chain(joint)[:-1]) if name in names), None) for joint in names]
    places = [body.transform(joint).position for joint in names]
    origins = [(0.0, 0.0, 0.0) if parent is None else body.transform(parent).position for parent in parents]
    offsets = [tuple(np.subtract(place, origin).tolist()) for place, origin in zip(places, origins, strict=True)]
    indices = [-1 if parent is None else names.index(parent) for parent in parents]
    return Skeleton(tuple(names), tuple(indices), tuple(offsets))
