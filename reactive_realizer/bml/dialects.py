"""Dialects: languages whose scripts are read as blocks of BML, so that nothing else needs to know them."""

import logging
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Final

from reactive_realizer.bml.block import Parsed, Problem
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.faults import ReaderFailed
from reactive_realizer.bml.names import BLOCK
from reactive_realizer.limits import Limits

_log = logging.getLogger(__name__)

_SNIFFED: Final = 4000
"""Bytes or characters at the beginning of a document by which its dialect is recognized."""

_XML_TYPES: Final = ("application/xml", "text/xml")
"""Media types that say nothing of the dialect."""


@dataclass(frozen=True, slots=True)
class Dialect:
    """A language of scripts for virtual humans.

    Attributes:
        media_types: of its documents, such as ``application/bml+xml``; in lower case.
        recognizes: whether a document is in this dialect, from its first 4000 characters.
        read: returns the blocks and procedures of a document with the problems of each, as `parse` does for BML: never
            empty, with locations in the document, and without parts over the limits. Its last argument is an id for a
            block without one, which no other document gets.
    """

    media_types: tuple[str, ...]
    recognizes: Callable[[str], bool]
    read: Callable[[str | bytes, Limits, str], list[Parsed]]


_BML_TYPES: Final = ("application/bml+xml", "application/vnd.smartbody+xml", "application/vnd.greta+xml")

BML_DIALECT: Final = Dialect(_BML_TYPES, lambda text: True, parse)
"""BML 1.0 and its drafts. Its reader also says what is wrong with documents that no other dialect recognizes."""


class Dialects:
    """The dialects that are known.

    Args:
        dialects: by name. A document that several recognize is read by the first one; that of BML is the last.
    """

    def __init__(self, dialects: Mapping[str, Dialect]) -> None:
        others = {name: each for name, each in sorted(dialects.items()) if each is not BML_DIALECT}
        self._dialects = {**others, "bml": BML_DIALECT}
        self._by_type = {kind: each for each in self._dialects.values() for kind in each.media_types}

    @property
    def media_types(self) -> tuple[str, ...]:
        """The media types of documents that can be read."""
        return (*_XML_TYPES, *self._by_type)

    def determined_by(self, media_type: str) -> bool:
        """Whether a media type is that of one dialect."""
        return media_type in self._by_type

    def read(self, document: str | bytes, limits: Limits, name: str, media_type: str = "") -> list[Parsed]:
        """The blocks and procedures of a document.

        Args:
            document: in any dialect.
            limits: the sizes that are refused.
            name: id for a block that has none.
            media_type: determines the dialect if it is that of one; otherwise, the content does.
        """
        dialect = self._by_type.get(media_type) or self._recognized(document)
        try:
            return dialect.read(document, limits, name)
        except Exception as failure:
            _log.exception("the reader of a document failed")
            return [Parsed(None, (Problem(ReaderFailed(reason=str(failure), line=1, column=1), BLOCK),))]

    def _recognized(self, document: str | bytes) -> Dialect:
        start = document[:_SNIFFED]
        text = start if isinstance(start, str) else start.decode("utf-8", "replace")
        return next(dialect for name, dialect in self._dialects.items() if _recognizes(name, dialect, text))


def _recognizes(name: str, dialect: Dialect, text: str) -> bool:
    try:
        return dialect.recognizes(text)
    except Exception:
        _log.exception("the dialect %s failed to recognize a document", name)
        return False


ONLY_BML: Final = Dialects({})
