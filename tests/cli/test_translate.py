"""The command translate: what it writes plays as the document does."""

from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.__main__ import main
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import open_pilot

SCRIPT = """
TIME_RESET
BEGIN K_POSE_SEQUENCE
  CHARACTER:Amber
  START:asap
  TIME_WARP:EXP;3
  FADE_OUT:300
  BEGIN K_POSE
    TIME_POINT:+600
    HOLD:133
    BEGIN POSITION_CONSTRAINT
      BODY_GROUP:rarm
      JOINT:r2Dist
      TARGET:-0.131;-0.254;0.157
      FEEDBACK_ID:there
    END
    BEGIN ORIENTATION_CONSTRAINT
      BODY_GROUP:rarm
      JOINT:rhand
      NORMAL:Zaxis
      DIRECTION:0;0;-1
    END
    BEGIN POSE_TARGET
      BODY_GROUP:rhand
      POSE_KEY:hands_ring
    END
    BEGIN LOOK_AT_CONSTRAINT
      BODY_GROUP:headThorax
      TARGET:-2;-1;0.5
    END
    BEGIN MORPH_TARGET
      MORPH_KEY:ExpSmileClosed
      MORPH_VALUE:0.7
    END
  END
END
"""

DRAFT = """
<act><participant id="brad"/><bml>
  <speech id="s"><text>Well, <mark name="w"/>look <tm id="x"/>there.</text></speech>
  <head type="NOD" repeats="2" stroke="s:w"/>
  <gaze target="bluebox" sbm:joint-range="EYES NECK" start="s:x"/>
  <saccade magnitude="-6" direction="30" sbm:duration="0.3" start="s:x+1"/>
</bml></act>
"""


def translated(path: Path, capsys: pytest.CaptureFixture[str]) -> str:
    assert main(["translate", str(path)]) == 0
    return capsys.readouterr().out


async def performance(text: str, *assets: Path) -> tuple[list[str], np.ndarray]:
    async with open_pilot(SceneOptions(voice="text", assets=assets)) as pilot:
        pilot.watch()
        pilot.perform(text)
        await pilot.advance(3)
        (frames,) = pilot.frames.values()
        reports = [f"{message.kind} {message.id} {message.time}" for message in pilot.feedback.messages]
        return reports, np.array([np.concatenate([frame.rotations.ravel(), frame.weights]) for frame in frames])


@pytest.mark.parametrize("script", [SCRIPT, DRAFT])
async def test_a_translation_plays_the_same_frame_by_frame(
    script: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "script"
    path.write_text(script)
    meant = translated(path, capsys)
    assert meant.startswith("<b")
    reports, frames = await performance(script)
    again, other = await performance(meant)
    assert [each for each in reports if "warning" not in each] == [each for each in again if "warning" not in each]
    assert np.array_equal(frames, other)


CLIPS = """
<act><bml>
  <speech id="s"><text>Up <mark name="w"/>with your hands.</text></speech>
  <animation name="Brad@Raise" speed="1.5" stroke="s:w"/>
  <body posture="Brad@Raise" start="2"/>
  <sbm:grab sbm:release-pawn="true" start="1"/>
</bml></act>
"""
MOTION = """SkMotion
channels 1
l_shoulder Quat
frames 3
kt 0 fr 0 0 -0.9
kt 0.2 fr 0 0 0.5
kt 1.5 fr 0 0 -1.5
emphasis time: 0.2
"""


async def test_a_translation_of_clips_of_smartbody_plays_the_same(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "Brad@Raise.skm").write_text(MOTION)
    path = tmp_path / "script"
    path.write_text(CLIPS)
    reports, frames = await performance(CLIPS, tmp_path)
    again, other = await performance(translated(path, capsys), tmp_path)
    assert reports == again
    assert np.array_equal(frames, other)
    assert np.ptp(frames, axis=0).max() > 0.2


def test_accents_and_pauses_of_a_draft_are_still_spoken_in_its_translation(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    accents = '<pitchaccent level="strong" start="s:a" end="s:b"/><boundary start="s:b" end="s:b+0.3"/>'
    path = tmp_path / "script"
    path.write_text(f'<bml id="b"><speech id="s"><tm id="a"/>This, <tm id="b"/>not that.{accents}</speech></bml>')
    path.write_text(translated(path, capsys))
    assert main(["check", str(path)]) == 0
    assert '<ssml:break time="0.3s"/>' in path.read_text()
    assert '<ssml:emphasis level="strong">' in path.read_text()


def test_a_translation_of_a_translation_is_the_same(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "script"
    path.write_text(SCRIPT)
    once = translated(path, capsys)
    path.write_text(once)
    assert translated(path, capsys) == once


def test_problems_are_on_stderr_with_their_lines(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "script.embr"
    path.write_text(SCRIPT.replace("r2Dist", "r9Dist").strip())
    assert main(["translate", str(path), "--name", "greeting"]) == 0
    out, err = capsys.readouterr()
    assert 'id="greeting"' in out
    assert err.startswith(f"{path}:12:7: there is no JOINT r9Dist")


def test_a_document_of_nothing_that_plays_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "script"
    path.write_text("<html/>")
    assert main(["translate", str(path)]) == 1
    assert main(["translate", str(tmp_path / "none")]) == 2
    assert capsys.readouterr().out == ""
