"""The command `check`: problems of files with their locations."""

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from reactive_realizer.__main__ import main
from reactive_realizer.assembly.assets import PACKAGE_ASSETS
from reactive_realizer.bml.names import BML
from reactive_realizer.engines.wait_engine import WaitEngine
from reactive_realizer.testing.pilot import block

from .conftest import HELLO


def check(capsys: pytest.CaptureFixture[str], *files: str) -> tuple[int, Any]:
    status = main(["check", *files])
    return status, capsys.readouterr().out.splitlines()


def test_check_prints_nothing_for_a_valid_file(bml: Callable[..., str], capsys: pytest.CaptureFixture[str]) -> None:
    assert check(capsys, bml(HELLO)) == (0, [])


def test_a_legal_element_that_is_not_realized_yet_is_no_problem(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert check(capsys, bml(block("b", '<locomotion id="go" target="bluebox"/>'))) == (0, [])


def test_an_unknown_element_is_a_problem(bml: Callable[..., str], capsys: pytest.CaptureFixture[str]) -> None:
    status, (line,) = check(capsys, bml(block("b", '<speach id="s"/>')))
    assert status == 1
    assert "<speach> is not a behavior" in line


def test_a_sync_point_that_another_block_does_not_define_is_a_problem(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str]
) -> None:
    nod = '<head id="n" lexeme="NOD" start="a:{}"/>'
    gesture = block("a", '<gesture id="g" lexeme="BEAT"/>', stroke="g:stroke")
    assert check(capsys, bml(gesture + block("b", nod.format("stroke")) + block("c", nod.format("ready")))) == (0, [])
    status, (line,) = check(capsys, bml(gesture + block("b", nod.format("strokeEnd"))))
    assert status == 1
    assert "a:strokeEnd: the block 'a' has no sync point 'strokeEnd'; it has start, ready, stroke, relax, end" in line


def test_a_block_may_refer_to_blocks_of_its_file_and_of_earlier_files(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str]
) -> None:
    late = block("zero", '<head id="h" lexeme="NOD" start="two:h:end"/>')
    first = bml(late + block("one") + block("two", '<head id="h" lexeme="NOD" start="one:0.5"/>'), "first.xml")
    second = bml(block("three", '<head id="h" lexeme="NOD" start="two:h:end" stroke="anticipators:m:hit"/>'), "2.xml")
    assert check(capsys, first, second) == (0, [])
    status, lines = check(capsys, second, first)
    assert status == 1
    assert lines == [f"{second}:1:{lines[0].split(':')[2]}: two:h:end: the block 'two' is unknown or has ended"]


def test_the_problem_of_a_reference_to_an_unreadable_behavior_says_so(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str]
) -> None:
    status, lines = check(capsys, bml(block("b", '<head id="h"/><head id="i" lexeme="NOD" start="h:end"/>')))
    assert status == 1
    assert "<head> requires the attribute 'lexeme'" in lines[0]
    assert "h:end has no time because 'h' is dropped" in lines[1]


def test_a_reference_to_an_unknown_block_is_a_problem(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str]
) -> None:
    tie = '<constraint><synchronize><sync ref="h:start"/><sync ref="{}:w:end"/></synchronize></constraint>'
    written = block("b", '<head id="h" lexeme="NOD"/>' + tie) + block("later", '<wait id="w" duration="1"/>')
    assert check(capsys, bml(written.format("later"))) == (0, [])
    status, (line,) = check(capsys, bml(written.format("never")))
    assert status == 1
    assert "the block 'never' is unknown" in line


@pytest.mark.parametrize("point", ["spacebar:pres", "metronome:beat3"])
def test_an_unknown_point_of_an_anticipator_is_a_problem(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str], point: str
) -> None:
    nod = f'<wait id="w" duration="1"/>\n<head id="h" lexeme="NOD" start="anticipators:{point}"/>'
    file = bml(block("b", nod))
    status, (line,) = check(capsys, file)
    anticipator, _, sync = point.partition(":")
    assert status == 1
    assert line.startswith(f"{file}:2:1: anticipators:{point}: the anticipator '{anticipator}' has no point '{sync}'")
    assert ("did you mean 'press'?" in line) is (sync == "pres")


