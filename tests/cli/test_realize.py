"""`realize` and `check`, as whoever calls them sees them."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.__main__ import main
from reactive_realizer.testing.pilot import block

HELLO = block(
    "hello",
    """
    <speech id="say"><text>Hello, <sync id="you"/>how are you?</text></speech>
    <gesture id="g" lexeme="BEAT" stroke="say:you"/>
    <gaze id="look" target="bluebox" start="0.5" end="2"/>
    """,
)


@pytest.fixture
def bml(tmp_path: Path):
    def write(text: str, name: str = "a.xml") -> str:
        (tmp_path / name).write_text(text)
        return str(tmp_path / name)

    return write


@pytest.fixture
def realize(tmp_path: Path, capsys):
    """Runs ``realize``: exit status, feedback as (time, xml), stderr."""

    def run(*arguments: str):
        file = tmp_path / "feedback.jsonl"
        status = main(["realize", *arguments, "--voice", "text", "--feedback", str(file)])
        lines = [json.loads(line) for line in file.read_text().splitlines()] if file.is_file() else []
        assert all(set(line) == {"time", "xml"} for line in lines)
        captured = capsys.readouterr()
        assert captured.out == "", "stdout carries only what was asked for"
        return status, [(line["time"], line["xml"]) for line in lines], captured.err

    return run


def ids(feedback, kind="Progress"):
    return [xml.partition('id="')[2].partition('"')[0] for _, xml in feedback if f"{kind} " in xml]


def test_a_session_ends_with_its_last_block(realize, bml) -> None:
    status, feedback, errors = realize(bml(HELLO))
    assert status == 0
    assert ids(feedback)[0] == "hello:start"
    assert ids(feedback)[-1] == "hello:end"
    assert errors == ""


def test_files_enter_at_their_times_in_order(realize, bml) -> None:
    one, two = bml(block("one"), "one.xml"), bml(block("two"), "two@.xml")
    _, feedback, _ = realize(f"{two}@1.5", one)
    starts = [(time, xml) for time, xml in feedback if ":start" in xml]
    assert [(time, "two" in xml) for time, xml in starts] == [(0.0, False), (1.5, True)]


@pytest.mark.parametrize("name", ["me@home", "me@", "me@inf", "me@nan", "me@1_000", "me@1.2.3", "me@1e", "me@ 1"])
def test_only_a_suffix_that_is_a_number_is_a_time(realize, bml, name) -> None:
    assert realize(bml(block("b"), name))[0] == 0


@pytest.mark.parametrize(
    ("suffix", "time"), [("2", 2), ("0.5", 0.5), (".5", 0.5), ("2.", 2), ("2e0", 2), ("5E-1", 0.5)]
)
def test_a_number_may_be_written_in_any_way(realize, bml, suffix, time) -> None:
    _, feedback, _ = realize(f"{bml(block('b'))}@{suffix}")
    assert [when for when, xml in feedback if "b:start" in xml] == [time]


def test_a_time_that_is_never_is_a_wrong_option(bml, capsys) -> None:
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
        ("<bml/>", 1),
        ("", 1),
        (block("b", '<wait id="w" duration="1"/>') + block("b"), 1),
        (block("b", characterId="carol"), 1),
        (block("b", '<required><gesture id="g" lexeme="SAMBA"/></required>'), 1),
        (block("b") + "<bml id='c'><oops></bml>" + block("d"), 1),
    ],
)
def test_the_exit_status_says_whether_every_block_was_taken_and_none_failed(realize, bml, text, status) -> None:
    assert realize(bml(text))[0] == status


def test_a_malformed_block_is_told_with_its_own_line_and_reading_goes_on(realize, bml) -> None:
    text = f"<?xml version='1.0'?>\n<!-- one -->\n{block('a')}\n<bml id='bad'>\n<oops>\n</bml>\n{block('z')}"
    _, feedback, _ = realize(bml(text))
    assert [id_ for id_ in ids(feedback) if id_.endswith("end")] == ["a:end", "z:end"]
    (warning,) = [xml for _, xml in feedback if "warningFeedback" in xml]
    assert "line 6" in warning


def test_what_still_waits_when_nothing_can_move_is_named(realize, bml) -> None:
    text = block("b", '<head id="h" lexeme="NOD" start="anticipators:never:comes" end="2"/>')
    text += block("next", composition="APPEND")
    status, feedback, _ = realize(bml(text))
    assert status == 0
    warnings = [xml for _, xml in feedback if "warningFeedback" in xml]
    assert "never:comes" in warnings[0]
    assert 'id="b"' in warnings[0]
    assert "b:end" in warnings[1]
    assert feedback[-1][0] < 3


def test_until_ends_a_session(realize, bml) -> None:
    status, feedback, _ = realize(bml(block("b", '<wait id="w" duration="50"/>')), "--until", "1")
    assert status == 0
    assert ids(feedback) == ["b:start", "b:w:start"]


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
        ["{file}", "--frames", "no-such-folder/frames.npz"],
        [],
    ],
)
def test_a_file_that_is_not_there_and_a_wrong_option_are_2(bml, arguments, capsys) -> None:
    file = bml(block("b"))
    try:
        status = main(["realize", "--voice", "text", *(argument.format(file=file) for argument in arguments)])
    except SystemExit as ended:
        status = ended.code
    assert status == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err
    assert "Traceback" not in captured.err


@pytest.mark.parametrize("command", ["realize", "check"])
def test_every_command_has_help_with_an_example(command, capsys) -> None:
    with pytest.raises(SystemExit) as ended:
        main([command, "--help"])
    assert ended.value.code == 0
    assert f"example: reactive-realizer {command}" in capsys.readouterr().out


def test_feedback_goes_to_stdout_when_asked_and_nothing_else_does(bml, capsys) -> None:
    assert main(["realize", bml(HELLO), "--voice", "text", "--feedback", "-"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) > 10
    assert all(set(json.loads(line)) == {"time", "xml"} for line in lines)


# --- frames


def frames_of(bml, tmp_path, *options):
    file = tmp_path / "frames.npz"
    assert main(["realize", bml(HELLO), "--voice", "text", "--frames", str(file), *options]) == 0
    return np.load(file)


def test_frames_have_the_names_shapes_and_times_that_are_promised(bml, tmp_path) -> None:
    frames = frames_of(bml, tmp_path)
    assert set(frames) == {"time", "joints", "parents", "offsets", "rotations", "root", "morphs", "weights"}
    count, joints, morphs = len(frames["time"]), len(frames["joints"]), len(frames["morphs"])
    assert frames["parents"].shape == (joints,)
    assert np.issubdtype(frames["parents"].dtype, np.integer)
    assert frames["offsets"].shape == (joints, 3)
    assert frames["rotations"].shape == (count, joints, 4)
    assert frames["root"].shape == (count, 3)
    assert frames["weights"].shape == (count, morphs)
    assert np.allclose(frames["time"], np.arange(count) * 0.02, atol=1e-12)
    assert frames["time"][-1] > 1.5
    assert np.allclose(np.linalg.norm(frames["rotations"], axis=-1), 1)
    assert ((frames["weights"] >= 0) & (frames["weights"] <= 1)).all()
    assert {"r_wrist", "skullbase"} <= set(frames["joints"])


def test_with_two_characters_every_name_has_the_character_before_it(bml, tmp_path, tests_data) -> None:
    frames = frames_of(bml, tmp_path, "--human", str(tests_data / "humans" / "two.toml"))
    assert {name.partition("/")[0] for name in frames} == {"alice", "bob"}
    assert np.array_equal(frames["alice/time"], frames["bob/time"])


# --- the same every time


def session(bml, tmp_path, name, seed, *voice):
    feedback, frames = tmp_path / f"{name}.jsonl", tmp_path / f"{name}.npz"
    command = [sys.executable, "-m", "reactive_realizer", "realize", bml(HELLO), *voice]
    command += ["--feedback", str(feedback), "--frames", str(frames)]
    subprocess.run(command, check=True, env={**os.environ, "PYTHONHASHSEED": seed}, timeout=50)
    arrays = np.load(frames)
    return feedback.read_bytes(), {key: arrays[key].tobytes() for key in arrays}


@pytest.mark.parametrize("voice", ["text", pytest.param("espeak", marks=pytest.mark.speech)])
def test_the_same_input_gives_the_same_bytes_whatever_the_hash_seed(bml, tmp_path, voice) -> None:
    one = session(bml, tmp_path, "one", "0", "--voice", voice)
    assert session(bml, tmp_path, "two", "1", "--voice", voice) == one
    assert len(one[0].splitlines()) > 10


# --- check


def check(capsys, *files):
    status = main(["check", *files])
    return status, capsys.readouterr().out.splitlines()


def test_a_file_that_is_fine_is_answered_by_nothing(bml, capsys) -> None:
    assert check(capsys, bml(HELLO)) == (0, [])


def test_what_is_legal_and_not_yet_realized_is_no_problem(bml, capsys) -> None:
    assert check(capsys, bml(block("b", '<locomotion id="go" target="bluebox"/>'))) == (0, [])


def test_an_element_that_bml_does_not_have_is_a_problem(bml, capsys) -> None:
    status, (line,) = check(capsys, bml(block("b", '<speach id="s"/>')))
    assert status == 1
    assert "<speach> is no behavior" in line


def test_a_block_may_refer_to_those_before_it_in_its_file_and_in_earlier_files(bml, capsys) -> None:
    first = bml(block("one") + block("two", '<head id="h" lexeme="NOD" start="one:0.5"/>'), "first.xml")
    second = bml(block("three", '<head id="h" lexeme="NOD" start="two:h:end" stroke="anticipators:m:hit"/>'), "2.xml")
    assert check(capsys, first, second) == (0, [])
    status, lines = check(capsys, second, first)
    assert status == 1
    assert lines == [f"{second}:1:{lines[0].split(':')[2]}: no block 'two' for two:h:end: it is unknown or has ended"]


def test_who_hangs_on_what_cannot_be_read_is_told_that_this_is_why(bml, capsys) -> None:
    status, lines = check(capsys, bml(block("b", '<head id="h"/><head id="i" lexeme="NOD" start="h:end"/>')))
    assert status == 1
    assert "<head> needs the attribute 'lexeme'" in lines[0]
    assert "h:end never comes, because 'h' is dropped" in lines[1]


def test_a_reference_to_a_block_that_comes_later_is_a_problem_also_in_a_constraint(bml, capsys) -> None:
    tie = '<constraint><synchronize><sync ref="h:start"/><sync ref="later:w:end"/></synchronize></constraint>'
    later = block("later", '<wait id="w" duration="1"/>')
    status, (line,) = check(capsys, bml(block("b", '<head id="h" lexeme="NOD"/>' + tie) + later))
    assert status == 1
    assert "no block 'later'" in line


BMLT = 'xmlns:x="http://hmi.ewi.utwente.nl/bmlt"'


def test_a_sync_point_that_what_plays_a_behavior_does_not_know_is_a_problem(bml, capsys) -> None:
    nod = '<head id="h" lexeme="NOD"/><wait id="w" start="h:{}"/>'
    assert check(capsys, bml(block("b", nod.format("strokeStart")))) == (0, [])
    status, (line,) = check(capsys, bml(block("b", nod.format("apex"))))
    assert status == 1
    assert "'h' has no sync point 'apex' for h:apex; it has start, ready" in line


def test_an_attribute_that_ties_a_point_which_its_motion_has_not_is_a_problem(bml, capsys) -> None:
    conduct = f'<x:procanimation {BMLT} id="p" name="conduct-3-beat" {{}}="2"/>'
    assert check(capsys, bml(block("b", conduct.format("beat2")))) == (0, [])
    status, (line,) = check(capsys, bml(block("b", conduct.format("beat9"))))
    assert status == 1
    assert "'p' has no sync point 'beat9' for 2; it has start, beat1, beat2, beat3, end" in line


def test_a_change_of_a_behavior_that_its_block_has_not_is_a_problem(bml, capsys) -> None:
    change = (
        f'<head id="h" lexeme="NOD"/><x:parametervaluechange {BMLT} id="c" target="{{}}" paramId="amount">'
        '<x:trajectory type="linear" targetValue="1"/></x:parametervaluechange>'
    )
    assert check(capsys, bml(block("b", change.format("h")))) == (0, [])
    status, (line,) = check(capsys, bml(block("b", change.format("b:j"))))
    assert status == 1
    assert "the block 'b' has no behavior 'j'" in line


@pytest.mark.parametrize(
    ("parameter", "problem"),
    [
        ('name="amount"', "<parameter> needs the attribute 'value'"),
        ('name="amount" value="1" unit="m"', "unknown attribute unit of <parameter>; known are name, value"),
        (
            'name="amount" value="1" xmlns:u="urn:units" u:unit="m"',
            "the attribute unit of urn:units means nothing here",
        ),
        ('name="amount" value="7"', None),
        ('name="amuont" value="1"', None),
    ],
)
def test_of_a_parameter_it_is_judged_how_it_is_written_not_what_it_says(bml, capsys, parameter, problem) -> None:
    inside = f'<head id="h" lexeme="NOD"><x:parameter {BMLT} {parameter}/></head>'
    _, lines = check(capsys, bml(block("b", inside)))
    assert [line.partition(": ")[2] for line in lines] == [problem] * (problem is not None)


def test_blocks_that_are_activated_and_interrupted_are_no_targets_of_the_world(bml, capsys) -> None:
    inside = f'<x:activate {BMLT} id="a" target="later"/><x:interrupt {BMLT} id="i" target="later"/>'
    assert check(capsys, bml(block("b", inside))) == (0, [])


def test_a_block_that_joins_one_that_never_was_is_a_problem(bml, capsys) -> None:
    after = f'<bml {BMLT} id="b" x:appendAfter="one,two" scheduling="chunk-after(one)"/>'
    status, (line,) = check(capsys, bml(block("one") + after))
    assert status == 1
    assert "appendAfter: there never was a block 'two'" in line


def test_a_procedure_is_defined_before_it_is_used_and_judged_where_it_is_defined(bml, capsys) -> None:
    definition = f'<x:defineproc {BMLT} id="p"><gaze id="look" target="{{}}"/></x:defineproc>'
    use = f'<x:useproc {BMLT} procid="p" bmlid="b"/>'
    assert check(capsys, bml(definition.format("bluebox") + use)) == (0, [])
    status, (early, target) = check(capsys, bml(use + definition.format("nowhere")))
    assert status == 1
    assert "no procedure 'p'; there are none" in early
    assert "no target 'nowhere'" in target


def test_two_blocks_of_one_file_have_two_ids_unless_a_replace_ends_the_first(bml, capsys) -> None:
    twice = bml(f"{block('b')}\n{block('b')}", "twice.xml")
    status, lines = check(capsys, twice)
    assert status == 1
    assert lines == [f"{twice}:2:1: a block with id 'b' has not ended yet; this one is refused"]
    replaced = bml(block("b") + block("c", composition="REPLACE") + block("b"), "replaced.xml")
    assert check(capsys, replaced) == (0, [])
    assert check(capsys, bml(block("b"), "one.xml"), bml(block("b"), "two.xml")) == (0, [])


@pytest.mark.parametrize("command", ["realize", "check"])
@pytest.mark.parametrize("mistake", ["bindings = { foo = 'x' }", "[limits]\nblocks_alive = -1"])
def test_a_human_file_that_cannot_be_is_2_and_one_line_says_why(bml, capsys, command, mistake) -> None:
    human = bml(f"[character.alice]\n{mistake}", "human.toml")
    assert main([command, bml(block("b")), "--human", human]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("human.toml: ")


def test_every_problem_has_file_line_and_column_of_its_start_tag(bml, capsys) -> None:
    file = bml(
        block(
            "b",
            """
  <head id="h" lexeme="NOD" speed="3"/>
  <gaze id="g" target="nowhere"/>
  <head id="i" lexeme="NOD" start="nobody:end"/><head id="j" lexeme="NOD" end="h:sunset"/>
  <wait id="w" duration="-1"/>
