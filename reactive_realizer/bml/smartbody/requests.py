"""Requests as SmartBody gets them: words that say who behaves, before the document.

After table 1 of M. Thiebaux, S. Marsella, A. Marshall and M. Kallmann, "SmartBody: behavior realization for embodied
conversational agents" (AAMAS 2008), which also leaves the element of a mark open.
"""

import re
from typing import Final, NamedTuple

_HEAD: Final = re.compile(
    r"\ufeff?\s*(?:vrSpeak|vrAgentBML\s+request)\s+(?P<agent>[^\s<]+)\s+[^\s<]+\s+(?P<name>[^\s<]+)\s+(?=<)"
)
_NO_ID: Final = re.compile(r"[^\w.-]")
_OPEN_MARK: Final = re.compile(r"<tm(\s[^<>]*[^<>/])>")
UNCLOSED_MARK: Final = "m"
"""The name that a mark without an end tag gets: a letter shorter, so that the slash that closes it moves nothing."""


class Request(NamedTuple):
    """A document, and who plays it.

    Attributes:
        document: without the words before it; everything in it stands where it stood.
        agent: who behaves; empty if nothing says so.
        name: of the request; empty if it has none.
    """

    document: str
    agent: str = ""
    name: str = ""

    @classmethod
    def read(cls, text: str) -> "Request":
        """The request in a text, which may be a document alone."""
        text = with_closed_marks(text)
        head = _HEAD.match(text)
        if head is None:
            return cls(text)
        blank = re.sub(r"[^\n]", " ", head[0])
        return cls(blank + text[head.end() :], head["agent"], _NO_ID.sub("_", head["name"]))


def with_closed_marks(document: str) -> str:
    """Return a document whose marks have no end tags with these elements closed; nothing in it moves."""
    if "<tm" not in document or "</tm" in document:
        return document
    return _OPEN_MARK.sub(rf"<{UNCLOSED_MARK}\1/>", document)
