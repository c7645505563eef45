"""The log on stderr: one line for each record, whatever clients have put into it, and not too many of them."""

import logging
import sys

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
        """The line of a record."""
        return _printable(super().formatMessage(record))

    def formatException(self, ei: "logging._SysExcInfoType") -> str:
        """The lines of a traceback."""
        return "\n".join(f"  {_printable(line)}" for line in super().formatException(ei).split("\n"))


class LogLimit(logging.Filter):
    """Drops records that follow each other too fast, which would fill a disk, and then says how many."""

    def __init__(self) -> None:
        super().__init__()
        self._left = float(_BURST)
        self._last = 0.0
        self._dropped = 0

    def filter(self, record: logging.LogRecord) -> bool:
        """Whether a record is written."""
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


def log_to_stderr(level: int) -> None:
    """Writes the records from a level on to stderr."""
    handler = logging.StreamHandler(sys.stderr)
    handler.setFormatter(LineFormatter())
    handler.addFilter(LogLimit())
    logging.basicConfig(level=level, handlers=[handler])


def _printable(text: str) -> str:
    if text.isprintable():
        return text
    return "".join(each if each.isprintable() else each.encode("unicode_escape").decode() for each in text)
