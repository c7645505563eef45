"""How the figure stands when it does nothing: our own pose, near the H-Anim default, but at ease."""

from collections.abc import Iterator, Mapping
from types import MappingProxyType

from reactive_realizer.embodiment.quaternion import Quat, from_euler

_FINGERS = ("index", "middle", "ring", "pinky")
_CURL = (0.22, 0.30, 0.18)
# The outer fingers of a loose hand are bent more than the index.
_MORE = {"index": 0.8, "middle": 1.0, "ring": 1.2, "pinky": 1.35}


def _rotations() -> Iterator[tuple[str, Quat]]:
    for side, outward in (("l", 1.0), ("r", -1.0)):
        # Off the hips, and turned a little inward: seen from the front, the backs of the hands show.
        yield f"{side}_shoulder", from_euler(0.04, -0.25 * outward, 0.16 * outward)
        yield f"{side}_elbow", from_euler(-0.24, 0.0, 0.0)
        yield f"{side}_wrist", from_euler(0.0, 0.0, -0.05 * outward)
        for finger in _FINGERS:
            for i, curl in enumerate(_CURL, 1):
                yield f"{side}_{finger}{i}", from_euler(0.0, 0.0, -outward * curl * _MORE[finger])
        for i, bend in enumerate((0.10, 0.12, 0.12), 1):
            yield f"{side}_thumb{i}", from_euler(0.0, -outward * bend, 0.0)


REST_POSE: Mapping[str, Quat] = MappingProxyType(dict(_rotations()))
"""Joint -> rotation: arms hanging loosely, elbows a little bent, fingers a little curled."""
