"""From bytes to the text of a document."""

import codecs
import re
from typing import Final

from reactive_realizer.errors import error

_MARKS: Final = ((codecs.BOM_UTF8, "utf-8-sig"), (codecs.BOM_UTF16_LE, "utf-16"), (codecs.BOM_UTF16_BE, "utf-16"))
_DECLARED: Final = re.compile(rb"""<\?xml\s[^<>]*?encoding\s*=\s*["']([A-Za-z0-9._-]+)["']""")
_BYTE_ENCODINGS: Final = {"utf-8", "ascii", "iso8859-1"}
"""Those that are read without a byte order mark, by the name that Python gives them."""


def decode(data: bytes) -> str:
    """The text of a document by its byte order mark, its first XML declaration, or as UTF-8.

    Bytes that are no text become lone surrogates, at which the parser stops and can name the line.

    Raises:
        RealizerError: ``bad-encoding``.
    """
    try:
        return data.decode(_encoding_of(data), "surrogateescape")
    except (UnicodeDecodeError, LookupError):
        raise error("bad-encoding", line=1, column=1) from None


def _encoding_of(data: bytes) -> str:
    for mark, encoding in _MARKS:
        if data.startswith(mark):
            return encoding
    declared = _DECLARED.search(data)
    encoding = codecs.lookup(declared[1].decode()).name if declared else "utf-8"
    if encoding not in _BYTE_ENCODINGS:
        raise LookupError(encoding)
    return encoding
