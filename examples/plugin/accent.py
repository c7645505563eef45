"""A formula function: the strength of each beat of a bar."""

_BEATS = (1.0, 0.5, 0.8, 0.5)


def accent(beat: float) -> float:
    """The strength of a beat, 0 to 1, in a bar of four; beats are counted from 0."""
    return _BEATS[int(beat) % len(_BEATS)]
