"""Faults of documents: what cannot be read, and references that name nothing."""

from collections.abc import Iterable

from reactive_realizer.errors import Fault, ParsingFault, SchedulingFault, WarningType


class BadEncoding(ParsingFault):
    """A document that is not text in one of the encodings that are read."""

    code = "bad-encoding"
    template = "the text is not valid UTF-8, UTF-16, ISO-8859-1 or US-ASCII"


class MalformedXml(ParsingFault):
    """A document that is not well-formed XML."""

    code = "malformed-xml"
    template = "not well-formed XML: {reason}"
    reason: str


class UnclosedElement(ParsingFault):
    """A document that ends inside an element."""

    code = "unclosed-element"
    template = "not well-formed XML: the document ends inside <{element}>"
    element: str


class Doctype(ParsingFault):
    """A document with a DOCTYPE that declares entities or anything else, or stands inside a block."""

    code = "doctype"
    template = "a DOCTYPE that declares something, or stands inside a block, is not allowed"


class TooManyBytes(ParsingFault):
    """A document over the size limit."""

    code = "too-many-bytes"
    template = "{size} bytes; the limit is {limit}"
    size: int | str
    limit: int


class TooDeep(ParsingFault):
    """Elements nested too deeply."""

    code = "too-deep"
    template = "elements are nested more than {limit} deep"
    limit: int


class TooManyAttributes(ParsingFault):
    """An element with too many attributes and namespace declarations."""

    code = "too-many-attributes"
    template = "an element has more than {limit} attributes"
    limit: int


class TooManyRoots(ParsingFault):
    """A document with too many blocks."""

    code = "too-many-roots"
    template = "the document has more than {limit} blocks; the rest is not read"
    limit: int


class TooManyBehaviors(ParsingFault):
    """A block with too many behaviors."""

    code = "too-many-behaviors"
    template = "the block has {size} behaviors; the limit is {limit}"
    size: int
    limit: int


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


class NotBml(ParsingFault):
    """A root element that is neither a block nor a procedure."""

    code = "not-bml"
    template = "<{element}> is not a bml block, defineproc or useproc"
    element: str


class LeftOut(ParsingFault):
    """Elements beside the blocks of a document that are in another language, such as FML."""

    code = "left-out"
    template = "{elements} in <{parent}> is left out; only the blocks of BML in it are played"
    elements: tuple[str, ...]
    parent: str


class LipsLeftOut(ParsingFault):
    """Shapes of the mouth beside a speech."""

    code = "lips-left-out"
    template = "{elements} is left out: the lips follow the sound of the speech"
    elements: tuple[str, ...]


class TimeUnused(ParsingFault):
    """Times of the marks of a speech that is not a recording."""

    code = "time-unused"
    template = "time of {marks} has no effect: it states where a mark is in a recording, and this speech has none"
    marks: tuple[str, ...]


class ReaderFailed(ParsingFault):
    """A document whose reader failed."""

    code = "reader-failed"
    template = "the reader of this document failed: {reason}"
    reason: str


class NoBlock(ParsingFault):
    """A document without blocks."""

    code = "no-block"
    template = "the document contains no bml block"


class ProcedureInBlock(ParsingFault):
    """A definition or use of a procedure inside a block."""

    code = "procedure-in-block"
    template = "<{element}> must be placed outside of blocks"
    element: str


class NoBlockId(ParsingFault):
    """A block without an id."""

    code = "no-block-id"
    template = "the bml block has no id, so it is refused"


class MissingAttribute(ParsingFault):
    """A required attribute that is missing."""

    code = "missing-attribute"
    template = "<{element}> requires the attribute '{attribute}'"
    element: str
    attribute: str


class UnknownAttribute(ParsingFault):
    """Attributes that an element does not have."""

    code = "unknown-attribute"
    template = "unknown attribute {attributes} of <{element}>; known: {known}"
    unknown = "attributes"
    element: str
    attributes: tuple[str, ...]
    known: tuple[str, ...]


class BadAttribute(ParsingFault):
    """A value that an attribute cannot have."""

    code = "bad-attribute"
    template = "{attribute}='{value}' of <{element}>: {reason}"
    element: str
    attribute: str
    value: str
    reason: str


class NotAnId(Fault):
    """A value that is not an id."""

    code = "not-an-id"
    template = (
        "an id must have 1 to 200 characters, without white space, control characters, ':' or '+', and cannot be 'bml'"
    )


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


