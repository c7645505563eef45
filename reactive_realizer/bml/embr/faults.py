"""Faults of EMBRScript."""

from reactive_realizer.errors import ParsingFault


class UnknownScriptWord(ParsingFault):
    """A word that the language does not have where it stands."""

    code = "embr-unknown-word"
    template = "{parent} has no {word}; it has {known}"
    unknown = "word"
    word: str
    parent: str
    known: tuple[str, ...]


class NotAStatement(ParsingFault):
    """A text that is no statement."""

    code = "embr-not-a-statement"
    template = "'{text}' is not TIME_RESET, BEGIN, END, or NAME:VALUE"
    text: str


class StrayEnd(ParsingFault):
    """An END without a BEGIN."""

    code = "embr-stray-end"
    template = "this END closes nothing"


class Unclosed(ParsingFault):
    """A script that ends inside an element."""

    code = "embr-unclosed"
    template = "the script ends inside this {element}; what is written of it plays"
    element: str


class BadValue(ParsingFault):
    """A value that cannot be read."""

    code = "embr-bad-value"
    template = "{parameter}:{value}: {reason}"
    parameter: str
    value: str
    reason: str


class Missing(ParsingFault):
    """An element without something that it needs."""

    code = "embr-missing"
    template = "{element} needs {parameter}"
    element: str
    parameter: str


class UnknownName(ParsingFault):
    """A body group, joint or shader that is not known."""

    code = "embr-unknown-name"
    template = "there is no {kind} {name}; known are {known}"
    unknown = "name"
    kind: str
    name: str
    known: tuple[str, ...]


class TimeBack(ParsingFault):
    """A time that is not after the one before it, in s."""

    code = "embr-time-back"
    template = (
        "TIME_POINT is at {time} s, before the end of the pose before it at {earliest} s; it comes right after that"
    )
    compared = ("time", "earliest")
    time: float
    earliest: float


class NotRealized(ParsingFault):
    """A feature of the language that has no effect here; each is named once for a script."""

    code = "embr-not-realized"
    template = "{feature} has no effect: {reason}"
    feature: str
    reason: str


class Limited(ParsingFault):
    """A value beyond what a body or a face does; it becomes the limit."""

    code = "embr-limited"
    template = "{key} is {bound} here, not {value}"
    key: str
    value: float
    bound: str


class TooManyPoses(ParsingFault):
    """A gesture with more poses than are read."""

    code = "embr-too-many-poses"
    template = "the gesture has {poses} poses; at most {limit} are read"
    poses: int
    limit: int


class NoSequence(ParsingFault):
    """A script without sequences."""

    code = "embr-no-sequence"
    template = "the script has no K_POSE_SEQUENCE"