def test_points_with_names_of_the_human_file_are_known(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    human = tmp_path / "human.toml"
    human.write_text('[character.alice]\n[anticipator.trainee]\nkind = "exercise"\nnames = ["down"]\n')
    nods = [f'<head id="h{n}" lexeme="NOD" start="anticipators:trainee:{sync}"/>' for n, sync in enumerate(("down", 3))]
    assert check(capsys, bml(block("b", "".join(nods))), "--human", str(human)) == (0, [])


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("partner", "the human file has no anticipator 'partner', so clients must predict it"),
        ("spacbar", "no anticipator 'spacbar' is known yet; did you mean 'spacebar'?"),
        ("event", "no anticipator 'event' is known yet; did you mean 'events'?"),
    ],
)
def test_an_anticipator_that_is_not_in_the_human_file_is_reported_on_stderr_only(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str], name: str, said: str
) -> None:
    file = bml(block("b", f'<head id="h" lexeme="NOD" start="anticipators:{name}:press"/>'))
    assert main(["check", file]) == 0
    captured = capsys.readouterr()
    assert captured.out == ""
    (line,) = captured.err.splitlines()
    assert line.startswith(f"{file}:1:")
    assert said in line


def test_an_event_that_behaviors_emit_is_a_point_without_an_anticipator(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", bml(block("b", '<head id="h" lexeme="NOD" start="anticipators:events:asked"/>'))]) == 0
    assert capsys.readouterr() == ("", "")


BMLT = 'xmlns:x="http://hmi.ewi.utwente.nl/bmlt"'


def test_a_sync_point_that_the_motion_of_a_behavior_lacks_is_a_problem(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str]
) -> None:
    nod = '<head id="h" lexeme="NOD"/><wait id="w" start="h:{}"/>'
    assert check(capsys, bml(block("b", nod.format("strokeStart")))) == (0, [])
    status, (line,) = check(capsys, bml(block("b", nod.format("apex"))))
    assert status == 1
    assert "h:apex: 'h' has no sync point 'apex'; it has start, ready" in line


def test_an_attribute_for_a_sync_point_that_the_motion_lacks_is_a_problem(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str]
) -> None:
    conduct = f'<x:procanimation {BMLT} id="p" name="conduct-3-beat" {{}}="2"/>'
    assert check(capsys, bml(block("b", conduct.format("beat2")))) == (0, [])
    status, (line,) = check(capsys, bml(block("b", conduct.format("beat9"))))
    assert status == 1
    assert "2: 'p' has no sync point 'beat9'; it has start, beat1, beat2, beat3, end" in line


def test_a_parameter_change_of_an_unknown_behavior_is_a_problem(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str]
) -> None:
    change = (
        f'<head id="h" lexeme="NOD"/><x:parametervaluechange {BMLT} id="c" target="{{}}" paramId="amount">'
        '<x:trajectory type="linear" targetValue="1"/></x:parametervaluechange>'
    )
    assert check(capsys, bml(block("b", change.format("h")))) == (0, [])
    status, (line,) = check(capsys, bml(block("b", change.format("b:j"))))
    assert status == 1
    assert "the block 'b' has no behavior j; it has h, c" in line


@pytest.mark.parametrize(
    ("parameter", "problem"),
    [
        ('name="amount"', "<parameter> requires the attribute 'value'"),
        ('name="amount" value="1" unit="m"', "unknown attribute unit of <parameter>; known: name, value"),
        (
            'name="amount" value="1" xmlns:u="urn:units" u:unit="m"',
            "unit of urn:units has no effect here",
        ),
        ('name="amount" value="7"', None),
        ('name="amuont" value="1"', None),
    ],
)
def test_the_form_of_a_parameter_is_checked_and_its_name_and_value_are_not(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str], parameter: str, problem: str | None
) -> None:
    inside = f'<head id="h" lexeme="NOD"><x:parameter {BMLT} {parameter}/></head>'
    _, lines = check(capsys, bml(block("b", inside)))
    assert [line.partition(": ")[2] for line in lines] == [problem] * (problem is not None)