class NotAVector(Fault):
    """A value that is not a vector."""

    code = "not-a-vector"
    template = "a vector has three numbers, not {size}"
    size: int


class NotWhole(Fault):
    """A value that is not a whole number."""

    code = "not-whole"
    template = "not a whole number"


class OutOfRange(Fault):
    """A number outside of its range."""

    code = "out-of-range"
    template = "not between {low} and {high}"
    low: str
    high: str


class UnknownWord(Fault):
    """A value outside of an enumeration."""

    code = "unknown-word"
    template = "not one of {known}"
    unknown = "word"
    word: str
    known: tuple[str, ...]


class NotAnEvent(Fault):
    """A value that is not the name of an event."""

    code = "not-an-event"
    template = (
        "not the name of an event: it has at most 200 characters, no white space, ':' or '+', and does not end in '-' "
        "and a number"
    )


class NotAReference(Fault):
    """A value that is not a sync reference."""

    code = "not-a-reference"
    template = "not a sync reference; write [block:]behavior:sync[+seconds], or seconds"


class OnlyBlockStart(Fault):
    """A sync point of a block that references cannot name."""

    code = "only-block-start"
    template = "a reference can name the start of its own block, or a sync point of another block: {known}"
    known: tuple[str, ...]


class NotOwnPoint(Fault):
    """A sync point of a block that is not defined by a point of a behavior of this block."""

    code = "not-own-point"
    template = "a sync point of a block is one of its behaviors, behavior:sync, without an offset"


class NotOuterPoint(Fault):
    """A start of a block that is not tied to another block or an anticipator."""

    code = "not-outer-point"
    template = "a block can start at a sync point of another block or of an anticipator"


class ExternalReference(Fault):
    """A reference of a draft to a behavior of another block."""

    code = "external-reference"
    template = "this behavior belongs to another block; a draft must set bmlt:allowexternalrefs='true' to refer to it"


class AbsurdTime(Fault):
    """A time that is too far away, in s."""

    code = "absurd-time"
    template = "times cannot exceed {limit:g} s"
    limit: float


class UnknownElement(ParsingFault):
    """Child elements that an element does not have."""

    code = "unknown-element"
    template = "unknown {elements} in <{parent}>; known: {known}"
    unknown = "elements"
    elements: tuple[str, ...]
    parent: str
    known: tuple[str, ...]


class TwoEnds(ParsingFault):
    """A wait that ends at an event and at something else."""

    code = "two-ends"
    template = "a wait ends at its event; it cannot have '{attribute}' too, but it can have 'max-wait'"
    attribute: str


class MissingElement(ParsingFault):
    """Required child elements that are missing."""

    code = "missing-element"
    template = "<{element}> must contain {children}"
    element: str
    children: str


class RepeatedElement(ParsingFault):
    """A child element that may occur only once."""

    code = "repeated-element"
    template = "<{parent}> contains more than one <{element}>"
    element: str
    parent: str


class StrayText(ParsingFault):
    """Text in an element that contains none."""

    code = "stray-text"
    template = "unexpected text '{text}'"
    text: str


class DuplicateId(ParsingFault):
    """An id that another element has."""

    code = "duplicate-id"
    template = "<{element}>: the id '{id}' is already in use"
    element: str
    id: str


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


class EventTooLong(ParsingFault):
    """An event with a content over the limit."""

    code = "event-too-long"
    template = "the content of the event has more than {limit} characters"
    limit: int


class MoreProblems(ParsingFault):
    """Further problems of a block that are not reported one by one."""

    code = "more-problems"
    template = "{number} more problems in this block"
    number: int


class UnknownBehavior(Fault):
    """An element in a block that is not a behavior of BML."""

    code = "unknown-behavior"
    template = "<{element}> is not a behavior of BML 1.0; known: {known}"
    unknown = "element"
    warning = WarningType.BEHAVIOR_TYPE_NOT_SUPPORTED
    element: str
    known: tuple[str, ...]