""",
        )
    )
    status, lines = check(capsys, file)
    assert status == 1
    places = [":".join(line.removeprefix(f"{file}:").split(":")[:2]) for line in lines]
    assert [place.partition(":")[0] for place in places] == ["2", "3", "4", "4", "5"]
    assert places[0] == "2:1"
    reasons = ["speed", "nowhere", "nobody", "sunset", "-1"]
    assert all(reason in line for reason, line in zip(reasons, lines, strict=True))


def test_targets_are_those_of_the_human_file(bml, capsys, tests_data) -> None:
    file = bml(block("b", '<gaze id="g" target="bob"/>'))
    assert check(capsys, file)[0] == 1
    assert check(capsys, file, "--human", str(tests_data / "humans" / "two.toml"))[0] == 0


def test_check_answers_2_where_a_file_is_not_there(capsys) -> None:
    assert main(["check", "no-such-file.xml"]) == 2
    assert "no-such-file.xml" in capsys.readouterr().err


def test_explain_writes_why_each_point_of_each_block_was_when_it_was(bml, realize, tmp_path) -> None:
    script = bml(block("one", '<wait id="w" duration="0.5"/>') + block("two", composition="APPEND"))
    out = tmp_path / "why.json"
    status, _, _ = realize(script, "--explain", str(out))
    one, two = json.loads(out.read_text())
    assert (status, one["block"], two["block"]) == (0, "one", "two")
    assert one["points"]["one:w:end"]["time"] == 0.5
    assert one["points"]["one:w:end"]["commit"]["cause"] == "plan one"
