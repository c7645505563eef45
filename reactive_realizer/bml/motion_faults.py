"""Faults of motions that a document describes: key poses, EMBRScript and MURML."""

from reactive_realizer.errors import ParsingFault


class GivenTwice(ParsingFault):
    """Something that a script or a description gives more than once where it counts once."""

    code = "given-twice"
    template = "{what} is given twice; {counting} counts"
    what: str
    counting: str


class BeyondLimit(ParsingFault):
    """A part of a motion that is more than is read of it; the parts before it play."""

    code = "beyond-limit"
    template = "this {element} and all after it are left out: at most {limit} {things} are played ({key})"
    element: str
    limit: int
    things: str
    key: str


class PoseTooEarly(ParsingFault):
    """A key pose before the end of the one before it, in s."""

    code = "pose-too-early"
    template = "the key pose at {time} s is before the end of the one before it, at {earliest} s"
    compared = ("time", "earliest")
    time: float
    earliest: float


class HeldCurve(ParsingFault):
    """A key pose with a hold and parameters of a curve that passes it."""

    code = "held-curve"
    template = "a motion stops at a key pose with a hold, so this one has no use for {attributes}"
    attributes: tuple[str, ...]