FOREIGN = 'xmlns:f="urn:f" f:mood="glad"'


@pytest.mark.parametrize(
    ("text", "place"),
    [
        (f'<bml xmlns="{BML}" id="b" {FOREIGN}/>', "1:1"),
        (f'<bml xmlns="{BML}" id="b">\n <head id="h" lexeme="NOD" {FOREIGN}/></bml>', "2:2"),
        (f'<bml xmlns="{BML}" id="b">\n <gesture id="g" lexeme="SAMBA" {FOREIGN}/></bml>', "2:2"),
        (f'<bml xmlns="{BML}" id="b">\n <locomotion id="l" target="bluebox" {FOREIGN}/></bml>', "2:2"),
    ],
)
def test_an_attribute_of_another_namespace_without_effect_is_reported_on_stderr(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str], text: str, place: str
) -> None:
    file = bml(text)
    assert main(["check", file]) == 0
    captured = capsys.readouterr()
    assert captured.out == ""
    assert f"{file}:{place}: mood of urn:f has no effect here" in captured.err.splitlines()


@pytest.mark.parametrize(
    "inside",
    ['<f:dance id="d" xmlns:f="urn:f" f:mood="glad"/>', f'<gaze id="g" target="bluebox" {BMLT} x:dynamic="true"/>'],
)
def test_a_foreign_attribute_that_an_engine_may_read_is_not_reported(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str], inside: str
) -> None:
    assert main(["check", bml(block("b", inside))]) == 0
    captured = capsys.readouterr()
    assert captured.out == ""
    assert "has no effect" not in captured.err


@pytest.mark.parametrize(
    ("inside", "reason"),
    [
        (
            '<gesture id="g" lexeme="BAET"/>',
            "no entry of the binding plays <gesture> with lexeme='BAET'; did you mean 'BEAT'?",
        ),
        ('<faceLexeme id="f" lexeme="GRIN" amount="1"/>', "there is no face lexeme 'GRIN'; available: "),
        (
            '<postureShift id="p"><pose part="ARMS" lexeme="ARMS_CROSED"/></postureShift>',
            "there is no ARMS pose 'ARMS_CROSED'",
        ),
        (f'<x:procanimation {BMLT} id="p" name="samba"/>', "there is no asset named 'samba.xml'"),
        ('<speech id="s"><text>...</text></speech>', "its text contains no words"),
    ],
)
def test_a_behavior_that_this_scene_cannot_play_is_reported_on_stderr_only(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str], inside: str, reason: str
) -> None:
    file = bml(block("b", inside))
    assert main(["check", file]) == 0
    captured = capsys.readouterr()
    assert captured.out == ""
    (line,) = captured.err.splitlines()
    assert line.startswith(f"{file}:1:")
    assert f": {reason}" in line


def test_lexemes_of_a_folder_of_assets_are_known_if_it_is_given(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    file = bml(block("b", f'<x:procanimation {BMLT} id="p" name="hop"/>'))
    (tmp_path / "assets").mkdir()
    animation = (PACKAGE_ASSETS / "procanimation" / "beat_right.xml").read_text()
    (tmp_path / "assets" / "hop.xml").write_text(animation)
    assert main(["check", file, "--assets", str(tmp_path / "assets")]) == 0
    assert capsys.readouterr().err == ""


def test_a_behavior_without_a_motion_is_not_reported_if_its_description_plays(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str]
) -> None:
    inside = f"""<gesture id="g" lexeme="BAET"><description priority="1" type="application/bmlt">
      <x:procanimation {BMLT} id="p" name="conduct-3-beat"/></description></gesture>"""
    assert main(["check", bml(block("b", inside))]) == 0
    assert capsys.readouterr().err == ""


