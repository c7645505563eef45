"""Faults of speeches: their texts, marks and descriptions."""

from reactive_realizer.errors import ParsingFault


class LipsLeftOut(ParsingFault):
    """Shapes of the mouth without a speech."""

    code = "lips-left-out"
    template = "{elements} is left out: lips follow the sound of a speech, and this block has none"
    elements: tuple[str, ...]


class TimeUnused(ParsingFault):
    """Times of the marks of a speech that is not a recording."""

    code = "time-unused"
    template = "time of {marks} has no effect: it states where a mark is in a recording, and this speech has none"
    marks: tuple[str, ...]


class UtteranceTooLong(ParsingFault):
    """A speech with a text over the limit."""

    code = "utterance-too-long"
    template = "the text has more than {limit} characters"
    limit: int


class TooMuchMarkup(ParsingFault):
    """A text with more SSML than the limit."""

    code = "too-much-markup"
    template = "the SSML has more than {limit} elements and properties"
    limit: int


class TooMuchSilence(ParsingFault):
    """A text with breaks that are too long."""

    code = "too-much-silence"
    template = "the breaks last more than {limit} s in all"
    compared = ("limit",)
    limit: float


class MissingMarks(ParsingFault):
    """SSML without sync points that its speech has."""

    code = "missing-marks"
    template = "the SSML needs a <mark> for each <sync> of the text; these are missing: {marks}"
    marks: tuple[str, ...]


class OtherMarkup(ParsingFault):
    """A description of a speech in a language that no voice here understands."""

    code = "other-markup"
    template = "a description in {language} cannot be spoken; the next one, or the text, is"
    language: str


class UnknownMark(ParsingFault):
    """A description of a speech that times a sync point which the speech does not have."""

    code = "unknown-mark"
    template = "the speech has no inline sync point '{mark}'; it has {known}"
    unknown = "mark"
    mark: str
    known: tuple[str, ...]
