"""Feedback of BML 1.0 from the messages of a realizer of the Virtual Human Toolkit."""

from collections.abc import Iterator
from types import MappingProxyType
from typing import Final

from lxml import etree

from reactive_realizer.bml.names import BML, BMLA
from reactive_realizer.client.vh_message import VhMessage

_STATUS: Final = f"{{{BMLA}}}status"
_ENDS: Final = MappingProxyType({"complete": "DONE", "interrupted": "INTERRUPTED"})
"""States of blocks, by the word with which an end is reported; another word is a failure."""
_POINTS: Final = MappingProxyType({"stroke_start": "strokeStart", "stroke_end": "strokeEnd"})
"""Names of sync points, by those of SmartBody, where they differ."""
_BLOCKS: Final = MappingProxyType({"blockstart": "start", "blockend": "end"})

Timed = tuple[float, str]
"""Feedback: the time at which it arrived, s, and its XML."""


class VhmsgFeedback:
    """Reads ``vrAgentBML``, ``vrSpeakFailed``, and feedback on behaviors in the form of SmartBody or of BML 1.0.

    ``vrAgentBML`` contains no time, so the time of its arrival counts. Of a realizer that reports the times of blocks
    itself, only the ends that it does not report otherwise are taken from it.

    Args:
        agent: on which feedback is read.
    """

    def __init__(self, agent: str) -> None:
        self._agent = agent
        self._reports_blocks = False
        self._ahead = 0.0
        self._starts: dict[str, float] = {}
        self._ended: set[str] = set()

    def take(self, message: VhMessage, now: float) -> Iterator[Timed]:
        """The feedback in a message that arrived at a time, s; none if it is no feedback on the agent."""
        word, argument = message
        if word.startswith("<"):
            yield now, self._feedback(word, now)
        elif word == "vrSpeakFailed":
            agent, _, name, reason = (*argument.split(maxsplit=3), "", "", "", "")[:4]
            if agent == self._agent:
                yield now, _warning(name, reason)
        elif word == "vrAgentBML":
            agent, name, point, rest = (*argument.split(maxsplit=3), "", "", "", "")[:4]
            if agent == self._agent and point in _BLOCKS.values():
                yield from self._request(name, point, rest, now)

    def _request(self, name: str, point: str, rest: str, now: float) -> Iterator[Timed]:
        outcome, _, reason = rest.partition(" ")
        if outcome == "error" and (reason or not self._reports_blocks):
            yield now, _warning(name, reason)
        reported = name in self._ended or outcome == "complete" if point == "end" else True
        if not (self._reports_blocks and reported):
            yield now, self._block(name, point, now + self._ahead, _ENDS.get(outcome, "FAILED"))

    def _feedback(self, xml: str, now: float) -> str:
        """Feedback on a behavior or block as BML 1.0; what is no XML, and other elements, as they are."""
        try:
            element = etree.fromstring(xml)
            id_ = element.get("id", "")
            kind = etree.QName(element).localname
            time = float(element.get("globalTime" if kind.endswith("Progress") else "time", "nan"))
        except (etree.XMLSyntaxError, ValueError):
            return xml
        name, _, point = id_.partition(":")
        if kind in ("blockProgress", *_BLOCKS):
            self._reports_blocks, self._ahead = True, time - now
        if kind == "syncpointprogress":
            return self._sync(element, id_, time)
        if kind in _BLOCKS:
            return self._block(name, _BLOCKS[kind], time, "DONE")
        if kind == "blockProgress":
            self._note(name, point, time)
        return xml

    def _sync(self, element: etree._Element, id_: str, time: float) -> str:
        name, _, point = id_.rpartition(":")
        element.tag = f"{{{BML}}}syncPointProgress"
        element.set("id", f"{name}:{_POINTS.get(point, point)}")
        element.set("globalTime", str(time))
        element.set("time", str(time - self._starts.get(name.partition(":")[0], time)))
        return etree.tostring(element, encoding="unicode")

    def _block(self, name: str, point: str, time: float, status: str) -> str:
        self._note(name, point, time)
        element = etree.Element(f"{{{BML}}}blockProgress", id=f"{name}:{point}", globalTime=str(time))
        if point == "end":
            element.set(_STATUS, status)
        return etree.tostring(element, encoding="unicode")

    def _note(self, name: str, point: str, time: float) -> None:
        if point == "start":
            self._starts[name] = time
            self._ended.discard(name)
        elif point == "end":
            self._ended.add(name)


def _warning(name: str, reason: str) -> str:
    element = etree.Element(f"{{{BML}}}warningFeedback", id=name, type="PARSING_FAILURE")
    element.text = reason
    return etree.tostring(element, encoding="unicode")
