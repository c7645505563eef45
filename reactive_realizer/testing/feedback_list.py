"""Feedback as a test reads it."""

from dataclasses import dataclass
from itertools import takewhile

from lxml import etree

from reactive_realizer.bml.names import BMLA, OWN
from reactive_realizer.feedback.feedback_manager import Report

_STATUS = f"{{{BMLA}}}status"
_TIME = f"{{{OWN}}}time"


@dataclass(frozen=True, slots=True)
class Line:
    """One message: its element, and when it was told."""

    time: float
    element: etree._Element

    @property
    def kind(self) -> str:
        """Local name of the element."""
        return etree.QName(self.element).localname

    @property
    def id(self) -> str:
        """Its id; of a prediction the block's; empty where it has none."""
        return str(self.element.get("id") or next((child.get("id", "") for child in self.element), ""))

    @property
    def at(self) -> float:
        """Global time of progress."""
        return float(self.element.get("globalTime", "nan"))

    def predicted(self, point: str) -> float:
        """The global time that a prediction has for ``block:behavior:sync``, ``block:start`` or ``block:end``.

        Raises:
            LookupError: it says nothing of it.
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
    """All that was told, in order.

    Attributes:
        raw: as it was told.
    """

    def __init__(self) -> None:
        self.raw: list[str] = []
        self._lines: list[Line] = []
        self._unread: list[Report] = []

    def __call__(self, report: Report) -> None:
        """Take a report; it is read when somebody asks, and so costs no tick anything."""
        self.raw.append(report.xml)
        self._unread.append(report)

    @property
    def lines(self) -> list[Line]:
        """All messages."""
        self._lines += (Line(report.time, etree.fromstring(report.xml)) for report in self._unread)
        self._unread.clear()
        return self._lines

    def add(self, time: float, xml: str) -> None:
        """Take a message that was told at a time, s.

        Raises:
            lxml.etree.XMLSyntaxError: it is no XML.
        """
        self.lines.append(Line(time, etree.fromstring(xml)))
        self.raw.append(xml)

    def of(self, kind: str) -> list[Line]:
        """The messages of one kind."""
        return [line for line in self.lines if line.kind == kind]

    @property
    def progress(self) -> list[str]:
        """Ids of block and sync point progress, in order."""
        return [line.id for line in self.lines if line.kind in ("blockProgress", "syncPointProgress")]

    def time(self, id_: str) -> float:
        """The globalTime at which a block or sync point was reached.

        Raises:
            AssertionError: it was reached never, or more than once.
        """
        found = [line.at for line in self.lines if line.kind.endswith("Progress") and line.id == id_]
        assert len(found) == 1, f"{id_} was reported {len(found)} times"
        return found[0]

    def reached(self, id_: str) -> bool:
        """Whether a block or sync point was reported."""
        return id_ in self.progress

    @property
    def warnings(self) -> list[tuple[str, str]]:
        """Id and type of every warning, in order."""
        return [(line.id, str(line.element.get("type"))) for line in self.of("warningFeedback")]

    def status(self, block: str, sync: str = "end") -> str:
        """The status with which a block started or ended."""
        line = next(line for line in self.of("blockProgress") if line.id == f"{block}:{sync}")
        return str(line.element.get(_STATUS))

    def predictions(self, block: str) -> list[Line]:
        """The predictions of a block, in order."""
        return [line for line in self.of("predictionFeedback") if line.id == block]

    def predicted(self, point: str) -> float:
        """The global time last predicted for ``block:behavior:sync``, ``block:start`` or ``block:end``."""
        return self.predictions(point.partition(":")[0])[-1].predicted(point)

    def foretold(self, point: str) -> float:
        """Like `predicted`, of the last prediction that was told before the point itself.

        Raises:
            AssertionError: there is none.
            LookupError: it says nothing of the point.
        """
        block = point.partition(":")[0]
        before = takewhile(lambda line: line.kind == "predictionFeedback" or line.id != point, self.lines)
        own = [line for line in before if line.kind == "predictionFeedback" and line.id == block]
        assert own, f"nothing was predicted of {block} before {point} was told"
        return own[-1].predicted(point)
