"""The log on stderr: one line for each record, whatever clients have put into it, and not too many of them."""

import json
import logging
import sys
from datetime import UTC, datetime

_FORMAT = "%(levelname)s %(name)s: %(message)s"

_BURST = 200
_PER_SECOND = 10.0


class LineFormatter(logging.Formatter):
    """Writes a record so that no text of a client can look like another record, or control a terminal.

    Characters that cannot be printed are escaped, and the lines of a traceback are indented.
    """

    def __init__(self) -> None:
        super().__init__(_FORMAT)

    def formatMessage(self, record: logging.LogRecord) -> str:
        """The line of a record, with the address of the client that it is about, if any."""
        address = getattr(record, "address", None)
        return _printable(super().formatMessage(record) + ("" if address is None else f" ({address})"))

    def formatException(self, ei: "logging._SysExcInfoType") -> str:
        """The lines of a traceback."""
        return "\n".join(f"  {_printable(line)}" for line in super().formatException(ei).split("\n"))


class JsonFormatter(logging.Formatter):
    """Writes a record as a JSON object: time (ISO 8601, UTC), level, logger, message; address and traceback, if any."""

    def format(self, record: logging.LogRecord) -> str:
        """The object on one line."""
        written = {
            "time": datetime.fromtimestamp(record.created, UTC).isoformat(timespec="milliseconds"),
            "level": record.levelname,
            "logger": record.name,
            "message": record.getMessage(),
            "address": getattr(record, "address", None),
            "traceback": self.formatException(record.exc_info) if record.exc_info else None,
        }
        return json.dumps({name: value for name, value in written.items() if value is not None})


FORMATTERS = {"text": LineFormatter, "json": JsonFormatter}
"""The formats of the log by name."""


class LogLimit(logging.Filter):
    """Drops records that follow each other too fast, which would fill a disk, and then says how many."""

    def __init__(self) -> None:
        super().__init__()
        self._left = float(_BURST)
        self._last = 0.0
        self._dropped = 0

    def filter(self, record: logging.LogRecord) -> bool:
        """Return False for a record that comes too soon after many others, so that it is not written."""
        self._left = min(float(_BURST), self._left + (record.created - self._last) * _PER_SECOND)
        self._last = record.created
        if self._left < 1:
            self._dropped += 1
            return False
        self._left -= 1
        if self._dropped:
            record.msg = f"{record.getMessage()} ({self._dropped} lines before this one were left out)"
            record.args = None
            self._dropped = 0
        return True


def log_to_stderr(level: int, form: str = "text") -> None:
    """Writes the records from a level on to stderr, in one of the `FORMATTERS`."""
    handler = logging.StreamHandler(sys.stderr)
    handler.setFormatter(FORMATTERS[form]())
    handler.addFilter(LogLimit())
    logging.basicConfig(level=level, handlers=[handler])


def _printable(text: str) -> str:
    if text.isprintable():
        return text
    return "".join(each if each.isprintable() else each.encode("unicode_escape").decode() for each in text)
