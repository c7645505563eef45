"""Splits a document into its top-level elements.

A document may hold several blocks, so it is parsed as the content of an artificial root element. The parser is expat:
it reports columns, stops at a DOCTYPE before any entity is defined, and never opens a file or a connection. Parsing
resumes behind a DOCTYPE that declares nothing, and behind the block that contains an error.
"""

import codecs
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Final
from xml.parsers import expat

from lxml import etree

from reactive_realizer.bml.block import Problem
from reactive_realizer.bml.faults import (
    BadEncoding,
    Doctype,
    MalformedXml,
    StrayText,
    TooDeep,
    TooManyAttributes,
    UnclosedElement,
)
from reactive_realizer.bml.names import BLOCK, SBM, Location
from reactive_realizer.bml.trees import Tree
from reactive_realizer.errors import Fault, RealizerError, quoted
from reactive_realizer.limits import Limits

_BYTE_ORDER_MARKS: Final = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
_DECLARED_ENCODING: Final = re.compile(rb"""<\?xml\s[^<>]*?encoding\s*=\s*["']([A-Za-z0-9._-]+)["']""")
_BYTE_ENCODINGS: Final = {"utf-8", "ascii", "iso8859-1"}
"""Encodings that are read without a byte order mark, by their Python names."""

_ROOT: Final = b'<_ xmlns:sbm="%s">' % SBM.encode()
"""Scripts of SmartBody use its prefix without declaring it."""
_ROOT_END: Final = b"</_>"
_PIECE: Final = 1 << 16
"""Bytes per call: expat copies its input, and a document with many errors starts it many times."""
_START_TAG: Final = re.compile(rb"<(?:[\w.-]+:)?(?:bml|defineproc|useproc|act|fml-apml)[\s/>]")
_END_TAG: Final = re.compile(rb"</(?:[\w.-]+:)?(?:bml|defineproc|useproc)\s*>")
_DOCTYPE: Final = re.compile(rb"<!DOCTYPE", re.IGNORECASE)
_PLAIN_DOCTYPE: Final = re.compile(
    rb"""<!DOCTYPE\s+[^\s<>\[\]"']+(?:\s+(?:SYSTEM|PUBLIC\s*(?:"[^"]*"|'[^']*'))\s*(?:"[^"]*"|'[^']*'))?\s*(?:\[\s*\]\s*)?>"""
)
"""A DOCTYPE that declares nothing itself; what it names is not opened, so it has no effect."""
_WHOLE_DOCTYPE: Final = re.compile(
    rb"""
    <!DOCTYPE (?> [^"'\[>] | "[^"]*" | '[^']*' )*+
    (?: \[ (?> [^"'\]<] | <(?!!--|\?) | <!--.*?--> | <\?.*?\?> | "[^"]*" | '[^']*' )*+ \] \s* )? >
    """,
    re.IGNORECASE | re.DOTALL | re.VERBOSE,
)
"""A DOCTYPE with its declarations; without backtracking, so that a search takes no more than its length."""
_NOT_UTF8: Final = re.compile(rb"\xed[\xb2\xb3][\x80-\xbf]")
"""An invalid byte, as `decode` keeps it: a lone surrogate from U+DC80 to U+DCFF."""
_DECLARATION_END: Final = re.compile(rb"\?>")
_MISPLACED_DECLARATION: Final = expat.errors.codes[expat.errors.XML_ERROR_MISPLACED_XML_PI]


@dataclass(frozen=True, slots=True)
class Root:
    """A well-formed element of a block, or at the top level.

    Attributes:
        tree: the element.
        locations: of all elements in it.
        notes: what is told about its document.
    """

    tree: Tree
    locations: Mapping[Tree, Location]
    notes: tuple[Fault, ...] = ()


def decode(data: bytes) -> str:
    """The text of a document: by its byte order mark, by its first XML declaration, or as UTF-8.

    Invalid bytes become lone surrogates; the parser stops there and reports the line.

    Raises:
        RealizerError: ``bad-encoding``.
    """
    try:
        return data.decode(_encoding_of(data), "surrogateescape")
    except (UnicodeDecodeError, LookupError):
        raise RealizerError(BadEncoding(line=1, column=1)) from None


