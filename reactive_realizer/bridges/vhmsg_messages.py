"""Messages of the Virtual Human Toolkit: VHMSG, over ActiveMQ.

The text of a message is its first word, which selects it, and an argument, encoded as in a form of HTML (UTF-8). Some
programs do not encode it.
"""

import re
from collections.abc import Container
from itertools import chain, count
from typing import Final, NamedTuple
from urllib.parse import quote_plus, unquote_plus

from lxml import etree

_SPEAK: Final = "vrSpeak"
_AGENT_BML: Final = "vrAgentBML"
_REQUEST: Final = "request"
_PROLOG: Final = re.compile(r"\s*(?:<\?xml\b.*?\?>)?\s*(?:<!DOCTYPE[^\[>]*>)?", re.DOTALL)
_ROOT: Final = '<_ xmlns:sbm="urn:smartbody">{}</_>'
"""Scripts of SmartBody use its prefix without declaring it."""
_NO_ID: Final = re.compile(r"[^\w.-]")


class VhMessage(NamedTuple):
    """A message: its first word, and the rest, decoded."""

    word: str
    argument: str

    @classmethod
    def read(cls, text: str) -> "VhMessage":
        """The message in a text."""
        word, _, argument = text.strip().partition(" ")
        encoded = not re.search(r"[\s<]", argument)
        return cls(word, unquote_plus(argument) if encoded else argument)

    @property
    def text(self) -> str:
        """The message as it is sent."""
        return f"{self.word} {quote_plus(self.argument)}"


class Act(NamedTuple):
    """A request to an agent to behave (``vrSpeak``, or ``vrAgentBML request``).

    Attributes:
        agent: who behaves.
        recipient: who is addressed.
        name: of the request.
        xml: its BML, in an ``<act>`` or not.
    """

    agent: str
    recipient: str
    name: str
    xml: str

    @classmethod
    def of(cls, message: VhMessage) -> "Act | None":
        """The request in a message, if it is one."""
        word, argument = message
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
            ValueError: the request is not well-formed XML, or has no block.
        """
        try:
            root = etree.fromstring(_ROOT.format(_PROLOG.sub("", self.xml, count=1)), _parser())
        except etree.XMLSyntaxError as problem:
            raise ValueError(str(problem)) from problem
        blocks = list(root.iter("{*}bml"))
        if not blocks:
            raise ValueError("it has no <bml>")
        ids: list[str] = []
        for block in blocks:
            for name in ("character", "agent"):
                block.attrib.pop(name, "")
            block.set("characterId", character)
            ids.append(_free(_NO_ID.sub("_", self.name), taken, ids))
            block.set("id", ids[-1])
        return "".join(etree.tostring(each, encoding="unicode", with_tail=False) for each in blocks), ids


def _parser() -> etree.XMLParser:
    return etree.XMLParser(resolve_entities=False, no_network=True)


def _free(name: str, taken: Container[str], also: Container[str]) -> str:
    """A name that is not taken."""
    names = chain([name], (f"{name}_{number}" for number in count(2)))
    return next(each for each in names if each not in taken and each not in also)
