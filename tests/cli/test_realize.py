"""The command `realize`: when files enter, its output, and its exit status."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from reactive_realizer.__main__ import main
from reactive_realizer.bml.names import BML
from reactive_realizer.testing.pilot import block

from .conftest import HELLO


def ids(feedback: Any, kind: str = "Progress") -> list[Any]:
    return [xml.partition('id="')[2].partition('"')[0] for _, xml in feedback if f"{kind} " in xml]


def test_a_session_ends_with_its_last_block(
    realize: Callable[..., tuple[int, list[tuple[float, str]], str]], bml: Callable[..., str]
) -> None:
    status, feedback, errors = realize(bml(HELLO))
    assert status == 0
    assert ids(feedback)[0] == "hello:start"
    assert ids(feedback)[-1] == "hello:end"
    assert errors == ""


def test_files_enter_at_their_times_in_order(
    realize: Callable[..., tuple[int, list[tuple[float, str]], str]], bml: Callable[..., str]
) -> None:
    one, two = bml(block("one"), "one.xml"), bml(block("two"), "two@.xml")
    _, feedback, _ = realize(f"{two}@1.5", one)
    starts = [(time, xml) for time, xml in feedback if ":start" in xml]
    assert [(time, "two" in xml) for time, xml in starts] == [(0.0, False), (1.5, True)]


def test_a_file_enters_at_its_time_after_all_earlier_blocks_have_ended(
    realize: Callable[..., tuple[int, list[tuple[float, str]], str]], bml: Callable[..., str]
) -> None:
    one, two = bml(block("one"), "one.xml"), bml(block("two"), "two.xml")
    status, feedback, errors = realize(one, f"{two}@30")
    assert (status, errors) == (0, "")
    assert [time for time, xml in feedback if "two:start" in xml] == [30.0]


def test_a_file_that_would_enter_after_the_end_of_the_session_is_reported(
    realize: Callable[..., tuple[int, list[tuple[float, str]], str]], bml: Callable[..., str]
) -> None:
    one, two = bml(block("one"), "one.xml"), bml(block("two"), "two.xml")
    status, feedback, errors = realize(one, f"{two}@2", "--until", "1")
    assert (status, ids(feedback)) == (0, ["one:start", "one:end"])
    assert errors == f"{two} was not played: the session ended at 1.00 s, before its time of 2.00 s\n"
    assert realize(one, f"{two}@1", "--until", "1")[2] == ""


@pytest.mark.parametrize("name", ["me@home", "me@", "me@inf", "me@nan", "me@1_000", "me@1.2.3", "me@1e", "me@ 1"])
def test_only_a_suffix_that_is_a_number_is_a_time(
    realize: Callable[..., tuple[int, list[tuple[float, str]], str]], bml: Callable[..., str], name: str
) -> None:
    assert realize(bml(block("b"), name))[0] == 0


@pytest.mark.parametrize(
    ("suffix", "time"), [("2", 2), ("0.5", 0.5), (".5", 0.5), ("2.", 2), ("2e0", 2), ("5E-1", 0.5)]
)
def test_a_number_may_be_written_in_any_way(
    realize: Callable[..., tuple[int, list[tuple[float, str]], str]], bml: Callable[..., str], suffix: str, time: float
) -> None:
    _, feedback, _ = realize(f"{bml(block('b'))}@{suffix}")
    assert [when for when, xml in feedback if "b:start" in xml] == [time]


def test_a_time_that_is_not_finite_is_a_usage_error(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as end:
        main(["realize", f"{bml(block('b'))}@1e999"])
    assert end.value.code == 2
    assert "@1e999" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("text", "status"),
    [
        (HELLO, 0),
        (block("b", '<head id="h" lexeme="NOD" start="nobody:end"/>'), 0),
        (block("b", '<teleport id="t"/>'), 0),
        (block("b", '<wait id="w" duration="3"/>') + block("c", composition="REPLACE"), 0),
        (block("b", '<head id="h" lexeme="NOD" start="anticipators:never:comes"/>'), 0),
        ("<bml", 1),
        (f'<bml xmlns="{BML}"/>', 1),
        ("", 1),
        (block("b", '<wait id="w" duration="1"/>') + block("b"), 1),
        (block("b", characterId="carol"), 1),
        (block("b", '<required><gesture id="g" lexeme="SAMBA"/></required>'), 1),
        (block("b") + "<bml id='c'><oops></bml>" + block("d"), 1),
    ],
)
def test_the_exit_status_is_0_if_all_blocks_were_accepted_and_none_failed(
    realize: Callable[..., tuple[int, list[tuple[float, str]], str]], bml: Callable[..., str], text: str, status: int
) -> None:
    assert realize(bml(text))[0] == status


def test_a_malformed_block_is_reported_with_its_line_and_the_others_are_read(
    realize: Callable[..., tuple[int, list[tuple[float, str]], str]], bml: Callable[..., str]
) -> None:
    text = f"<?xml version='1.0'?>\n<!-- one -->\n{block('a')}\n<bml id='bad'>\n<oops>\n</bml>\n{block('z')}"
    _, feedback, _ = realize(bml(text))
    assert [id_ for id_ in ids(feedback) if id_.endswith("end")] == ["a:end", "z:end"]
    (warning,) = [xml for _, xml in feedback if "warningFeedback" in xml]
    assert "line 6" in warning


def test_blocks_that_wait_forever_are_listed_at_the_end(
    realize: Callable[..., tuple[int, list[tuple[float, str]], str]], bml: Callable[..., str]
) -> None:
    text = block("b", '<head id="h" lexeme="NOD" start="anticipators:never:comes" end="2"/>')
    text += block("next", composition="APPEND")
    status, feedback, _ = realize(bml(text))
    assert status == 0
    warnings = [xml for _, xml in feedback if "warningFeedback" in xml]
    assert "never:comes" in warnings[0]
    assert 'id="b"' in warnings[0]
    assert "b:end" in warnings[1]
    assert feedback[-1][0] < 3


def test_until_ends_a_session_and_names_the_blocks_that_it_cuts(
    realize: Callable[..., tuple[int, list[tuple[float, str]], str]], bml: Callable[..., str]
) -> None:
    waits = [block(id_, f'<wait id="w" duration="{duration}"/>') for id_, duration in [("a", 0.5), ("b", 50), ("c", 9)]]
    status, feedback, errors = realize(bml("".join(waits)), "--until", "1")
    assert status == 0
    assert [id_ for id_ in ids(feedback) if id_.endswith("end")] == ["a:w:end", "a:end"]
    assert errors == "the session ended at 1.00 s (--until), before the end of b, c\n"


@pytest.mark.parametrize(
    "arguments",
    [
        ["no-such-file.xml"],
        ["{file}", "--human", "no-such-file.toml"],
        ["{file}", "--clock", "sundial"],
        ["{file}", "--until", "nan"],
        ["{file}", "--until", "-1"],
        ["{file}", "--seed", "x"],
        ["{file}", "--assets", "no-such-folder"],
        ["{file}", "--feedback", "no-such-folder/feedback"],
        ["{file}", "--bvh", "no-such-folder/out.bvh"],
        ["{file}", "--audio", "/"],
        ["{file}", "--frames", "no-such-folder/frames.npz"],
        [],
    ],
)
def test_the_exit_status_is_2_for_a_missing_file_or_a_usage_error(
    bml: Callable[..., str], arguments: Any, capsys: pytest.CaptureFixture[str]
) -> None:
    file = bml(block("b"))
    status: object
    try:
        status = main(["realize", "--voice", "text", *(argument.format(file=file) for argument in arguments)])
    except SystemExit as ended:
        status = ended.code
    assert status == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err
    assert "Traceback" not in captured.err


def test_a_file_that_cannot_be_written_is_told_in_a_line_and_the_others_are_written(
    bml: Callable[..., str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    outputs = ["--feedback", "/dev/full", "--audio", "/proc/x", "--bvh", "/dev/full", "--explain", f"{tmp_path}/why"]
    assert main(["realize", bml(HELLO), "--voice", "text", *outputs]) == 2
    feedback, bvh, audio = capsys.readouterr().err.splitlines()
    assert feedback == "the feedback cannot be written: No space left on device"
    assert bvh == "/dev/full cannot be written: No space left on device"
    assert audio.startswith("/proc/x cannot be written: ")
    assert "hello" in (tmp_path / "why").read_text()


@pytest.mark.parametrize(
    ("text", "status", "said"),
    [
        (f'<bml xmlns="{BML}"/>', 1, "{file}: line 1, column 1: the bml block has no id, so it is refused\n"),
        (block("b", '\n<teleport id="t"/>'), 0, "b:t: line 2, column 1: <teleport> is not a behavior of BML 1.0"),
        (HELLO, 0, ""),
    ],
)
def test_without_feedback_the_warnings_go_to_stderr(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str], text: str, status: int, said: str
) -> None:
    file = bml(text)
    assert main(["realize", file, "--voice", "text"]) == status
    assert capsys.readouterr().err.startswith(said.format(file=file))


def test_warnings_of_blocks_without_an_id_name_their_file(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str]
) -> None:
    no_id = f'<bml xmlns="{BML}"/>'
    files = {
        "named.xml": block("b", '<teleport id="t"/>'),
        "draft.xml": '<bml><gaze id="look" target="nobody"/></bml>',
        "two_drafts.xml": '<bml/><bml><gaze id="look" target="nobody"/></bml>',
        "cut.xml": "<bml>",
        "no_id.xml": no_id,
        "late.xml": no_id,
    }
    named, draft, two_drafts, cut, no_id, late = (bml(text, name) for name, text in files.items())
    assert main(["realize", f"{late}@1", named, draft, two_drafts, cut, no_id, "--voice", "text"]) == 1
    subjects = [line.partition(": line ")[0] for line in capsys.readouterr().err.splitlines()]
    unread, planned = [cut, no_id, late], ["b:t", f"{draft}: document2:look", f"{two_drafts}: document3_2:look"]
    assert [subject for subject in subjects if subject in unread] == unread
    assert sorted(subject for subject in subjects if subject not in unread) == sorted(planned)


def test_only_feedback_goes_to_stdout_if_requested(bml: Callable[..., str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["realize", bml(HELLO), "--voice", "text", "--feedback", "-"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) > 10
    assert all(set(json.loads(line)) == {"time", "xml"} for line in lines)


def test_explain_writes_the_explanation_of_every_sync_point(
    bml: Callable[..., str], realize: Callable[..., tuple[int, list[tuple[float, str]], str]], tmp_path: Path
) -> None:
    script = bml(block("one", '<wait id="w" duration="0.5"/>') + block("two", composition="APPEND"))
    out = tmp_path / "why.json"
    status, _, _ = realize(script, "--explain", str(out))
    one, two = json.loads(out.read_text())
    assert (status, one["block"], two["block"]) == (0, "one", "two")
    assert one["points"]["one:w:end"]["time"] == 0.5
    assert one["points"]["one:w:end"]["commit"]["cause"] == "plan one"
