"""MURML's key frames of the face, as an animation of morph targets."""

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.bml.murml.description import Frame, Keyframing
from reactive_realizer.engines.face.face_animation import FaceAnimation
from reactive_realizer.engines.face.face_shapes import FaceShapes
from reactive_realizer.errors import Fault, RealizerError

_STEPS = 8
"""Rows between two frames; the animation passes evenly between rows."""

_PERCENT = 0.01
_SHORTEST = 0.04
"""Duration of an animation whose only frame is at its start, s."""


def murml_face(keyframing: Keyframing, shapes: FaceShapes) -> FaceAnimation:
    """The animation of key frames.

    It begins with the face as it is below unless the first frame is to be there at once. The peak of its attack is the
    first frame.

    Args:
        keyframing: the key frames.
        shapes: the faces of its avatar.

    Returns:
        The animation, with a note for each morph target that the avatar lacks.

    Raises:
        RealizerError: "no-morph": the avatar has none of them.
    """
    morphs, notes = _known(keyframing.frames, shapes)
    first = keyframing.frames[0]
    times, rows = [0.0], [np.zeros(len(morphs))]
    shares = np.arange(1, _STEPS + 1) / _STEPS
    progress = np.array([keyframing.progress(share) for share in shares.tolist()])[:, np.newaxis]
    if first.time == 0.0 or not keyframing.from_current:
        rows = [_row(first, morphs, rows[0])]
    for frame in keyframing.frames:
        if frame.time > 0.0:
            begin, before, goal = times[-1], rows[-1], _row(frame, morphs, rows[-1])
            times += (begin + shares * (frame.time - begin)).tolist()
            rows += list(before + progress * (goal - before))
    if len(times) == 1:
        times, rows = [0.0, _SHORTEST], [rows[0], rows[0]]
    points = {"start": 0.0, "attackPeak": first.time, "relax": times[-1], "end": times[-1]}
    return FaceAnimation(tuple(times), morphs, np.array(rows).clip(0.0, 1.0), points, notes)


def _known(frames: tuple[Frame, ...], shapes: FaceShapes) -> tuple[tuple[str, ...], tuple[Fault, ...]]:
    """The morph targets that the avatar has, and a fault for each other one."""
    known: dict[str, None] = {}
    faults: dict[str, Fault] = {}
    for frame in frames:
        for name in frame.values:
            try:
                known[shapes.known_morph(name)] = None
            except RealizerError as refused:
                faults.setdefault(name, refused.fault.located(frame.location.line, frame.location.column))
    if not known:
        raise RealizerError(next(iter(faults.values())))
    return tuple(known), tuple(faults.values())


def _row(frame: Frame, morphs: tuple[str, ...], before: NDArray[np.float64]) -> NDArray[np.float64]:
    """The weights of morph targets in a frame; one that it does not name keeps its weight."""
    weights = dict(zip(morphs, before.tolist(), strict=True))
    weights |= {morph: _PERCENT * frame.values[morph][0] for morph in morphs if morph in frame.values}
    return np.array(list(weights.values()))