def read_roots(text: str, limits: Limits) -> Iterator[Root | Problem]:
    """Each top-level element of a document, or the reason to refuse it, in document order."""
    data = re.sub(r"\r\n?", "\n", text).encode("utf-8", "surrogatepass")
    start, location = 0, Location(1, 1)
    refusal: Fault | None = None
    while start < len(data):
        run = _ParserRun(data, start, location, limits, refusal)
        end = run.read()
        yield from run.found
        refusal = run.refusal
        location = location.after(data[start:end].decode("utf-8", "surrogatepass"))
        start = end
    if refusal is not None:
        yield Problem(refusal, BLOCK)


def _encoding_of(data: bytes) -> str:
    for mark, encoding in _BYTE_ORDER_MARKS:
        if data.startswith(mark):
            return encoding
    declared = _DECLARED_ENCODING.search(data)
    encoding = codecs.lookup(declared[1].decode()).name if declared else "utf-8"
    if encoding == "utf-16":  # written before the text was encoded in another way: a declaration in UTF-16 is not found
        return "utf-8"
    if encoding not in _BYTE_ENCODINGS:
        raise LookupError(encoding)
    return encoding


class _RootBuilder:
    """Builds the tree of one top-level element, or finds a reason to refuse it.

    Attributes:
        id: from its start tag, not validated; "bml" if it has none, or is refused for its document.
        open: local name and location of the elements that have not ended.
        refused: the first reason to refuse it.
    """

    def __init__(self, attributes: Mapping[str, str], limits: Limits, refused: Fault | None) -> None:
        self.id = BLOCK if refused else quoted(attributes.get("id", "")) or BLOCK
        self.open: list[tuple[str, Location]] = []
        self._limits = limits
        self.refused = refused
        self._builder: Any = etree.TreeBuilder()  # its stubs lack the prefixes
        self._locations: dict[Tree, Location] = {}

    def start(self, name: str, attributes: dict[str, str], prefixes: dict[str | None, str], location: Location) -> None:
        """Takes a start tag, its names in Clark notation."""
        self.open.append((name.rpartition("}")[2], location))
        if len(self.open) > self._limits.xml_depth:
            self._refuse(TooDeep(limit=self._limits.xml_depth), location)
        if len(attributes) + len(prefixes) > self._limits.xml_attributes:
            self._refuse(TooManyAttributes(limit=self._limits.xml_attributes), location)
        if self.refused:
            return
        try:
            tree = self._builder.start(name, attributes, prefixes)
        except ValueError as invalid:  # lxml is stricter than expat about the URI of a namespace
            self._refuse(MalformedXml(reason=quoted(str(invalid))), location)
        else:
            self._locations[tree] = location

    def text(self, text: str) -> None:
        """Takes text."""
        if not self.refused:
            self._builder.data(text)

    def end(self, name: str) -> None:
        """Takes an end tag."""
        self.open.pop()
        if not self.refused:
            self._builder.end(name)

    def close(self) -> Root | Problem:
        """The result, after the end tag of the element."""
        if self.refused:
            return Problem(self.refused, self.id)
        return Root(self._builder.close(), self._locations)

    def _refuse(self, fault: Fault, location: Location) -> None:
        self.refused = self.refused or fault.located(location.line, location.column)