def test_an_engine_that_fails_is_reported_and_the_rest_is_checked(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(WaitEngine, "plan", lambda *_: 1 / 0)
    file = bml(block("b", '<wait id="w" duration="1"/><gaze id="g" target="nowhere"/>'))
    assert main(["check", file]) == 1
    captured = capsys.readouterr()
    assert "there is no target 'nowhere'" in captured.out
    assert "its preparation failed: division by zero" in captured.err
    assert "nowhere" not in captured.err


def test_targets_of_activate_and_interrupt_are_blocks_and_not_objects_of_the_world(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str]
) -> None:
    inside = f'<x:activate {BMLT} id="a" target="later"/><x:interrupt {BMLT} id="i" target="later"/>'
    assert check(capsys, bml(block("b", inside))) == (0, [])


def test_a_composition_with_an_unknown_block_is_a_problem(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str]
) -> None:
    after = f'<bml {BMLT} id="b" x:appendAfter="one,two" scheduling="chunk-after(one)"/>'
    status, (line,) = check(capsys, bml(block("one") + after))
    assert status == 1
    assert "appendAfter: there has never been a block 'two'" in line


def test_a_procedure_is_checked_at_its_definition_and_must_precede_its_uses(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str]
) -> None:
    definition = f'<x:defineproc {BMLT} id="p"><gaze id="look" target="{{}}"/></x:defineproc>'
    use = f'<x:useproc {BMLT} procid="p" bmlid="b"/>'
    assert check(capsys, bml(definition.format("bluebox") + use)) == (0, [])
    status, (early, target) = check(capsys, bml(use + definition.format("nowhere")))
    assert status == 1
    assert "there is no procedure 'p'; available: none" in early
    assert "there is no target 'nowhere'" in target


def test_a_repeated_id_in_a_file_is_a_problem_unless_a_replace_ends_the_first_block(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str]
) -> None:
    twice = bml(f"{block('b')}\n{block('b')}", "twice.xml")
    status, lines = check(capsys, twice)
    assert status == 1
    assert lines == [f"{twice}:2:1: there is already a block 'b' that has not ended; this one is refused"]
    replaced = bml(block("b") + block("c", composition="REPLACE") + block("b"), "replaced.xml")
    assert check(capsys, replaced) == (0, [])
    assert check(capsys, bml(block("b"), "one.xml"), bml(block("b"), "two.xml")) == (0, [])


def test_every_problem_has_file_line_and_column_of_its_start_tag(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str]
) -> None:
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


def test_targets_are_those_of_the_human_file(
    bml: Callable[..., str], capsys: pytest.CaptureFixture[str], tests_data: Path
) -> None:
    file = bml(block("b", '<gaze id="g" target="bob"/>'))
    assert check(capsys, file)[0] == 1
    assert check(capsys, file, "--human", str(tests_data / "humans" / "two.toml"))[0] == 0


def test_the_exit_status_of_check_is_2_for_a_missing_file(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "no-such-file.xml"]) == 2
    assert "no-such-file.xml" in capsys.readouterr().err


def test_a_streamed_speech_is_checked_without_its_sound(bml: Callable[..., str]) -> None:
    stream = "<stream xmlns='urn:reactive-realizer:1' name='x' rate='24000'/>"
    described = f'<text>Hello.</text><description priority="1" type="audio/x-stream">{stream}</description>'
    assert main(["check", bml(block("b", f'<speech id="s">{described}</speech>'))]) == 0


@pytest.mark.parametrize("command", ["check", "realize", "translate"])
def test_a_document_may_come_through_a_pipe(command: str) -> None:
    reading, writing = os.pipe()
    with os.fdopen(writing, "w") as pipe:
        pipe.write(block("b", '<wait id="w" duration="0.1"/>'))
    try:
        assert main([command, f"/dev/fd/{reading}"]) == 0
    finally:
        os.close(reading)


@pytest.mark.parametrize("command", ["check", "realize", "translate"])
def test_a_folder_in_the_place_of_a_file_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], command: str
) -> None:
    assert main([command, str(tmp_path)]) == 2
    assert capsys.readouterr().err == f"a folder, not a file: {tmp_path}\n"
    assert main([command, str(tmp_path / "nothing.xml")]) == 2
    assert capsys.readouterr().err == f"no such file: {tmp_path / 'nothing.xml'}\n"
