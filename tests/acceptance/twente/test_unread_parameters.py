"""A parameter of what reads none, and an attribute of a parameter that nobody knows, are told, and all else plays."""

import pytest

from .motions import told

SAID = '<bmlt:parameter name="loudness" value="5"/><bmlt:parameter name="accent" value="none"/>'
CHANGE = (
    '<bmlt:parametervaluechange id="x" target="s" paramId="volume" start="0" end="0.3">{}'
    '<bmlt:trajectory type="linear" targetValue="70"/></bmlt:parametervaluechange>'
)
SPEECH = '<speech id="s"><text>one two three</text></speech>'


@pytest.mark.parametrize(
    "xml",
    [
        '<speech id="x"><text>well</text>{}</speech>',
        '<faceLexeme id="x" lexeme="RAISE_BROWS">{}</faceLexeme>',
        '<wait id="x" duration="0.5">{}</wait>',
        f"{SPEECH}\n{CHANGE}",
        '<bmlt:interrupt id="x" target="other">{}</bmlt:interrupt>',
        '<bmla:activate id="x" target="later">{}</bmla:activate>',
    ],
)
async def test_all_parameters_of_what_reads_none_are_told_in_one_warning_and_it_plays(pilot, xml) -> None:
    pilot.block("other", '<wait id="w" duration="5"/>')
    pilot.block("later", **{"bmla:preplan": "true"})
    pilot.block("b", "\n" + xml.format(SAID))
    await pilot.advance(3)
    assert pilot.feedback.warnings == [("b:x", "CUSTOM_ATTRIBUTE_NOT_SUPPORTED")]
    element = xml.partition(' id="x"')[0].rpartition("<")[2].rpartition(":")[2]
    line = 2 + xml.partition("<bmlt:p")[0].count("\n")
    assert f"line {line}, column 1: unknown parameter accent, loudness of <{element}>" in told(pilot)
    assert "what plays it knows none" in told(pilot)
    assert pilot.feedback.reached("b:x:end")
    assert pilot.feedback.status("b") == "DONE"


async def test_it_is_told_of_what_waits_too(pilot) -> None:
    pilot.block("b", f'<wait id="x" start="anticipators:t:hit" duration="1">{SAID}</wait>')
    await pilot.advance(0.1)
    assert pilot.feedback.warnings == [("b:x", "CUSTOM_ATTRIBUTE_NOT_SUPPORTED")]


async def test_an_attribute_of_another_namespace_on_a_parameter_is_told_and_the_parameter_counts(pilot) -> None:
    unit = 'xmlns:u="urn:units" u:unit="m"'
    pilot.block("b", f'<head id="x" lexeme="NOD"><bmlt:parameter name="amount" value="0.4" {unit}/></head>')
    await pilot.advance(2)
    assert pilot.feedback.warnings == [("b:x", "CUSTOM_ATTRIBUTE_NOT_SUPPORTED")]
    assert "the attribute unit of urn:units means nothing here" in told(pilot)
    assert pilot.feedback.reached("b:x:end")
