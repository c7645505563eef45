"""The log on stderr."""

import json
import logging
from collections.abc import Callable

import pytest

from reactive_realizer.cli.log import JsonFormatter, LineFormatter, LogLimit


def record(text: str, created: float = 0.0) -> logging.LogRecord:
    made = logging.LogRecord("server", logging.INFO, "file", 1, "%s", (text,), None)
    made.created = created
    return made


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("/\nERROR root: fake", r"INFO server: /\nERROR root: fake"),
        ("\r\x1b[31m\x07", r"INFO server: \r\x1b[31m\x07"),
        ("\u2028\x85\udc80", r"INFO server: \u2028\x85\udc80"),
        ("Zoë, 你好", "INFO server: Zoë, 你好"),
    ],
)
def test_text_of_a_client_stays_on_its_line(text: str, line: str) -> None:
    assert LineFormatter().format(record(text)) == line


def test_the_lines_of_a_traceback_are_indented() -> None:
    try:
        raise ValueError("/\nERROR root: \x1bfake")
    except ValueError as problem:
        failed = logging.LogRecord("server", logging.ERROR, "file", 1, "failed", (), (ValueError, problem, None))
    assert LineFormatter().format(failed) == "ERROR server: failed\n  ValueError: /\n  ERROR root: \\x1bfake"


@pytest.fixture
def written() -> Callable[[int, float], list[str]]:
    """The lines that are written of a number of records at a time."""
    limit = LogLimit()

    def write(number: int, time: float) -> list[str]:
        records = [record(str(n), time) for n in range(number)]
        return [each.getMessage() for each in records if limit.filter(each)]

    return write


def test_a_flood_of_records_is_cut_and_counted(written: Callable[[int, float], list[str]]) -> None:
    assert len(written(10_000, 0.0)) < 1000
    assert len(written(10_000, 100.0)) < 1000
    assert "9800 lines before this one were left out" in written(1, 200.0)[0]


def test_quiet_logs_are_complete(written: Callable[[int, float], list[str]]) -> None:
    assert [line for second in range(1000) for line in written(5, float(second))] == ["0", "1", "2", "3", "4"] * 1000


def test_a_record_names_the_address_of_its_client() -> None:
    refused = record("refused")
    refused.address = "192.0.2.7"
    assert LineFormatter().format(refused) == "INFO server: refused (192.0.2.7)"
    assert json.loads(JsonFormatter().format(refused))["address"] == "192.0.2.7"


def test_a_record_is_a_json_object_on_one_line() -> None:
    try:
        raise ValueError("/\nproblem")
    except ValueError as problem:
        failed = logging.LogRecord(
            "server", logging.ERROR, "file", 1, "failed\n%s", ("x",), (ValueError, problem, None)
        )
    failed.created = 0.25
    (line,) = JsonFormatter().format(failed).splitlines()
    assert json.loads(line) == {
        "time": "1970-01-01T00:00:00.250+00:00",
        "level": "ERROR",
        "logger": "server",
        "message": "failed\nx",
        "traceback": "ValueError: /\nproblem",
    }
