"""Faults of documents, blocks and their elements: what cannot be read."""

from collections.abc import Iterable

from reactive_realizer.errors import Fault, ParsingFault, WarningType


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
