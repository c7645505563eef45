"""The cases of the suite: BML to send, the expectations that do not follow from it, and single checks."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import StrEnum
from importlib.resources import files
from types import MappingProxyType
from typing import Final

from lxml import etree

from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.bml.document import parse
from reactive_realizer.limits import Limits
from reactive_realizer.testing.feedback_list import FeedbackList


class Profile(StrEnum):
    """What is asserted: each profile adds something to what BML 1.0 requires."""

    BML = "bml"
    BMLA = "bmla"
    EXTENSIONS = "extensions"
    PREDICTIONS = "predictions"
    STATUS = "status"
    STRICT = "strict"


PROFILES: Final = MappingProxyType(
    {
        Profile.BML: "what BML 1.0 requires",
        Profile.BMLA: "the attributes and behaviors of BMLA",
        Profile.EXTENSIONS: "behaviors of the core extensions, of BMLT and of MURML",
        Profile.PREDICTIONS: "that points are reached at their predicted times",
        Profile.STATUS: "the states in which blocks end (`bmla:status`), also of blocks that never start",
        Profile.STRICT: "ids and types of warnings, that waiting blocks start at once, and what BML 1.0 leaves open",
    }
)
"""The profiles, each with what it asserts."""


@dataclass(frozen=True, slots=True)
class Check:
    """An assertion about feedback.

    Attributes:
        source: the part of the script, or the rule of BML, that requires it.
        assertion: raises AssertionError if it does not hold.
        profile: to which it belongs.
        timed: whether the assertion compares times, and so has the argument ``tolerance`` (s).
    """

    source: str
    assertion: Callable[..., None]
    profile: Profile = Profile.BML
    timed: bool = False

    def problem(self, feedback: FeedbackList, tolerance: float) -> str | None:
        """The reason for which it does not hold, with a tolerance of times, s; None if it holds."""
        try:
            if self.timed:
                self.assertion(feedback, tolerance=tolerance)
            else:
                self.assertion(feedback)
        except AssertionError as problem:
            return f"{problem} ({self.source})"
        except (ValueError, LookupError, StopIteration) as problem:
            return f"a part of the feedback is missing: {problem!r} ({self.source})"
        return None


SUITE: Final = files(__package__) / "cases"

_UNPLAYED: Final = ("REVOKED", "FAILED")


@dataclass(frozen=True, slots=True)
class Send:
    """A document to send.

    Attributes:
        xml: as it is sent.
        after: the progress to wait for before sending, ``block:start`` or ``block:behavior:sync``; None for none.
        refused: whether all its blocks must be rejected.
    """

    xml: str
    after: str | None
    refused: bool

    @property
    def blocks(self) -> tuple[BehaviorBlock, ...]:
        """Its readable blocks; none if it must be rejected."""
        read = [] if self.refused else parse(self.xml, Limits())
        return tuple(parsed.block for parsed in read if parsed.block is not None)


@dataclass(frozen=True, slots=True)
class Warned:
    """An expected warning.

    Attributes:
        plays: whether the behavior plays anyway.
    """

    id: str
    type: str
    plays: bool


@dataclass(frozen=True, slots=True)
class ConformanceCase:
    """One case of the suite.

    Attributes:
        name: of its file.
        title: a sentence that states the requirement.
        sends: documents to send, in order.
        warnings: all expected warnings.
        ends: the state in which a block ends, of those that do not end DONE.
        profile: to which the case belongs.
        then: what follows when these blocks have ended; its feedback is examined alone, so ids may be used again.
    """

    name: str
    title: str
    profile: Profile
    sends: tuple[Send, ...]
    warnings: tuple[Warned, ...]
    ends: dict[str, str]
    then: "ConformanceCase | None" = None

    @property
    def parts(self) -> Iterator["ConformanceCase"]:
        """The case itself, and what follows it, in order."""
        part: ConformanceCase | None = self
        while part is not None:
            yield part
            part = part.then

    @property
    def blocks(self) -> tuple[BehaviorBlock, ...]:
        """All blocks that must be accepted, in order."""
        return tuple(block for send in self.sends for block in send.blocks)

    def starts(self, block: BehaviorBlock) -> bool:
        """Whether a block must start."""
        return self.ends.get(block.id) not in _UNPLAYED


def read_suite() -> list[ConformanceCase]:
    """The cases of the suite, in order of their names."""
    found = (read_case(file.name.removesuffix(".xml"), file.read_bytes()) for file in SUITE.iterdir())
    return sorted(found, key=lambda case: case.name)


def read_case(name: str, text: bytes) -> ConformanceCase:
    """Read a case from the content of its file."""
    root = etree.fromstring(text)
    return _part(name, _attribute(root, "title"), Profile(root.get("profile", Profile.BML)), root)


def _part(name: str, title: str, profile: Profile, root: etree._Element) -> ConformanceCase:
    """A case, or what follows in it: the content of an element."""
    sends = tuple(map(_send, root.iterchildren("send")))
    warnings = tuple(map(_warned, root.iterchildren("warning")))
    ends = {_attribute(element, "block"): _attribute(element, "status") for element in root.iterchildren("end")}
    following = root.find("then")
    then = None if following is None else _part(name, title, profile, following)
    return ConformanceCase(name, title, profile, sends, warnings, ends, then)


def _attribute(element: etree._Element, name: str) -> str:
    return str(element.attrib[name])


def _warned(element: etree._Element) -> Warned:
    return Warned(_attribute(element, "id"), _attribute(element, "type"), element.get("plays") == "true")


def _send(element: etree._Element) -> Send:
    """A document to send: the child elements or, if it is malformed on purpose, the text."""
    inside = "".join(etree.tostring(child, encoding="unicode") for child in element)
    return Send(inside or element.text or "", element.get("after"), element.get("refused") == "true")
