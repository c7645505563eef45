"""Writes motion as a NumPy archive, in the format of docs/cli.md, frames."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from reactive_realizer.export.recorded_motion import RecordedMotion


def write_npz(path: Path, motions: Mapping[str, RecordedMotion]) -> None:
    """Write one archive; with several characters, every name has the prefix ``ID/``."""
    arrays: dict[str, object] = {}
    for id_, motion in motions.items():
        prefix = f"{id_}/" if len(motions) > 1 else ""
        arrays |= {prefix + name: array for name, array in _arrays(motion).items()}
    with path.open("wb") as file:
        np.savez(file, **arrays)  # type: ignore[arg-type]


def _arrays(motion: RecordedMotion) -> dict[str, object]:
    skeleton = motion.avatar.skeleton
    return {
        "time": motion.times,
        "joints": np.array(skeleton.joints),
        "parents": np.array(skeleton.parents),
        "offsets": np.array(skeleton.offsets),
        "rotations": motion.rotations,
        "root": motion.roots,
        "morphs": np.array(motion.avatar.morphs),
        "weights": motion.weights,
    }
