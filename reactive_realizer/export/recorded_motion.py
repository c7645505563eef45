"""The motion of characters in a session, as arrays."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.frame import Frame


@dataclass(frozen=True, slots=True, eq=False)
class RecordedMotion:
    """F frames of one character.

    Attributes:
        avatar: of the character, with J joints and M morphs.
        times: (F,) s.
        roots: (F, 3) position of HumanoidRoot in the world, m.
        rotations: (F, J, 4) unit quaternions w x y z, local to the parent joint.
        weights: (F, M) of the morphs, 0 to 1.
    """

    avatar: Avatar
    times: NDArray[np.float64]
    roots: NDArray[np.float64]
    rotations: NDArray[np.float64]
    weights: NDArray[np.float64]


class MotionRecorder:
    """Keeps the frames of all characters (`Realizer.watch`)."""

    def __init__(self, avatars: Mapping[str, Avatar]) -> None:
        self._avatars = avatars
        self._frames: dict[str, list[Frame]] = {id_: [] for id_ in avatars}

    def __call__(self, frames: Mapping[str, Frame]) -> None:
        """Keep the frames of a tick."""
        for id_, frame in frames.items():
            self._frames[id_].append(frame)

    def motions(self) -> dict[str, RecordedMotion]:
        """Return what was kept, by the ids of the characters."""
        return {id_: _motion(self._avatars[id_], frames) for id_, frames in self._frames.items()}


def _motion(avatar: Avatar, frames: list[Frame]) -> RecordedMotion:
    return RecordedMotion(
        avatar,
        np.array([frame.time for frame in frames]),
        np.array([frame.root for frame in frames]).reshape(-1, 3),
        np.array([frame.rotations for frame in frames]).reshape(-1, len(avatar.skeleton.joints), 4),
        np.array([frame.weights for frame in frames]).reshape(-1, len(avatar.morphs)),
    )


def file_of(path: Path, character: str, number: int) -> Path:
    """Return the file of one of several characters: with two, that of alice in ``out.bvh`` is ``out.alice.bvh``."""
    return path if number == 1 else path.with_name(f"{path.stem}.{character}{path.suffix}")
