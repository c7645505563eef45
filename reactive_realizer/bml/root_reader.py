"""From the text of a document to its top-level elements.

A document may hold several blocks, so it is read as the inside of one made-up root. expat reads it: it knows columns,
stops at a DOCTYPE before any entity exists, and reaches nothing outside. After an error reading starts anew behind the
block concerned.
"""

import re
from collections.abc import Iterator
from typing import Final
from xml.parsers import expat

from reactive_realizer.bml.block import Problem
from reactive_realizer.bml.names import BLOCK, Location
from reactive_realizer.bml.root_builder import Root, RootBuilder
from reactive_realizer.bml.trees import shown
from reactive_realizer.errors import Fault
from reactive_realizer.limits import Limits

_ROOT: Final = b"<_>"
_ROOT_END: Final = b"</_>"
_PIECE: Final = 1 << 16
"""Bytes fed at once: expat copies what it is fed, and a bad document starts it many times."""
_START_TAG: Final = re.compile(rb"<(?:[\w.-]+:)?(?:bml|defineproc|useproc)[\s/>]")
_END_TAG: Final = re.compile(rb"</(?:[\w.-]+:)?(?:bml|defineproc|useproc)\s*>")
_DOCTYPE: Final = re.compile(rb"<!DOCTYPE", re.IGNORECASE)
_DECLARATION_END: Final = re.compile(rb"\?>")
_MISPLACED_DECLARATION: Final = expat.errors.codes[expat.errors.XML_ERROR_MISPLACED_XML_PI]


def read_roots(text: str, limits: Limits) -> Iterator[Root | Problem]:
    """The top-level elements of a document, or why one is refused, in order."""
    data = re.sub(r"\r\n?", "\n", text).encode("utf-8", "surrogatepass")
    start, location = 0, Location(1, 1)
    while start < len(data):
        reading = _Reading(data, start, location, limits)
        end = reading.read()
        yield from reading.found
        location = location.after(data[start:end].decode("utf-8", "surrogatepass"))
        start = end


class _Reading:
    """One run of expat over a document, from a given place to the end or the first error."""

    def __init__(self, data: bytes, start: int, location: Location, limits: Limits) -> None:
        self.found: list[Root | Problem] = []
        self._data = data
        self._start = start
        self._location = location
        self._limits = limits
        self._root: RootBuilder | None = None
        self._prefixes: dict[str | None, str] = {}
        self._stray = False
        self._parser = self._make_parser()

    def read(self) -> int:
        """Reads, and gives the index at which to read on."""
        try:
            self._parser.Parse(_ROOT)
            self._parser.StartElementHandler = self._on_start
            for first in range(self._start, len(self._data), _PIECE):
                self._parser.Parse(self._data[first : first + _PIECE])
            self._parser.Parse(_ROOT_END, True)
        except expat.ExpatError as stopped:
            return self._recover(stopped)
        finally:
            del self._parser  # it leads back here: only the garbage collector would find the two
        return len(self._data)

    def _make_parser(self) -> expat.XMLParserType:
        # With "}" between namespace and name only the "{" of Clark notation is missing.
        parser = expat.ParserCreate("utf-8", "}")
        parser.EndElementHandler = self._on_end
        parser.CharacterDataHandler = self._on_text
        parser.StartNamespaceDeclHandler = self._on_prefix
        return parser

    def _on_prefix(self, prefix: str | None, uri: str | None) -> None:
        self._prefixes[prefix] = uri or ""

    def _on_start(self, name: str, attributes: dict[str, str]) -> None:
        if self._root is None:
            self._root = RootBuilder(attributes, self._limits)
            self._stray = False
        named = {_clark(each): value for each, value in attributes.items()}
        self._root.start(_clark(name), named, self._prefixes, self._place())
        self._prefixes = {}

    def _on_text(self, text: str) -> None:
        if self._root is not None:
            self._root.text(text)
        elif text.strip() and not self._stray:
            self._stray = True
            self._report("stray-text", self._place(), text=shown(text))

    def _on_end(self, name: str) -> None:
        if self._root is None:
            return
        self._root.end(_clark(name))
        if not self._root.open:
            self.found.append(self._root.close())
            self._root = None

    def _recover(self, stopped: expat.ExpatError) -> int:
        """Reports the error; where to read on."""
        index = self._start + self._parser.ErrorByteIndex - len(_ROOT)
        # expat points behind "<!" and "</".
        behind = 2 if self._data[index - 2 : index] in {b"<!", b"</"} else 0
        if self._root is None and stopped.code == _MISPLACED_DECLARATION:
            return self._behind(_DECLARATION_END, index)
        place = self._at(self._parser.ErrorLineNumber, self._parser.ErrorColumnNumber - behind)
        if _DOCTYPE.match(self._data, index - behind):
            self._report("doctype", place)
        elif index >= len(self._data) and self._root is not None:
            element, place = self._root.open[-1]
            self._report("unclosed-element", place, element=element)
        else:
            self._report("malformed-xml", place, reason=expat.ErrorString(stopped.code))
            if self._root is None:
                following = _START_TAG.search(self._data, index + 1)
                return following.start() if following else len(self._data)
        return self._behind(_END_TAG, index - behind)

    def _behind(self, pattern: re.Pattern[bytes], index: int) -> int:
        match = pattern.search(self._data, index)
        return match.end() if match else len(self._data)

    def _report(self, code: str, place: Location, **details: object) -> None:
        block = BLOCK if self._root is None else self._root.id
        self.found.append(Problem(Fault(code, details, place.line, place.column), block))

    def _place(self) -> Location:
        return self._at(self._parser.CurrentLineNumber, self._parser.CurrentColumnNumber)

    def _at(self, line: int, column: int) -> Location:
        """A place of the document from one of this run: lines from 1, columns from 0, the root's start tag included."""
        if line == 1:
            return Location(self._location.line, self._location.column + column - len(_ROOT))
        return Location(self._location.line + line - 1, column + 1)


def _clark(name: str) -> str:
    return "{" + name if "}" in name else name
