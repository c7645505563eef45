"""Records feedback, for assertions in tests."""

from dataclasses import dataclass
from itertools import takewhile

from lxml import etree

from reactive_realizer.bml.names import BMLA, OWN
from reactive_realizer.feedback.feedback_manager import Report

_STATUS = f"{{{BMLA}}}status"
_TIME = f"{{{OWN}}}time"


@dataclass(frozen=True, slots=True)
class FeedbackMessage:
    """One message: the time at which it was sent, s, and its element."""

    time: float
    element: etree._Element

    @property
    def kind(self) -> str:
        """Local name of the element."""
        return etree.QName(self.element).localname

    @property
    def id(self) -> str:
        """Its id, or the id of the block of a prediction; empty if it has none."""
        return str(self.element.get("id") or next((child.get("id", "") for child in self.element), ""))

    @property
    def text(self) -> str:
        """The text of the element, such as the sentence of a warning; empty if it has none."""
        return self.element.text or ""

    @property
    def global_time(self) -> float:
        """The global time of block or sync point progress, s."""
        return float(self.element.get("globalTime", "nan"))

    def predicted(self, point: str) -> float:
        """The global time in a prediction of ``block:behavior:sync``, ``block:start`` or ``block:end``, s.

        Raises:
            LookupError: the point is not in the prediction.
        """
        block, *behavior, sync = point.split(":", 2)
        if not behavior:
            return float(self.element[0].attrib[f"global{sync.capitalize()}"])
        own = next((child for child in self.element if child.get("id") == f"{block}:{behavior[0]}"), None)
        if own is None:
            raise LookupError(f"{block}:{behavior[0]}")
        inline = (each.get(_TIME) for each in own.iter() if each.get("id") == sync)
        time = own.get(sync) or next(inline, None)
        if time is None:
            raise LookupError(point)
        return float(self.element[0].attrib["globalStart"]) + float(time)


class FeedbackList:
    """All messages of a session, in order.

    Attributes:
        raw: the messages as XML.
    """

    def __init__(self) -> None:
        self.raw: list[str] = []
        self._messages: list[FeedbackMessage] = []
        self._unread: list[Report] = []
        self._progress: list[str] = []
        self._progress_of = 0

    def __call__(self, report: Report) -> None:
        """Adds a report; it is parsed only when it is read, so that ticks take no time for it."""
        self.raw.append(report.xml)
        self._unread.append(report)

    @property
    def messages(self) -> list[FeedbackMessage]:
        """All messages, parsed."""
        self._messages += (FeedbackMessage(report.time, etree.fromstring(report.xml)) for report in self._unread)
        self._unread.clear()
        return self._messages

    def clear(self) -> None:
        """Forgets all messages, so that a long session takes no memory for them."""
        self.raw.clear()
        self._messages.clear()
        self._unread.clear()
        self._progress.clear()
        self._progress_of = 0

    def add(self, time: float, xml: str) -> None:
        """Adds a message that was sent at a time, s.

        Raises:
            lxml.etree.XMLSyntaxError: it is not well-formed.
        """
        self.messages.append(FeedbackMessage(time, etree.fromstring(xml)))
        self.raw.append(xml)

    def of(self, kind: str) -> list[FeedbackMessage]:
        """The messages of one kind."""
        return [message for message in self.messages if message.kind == kind]

    @property
    def progress(self) -> list[str]:
        """The ids of block and sync point progress, in order."""
        messages = self.messages
        for message in messages[self._progress_of :]:
            if message.kind in ("blockProgress", "syncPointProgress"):
                self._progress.append(message.id)
        self._progress_of = len(messages)
        return self._progress.copy()

    def time(self, id_: str) -> float:
        """The global time at which a block or sync point was reached, s.

        Raises:
            AssertionError: it was not reported exactly once.
        """
        found = [
            message.global_time for message in self.messages if message.kind.endswith("Progress") and message.id == id_
        ]
        assert len(found) == 1, f"{id_} was reported {len(found)} times"
        return found[0]

    def reached(self, id_: str) -> bool:
        """Whether a block or sync point was reported."""
        return id_ in self.progress

    @property
    def warnings(self) -> list[tuple[str, str]]:
        """The id and type of every warning, in order."""
        return [(message.id, str(message.element.get("type"))) for message in self.of("warningFeedback")]

    def status(self, block: str, sync: str = "end") -> str:
        """The status with which a block started or ended."""
        message = next(message for message in self.of("blockProgress") if message.id == f"{block}:{sync}")
        return str(message.element.get(_STATUS))

    def predictions(self, block: str) -> list[FeedbackMessage]:
        """The predictions of a block, in order."""
        return [message for message in self.of("predictionFeedback") if message.id == block]

    def predicted(self, point: str) -> float:
        """The global time last predicted for ``block:behavior:sync``, ``block:start`` or ``block:end``."""
        return self.predictions(point.partition(":")[0])[-1].predicted(point)

    def predicted_before(self, point: str) -> float:
        """The global time in the last prediction before the point itself was reported, s.

        Raises:
            AssertionError: there is no such prediction.
            LookupError: the point is not in it.
        """
        block = point.partition(":")[0]
        before = takewhile(lambda message: message.kind == "predictionFeedback" or message.id != point, self.messages)
        own = [message for message in before if message.kind == "predictionFeedback" and message.id == block]
        assert own, f"nothing was predicted of {block} before {point} was reported"
        return own[-1].predicted(point)