class _ParserRun:
    """One run of expat over a document, from a given index to the end or to the first error.

    Attributes:
        found: the elements and the problems of this run.
        refusal: why the next top-level element is refused.
    """

    def __init__(self, data: bytes, start: int, location: Location, limits: Limits, refusal: Fault | None) -> None:
        self.found: list[Root | Problem] = []
        self.refusal = refusal
        self._data = data
        self._start = start
        self._location = location
        self._limits = limits
        self._root: _RootBuilder | None = None
        self._prefixes: dict[str | None, str] = {}
        self._stray = False
        self._parser = self._make_parser()

    def read(self) -> int:
        """Parses, and returns the index at which the next run starts."""
        try:
            self._parser.Parse(_ROOT)
            self._parser.StartElementHandler = self._on_start
            self._parser.StartNamespaceDeclHandler = self._on_prefix
            for first in range(self._start, len(self._data), _PIECE):
                self._parser.Parse(self._data[first : first + _PIECE])
            self._parser.Parse(_ROOT_END, True)
        except expat.ExpatError as stopped:
            return self._recover(stopped)
        finally:
            del self._parser  # its handlers refer to this object, a cycle for the garbage collector
        return len(self._data)

    def _make_parser(self) -> expat.XMLParserType:
        # With "}" between namespace and name, only the "{" of Clark notation is missing.
        parser = expat.ParserCreate("utf-8", "}")
        parser.EndElementHandler = self._on_end
        parser.CharacterDataHandler = self._on_text
        return parser

    def _on_prefix(self, prefix: str | None, uri: str | None) -> None:
        self._prefixes[prefix] = uri or ""

    def _on_start(self, name: str, attributes: dict[str, str]) -> None:
        if self._root is None:
            self._root, self.refusal = _RootBuilder(attributes, self._limits, self.refusal), None
            self._stray = False
        named = {_clark(each): value for each, value in attributes.items()}
        self._root.start(_clark(name), named, self._prefixes, self._place())
        self._prefixes = {}

    def _on_text(self, text: str) -> None:
        if self._root is not None:
            self._root.text(text)
        elif text.strip() and not self._stray:
            self._stray = True
            self._report(StrayText(text=quoted(text)), self._place())

    def _on_end(self, name: str) -> None:
        if self._root is None:
            return
        self._root.end(_clark(name))
        if not self._root.open:
            self.found.append(self._root.close())
            self._root = None

    def _recover(self, stopped: expat.ExpatError) -> int:
        """Reports the error, and returns the index at which the next run starts."""
        index = self._start + self._parser.ErrorByteIndex - len(_ROOT)
        # expat points behind "<!" and "</".
        behind = 2 if self._data[index - 2 : index] in {b"<!", b"</"} else 0
        if self._root is None and stopped.code == _MISPLACED_DECLARATION:
            return self._behind(_DECLARATION_END, index)
        place = self._at(self._parser.ErrorLineNumber, self._parser.ErrorColumnNumber - behind)
        plain = _PLAIN_DOCTYPE.match(self._data, index - behind) if self._root is None else None
        if plain is not None:
            return plain.end()
        if _DOCTYPE.match(self._data, index - behind):
            if self._root is None:
                self.refusal = Doctype().located(place.line, place.column)
                whole = _WHOLE_DOCTYPE.match(self._data, index - behind)
                return whole.end() if whole else len(self._data)
            self._report(Doctype(), place)
        elif index >= len(self._data) and self._root is not None:
            element, place = self._root.open[-1]
            self._report(UnclosedElement(element=element), place)
        else:
            foreign = _NOT_UTF8.match(self._data, index - behind)
            reason = "this is not UTF-8; another encoding has to be declared" if foreign else None
            self._report(MalformedXml(reason=reason or expat.ErrorString(stopped.code)), place)
            if self._root is None:
                following = _START_TAG.search(self._data, index + 1)
                return following.start() if following else len(self._data)
        return self._behind(self._end_tag(), index - behind)

    def _end_tag(self) -> re.Pattern[bytes]:
        """The end tag of the top-level element."""
        if self._root is None:
            return _END_TAG
        return re.compile(rb"</(?:[\w.-]+:)?%s\s*>" % re.escape(self._root.open[0][0]).encode("utf-8", "surrogatepass"))

    def _behind(self, pattern: re.Pattern[bytes], index: int) -> int:
        match = pattern.search(self._data, index)
        return match.end() if match else len(self._data)

    def _report(self, fault: Fault, place: Location) -> None:
        located = fault.located(place.line, place.column)
        if self._root is None:
            self.found.append(Problem(located, BLOCK))
        else:
            self.found.append(Problem(self._root.refused or located, self._root.id))

    def _place(self) -> Location:
        return self._at(self._parser.CurrentLineNumber, self._parser.CurrentColumnNumber)

    def _at(self, line: int, column: int) -> Location:
        """The location in the document of a position in this run.

        Args:
            line: from 1.
            column: from 0; in the first line it includes the start tag of the artificial root.
        """
        if line == 1:
            return Location(self._location.line, self._location.column + column - len(_ROOT))
        return Location(self._location.line + line - 1, column + 1)


def _clark(name: str) -> str:
    return "{" + name if "}" in name else name
