"""Faults of MURML."""

from reactive_realizer.errors import ParsingFault


class UnknownSymbol(ParsingFault):
    """A symbol that a slot does not have."""

    code = "murml-unknown-symbol"
    template = "{slot} has no {symbol}; it has {known}"
    unknown = "symbol"
    slot: str
    symbol: str
    known: tuple[str, ...]


class BadMurmlValue(ParsingFault):
    """A value of a slot that cannot be read."""

    code = "murml-bad-value"
    template = "{slot} '{value}': {reason}"
    slot: str
    value: str
    reason: str


class MissingMurmlValue(ParsingFault):
    """A movement without a value that it needs."""

    code = "murml-missing-value"
    template = "this movement of {slot} needs {values}"
    slot: str
    values: str


class BadPosture(ParsingFault):
    """The text of a posture that cannot be read."""

    code = "murml-bad-posture"
    template = "'{text}' is no part of a posture; write (l_shoulder 3 100 0 0), or (browInnerUp 1 50) in a face"
    text: str


class FrameTooEarly(ParsingFault):
    """A frame that is not after the one before it; times in s."""

    code = "murml-frame-too-early"
    template = "the frame at {time} s is not after the one before it, at {earliest} s"
    compared = ("time", "earliest")
    time: float
    earliest: float


class MurmlNotRealized(ParsingFault):
    """A feature of MURML that has no effect here; each is named once for a description."""

    code = "murml-not-realized"
    template = "{feature} has no effect: {reason}"
    feature: str
    reason: str


class NothingToPlay(ParsingFault):
    """A description in which nothing can be played."""

    code = "murml-empty"
    template = "<{element}> has nothing that can be played"
    element: str
