"""Behaviors of BMLT that cannot be played are reported, and the rest plays."""

from pathlib import Path

import pytest

from reactive_realizer.testing.pilot import RealizerPilot

from .motions import ARM, KEYS, SWING, WAVE, told

PERLIN = '<bmlt:noise id="x" type="perlin" joint="vl5"><bmlt:parameter name="{}" value="{}"/></bmlt:noise>'


@pytest.mark.parametrize(
    ("xml", "said"),
    [
        ('<bmlt:procanimation id="x" name="nowhere"/>', "no asset named 'nowhere.xml'"),
        ('<bmlt:procanimation id="x"/>', "<procanimation> needs a file, or the name of one"),
        ('<bmlt:keyframe id="x" name="nowhere"/>', "no asset named 'nowhere.xml' or 'nowhere.bvh'"),
        ('<bmlt:keyframe id="x" name="../secret"/>', "it must be a relative path inside the asset folders"),
        (f'<bmlt:keyframe id="x" name="wave">{ARM.replace("joints", "mirror")}</bmlt:keyframe>',
         "mirror='r_shoulder,r_elbow r_wrist' must be true or false"),
        (f'<bmlt:keyframe id="x">{WAVE.strip().replace("true", "maybe")}</bmlt:keyframe>',
         "x, line 2, <KeyPosition>: leave='maybe' must be true or false"),
        (f'<bmlt:keyframe id="x">{WAVE.strip().replace(KEYS, "0 1 0")}</bmlt:keyframe>',
         "x, line 1, <SkeletonInterpolator>: 3 numbers do not form rows of 5"),
        (f'<bmlt:keyframe id="x">{WAVE.strip().replace("up", "a b")}</bmlt:keyframe>',
         "x, line 2, <KeyPosition>: id='a b' cannot name a sync point"),
        (f'<bmlt:keyframe id="x" name="wave">{ARM.replace("r_shoulder,r_elbow r_wrist", "l_knee")}</bmlt:keyframe>',
         "this character lacks l_knee, which <keyframe> needs"),
        ('<bmlt:keyframe id="x" name="wave"><bmlt:parameter name="filter" value="-3"/></bmlt:keyframe>',
         "the parameter filter must be a number from 0 to 1e+06, not '-3'"),
        (PERLIN.format("persistencex", "1e300"),
         "the parameter persistencex must be a number from 0 to 1, not '1e+300'"),
        (PERLIN.format("basefreqx", "fast"),
         "the parameter basefreqx must be a number from 0 to 1000, not 'fast'"),
        ('<bmlt:procanimation id="x" name="swing"><bmlt:parameter name="a" value="much"/></bmlt:procanimation>',
         "the parameter a must be a number from -inf to inf, not 'much'"),
        ('<head id="x" lexeme="NOD"><bmlt:parameter name="amount" value="7"/></head>',
         "the parameter amount must be a number from 0 to 1, not '7'"),
        ('<head id="x" lexeme="NOD"><bmlt:parameter name="repetition" value="1e9"/></head>',
         "the parameter r must be a number from 0 to 100, not '1e+09'"),
        ('<gesture id="x" lexeme="BEAT"><bmlt:parameter name="amount" value="1.5"/></gesture>',
         "the parameter amount must be a number from 0 to 1, not '1.5'"),
        ('<gesture id="x" lexeme="BEAT"><bmlt:parameter name="postStrokeHoldDuration" value="-3"/></gesture>',
         "the parameter postStrokeHoldDuration must be a number from 0 to 600, not '-3'"),
        ('<gaze id="x" target="bluebox"><bmlt:parameter name="back" value="-1"/></gaze>',
         "the parameter back must be a number from 0 to 1, not '-1'"),
        ('<bmlt:noise id="x" type="perlin" joint="tail"/>', "this character lacks tail, which <noise> needs"),
        ('<bmlt:noise id="x" type="white" joint="vl5"/>', "no entry of the binding plays <noise> with type='white'"),
        ('<gesture id="x" lexeme="JUGGLE"/>', "no entry of the binding plays <gesture> with lexeme='JUGGLE'"),
        ('<bmlt:transition id="x" class="Teleport"/>', "there is no transition 'Teleport'; available: SlerpTransition"),
    ],
)  # fmt: skip
async def test_a_refused_behavior_is_reported_with_its_reason_and_others_play(
    pilot: RealizerPilot, xml: str, said: str
) -> None:
    pilot.block("b", f'{xml}<head id="nod" lexeme="NOD"/>')
    await pilot.advance(2)
    assert pilot.feedback.warnings == [("b:x", "CANNOT_CREATE_BEHAVIOR")]
    assert said in told(pilot)
    assert "b:nod:end" in pilot.feedback.progress


async def test_an_ambiguous_name_is_reported_with_all_its_files(pilot: RealizerPilot, tmp_path: Path) -> None:
    (tmp_path / "again").mkdir()
    (tmp_path / "again" / "swing.xml").write_text(SWING)
    pilot.block("b", '<bmlt:procanimation id="x" name="swing"/>')
    await pilot.advance(1)
    assert pilot.feedback.warnings == [("b:x", "CANNOT_CREATE_BEHAVIOR")]
    assert "again/swing.xml, moves/swing.xml" in told(pilot)
