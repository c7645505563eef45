"""Parameters of behaviors that read none, and unknown attributes of parameters, are reported, and the rest plays."""

import pytest

from reactive_realizer.testing.pilot import RealizerPilot

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
async def test_parameters_of_a_behavior_that_reads_none_are_in_one_warning(pilot: RealizerPilot, xml: str) -> None:
    pilot.block("other", '<wait id="w" duration="5"/>')
    pilot.block("later", **{"bmla:preplan": "true"})
    pilot.block("b", "\n" + xml.format(SAID))
    await pilot.advance(3)
    assert pilot.feedback.warnings == [("b:x", "CUSTOM_ATTRIBUTE_NOT_SUPPORTED")]
    element = xml.partition(' id="x"')[0].rpartition("<")[2].rpartition(":")[2]
    line = 2 + xml.partition("<bmlt:p")[0].count("\n")
    assert f"line {line}, column 1: unknown parameter accent, loudness of <{element}>" in told(pilot)
    assert "it has none" in told(pilot)
    assert pilot.feedback.reached("b:x:end")
    assert pilot.feedback.status("b") == "DONE"


async def test_unread_parameters_of_a_wait_are_reported(pilot: RealizerPilot) -> None:
    pilot.block("b", f'<wait id="x" start="anticipators:t:hit" duration="1">{SAID}</wait>')
    await pilot.advance(0.1)
    assert pilot.feedback.warnings == [("b:x", "CUSTOM_ATTRIBUTE_NOT_SUPPORTED")]


async def test_a_foreign_attribute_of_a_parameter_is_reported_and_the_parameter_applies(
    pilot: RealizerPilot,
) -> None:
    unit = 'xmlns:u="urn:units" u:unit="m"'
    pilot.block("b", f'<head id="x" lexeme="NOD"><bmlt:parameter name="amount" value="0.4" {unit}/></head>')
    await pilot.advance(2)
    assert pilot.feedback.warnings == [("b:x", "CUSTOM_ATTRIBUTE_NOT_SUPPORTED")]
    assert "unit of urn:units has no effect here" in told(pilot)
    assert pilot.feedback.reached("b:x:end")
