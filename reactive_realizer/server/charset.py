"""The text of a body whose encoding its header names."""

import codecs
from typing import Final

from reactive_realizer.errors import error

_MARKS: Final = (codecs.BOM_UTF8, codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
_CHARSETS: Final = {
    "utf-8": "utf-8",
    "ascii": "ascii",
    "iso8859-1": "iso8859-1",
    "utf-16": "utf-16-be",  # without a mark, RFC 2781, 4.3
    "utf-16-be": "utf-16-be",
    "utf-16-le": "utf-16-le",
}
"""Those that are read, by the name that Python gives them."""


def text_of(body: bytes, charset: str | None) -> str | bytes:
    """The body as text if its header says how, else as it is: then the document itself says it.

    A byte order mark goes before the header, and the header before what the document declares (RFC 7303, 3). Bytes that
    are no text become lone surrogates, at which the parser stops and can name the line.

    Raises:
        RealizerError: "wrong-charset", "bad-encoding".
    """
    if charset is None or body.startswith(_MARKS):
        return body
    encoding = _encoding(charset)
    try:
        return body.decode(encoding, "surrogateescape")
    except UnicodeDecodeError as problem:
        raise error("bad-encoding", line=1, column=1) from problem


def _encoding(charset: str) -> str:
    try:
        return _CHARSETS[codecs.lookup(charset).name]
    except (LookupError, ValueError) as problem:  # ValueError: no name of anything
        raise error("wrong-charset", charset=charset) from problem
