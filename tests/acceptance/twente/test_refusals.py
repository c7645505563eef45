"""What of BMLT cannot be played is said, and the rest goes on."""

import pytest

from .motions import ARM, KEYS, SWING, WAVE, told

PERLIN = '<bmlt:noise id="x" type="perlin" joint="vl5"><bmlt:parameter name="{}" value="{}"/></bmlt:noise>'


@pytest.mark.parametrize(
    ("xml", "said"),
    [
        ('<bmlt:procanimation id="x" name="nowhere"/>', "no file 'nowhere.xml' among the assets"),
        ('<bmlt:procanimation id="x"/>', "<procanimation> needs a file, or the name of one"),
        ('<bmlt:keyframe id="x" name="nowhere"/>', "no file 'nowhere.xml' or 'nowhere.bvh' among the assets"),
        ('<bmlt:keyframe id="x" name="../secret"/>', "it may not leave the folders"),
        (f'<bmlt:keyframe id="x" name="wave">{ARM.replace("joints", "mirror")}</bmlt:keyframe>',
         "mirror='r_shoulder,r_elbow r_wrist' is neither true nor false"),
        (f'<bmlt:keyframe id="x">{WAVE.strip().replace("true", "maybe")}</bmlt:keyframe>',
         "x, line 2, <KeyPosition>: leave='maybe' is neither true nor false"),
        (f'<bmlt:keyframe id="x">{WAVE.strip().replace(KEYS, "0 1 0")}</bmlt:keyframe>',
         "x, line 1, <SkeletonInterpolator>: 3 numbers are no rows of 5"),
        (f'<bmlt:keyframe id="x">{WAVE.strip().replace("up", "a b")}</bmlt:keyframe>',
         "x, line 2, <KeyPosition>: id='a b' cannot name a sync point"),
        (f'<bmlt:keyframe id="x" name="wave">{ARM.replace("r_shoulder,r_elbow r_wrist", "l_knee")}</bmlt:keyframe>',
         "this figure has no l_knee, which <keyframe> needs"),
        ('<bmlt:keyframe id="x" name="wave"><bmlt:parameter name="filter" value="-3"/></bmlt:keyframe>',
         "the parameter filter is a number from 0 to 1e+06, which '-3' is not"),
        (PERLIN.format("persistencex", "1e300"),
         "the parameter persistencex is a number from 0 to 1, which '1e+300' is not"),
        (PERLIN.format("basefreqx", "fast"),
         "the parameter basefreqx is a number from 0 to 1000, which 'fast' is not"),
        ('<bmlt:procanimation id="x" name="swing"><bmlt:parameter name="a" value="much"/></bmlt:procanimation>',
         "the parameter a is a number from -inf to inf, which 'much' is not"),
        ('<head id="x" lexeme="NOD"><bmlt:parameter name="amount" value="7"/></head>',
         "the parameter amount is a number from 0 to 1, which '7' is not"),
        ('<head id="x" lexeme="NOD"><bmlt:parameter name="repetition" value="1e9"/></head>',
         "the parameter r is a number from 0 to 100, which '1e+09' is not"),
        ('<gesture id="x" lexeme="BEAT"><bmlt:parameter name="amount" value="1.5"/></gesture>',
         "the parameter amount is a number from 0 to 1, which '1.5' is not"),
        ('<gesture id="x" lexeme="BEAT"><bmlt:parameter name="postStrokeHoldDuration" value="-3"/></gesture>',
         "the parameter postStrokeHoldDuration is a number from 0 to 600, which '-3' is not"),
        ('<gaze id="x" target="bluebox"><bmlt:parameter name="back" value="-1"/></gaze>',
         "the parameter back is a number from 0 to 1, which '-1' is not"),
        ('<bmlt:noise id="x" type="perlin" joint="tail"/>', "this figure has no tail, which <noise> needs"),
        ('<bmlt:noise id="x" type="white" joint="vl5"/>', "nothing in the binding plays <noise> with type='white'"),
        ('<gesture id="x" lexeme="JUGGLE"/>', "nothing in the binding plays <gesture> with lexeme='JUGGLE'"),
        ('<bmlt:transition id="x" class="Teleport"/>', "no transition is called 'Teleport'; known are SlerpTransition"),
    ],
)  # fmt: skip
async def test_what_cannot_be_played_is_said_with_its_reason_and_the_rest_goes_on(pilot, xml, said) -> None:
    pilot.block("b", f'{xml}<head id="nod" lexeme="NOD"/>')
    await pilot.advance(2)
    assert pilot.feedback.warnings == [("b:x", "CANNOT_CREATE_BEHAVIOR")]
    assert said in told(pilot)
    assert "b:nod:end" in pilot.feedback.progress


async def test_a_name_that_several_files_bear_is_told_with_all_of_them(pilot, tmp_path) -> None:
    (tmp_path / "again").mkdir()
    (tmp_path / "again" / "swing.xml").write_text(SWING)
    pilot.block("b", '<bmlt:procanimation id="x" name="swing"/>')
    await pilot.advance(1)
    assert pilot.feedback.warnings == [("b:x", "CANNOT_CREATE_BEHAVIOR")]
    assert "again/swing.xml, moves/swing.xml" in told(pilot)