class ForeignAttribute(Fault):
    """Attributes of an element, of another namespace, that no engine uses."""

    code = "foreign-attribute"
    template = "{attributes} of {namespace} has no effect here"
    warning = WarningType.CUSTOM_ATTRIBUTE_NOT_SUPPORTED
    attributes: tuple[str, ...]
    namespace: str

    @classmethod
    def of(cls, attributes: Iterable[tuple[str, str]]) -> list[Fault]:
        """One fault for each namespace of some attributes, which are given as namespace and name."""
        by_namespace: dict[str, list[str]] = {}
        for namespace, name in attributes:
            by_namespace.setdefault(namespace, []).append(name)
        return [cls(attributes=tuple(names), namespace=each) for each, names in by_namespace.items()]


class NoCounterpart(Fault):
    """Attributes of SmartBody that nothing here corresponds to."""

    code = "no-counterpart"
    template = "{attributes} of SmartBody has no effect on <{element}> here"
    warning = WarningType.CUSTOM_ATTRIBUTE_NOT_SUPPORTED
    element: str
    attributes: tuple[str, ...]


class FadeTooLong(Fault):
    """A time of SmartBody in which a behavior fades out, in s, that is longer than the behavior."""

    code = "fade-too-long"
    template = "sbm:{attribute}='{fade:g}' has no effect: this <{element}> would fade out before it starts"
    warning = WarningType.CUSTOM_ATTRIBUTE_NOT_SUPPORTED
    element: str
    attribute: str
    fade: float


class PlaysOver(Fault):
    """A blend of SmartBody that changes the mixture of the one that plays."""

    code = "plays-over"
    template = (
        "mode='update' names no behavior that it changes, so this blend plays over the one that plays; "
        "a parametervaluechange changes that one"
    )
    warning = WarningType.CUSTOM_ATTRIBUTE_NOT_SUPPORTED


class NoOrientation(ParsingFault):
    """A movement of the head of SmartBody that is to turn it to a target, and has none."""

    code = "no-orientation"
    template = "<head type='ORIENT'> requires a target to which the head turns; SmartBody leaves it out too"


class LeftToPlugins(Fault):
    """A constraint of SmartBody that only an engine of a plug-in could play."""

    code = "left-to-plugins"
    template = (
        "a constraint of the {quantity} of {effector} is left to plug-ins: "
        "here, constraints are of the place of a wrist, hand or finger, such as r_wrist"
    )
    warning = WarningType.CUSTOM_BEHAVIOUR_NOT_SUPPORTED
    quantity: str
    effector: str


class UnknownReference(SchedulingFault):
    """A reference to a behavior that does not exist."""

    code = "unknown-reference"
    template = "{reference}: there is no behavior '{behavior}'; available: {known}"
    unknown = "behavior"
    reference: str
    behavior: str
    known: tuple[str, ...]


class UnknownMark(ParsingFault):
    """A description of a speech that times a sync point which the speech does not have."""

    code = "unknown-mark"
    template = "the speech has no inline sync point '{mark}'; it has {known}"
    unknown = "mark"
    mark: str
    known: tuple[str, ...]


class UnknownSync(SchedulingFault):
    """A reference to a sync point that its behavior does not have."""

    code = "unknown-sync"
    template = "{reference}: '{behavior}' has no sync point '{sync}'; it has {known}"
    unknown = "sync"
    reference: str
    behavior: str
    sync: str
    known: tuple[str, ...]


class UnknownBlock(SchedulingFault):
    """A reference to a block that does not exist, or has ended."""

    code = "unknown-block"
    template = "{reference}: the block '{block}' is unknown or has ended"
    unknown = "block"
    reference: str
    block: str
    known: tuple[str, ...] = ()


class UnknownBlockPoint(SchedulingFault):
    """A reference to a sync point that a block does not have."""

    code = "unknown-block-point"
    template = "{reference}: the block '{block}' has no sync point '{sync}'; it has {known}"
    unknown = "sync"
    reference: str
    block: str
    sync: str
    known: tuple[str, ...]


class UnknownOwner(SchedulingFault):
    """A reference to a block or behavior that does not exist."""

    code = "unknown-owner"
    template = (
        "{reference}: '{block}' is neither a behavior of this block nor a block that is still alive; behaviors: {known}"
    )
    unknown = "block"
    reference: str
    block: str
    known: tuple[str, ...]


class LostWith(SchedulingFault):
    """A reference to a behavior that was dropped."""

    code = "lost-with"
    template = "{reference} has no time because '{behavior}' is dropped; what depends on it is dropped too"
    reference: str
    behavior: str
