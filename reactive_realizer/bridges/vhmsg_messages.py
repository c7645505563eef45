"""Requests of the Virtual Human Toolkit, and what is reported of them."""

import re
from collections.abc import Container, Iterator
from itertools import chain, count
from typing import Final, NamedTuple

from lxml import etree

from reactive_realizer.bml.smartbody.requests import with_closed_marks
from reactive_realizer.client.vh_message import VhMessage

_SPEAK: Final = "vrSpeak"
_AGENT_BML: Final = "vrAgentBML"
_REQUEST: Final = "request"
_COMMAND: Final = "sbm"
_PLAY: Final = re.compile(r"bml\s+char\s+(\S+)\s+(?=<)")
"""The beginning of a SmartBody command that plays BML, with the name of the character."""
_PROLOG: Final = re.compile(r"\s*(?:<\?xml\b.*?\?>)?\s*(?:<!DOCTYPE[^\[>]*>)?", re.DOTALL)
_ROOT: Final = '<_ xmlns:sbm="urn:smartbody">{}</_>'
"""Scripts of SmartBody use its prefix without declaring it."""
_NO_ID: Final = re.compile(r"[^\w.-]")
_ACT: Final = "act"
_PARTICIPANT: Final = "participant"
_BLOCK: Final = "bml"


class Act(NamedTuple):
    """A request to an agent to behave (``vrSpeak``, ``vrAgentBML request``, or ``sbm bml char``).

    Attributes:
        agent: who behaves.
        recipient: who is addressed; a command addresses all.
        name: of the request; a command has none of its own.
        xml: its BML, in an ``<act>`` or not, or behaviors alone; marks may lack their end tags, as SmartBody allows.
    """

    agent: str
    recipient: str
    name: str
    xml: str

    @classmethod
    def of(cls, message: VhMessage) -> "Act | None":
        """The request in a message, if it is one."""
        word, argument = message
        if word == _COMMAND and (command := _PLAY.match(argument)) is not None:
            return cls(command[1], "all", _COMMAND, argument[command.end() :])
        if word == _AGENT_BML and argument.startswith(f"{_REQUEST} "):
            word, argument = _SPEAK, argument.removeprefix(_REQUEST)
        parts = argument.split(maxsplit=3)
        return cls(*parts) if word == _SPEAK and len(parts) == 4 else None

    def started(self) -> VhMessage:
        """Reports that it has started."""
        return VhMessage(_AGENT_BML, f"{self.agent} {self.name} start")

    def ended(self, outcome: str) -> VhMessage:
        """Reports that it has ended: complete, interrupted, or error."""
        return VhMessage(_AGENT_BML, f"{self.agent} {self.name} end {outcome}")

    def failed(self, reason: str) -> VhMessage:
        """Reports that it cannot be played."""
        return VhMessage("vrSpeakFailed", f"{self.agent} {self.recipient} {self.name} {reason}")

    def document(self, character: str, taken: Container[str]) -> tuple[str, list[str]]:
        """A document with its blocks, and their ids: its name, with a number if that is taken.

        Args:
            character: that plays them.
            taken: ids that are not free.

        Raises:
            ValueError: the request is not well-formed XML, or has no behaviors.
        """
        try:
            root = etree.fromstring(_ROOT.format(_PROLOG.sub("", with_closed_marks(self.xml), count=1)), _parser())
        except etree.XMLSyntaxError as problem:
            raise ValueError(str(problem)) from problem
        blocks = list(root.iter(f"{{*}}{_BLOCK}")) or list(_added_blocks(root))
        if not blocks:
            raise ValueError("it has no <bml> and no behaviors")
        ids: list[str] = []
        for block in blocks:
            for name in ("character", "agent"):
                block.attrib.pop(name, "")
            block.set("characterId", character)
            ids.append(_free(_NO_ID.sub("_", self.name), taken, ids))
            block.set("id", ids[-1])
        return "".join(etree.tostring(each, encoding="unicode", with_tail=False) for each in blocks), ids


def _added_blocks(root: etree._Element) -> Iterator[etree._Element]:
    """Move behaviors that stand alone, or directly in acts, into a block each, and yield these blocks."""
    for parent in [root, *root.iter(_ACT)]:
        behaviors = [child for child in parent.iterchildren("*") if child.tag not in (_ACT, _PARTICIPANT)]
        if behaviors:
            block = etree.SubElement(parent, _BLOCK)
            block.extend(behaviors)
            yield block


def _parser() -> etree.XMLParser:
    return etree.XMLParser(resolve_entities=False, no_network=True)


def _free(name: str, taken: Container[str], also: Container[str]) -> str:
    """A name that is not taken."""
    names = chain([name], (f"{name}_{number}" for number in count(2)))
    return next(each for each in names if each not in taken and each not in also)
